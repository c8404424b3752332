# SPDX-License-Identifier: GPL-2.0-or-later
# Files for ParaView, which meshio writes, read back by VTK's own reader, which ParaView uses: every array against the scene, and the shapes of the cells.
import math, os, shutil, tempfile, unittest

from yade import *
from yade import Quaternion, Vector3
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from testSnapshot import couplet
from yade_brick import brick, build, engines, loop, paraview, SegmentRecord, VtkRecorder

phi = math.radians(32)


def adobe(strength=1):
	mortar = Mortar(tensileStrength=4.6e3 * strength, cohesion=2.9e3 * strength, frictionAngle=phi, compressiveStrength=4.9e5 * strength)
	return BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=phi, mortar=mortar)


def scene(bodies, strength=1e3, **options):
	"""Bodies on a floor (body 0) with mortar, at rest under their weight where all are joined."""
	O.reset()
	clay = adobe(strength)
	O.bodies.append(utils.wall(0, axis=2, sense=1, material=clay))
	found = bodies(clay)
	O.bodies.append(found)
	O.engines = engines(**options)
	MortarJoints()()
	if all(body.material.mortar for body in found):
		StaticEquilibrium()()
	O.step()
	return found


def column(clay, **options):
	return [brick((.2, .2, .2), center=(0, 0, .1 + .2 * k), material=clay, contactThickness=1e-3, **options) for k in range(3)]


class Read:
	"""A .vtu file as VTK reads it."""

	def __init__(self, path):
		reader = vtkXMLUnstructuredGridReader()
		reader.SetFileName(path)
		reader.Update()
		self.grid = reader.GetOutput()
		self.points = vtk_to_numpy(self.grid.GetPoints().GetData()) if self.grid.GetNumberOfPoints() else np.empty((0, 3))
		self.pointData, self.cellData = self.arrays(self.grid.GetPointData()), self.arrays(self.grid.GetCellData())

	@staticmethod
	def arrays(data):
		return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}

	@property
	def cells(self):
		"""Points of each cell."""
		return [self.points[self.nodes(self.grid.GetCell(i).GetPointIds())] for i in range(self.grid.GetNumberOfCells())]

	@staticmethod
	def nodes(ids):
		return [ids.GetId(k) for k in range(ids.GetNumberOfIds())]

	@property
	def kinds(self):
		return {self.grid.GetCellType(i) for i in range(self.grid.GetNumberOfCells())}


hexahedron, quad = 12, 9  # VTK's numbers


class Written(unittest.TestCase):

	def setUp(self):
		self.folder = tempfile.mkdtemp()
		self.addCleanup(shutil.rmtree, self.folder)
		self.name = os.path.join(self.folder, 'out', 'wall')

	def frame(self, **options):
		return [Read(path) for path in VtkRecorder(self.name, **options)()]


def array(vectors):
	return np.array([tuple(vector[i] for i in range(3)) for vector in vectors])


