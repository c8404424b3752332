# SPDX-License-Identifier: GPL-2.0-or-later
# Locking: a cube that can hardly change its volume, glued on two faces or on one, and one hexahedron in bending, by the three elements.
import unittest

from cases import *
from mesh import *
from yade_brick import assembled

GROUP = 'Locking'
RATIOS = (.25, .4, .45, .49, .499)
COUNTS = (1, 2, 4)
TITLES = {'full': 'full', 'bbar': 'bbar', 'wilson': 'incompatible'}
PRINTED = 'the same mesh solved independently; eight digits, times the condition near nu = 0.5'


def apparentModulus(n, poisson, element):
	"""Of a unit cube of n^3 hexahedra between two bonded rigid plates, over E."""
	cube = Cube(1., n, 1., poisson, element)
	top = {3 * i + 2: 1. for i in cube.at(2, 1)}
	_, reaction = solve(cube.stiffness, np.zeros(3 * len(cube.points)), {**cube.fixed(2, 0), **cube.fixed(2, 1), **top})
	return sum(reaction[i] for i in top)


def settlement(n, poisson, element):
	"""Mean settlement of the top of a unit cube bonded at the base under an even pressure, times E / (pressure x height)."""
	cube = Cube(1., n, 1., poisson, element)
	load = np.zeros(3 * len(cube.points))
	load[2::3] = -cube.topShare
	u, _ = solve(cube.stiffness, load, cube.fixed(2, 0))
	return -cube.topShare @ u[2::3]


class CubeNearIncompressible(Case):

	def check(self, letter, response, quantity):
		errors = {name: {n: [] for n in COUNTS} for name in ELEMENTS}
		for poisson in RATIOS:
			expected = reference('lock.%s.h1.nu%g' % (letter, poisson))
			for name, element in ELEMENTS.items():
				for n in COUNTS:
					got = response(n, poisson, element)
					self.judge('nu %g, %s, %d^3: %s' % (poisson, TITLES[name], n, quantity), got, expected['%s_%d' % (name, n)], 1e-7, PRINTED)
					errors[name][n].append(100 * abs(got / expected['truth'] - 1))
				reason = 'what the element itself leaves: each value is judged above against an independent solution of the same mesh'
				self.compare('nu %g, %s, 4^3: %s' % (poisson, TITLES[name], quantity), got, expected['truth'], reason)
		for n in (1, 4):
			for name in ELEMENTS:
				axes = dict(xLabel="Poisson's ratio", yLabel='error against elasticity [%]', logY=True)
				self.curve('Locking %s: error with %d^3 hexahedra' % (letter, n), TITLES[name], RATIOS, errors[name][n], **axes)
		return errors

	def test_between_two_bonded_plates(self):
		"""Case A: a cube bonded to rigid plates on two faces is pulled; apparent modulus over E, for nu up to 0.499. Expected: an independent solution of the
		same mesh with 1, 2 and 4 hexahedra along an edge. One hexahedron has no free node and locks whatever the element; from 2^3 on only full
		integration does. Truth: converged elasticity."""
		errors = self.check('A', apparentModulus, 'modulus / E')
		self.atMost('largest error of bbar with 4^3 [%]', max(errors['bbar'][4]), 4, 'does not lock: 3.5 % at nu = 0.499, where the edges are singular')
		self.atMost('largest error of incompatible with 4^3 [%]', max(errors['wilson'][4]), 9, 'hardly locks')

	def test_on_one_bonded_base(self):
		"""Case B: the cube stands on a bonded base under an even pressure; mean settlement times E / (pressure x height). The incompatible and B-bar elements
		are within 18 % and 1.3 % of the truth with a single hexahedron at any nu; full integration settles by a fortieth at nu = 0.499."""
		errors = self.check('B', settlement, 'settlement')
		self.atMost('largest error of bbar with 1^3 [%]', max(errors['bbar'][1]), 1.3, 'does not lock')
		self.atMost('largest error of incompatible with 1^3 [%]', max(errors['wilson'][1]), 18, 'does not lock')

	def test_brick_on_one_bonded_base(self):
		"""Case B with a brick of the product: one element (inner='full') glued to the ground by springs of 1e7 times the brick's stiffness, an even pressure on
		its four top nodes, solved as the product's own structure (yade_brick.assembled). Expected: the single hexahedron of the references."""
		edge, pressure, thin = .2, 1e3, .001
		for poisson in RATIOS:
			for name, element in ELEMENTS.items():
				O.reset()
				clay = material(poisson=poisson)
				floor = ground(clay)
				b = add((edge,) * 3, center=(0, 0, edge / 2), material=clay, element=element, inner='full', contactThickness=thin)
				MortarJoints(mortar=Mortar(thickness=2 * thin, young=1e7 * YOUNG, poisson=poisson, **UNBREAKABLE))()
				structure = assembled()
				force = np.zeros(24)
				force[14::3] = -pressure * edge**2 / 4
				down = -(structure.nodalMap(b.id) @ structure.solve(structure.nodalMap(b.id).T @ force))[14::3].mean()
				expected = reference('lock.B.h1.nu%g' % poisson)[name + '_1']
				label = 'nu %g, %s: settlement x E / (pressure x height)' % (poisson, TITLES[name])
				self.judge(label, down * YOUNG / (pressure * edge), expected, 5e-6, 'what the glue gives way: 3e-6 for full at 0.499, tenfold with glue ten times softer')

	def test_convergence_to_elasticity(self):
		"""Both cases with the B-bar element at nu = 0.499, 2 to 12 hexahedra along an edge, against elasticity. The error falls in the order that the singular
		edge of the bonded base allows (1.19, not 2), and extrapolating with that order gives the truth: what is left with few elements is theirs."""
		counts, order = (2, 4, 8, 12), singularOrder(.499)
		for letter, response in (('A', apparentModulus), ('B', settlement)):
			truth = reference('lock.%s.h1.nu0.499' % letter)['truth']
			values = [response(n, .499, 'bbar') for n in counts]
			errors = [abs(v / truth - 1) for v in values]
			self.curve('Convergence at nu = 0.499 (B-bar)', 'case ' + letter, counts, errors, 'hexahedra along an edge', 'relative error', logX=True, logY=True)
			self.compare('case %s, 12^3' % letter, values[-1], truth, 'singular edges: see the order of convergence')
			observed = math.log(errors[-2] / errors[-1]) / math.log(12 / 8)
			self.judge('case %s: order of the error from 8 to 12' % letter, observed, order, .15, 'reached from below as elements get small')
			limit = extrapolated(values[-2], values[-1], 12 / 8, order)
			self.judge('case %s: extrapolated from 8 and 12' % letter, limit, truth, .003, 'the next terms of the error: five sixths of the error are gone')


