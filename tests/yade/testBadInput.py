# SPDX-License-Identifier: GPL-2.0-or-later
# Wrong input is refused at once: a ValueError (or the error named here) that says what is wrong, the value and what is allowed. Nothing ends the
# process: what can only be seen in a step is refused by an engine outside YADE's parallel loop. Materials: testBrickMat.py.
import math, re, tempfile, unittest

from yade import O, Body, ElastMat, FrictMat, Quaternion, Vector3, utils
from yade.wrapper import ForceResetter, InteractionLoop, NewtonIntegrator
from yade_brick import *
from yade_brick import build

import collapse

nan = float('nan')


def corners(size=Vector3(.2, .2, .2)):
	return [Vector3(sx * size[0], sy * size[1], sz * size[2]) / 2 for sx, sy, sz in build.cornerSigns]


def moved(corner, place):
	given = corners()
	given[corner] = place
	return given


class Refused(unittest.TestCase):

	def setUp(self):
		O.reset()

	tearDown = setUp

	def refused(self, parts, function, *arguments, error=ValueError, **keywords):
		"""The call raises, and the message holds all the parts."""
		with self.assertRaises(error) as caught:
			function(*arguments, **keywords)
		for part in parts:
			self.assertIn(part, str(caught.exception))


class Corners(Refused):

	def wrong(self, parts, given):
		self.refused(parts, Brick, corners=given, contactThickness=.005)
		self.refused(parts, Brick.solidProperties, given)

	def test_number_of_corners(self):
		self.wrong(['7 given', '8'], corners()[:7])
		self.wrong(['9 given', '8'], corners() + corners()[:1])

	def test_not_finite(self):
		self.wrong(['corner 3', 'nan', 'finite'], moved(3, Vector3(nan, 0, 0)))
		self.wrong(['corner 5', 'inf', 'finite'], moved(5, Vector3(0, math.inf, 0)))

	def test_inverted(self):
		self.wrong(['det J', 'inverted', 'order'], corners()[4:] + corners()[:4])

	def test_flat(self):
		self.wrong(['edge', 'has length 0 m', 'longer than'], [Vector3(c[0], c[1], 0) for c in corners()])

	def test_not_convex(self):
		self.wrong(['det J', 'not convex'], moved(6, -.5 * corners()[6]))

	def test_face_that_is_not_planar(self):
		self.wrong(['face 1 is not planar', 'allowed'], moved(6, 1.1 * corners()[6]))

	def test_centre_of_gravity_elsewhere(self):
		self.refused(['0.01', 'centre of gravity', 'solidProperties'], Brick, corners=[c + Vector3(.01, 0, 0) for c in corners()], contactThickness=.005)

	def test_axes_that_are_not_principal(self):
		turn = Quaternion(Vector3(0, 0, 1), .3)
		self.refused(['principal', 'allowed', 'solidProperties'], Brick, corners=[turn * c for c in corners(Vector3(.4, .2, .2))], contactThickness=.005)


