# SPDX-License-Identifier: GPL-2.0-or-later
# One brick of n^3 elements (deformation='refined') against the same mesh solved independently and against elasticity: what it gains, in statics and in
# the engine loop.
import unittest

from cases import *
from mesh import *
from testCube import CUBE_YOUNG, EDGE, NAMES, RATIOS, TITLES, WEIGHT
from yade_brick import assembled

GROUP = 'Refined bricks'
STIFF = 1e5  # of the glue under the cube over the brick's own
GLUE = 'what the glue gives way, 1e-7; round-off of springs so stiff; printed with eight digits'


def cube(n, poisson, element):
	"""A refined cube glued to the ground; its body."""
	clay = material(young=CUBE_YOUNG, poisson=poisson, density=1800, mortar=Mortar(**UNBREAKABLE))
	ground(clay)
	b = add(
	        (EDGE,) * 3, center=(0, 0, EDGE / 2), material=clay, deformation='refined', cells=n, segments=2 * n, element=element, inner='full',
	        contactThickness=1e-4
	)
	MortarJoints(mortar=Mortar(thickness=2e-4, young=STIFF * CUBE_YOUNG, poisson=poisson, **UNBREAKABLE))()
	return b


def surface(structure, b):
	"""Places of the nodes of a brick's surface at rest, in the brick's axes, from how they move as it turns: (nodes, 3) [m]."""
	turns = structure.nodalMap(b.id)[:, 3:6].reshape(-1, 3, 3)  # -[x]
	return np.array([(t[1, 2], -t[0, 2], t[0, 1]) for t in turns])


class RefinedCube(Case):

	def pressed(self, n, poisson, element):
		"""Change of width at a top corner, settlements of the top: mean and at a corner [m]; under an even pressure."""
		b = cube(n, poisson, element)
		structure = assembled()
		nodal, x = structure.nodalMap(b.id), surface(structure, b)
		top = np.isclose(x[:, 2], EDGE / 2)
		share = np.where(top, 1., 0.) / n**2
		for k in (0, 1):
			share[np.isclose(abs(x[:, k]), EDGE / 2)] /= 2
		load = np.zeros(nodal.shape[0])
		load[2::3] = -WEIGHT * share
		q = structure.solve(nodal.T @ load)  # the cube is the only brick, so its coordinates are all there are
		u = (nodal @ q).reshape(-1, 3)
		return dict(corner=u[5, 0] - u[4, 0], uz_avg=share @ u[:, 2], uz_corner=u[4, 2])

	def test_statics_is_that_of_the_mesh(self):
		"""The Poisson cube (0.1 m, E = 9.8e7 Pa, 200 N as an even pressure, base fixed) as one brick of n^3 elements, the insides condensed, on stiff glue. Static
		condensation is exact, so it has to be the mesh of n^3 hexahedra, solved independently, of all three elements."""
		for tag, poisson in RATIOS.items():
			for name, element in ELEMENTS.items():
				for n in (1, 2, 4) if name == 'full' else (2,):
					if n == 2 or name == 'full':
						O.reset()
						got, expected = self.pressed(n, poisson, element), reference('t2.mesh.%s.n%d.%s' % (name, n, tag))
						for quantity, key in (('corner', 'top_corner'), ('uz_avg', 'uz_avg'), ('uz_corner', 'uz_corner')):
							label = 'nu %g, %s, %d^3: %s [m]' % (poisson, TITLES[name], n, NAMES[key])
							self.judge(label, got[quantity], expected[quantity], 1e-6, GLUE)

	def test_error_of_one_brick_with_cells(self):
		"""Distance of that brick from converged elasticity, n = 1 to 8 elements along an edge: width at a top corner with incompatible elements. One element is
		8 to 32 % off, eight are below 0.3 %: a brick can be as accurate as one likes."""
		for tag, poisson in RATIOS.items():
			truth, errors = reference('t2.truth.unif.%s.top_corner' % tag), []
			for n in (1, 2, 4, 8):
				O.reset()
				got = self.pressed(n, poisson, 'incompatible')['corner']
				self.compare('nu %g, %d^3: %s [m]' % (poisson, n, NAMES['top_corner']), got, truth, 'of the mesh')
				errors.append(abs(got / truth - 1))
			axes = dict(xLabel='elements along an edge', yLabel='relative error', logX=True, logY=True)
			self.curve('Refined cube, error of %s' % NAMES['top_corner'], 'nu %g' % poisson, (1, 2, 4, 8), errors, **axes)
			self.atMost('nu %g, 8^3: error of the width' % poisson, errors[-1], .003, 'the edge of the base is singular, as for the mesh (testCube)')


class RefinedInTheLoop(Case):

	def column(self, cells):
		"""Three bonded cubes on the ground under their weight and a force aside on the uppermost."""
		clay = material(mortar=Mortar(**UNBREAKABLE))
		ground(clay)
		self.bricks = [
		        add((.2,) * 3, center=(0, 0, .2 * k + .1), material=clay, deformation='refined', cells=cells, segments=2 * cells, contactThickness=2e-3) for k in range(3)
		]
		MortarJoints()()
		O.forces.setPermF(self.bricks[-1].id, (20, 5, 0))
		engines()

	def corners(self):
		return np.array([tuple(c) for b in self.bricks for c in b.shape.worldCorners(b.state)])

	def test_damped_loop_comes_to_rest_where_the_direct_solution_is(self):
		"""A column of three bonded bricks of 2^3 and 3^3 elements, pushed aside: damped to rest in the engine loop, against the direct solution of the assembled
		structure (StaticEquilibrium). The same state comes from two ways through the code: nodal forces and modes step by step, and matrices."""
		for cells in (2, 3):
			O.reset()
			self.column(cells)
			start = self.corners()
			StaticEquilibrium()()
			direct = self.corners() - start
			O.reset()
			self.column(cells)
			untilRest(4)
			moved = self.corners() - start
			self.atMost(
			        '%d^3: largest difference / largest displacement' % cells, np.abs(moved - direct).max() / np.abs(direct).max(), 1e-6, 'what is left of the motion'
			)

	def test_frequency_of_a_column(self):
		"""The same column of bricks of 2^3 and 3^3 elements without weight: its first frequency by the assembled matrices, and by counting how it swings in the loop.
		The loop adds the error of leap-frog with the load, (omega dt)^2 / 24, and the midpoint rule of the modes, below 1e-4 here."""
		for cells in (2, 3):
			O.reset()
			self.column(cells)
			O.forces.setPermF(self.bricks[-1].id, (0, 0, 0))
			engine(NewtonIntegrator).gravity = (0, 0, 0)
			expected = assembled().frequencies(1)[0]
			O.forces.setPermF(self.bricks[-1].id, (20, 0, 0))
			StaticEquilibrium()()
			O.forces.setPermF(self.bricks[-1].id, (0, 0, 0))
			O.step()
			times, heights = [], []
			while len(times) == 0 or O.time < 4.6 / expected:
				O.step()
				times.append(O.time), heights.append(self.bricks[-1].state.pos[0])
			course = np.array(heights)
			crossings = [k for k in range(1, len(course)) if course[k - 1] < 0 <= course[k]]
			at = [times[k - 1] + (times[k] - times[k - 1]) * -course[k - 1] / (course[k] - course[k - 1]) for k in crossings]
			found = (len(at) - 1) / (at[-1] - at[0])
			self.judge('%d^3: first frequency [Hz]' % cells, found, expected, 2e-3, 'higher modes that the push leaves move the crossings a little')