class BendingOfOneHexahedron(Case):

	def test_moment_stiffness(self):
		"""One hexahedron bent by moments on two opposite faces: moment over curvature, relative to E I of a beam. Closed forms from the strain energy of
		u_x = kappa x z and the anticlastic u_y = - alpha y z that goes with it: full integration adds the shear that it cannot avoid (1.5 times too stiff for a
		cube), B-bar does so too but lets the volume change, the incompatible modes are exact."""
		for poisson in (.25, .4, .49):
			for a, b, c in ((1, 1, 1), (2, 1, 1), (1, 1, .5)):
				p, s = (a / c)**2, (b / c)**2
				lame, shear = poisson / ((1 + poisson) * (1 - 2 * poisson)), 1 / (2 * (1 + poisson))
				m = lame + 2 * shear
				expected = dict(
				        full=m + shear * p - lame**2 / (m + shear * s), wilson=1., bbar=2 * shear * (2 / 3 + p / 2 - 1 / (9 * (2 / 3 + s / 2)))
				)
				for name, element in ELEMENTS.items():
					K = elementStiffness(SIGNS / 2 * (a, b, c), 1., poisson, element)
					force = np.zeros((8, 3))
					force[:, 0] = SIGNS[:, 0] * SIGNS[:, 2]  # moment 2 c on either face
					u = (np.linalg.pinv(K, rcond=1e-10) @ force.ravel()).reshape(8, 3)
					curvature = u[6, 0] / (a / 2 * c / 2)
					label = 'nu %g, %g x %g x %g, %s: M / (curvature E I)' % (poisson, a, b, c, TITLES[name])
					self.judge(label, 2 * c / curvature / (b * c**3 / 12), expected[name], 1e-9, 'closed form; round-off')