class Shape(Refused):

	def test_thickness_of_the_contact_part(self):
		for value in (0, -1, .1, .2, math.inf, nan):
			self.refused(['thickness', '%g' % value, 'above 0', 'below 0.1'], Brick, corners=corners(), contactThickness=value)
		self.refused(['thickness', 'nan'], Brick, corners=corners())

	def test_names(self):
		for name, allowed in (('deformation', 'trilinear'), ('element', 'incompatible'), ('inner', 'inset')):
			self.refused(['Brick.' + name, "'linear'", 'allowed', "'%s'" % allowed], Brick, corners=corners(), contactThickness=.005, **{name: 'linear'})

	def test_segments(self):
		for value in (0, -1, 65, 10**6):
			self.refused(['segments', str(value), '1 to 64'], Brick, corners=corners(), contactThickness=.005, segments=value)

	def test_assignment_is_taken_back(self):
		shape = Brick(corners=corners(), contactThickness=.005)
		for name, wrong in (('deformation', 'linear'), ('contactThickness', .3), ('segments', 0), ('element', ''), ('corners', corners()[:4])):
			before = getattr(shape, name)
			with self.assertRaises(ValueError):
				setattr(shape, name, wrong)
			self.assertEqual(getattr(shape, name), before)

	def test_loaded_deformation_that_is_not_finite(self):
		collapse.build(1, 1)
		O.bodies[1].shape.deformation = 'trilinear'
		O.run(50, True)
		with tempfile.NamedTemporaryFile(suffix='.xml', mode='w+') as file:
			O.save(file.name, quiet=True)
			text = re.sub(r'(<rates[ >].*?<item>)[^<]*', r'\1nan', file.read(), 1, re.S)
			file.seek(0)
			file.write(text)
			file.truncate()
			file.flush()
			self.refused(['rates', 'must be finite'], O.load, file.name, quiet=True)

	def test_elasticity_and_density_that_overflow(self):
		O.engines = [BrickDynamics()]
		for young, density in ((1e308, 1e-300), (1e-300, 1e308)):
			O.bodies.clear()
			O.bodies.append(build.brick((.2, .2, .2), material=BrickMat(young=young, density=density)))
			self.refused(['%g' % young, '%g' % density, 'omega^2'], O.step)
		self.refused(['1e+308', 'overflow'], Brick.stiffness, corners(Vector3(100, 100, 100)), 1e308, .25)

	def test_corners_cannot_be_taken_away(self):
		collapse.build(1, 1)
		self.refused(['corners', 'none given'], setattr, O.bodies[1].shape, 'corners', [])
		O.step()

	def test_corners_without_state(self):
		self.refused(['state', 'None'], Brick(corners=corners(), contactThickness=.005).worldCorners, None)


class Bodies(Refused):

	def wrong(self, parts, **arguments):
		given = dict(size=(.2, .2, .2), material=BrickMat())
		given.update(arguments)
		self.refused(parts, build.brick, **given)

	def test_size(self):
		for size in ((.2, .2, -.2), (.2, 0, .2), (.2, nan, .2), (.2, .2)):
			self.wrong(['size', 'allowed', '> 0'], size=size)

	def test_place(self):
		self.wrong(['center', 'nan', 'finite'], center=(nan, 0, 0))
		self.wrong(['orientation', 'unit'], orientation=Quaternion(0, 0, 0, 0))

	def test_material(self):
		for material in (None, FrictMat()):
			self.wrong(['material', 'BrickMat'], material=material)
		for material in ('no such label', 7):
			self.wrong([repr(material), 'O.materials'], material=material)

	def test_types(self):
		self.wrong(['size', "'wide'"], size='wide')
		self.wrong(['size', '5'], size=5)
		self.wrong(['orientation', '[1, 0, 0, 0]', 'Quaternion'], orientation=[1, 0, 0, 0])
		self.wrong(['corners', 'eight points'], size=None, corners=3)


class Engines(Refused):

	def test_ground_motion(self):
		still = [Vector3.Zero] * 3
		self.refused(['sample 1', 'nan', 'finite'], GroundMotion, dt=.1, acceleration=[still[0], Vector3(nan, 0, 0)])
		self.refused(['1 samples', 'at least 2'], GroundMotion, dt=.1, acceleration=still[:1])
		for value in (0, -.1, nan, math.inf):
			self.refused(['interval', '%g' % value, '> 0'], GroundMotion, dt=value, acceleration=still)
		self.refused(['interval', 'nan'], GroundMotion, acceleration=still)
		self.refused(['first sample', 'nan'], GroundMotion, dt=.1, startTime=nan, acceleration=still)

	def test_ground_motion_in_a_step(self):
		O.engines = [GroundMotion(dt=.1)]
		self.refused(['acceleration', 'no samples'], O.step)
		O.engines = [GroundMotion(dt=.1, acceleration=[Vector3.Zero] * 2, ids=[3])]
		self.refused(['no body #3'], O.step)

	def test_ranges(self):
		for value in (-.1, 1, nan):
			self.refused(['damping', '%g' % value, '[0, 1)'], BrickDynamics, damping=value)
		for value in (0, 1.5, nan):
			self.refused(['safety', '%g' % value, '(0, 1]'], BrickTimeStepper, safety=value)
		self.refused(['tolerance', '-1', '>= 0'], MortarJoints, tolerance=-1)
		self.refused(['tolerance', 'inf', 'finite'], MortarJoints, tolerance=math.inf)
		self.refused(['normal', 'nan', 'finite'], MortarJoints, normal=Vector3(nan, 0, 0))
		self.refused(['gravity', 'nan', 'finite'], StaticEquilibrium, gravity=Vector3(0, nan, -9.8))