def tensors(symmetric):
	"""Tensors (n, 3, 3) from their components as VTK and ParaView order them: XX YY ZZ XY YZ XZ."""
	return symmetric[:, [0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(-1, 3, 3)


class Bricks(Written):

	def test_corners_displacement_and_velocity_are_the_scenes(self):
		bodies = scene(column)
		bodies[2].state.pos += Vector3(.01, 0, .02)
		bodies[2].state.ori = Quaternion((1, 2, 3), .3) * bodies[2].state.ori
		bodies[2].state.vel, bodies[2].state.angVel = Vector3(1, 2, 3), Vector3(.5, -.2, .7)
		read, *_ = self.frame(joints=False)
		self.assertEqual(read.kinds, {hexahedron})
		for place, body in enumerate(bodies):
			now = array(body.shape.worldCorners(body.state))
			np.testing.assert_allclose(read.cells[place], now, atol=1e-14)  # lengths below 1 m
			laid = array(body.state.refPos + body.state.refOri * corner for corner in body.shape.corners)
			np.testing.assert_allclose(read.pointData['displacement'][8 * place:8 * place + 8], now - laid, atol=1e-14)
			arms = now - array([body.state.pos])
			rigid = array([body.state.vel]) + np.cross(array([body.state.angVel])[0], arms)
			# the bricks are at rest but for that: rates of round-off, by 1e-9 J of a brick of 14 kg
			np.testing.assert_allclose(read.pointData['velocity'][8 * place:8 * place + 8], rigid, atol=1e-5)

	def test_hexahedra_are_not_inside_out_and_have_the_bricks_volume(self):
		corners = [(x * (1.3 if z < 0 else 1), y, z) for x, y, z in build.cornerSigns]
		clay = adobe()
		O.reset()
		O.bodies.append([brick((.25, .12, .06), material=clay), brick(corners=corners, material=clay, orientation=Quaternion((1, 1, 0), 2))])
		quality = vtkMeshQuality()
		read, *_ = self.frame(joints=False)
		quality.SetInputData(read.grid)
		for measure, expected in (('Volume', [body.shape.volume for body in O.bodies]), ('ScaledJacobian', None)):
			getattr(quality, f'SetHexQualityMeasureTo{measure}')()
			quality.Update()
			got = vtk_to_numpy(quality.GetOutput().GetCellData().GetArray('Quality'))
			self.assertGreater(got.min(), .5 if expected is None else 0)
			if expected:
				np.testing.assert_allclose(got, expected, rtol=1e-12)

	def test_stress_of_a_column_is_its_weight_by_its_area(self):
		scene(column, gravity=(0, 0, -9.8))
		read, *_ = self.frame(joints=False)
		stress = tensors(read.cellData['stress'])
		expected = [-1800 * 9.8 * .2 * (2.5 - k) for k in range(3)]
		# friction at the floor and mean of the inset part: some percent; the upper faces of each see the same
		np.testing.assert_allclose(stress[:, 2, 2], expected, rtol=.03)
		np.testing.assert_allclose(read.cellData['principalStress'][:, 2], stress[:, 2, 2], rtol=1e-6)
		self.assertTrue((np.abs(stress[:, 2, 2]) > 5 * np.abs(stress[:, 0, 1])).all())

	def test_stress_turns_with_its_brick_and_principal_stress_does_not(self):
		bodies = scene(column)
		turn = Quaternion((1, 2, 3), .8)
		upright, *_ = self.frame(joints=False)
		for body in bodies:
			body.state.ori = turn * body.state.ori
		turned, *_ = self.frame(joints=False)
		R = np.array([[turn.toRotationMatrix()[i, j] for j in range(3)] for i in range(3)])
		before, after = (tensors(read.cellData['stress']) for read in (upright, turned))
		size = np.abs(before).max()
		np.testing.assert_allclose(after, R @ before @ R.T, atol=1e-12 * size)
		np.testing.assert_allclose(turned.cellData['principalStress'], upright.cellData['principalStress'], atol=1e-12 * size)
		local = [[body.shape.stress()[i] for i in range(6)] for body in bodies]  # xx yy zz xy yz zx; bricks were along the axes
		np.testing.assert_allclose(upright.cellData['stress'], local, atol=1e-12 * size)

	def test_numbers_of_bricks_are_the_scenes(self):
		bodies = scene(lambda clay: column(clay) + [brick((.2, .2, .2), center=(1, 0, .5), material=clay, fixed=True, deformation='rigid')])
		bodies[1].state.vel, bodies[1].state.angVel = Vector3(0, 1, 0), Vector3(0, 0, 2)
		read, *_ = self.frame(joints=False, brickData={'course': lambda body: round(body.state.pos[2] / .2)})
		data = read.cellData
		self.assertEqual(data['id'].tolist(), [body.id for body in bodies])
		self.assertEqual(data['level'].tolist(), [2, 2, 2, 0])
		self.assertEqual(data['fixed'].tolist(), [0, 0, 0, 1])
		self.assertEqual(data['course'].tolist(), [round(body.state.pos[2] / .2) for body in bodies])
		np.testing.assert_allclose(data['elasticEnergy'], [body.shape.elasticEnergy() for body in bodies], rtol=1e-12)
		# m v^2 / 2 and I w^2 / 2 of a cube of 14.4 kg, I = m a^2 / 6; the deformation is at rest
		self.assertAlmostEqual(data['kineticEnergy'][1], 14.4 / 2 + 14.4 * .04 / 6 * 4 / 2, places=6)

	def test_stable_steps_of_bricks_are_above_that_of_the_scene(self):
		bodies = scene(column)
		stepper = loop.Loop(O.engines).stepper
		read, *_ = self.frame(joints=False)
		self.assertAlmostEqual(read.cellData['stableStep'].min() / stepper.limit, 1, places=12)
		self.assertEqual(read.cellData['id'][read.cellData['limiting'] == 1].tolist(), [stepper.limitingBrick])
		self.assertEqual(stepper.stableStep(0), math.inf)
		with self.assertRaisesRegex(IndexError, 'no body #7'):
			stepper.stableStep(7)

	def test_surface_of_a_refined_brick_is_closed_and_looks_outward(self):
		for cells in (2, 3):
			bodies = scene(lambda clay: [brick((.3, .2, .1), center=(0, 0, .05), material=clay, deformation='refined', cells=cells, segments=6)])
			read, *_ = self.frame(joints=False)
			self.assertEqual((read.kinds, len(read.cells)), ({quad}, 6 * cells**2))
			np.testing.assert_allclose(read.points[:8], array(bodies[0].shape.worldCorners(bodies[0].state)), atol=1e-14)
			# volume by the divergence theorem; the weight deforms it by 1e-4
			areas = [.5 * np.cross(cell[2] - cell[0], cell[3] - cell[1]) for cell in read.cells]
			volume = sum(area @ cell.mean(axis=0) for area, cell in zip(areas, read.cells)) / 3
			self.assertAlmostEqual(volume, bodies[0].shape.volume, delta=1e-3 * bodies[0].shape.volume)
			np.testing.assert_allclose(sum(areas), 0, atol=1e-15)
			self.assertLess(np.abs(read.pointData['displacement']).max(), 1e-4)

	def test_velocities_of_nodes_are_differences_of_places(self):
		for options in (dict(), dict(deformation='refined', cells=2)):
			bodies = scene(lambda clay: column(clay, **options))
			for body in bodies:
				body.state.vel, body.state.angVel = Vector3(.3, 0, .5), Vector3(0, 1, 0)
			O.run(20, True)
			before = array(bodies[1].shape.worldCorners(bodies[1].state))
			O.step()
			after = array(bodies[1].shape.worldCorners(bodies[1].state))
			got = array(bodies[1].shape.worldVelocities(bodies[1].state))
			state = bodies[1].state
			deforming = got[:8] - array([state.vel]) - np.cross(array([state.angVel])[0], after - array([state.pos]))
			self.assertGreater(np.abs(deforming).max(), 1e-3)
			# of the middle of the step: turning by 1 rad/s in a step of 1e-4 s
			np.testing.assert_allclose(got[:8], (after - before) / O.dt, atol=.1 * np.abs(deforming).max())


class Joints(Written):

	def test_segments_tile_the_joint_where_the_library_says(self):
		scene(lambda clay: build.englishBondWall(2, 2, (.2, .2, .2), material=clay, contactThickness=1e-3).bodies)
		_, read = self.frame(contacts=False)
		pair, place = read.cellData['id1'] * 1000 + read.cellData['id2'], 0
		for interaction in (i for i in O.interactions if i.phys.jointed):
			phys, geom = interaction.phys, interaction.geom
			these = np.flatnonzero(pair == interaction.id1 * 1000 + interaction.id2)
			self.assertEqual(read.cellData['segment'][these].tolist(), list(range(len(phys.segmentArea))))
			corners = np.array(read.cells)[these]
			areas = np.linalg.norm(.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]), axis=1)
			np.testing.assert_allclose(areas, phys.segmentArea, rtol=1e-3)  # faces are strained by 1e-4
			np.testing.assert_allclose(corners.mean(axis=1), array(phys.segmentPoints(geom)), atol=1e-12)
			for name, values in (('opening', phys.opening(geom)), ('normalStress', phys.normalStress(geom)), ('utilisation', phys.utilisation(geom))):
				np.testing.assert_allclose(read.cellData[name][these], values, rtol=1e-12, err_msg=name)
			for name, values in (('slip', phys.slip(geom)), ('shearStress', phys.shearStress(geom))):
				np.testing.assert_allclose(read.cellData[name][these], array(values), rtol=1e-12, err_msg=name)
			np.testing.assert_allclose(read.cellData['normal'][these], np.tile(array([geom.normal]), (len(these), 1)), atol=1e-14)
			place += len(these)
		self.assertEqual(place, len(pair))

	def rigidCouplet(self, by, **strengths):
		"""The upper of two rigid bricks moved by a vector [m], and a step in which the joint sees that."""
		wall = couplet(**{**dict(tensileStrength=1e6), **strengths})
		for body in wall.bodies:
			body.shape.deformation = 'rigid'
		loop.Loop(O.engines).dynamics.levelTime = 0
		O.step()
		wall.bodies[1].state.pos = Vector3(.1, .1, .3) + Vector3(*by)
		wall.bodies[1].state.vel = Vector3(0, 0, 0)
		O.step()
		return wall

	def test_opening_and_slip_are_what_was_imposed(self):
		self.rigidCouplet((1e-4, -2e-4, 3e-4))
		_, read, _ = self.frame()
		data = read.cellData
		np.testing.assert_allclose(data['opening'], 3e-4, atol=1e-9)  # round-off, and what the step before has moved
		np.testing.assert_allclose(data['slip'], np.tile([1e-4, -2e-4, 0], (4, 1)), atol=1e-9)
		np.testing.assert_allclose(data['normal'], np.tile([0, 0, 1], (4, 1)), atol=1e-12)
		# springs of two half bricks, eqs. (3) and (5): kn = E / ((1 - nu^2) l), ks = E / (2 (1 + nu) l), l = 0.2 m
		kn, ks = 9.8e6 / (1 - .25**2) / .2, 9.8e6 / 2.5 / .2
		np.testing.assert_allclose(data['normalStress'], kn * 3e-4, rtol=1e-5)
		np.testing.assert_allclose(data['shearStress'], np.tile([ks * 1e-4, -ks * 2e-4, 0], (4, 1)), rtol=1e-5, atol=1e-3)
		np.testing.assert_allclose(data['utilisation'], kn * 3e-4 / 1e6, rtol=1e-5)
		np.testing.assert_allclose(read.pointData['displacement'], np.tile([.5e-4, -1e-4, 1.5e-4], (16, 1)), atol=1e-7)

	def test_slip_on_a_support_is_of_the_brick_whatever_the_ids(self):
		clay = adobe(1e3)
		for floorFirst in (True, False):
			O.reset()
			floor, body = utils.wall(0, axis=2, sense=1, material=clay), brick((.2, .2, .2), center=(0, 0, .1), material=clay, deformation='rigid')
			O.bodies.append([floor, body] if floorFirst else [body, floor])
			O.engines = engines(gravity=0)
			MortarJoints()()
			O.step()
			body.state.pos = Vector3(1e-4, 0, .1 + 2e-4)
			O.step()
			record = SegmentRecord()
			record.update()
			self.assertEqual(set(map(tuple, record.bodies.tolist())), {(floor.id, body.id)})
			np.testing.assert_allclose(record.slip, np.tile([1e-4, 0, 0], (len(record), 1)), atol=1e-9)
			np.testing.assert_allclose(record.opening, 2e-4, atol=1e-9)
			np.testing.assert_allclose(record.normal, np.tile([0, 0, 1], (len(record), 1)), atol=1e-12)

	def test_segments_of_a_joint_that_is_gone_stay_on_the_lower_brick(self):
		wall = self.rigidCouplet((0, 0, 0), tensileStrength=1e3)
		recorder = VtkRecorder(self.name)
		recorder()
		wall.bodies[1].state.vel = Vector3(0, 0, .05)
		while O.interactions[0, 1].phys.jointed:
			recorder.look()
			O.step()
		_, now, _ = [Read(path) for path in recorder()]
		self.assertEqual((set(now.cellData['state']), set(now.cellData['joined'])), ({1}, {0}))
		lower, upper = wall.bodies
		# it breaks when 2e-5 m wide; joints are seen as they were a step, 1e-6 m, before
		np.testing.assert_allclose(now.cellData['opening'], upper.state.pos[2] - lower.state.pos[2] - .2, atol=3e-6)
		lower.state.pos, upper.state.pos = lower.state.pos + Vector3(1, 0, 0), upper.state.pos + Vector3(1, 0, .05)
		_, read, contacts = [Read(path) for path in recorder()]
		np.testing.assert_allclose(read.points, now.points + [1, 0, 0], atol=1e-12)
		np.testing.assert_allclose(read.points[:, 2], .2, atol=1e-4)  # the face of the lower brick, but for a step of 1 m/s
		np.testing.assert_allclose(read.cellData['opening'] - now.cellData['opening'], .05, atol=1e-12)
		self.assertEqual(np.abs(read.cellData['normalStress']).max(), 0)
		self.assertEqual(set(contacts.pointData) | set(contacts.cellData), set(paraview.contactMesh().cell_data))
		# a brick that is erased leaves its segments where they were
		O.bodies.erase(1)
		_, last, _ = [Read(path) for path in recorder()]
		np.testing.assert_allclose(last.points, read.points, atol=1e-12)

	def test_modes_are_known_as_long_as_contact_follows_and_unseen_after(self):
		wall = self.rigidCouplet((0, 0, 0), cohesion=1, tensileStrength=1e6)
		seen, blind = SegmentRecord(), SegmentRecord()
		seen.update(), blind.update()
		wall.bodies[1].state.vel = Vector3(2, 0, 0)
		while O.interactions.has(0, 1) and O.interactions[0, 1].phys.jointed:
			O.step()
		seen.update()
		self.assertEqual(set(seen.state), {2})
		wall.bodies[1].state.pos += Vector3(0, 0, 1)
		for _ in range(3):
			O.step()
		seen.update(), blind.update()
		self.assertEqual((set(seen.state), set(blind.state)), ({2}, {4}))

	def test_looks_between_frames_see_how_segments_fail(self):
		wall = self.rigidCouplet((0, 0, 0), tensileStrength=1e3)
		recorder = VtkRecorder(self.name, contacts=False)
		recorder()
		wall.bodies[1].state.vel = Vector3(0, 0, 1)
		while O.interactions.has(0, 1) and O.interactions[0, 1].isReal:
			O.step()
			recorder.look()
		_, read = [Read(path) for path in recorder()]
		self.assertEqual(set(read.cellData['state']), {1})
		self.assertEqual(len(paraview.readPvd(f'{self.name}-joints.pvd')), 2)

	def test_properties_of_segments_need_a_step_and_their_own_geometry(self):
		wall = couplet()
		phys = O.interactions[0, 1].phys
		for read in (phys.opening, phys.slip, phys.utilisation, phys.segmentOutlines, phys.segmentTable):
			with self.assertRaisesRegex(ValueError, 'geom is None'):
				read(None)