class Joints(Refused):

	def scene(self):
		"""Two by two bricks without joints."""
		collapse.build(2, 2)
		O.interactions.clear()

	def lay(self):
		MortarJoints()()

	def test_strengths_are_required(self):
		for name in ('tensileStrength', 'cohesion', 'frictionAngle', 'compressiveStrength'):
			self.scene()
			setattr(O.materials[0].mortar, name, nan)
			self.refused([name, 'not given'], self.lay)

	def test_mortar_thicker_than_both_contact_parts(self):
		self.scene()
		O.materials[0].mortar.thickness = .011
		self.refused(['0.011', 'brick #2', '0.005', 'at most twice'], self.lay)

	def test_bricks_of_different_mortar(self):
		self.scene()
		O.bodies[2].material = BrickMat(mortar=Mortar(tensileStrength=1, cohesion=1, frictionAngle=.1, compressiveStrength=1e6))
		self.refused(['#1', '#2', 'different mortar'], self.lay)

	def test_mortar_between_unlike_bricks_needs_its_own_elasticity(self):
		self.scene()
		O.materials[0].mortar.thickness = .002
		O.bodies[2].material = BrickMat(young=2 * O.materials[0].young, mortar=O.materials[0].mortar)
		self.refused(['#1', '#2', 'Mortar.young'], self.lay)

	def test_supports(self):
		for material in (None, ElastMat()):
			self.scene()
			O.bodies[0].material = material
			self.refused(['support #0', 'FrictMat'], self.lay)
		self.scene()
		O.bodies[0].shape.axis = 3
		self.refused(['Wall #0', 'axis 3', '0, 1 and 2'], self.lay)
		self.scene()
		O.bodies.append(utils.box(center=(0, 0, -1), extents=(1, 1, 0), material=O.materials[0]))
		self.refused(['Box #5', '1 1 0', 'above 0'], self.lay)

	def test_place_that_is_not_finite(self):
		self.scene()
		O.bodies[2].state.pos = Vector3(nan, 0, 0)
		self.refused(['Brick #2', 'not finite'], self.lay)

	def test_loop_without_the_functors_of_joints(self):
		parts = ([Ig2_Brick_Brick_BrickGeom, Ig2_Wall_Brick_BrickGeom], [Ip2_BrickMat_BrickMat_BrickPhys], [Law2_BrickGeom_BrickPhys_Mortar])
		for missing in [functor for part in parts for functor in part]:
			self.scene()
			O.engines = [InteractionLoop(*[[functor() for functor in part if functor is not missing] for part in parts])]
			self.refused([missing.__name__, 'InteractionLoop', '#'], self.lay)
			O.engines = [ForceResetter(), InteractionLoop(*[[functor() for functor in part] for part in parts]), BrickDynamics(), NewtonIntegrator()]
			self.lay()
			O.step()

	def test_equilibrium_of_what_is_not_finite(self):
		for change, parts in (
		        (lambda: setattr(O.bodies[2].state, 'mass', nan), ['#2', 'mass nan']),
		        (lambda: setattr(O.bodies[2].state, 'pos', Vector3(0, math.inf, 0)), ['#2', 'place']),
		        (lambda: O.forces.setPermF(3, Vector3(nan, 0, 0)), ['#3', 'force'])
		):
			collapse.build(2, 2)
			change()
			self.refused(parts, StaticEquilibrium(gravity=(0, 0, -9.8)))

	def test_brick_without_corners(self):
		self.scene()
		bare = Body()
		bare.shape, bare.material = Brick(), O.materials[0]
		O.bodies.append(bare)
		self.refused(['#5', 'no corners'], self.lay)

	def test_brick_of_another_material(self):
		self.scene()
		O.bodies[2].material = FrictMat()
		self.refused(['#2', 'BrickMat'], self.lay)

	def test_record_leaves_out_joints_that_have_failed_before(self):
		collapse.build(2, 2)
		O.step()
		count = JointRecord().segmentCount()
		O.bodies[4].state.vel = Vector3(0, 0, 20)
		while len([i for i in O.interactions if i.isReal and i.phys.segmentState and not i.phys.jointed]) == 0 and O.iter < 1000:
			O.step()
		record = JointRecord()
		record.update()
		record.marks()
		self.assertLess(record.segmentCount(), count)

	def test_energies_before_the_first_step(self):
		collapse.build(2, 2)
		self.refused(['first step'], restState, error=RuntimeError)

	def test_loads_and_frequencies(self):
		collapse.build(2, 2)
		O.step()
		assembly = assembled()
		self.refused(['load 3', 'finite'], assembly.solve, [0, 0, 0, nan] + [0] * (assembly.source.size - 4))
		self.refused(['loads', 'x'], assembly.solve, 'x')
		self.refused(['count', '1.5'], assembly.frequencies, 1.5)

	def test_stresses_before_the_first_step(self):
		collapse.build(2, 2)
		phys, geom = [(i.phys, i.geom) for i in O.interactions][0]
		for read in (phys.normalStress, phys.shearStress, phys.segmentPoints):
			self.refused(['first step'], read, geom, error=RuntimeError)
			self.refused(['geom', 'None'], read, None)


	def test_stresses_of_other_geometry_and_of_a_scene_that_is_gone(self):
		collapse.build(2, 2)
		O.step()
		(phys, geom), (_, other) = [(i.phys, i.geom) for i in O.interactions][:2]
		phys.elasticEnergy(geom)
		for read in (phys.normalStress, phys.shearStress, phys.segmentPoints, phys.elasticEnergy):
			self.refused(['one interaction'], read, other)
		assembly = assembled()
		O.reset()
		self.refused(['present scene'], phys.elasticEnergy, geom)
		self.refused(['#1', 'gone'], assembly.source.nodalMap, 1)

	def test_cells_of_a_brick_with_joints(self):
		collapse.build(2, 2)
		refined = next(b for b in O.bodies if isinstance(b.shape, Brick) and b.shape.deformation == 'refined')
		self.refused(['joints', 'cells'], setattr, refined.shape, 'deformation', 'trilinear')
		O.step()


class Steps(Refused):
	"""What only a step can see. Without joints, so that YADE's loop meets the body first."""

	def scene(self):
		collapse.build(2, 2)
		O.interactions.clear()

	def test_brick_without_corners(self):
		self.scene()
		bare = Body()
		bare.shape, bare.material = Brick(), O.materials[0]
		O.bodies.append(bare)
		self.refused(['#5', 'no corners'], O.step)

	def test_brick_of_another_material_or_none(self):
		for material in (FrictMat(), None):
			for place in (1, 4):
				self.scene()
				O.bodies[place].material = material
				self.refused(['#%d' % place, 'BrickMat'], O.step)

	def test_mass_and_inertia(self):
		for name, value in (('mass', 0), ('mass', nan), ('inertia', Vector3(1, 1, 0))):
			self.scene()
			setattr(O.bodies[2].state, name, value)
			self.refused(['#2', 'must be positive'], O.step)

	def test_place_or_velocity_that_is_no_number(self):
		collapse.build(2, 2)
		O.bodies[2].state.pos = Vector3(nan, 0, 0)
		self.refused(['not finite', 'step 0'], O.step, error=RuntimeError)
		collapse.build(2, 2)
		O.bodies[2].state.vel = Vector3(0, nan, 0)
		self.refused(['not finite', 'step 1'], O.run, 3, True, error=RuntimeError)

	def test_error_in_a_run_stops_it_and_reaches_the_script(self):
		self.scene()
		O.run(5, True)
		O.bodies[2].state.mass = 0
		self.refused(['#2', 'must be positive'], O.run, 5, True, error=RuntimeError)
		self.assertEqual(O.iter, 5)