class Contacts(Written):

	def test_forces_are_those_on_the_second_body(self):
		dry = BrickMat(young=9.8e6, density=1800, frictionAngle=phi)
		scene(lambda clay: [brick((.2, .2, .2), center=(0, 0, .1), material=dry)], gravity=(0, 0, -9.8))
		newton = loop.Loop(O.engines).newton
		newton.damping = .5
		O.run(3000, True)
		_, joints, read = self.frame()
		self.assertEqual((joints.grid.GetNumberOfCells(), read.grid.GetNumberOfCells()), (0, 1))
		onBrick = read.cellData['force'][0] * (1 if read.cellData['id2'][0] == 1 else -1)
		np.testing.assert_allclose(onBrick, [0, 0, 14.4 * 9.8], atol=.02 * 14.4 * 9.8)  # nearly at rest
		np.testing.assert_allclose(read.cellData['normalForce'] + read.cellData['shearForce'], read.cellData['force'])
		np.testing.assert_allclose(read.points[0], [0, 0, 0], atol=1e-3)
		self.assertAlmostEqual(read.cellData['area'][0], .04, delta=1e-5)  # the brick bulges by 1e-5 of its edge


class Series(Written):

	def test_frames_have_the_simulated_time_and_the_same_arrays(self):
		wall = couplet()
		recorder, times, names = VtkRecorder(self.name), [], []
		wall.bodies[1].state.vel = Vector3(0, 0, 1)
		for _ in range(3):
			files = recorder()
			times.append(O.time)
			names.append([(sorted(read.pointData), sorted(read.cellData)) for read in map(Read, files)])
			O.run(200, True)
		self.assertEqual(names[1:], names[:-1])
		for kind in ('bricks', 'joints', 'contacts'):
			frames = paraview.readPvd(f'{self.name}-{kind}.pvd')
			self.assertEqual([time for time, _ in frames], times)
			for _, file in frames:
				self.assertTrue(os.path.exists(os.path.join(os.path.dirname(self.name), file)))
		with open(f'{self.name}-bricks.pvd') as file:
			self.assertIn('<VTKFile type="Collection"', file.read())

	def test_frame_of_the_same_time_is_replaced(self):
		couplet()
		recorder = VtkRecorder(self.name)
		recorder(), recorder()
		self.assertEqual(len(paraview.readPvd(f'{self.name}-bricks.pvd')), 1)

	def test_continued_run_goes_on_with_its_series_and_its_failed_joints(self):
		wall = couplet()
		recorder = VtkRecorder(self.name)
		wall.bodies[1].state.vel = Vector3(0, 0, 1)
		times = []
		for _ in range(4):
			recorder()
			times.append(O.time)
			O.run(500, True)
		saved = os.path.join(self.folder, 'half.yade.gz')
		O.save(saved)
		states = recorder.segments.state.copy()
		self.assertFalse(O.interactions.has(0, 1) and O.interactions[0, 1].isReal)
		O.run(500, True)
		recorder()
		O.load(saved)
		again = VtkRecorder(self.name, resume=True)
		_, joints, _ = again()
		self.assertEqual([time for time, _ in paraview.readPvd(f'{self.name}-joints.pvd')], times + [O.time])
		self.assertEqual(Read(joints).cellData['state'].tolist(), states.tolist())
		np.testing.assert_allclose(Read(joints).points[:, 2], .2, atol=1e-3)
		# without asking for it a new series begins
		VtkRecorder(self.name)()
		self.assertEqual(len(paraview.readPvd(f'{self.name}-joints.pvd')), 1)

	def test_file_that_cannot_be_finished_leaves_the_one_before(self):
		path = os.path.join(self.folder, 'file')
		with open(path, 'w') as file:
			file.write('before')
		with self.assertRaises(KeyError):
			with paraview._replacing(path) as unfinished:
				with open(unfinished, 'w') as file:
					file.write('half')
				raise KeyError
		with open(path) as file:
			self.assertEqual((file.read(), os.listdir(self.folder)), ('before', ['file']))

	def test_wrong_arguments_are_told(self):
		couplet()
		for call, text in (
		        (lambda: VtkRecorder(''), "name is ''"), (lambda: VtkRecorder(3), 'name is 3'), (lambda: VtkRecorder('out/'), 'name is'),
		        (lambda: VtkRecorder('a', joints=1), 'joints is 1'), (lambda: VtkRecorder('a', brickData={'x': 3}), 'brickData is'),
		):
			with self.assertRaisesRegex(ValueError, text):
				call()
		O.reset()
		with self.assertRaisesRegex(ValueError, 'no brick'):
			VtkRecorder(self.name)()
		path = os.path.join(self.folder, 'x.pvd')
		with open(path, 'w') as file:
			file.write('no xml')
		with self.assertRaisesRegex(ValueError, 'x.pvd is no .pvd file'):
			paraview.readPvd(path)
