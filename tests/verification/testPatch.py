# SPDX-License-Identifier: GPL-2.0-or-later
# The hexahedron by itself: patch tests, one distorted hexahedron, eigenvalues, motions that must give no force.
import unittest

from cases import *
from mesh import *

GROUP = 'Patch tests'
PATCH_YOUNG, PATCH_POISSON = 1e6, .25
STRESSES = ('MacNeal-Harder', 'uniaxial', 'biaxial', 'shear', 'hydrostatic')
COMPONENTS = ('xx', 'yy', 'zz', 'xy', 'yz', 'zx')
ROUND_OFF = 'the field is linear, so only round-off is left'


def elasticity(young, poisson):
	"""Hooke's law for xx yy zz xy yz zx with engineering shear (6, 6)."""
	shear = young / (2 * (1 + poisson))
	law = np.diag([2 * shear] * 3 + [shear] * 3)
	law[:3, :3] += young * poisson / ((1 + poisson) * (1 - 2 * poisson))
	return law


def tensor(voigt, shear=1.):
	xx, yy, zz, xy, yz, zx = voigt
	return np.array([[xx, shear * xy, shear * zx], [shear * xy, yy, shear * yz], [shear * zx, shear * yz, zz]])


def voigt(matrix):
	return np.array([matrix[0, 0], matrix[1, 1], matrix[2, 2], matrix[0, 1], matrix[1, 2], matrix[2, 0]])


def strainMatrix(gradients):
	"""Strain by the amplitudes of shapes with these gradients (n, 3): (6, 3 n)."""
	return np.hstack([[(x, 0, 0), (0, y, 0), (0, 0, z), (y, x, 0), (0, z, y), (z, 0, x)] for x, y, z in gradients])


def meanStress(nodes, forces):
	"""Of a hexahedron in equilibrium with its nodal forces (8, 3): virial."""
	moment = forces.T @ nodes
	return voigt(moment + moment.T) / (2 * volume(nodes))


class Patch:
	"""The seven hexahedra of MacNeal and Harder: a distorted one inside a unit cube, six more between its faces and the cube's."""

	INNER = (
	        (.249, .342, .192), (.826, .288, .288), (.850, .649, .263), (.273, .750, .230), (.320, .186, .643), (.677, .305, .683), (.788, .693, .644),
	        (.165, .745, .702)
	)
	FACES = ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7))  # seen from outside, counter-clockwise

	def __init__(self):
		self.points = np.vstack([(SIGNS + 1) / 2, self.INNER])
		self.hexahedra = [[8 + a for a in face] + list(face) for face in self.FACES] + [list(range(8, 16))]

	def respond(self, stiffnessOf, stress):
		"""The cube's nodes are moved as in a uniform stress. Displacements (16, 3), and those of the uniform stress."""
		strain = np.linalg.solve(elasticity(PATCH_YOUNG, PATCH_POISSON), stress)
		exact = self.points @ tensor(strain, .5)
		parts = [(degrees(nodes), stiffnessOf(self.points[nodes])) for nodes in self.hexahedra]
		u, _ = solve(assemble(48, parts), np.zeros(48), dict(enumerate(exact[:8].ravel())))
		return u.reshape(16, 3), exact

	def stresses(self, stiffnessOf, u):
		"""Mean stress of each hexahedron (7, 6)."""
		return np.array([meanStress(self.points[h], (stiffnessOf(self.points[h]) @ u[h].ravel()).reshape(8, 3)) for h in self.hexahedra])


class IncompatibleByHand:
	"""The hexahedron with nine internal bending modes, written down apart from the product.

	:param corrected: their gradients times det J0 / det J, with which they do no work on a uniform stress (Taylor)
	"""

	def __init__(self, corrected):
		self.corrected = corrected

	def strainMatrices(self, nodes):
		centre, found = jacobian(nodes, np.zeros(3)), []
		for natural in GAUSS:
			J = jacobian(nodes, natural)
			inner = np.diag(-2 * natural) @ np.linalg.inv(centre)
			if self.corrected: inner *= np.linalg.det(centre) / np.linalg.det(J)
			found.append((strainMatrix(np.vstack([weightDerivatives(natural) @ np.linalg.inv(J), inner])), np.linalg.det(J)))
		return found

	def whole(self, nodes):
		law = elasticity(PATCH_YOUNG, PATCH_POISSON)
		return sum(weight * B.T @ law @ B for B, weight in self.strainMatrices(nodes))

	def inner(self, nodes):
		"""Amplitudes of the internal modes by the nodal displacements (9, 24)."""
		whole = self.whole(nodes)
		return -np.linalg.solve(whole[24:, 24:], whole[24:, :24])

	def stiffness(self, nodes):
		whole = self.whole(nodes)
		return whole[:24, :24] + whole[:24, 24:] @ self.inner(nodes)

	def stressesAtPoints(self, nodes, u):
		law, all = elasticity(PATCH_YOUNG, PATCH_POISSON), np.concatenate([u, self.inner(nodes) @ u])
		return [law @ B @ all for B, _ in self.strainMatrices(nodes)]


class SevenHexahedra(Case):

	def check(self, name, stress):
		"""One element under one stress: displacement of the inner nodes, stress in the hexahedron that is furthest off."""
		label, expected = name + ', ' + stress, np.array(reference('patch.%s.%s' % (name, stress))['sigma'])
		patch, largest = Patch(), abs(expected).max()
		stiffnessOf = lambda nodes: elementStiffness(nodes, PATCH_YOUNG, PATCH_POISSON, ELEMENTS[name])
		u, exact = patch.respond(stiffnessOf, expected)
		self.atMost(label + ': displacement, largest error / largest value', abs(u - exact).max() / abs(exact).max(), 1e-9, 'as the reference: ' + ROUND_OFF)
		stresses = patch.stresses(stiffnessOf, u)
		self.atMost(label + ': stress, largest error / largest value', abs(stresses - expected).max() / largest, 1e-9, 'as the reference: ' + ROUND_OFF)
		if stress != 'MacNeal-Harder': return
		worst = stresses[abs(stresses - expected).max(axis=1).argmax()]
		for component, got, wanted in zip(COMPONENTS, worst, expected):
			self.judge('%s: sigma %s [Pa]' % (label, component), got, wanted, 1e-9, ROUND_OFF)

	def test_full(self):
		"""Seven distorted hexahedra fill a unit cube (MacNeal and Harder, E = 1e6, nu = 0.25). The cube's eight nodes follow the linear field of a uniform
		stress; the eight inner nodes are free. Exact: they follow it too, and each hexahedron carries that stress (from its nodal forces)."""
		for stress in STRESSES: self.check('full', stress)

	def test_bbar(self):
		"""The same with the volumetric strain averaged over each hexahedron (element='bbar')."""
		for stress in STRESSES: self.check('bbar', stress)

	def test_incompatible_modes(self):
		"""The same with internal bending modes (element='incompatible')."""
		for stress in STRESSES: self.check('wilson', stress)

	def test_full_against_CalculiX(self):
		"""CalculiX 2.20, element C3D8 (full integration), on the same patch under sigma = 2000 Pa, tau = 400 Pa: displacements are exact, and so are the
		smallest and largest stress."""
		patch, expected = Patch(), reference('ccx.patch_C3D8')
		stiffnessOf = lambda nodes: elementStiffness(nodes, PATCH_YOUNG, PATCH_POISSON, 'full')
		u, exact = patch.respond(stiffnessOf, np.array([2000.] * 3 + [400.] * 3))
		error = abs(u - exact).max() / 1e-3
		self.atMost("largest error of displacement / 1e-3 m; CalculiX's is %.0e" % expected['err'], error, 1e-14, 'round-off in both')
		stresses = patch.stresses(stiffnessOf, u)
		for i, component in enumerate(COMPONENTS):
			self.judge('smallest sigma %s [Pa]' % component, stresses[:, i].min(), expected['smin'][i], 1e-9, ROUND_OFF)
			self.judge('largest sigma %s [Pa]' % component, stresses[:, i].max(), expected['smax'][i], 1e-9, ROUND_OFF)

	def test_incompatible_modes_against_CalculiX(self):
		"""CalculiX 2.20's C3D8I fails this patch by 12 %. Its numbers are those of internal modes whose gradient uses the Jacobian of the centre without the
		factor det J0 / det J: the same element, written down here without the product, gives them with and without it. With the factor it is the product's
		element to round-off, and passes; the difference is CalculiX's, not ours."""
		patch, expected, stress = Patch(), reference('ccx.patch_C3D8I'), np.array([2000.] * 3 + [400.] * 3)
		uncorrected, corrected = IncompatibleByHand(False), IncompatibleByHand(True)
		u, exact = patch.respond(uncorrected.stiffness, stress)
		self.judge('without the factor: error of displacement / 1e-3 m', abs(u - exact).max() / 1e-3, expected['err'], 1e-6, 'printed digits')
		found = np.array([s for h in patch.hexahedra for s in uncorrected.stressesAtPoints(patch.points[h], u[h].ravel())])
		for i, place in enumerate((0, 1, 2, 3, 5, 4)):  # CalculiX writes zx before yz
			self.judge('without the factor: smallest sigma %s [Pa]' % COMPONENTS[place], found[:, place].min(), expected['smin'][i], 1e-6, 'seven printed digits')
			self.judge('without the factor: largest sigma %s [Pa]' % COMPONENTS[place], found[:, place].max(), expected['smax'][i], 1e-6, 'seven printed digits')
		for h in patch.hexahedra:
			own, byHand = elementStiffness(patch.points[h], PATCH_YOUNG, PATCH_POISSON, 'incompatible'), corrected.stiffness(patch.points[h])
			self.atMost('with the factor: Brick.stiffness, largest difference / largest entry', abs(own - byHand).max() / abs(byHand).max(), 1e-13, 'round-off')


class OneHexahedron(Case):

	def test_distorted_one_in_uniform_strain(self):
		"""A hexahedron with eight irregular corners under the uniform displacement gradient 1e-3 [[1, .3, -.2], [.1, -.5, .4], [.6, -.7, .25]]. Its nodal
		forces are those of virtual work, whatever the element, and their virial is volume times stress, which gives the volume that the product sees."""
		nodes, expected = np.array(reference('hex.distorted.nodes')), np.array(reference('hex.distorted.forces'))
		gradient = 1e-3 * np.array([[1, .3, -.2], [.1, -.5, .4], [.6, -.7, .25]])
		trace = np.trace(gradient) * YOUNG / (1 - 2 * POISSON)  # of the stress
		for name, element in ELEMENTS.items():
			forces = (elementStiffness(nodes, YOUNG, POISSON, element) @ (nodes @ gradient.T).ravel()).reshape(8, 3)
			for axis in range(3):
				a = abs(forces - expected)[:, axis].argmax()
				got, wanted = forces[a, axis], expected[a, axis]
				label = '%s: force along %s on the node furthest off [N]' % (name, 'xyz'[axis])
				self.judge(label, got, wanted, 1e-5 / abs(wanted), 'nodes are printed to 5e-10 m of 0.1 m: 1e-5 N')
			self.judge(
			        name + ': volume [m3]', (forces * nodes).sum() / trace, reference('hex.distorted.volume'), 2e-8,
			        'coordinates and volume are printed with 8 digits'
			)

	def test_eigenvalues_of_a_cube(self):
		"""Eigenvalues of the stiffness over E L (nu = 0.25), with how often each occurs: six rigid motions with none, then shear and stretch (exact in any
		element), then bending and hourglass modes, by which the elements differ."""
		for name, element in ELEMENTS.items():
			expected = reference('hex.eig_%s_0.25' % name)
			values = np.linalg.eigvalsh(elementStiffness(SIGNS * .1, YOUNG, .25, element)) / (YOUNG * .2)
			for value, times in expected:
				near = values[abs(values - value) < 1e-6]
				self.judge('%s: times of %.6f' % (name, value), len(near), times, 0, 'a count')
				furthest = near[abs(near - value).argmax()]
				self.judge('%s: eigenvalue' % name, furthest, value, 1e-7 if value else 1e-12, 'printed with 8 digits' if value else 'round-off')

	def test_rigid_motion(self):
		"""Translations and small rotations about a point 3.7 m away give no nodal force in any element of the patch."""
		patch = Patch()
		for name, element in ELEMENTS.items():
			for h in patch.hexahedra:
				K = elementStiffness(patch.points[h], PATCH_YOUNG, PATCH_POISSON, element)
				forces = K @ rigidMotions(patch.points[h] + (3, 1, 2))
				self.atMost(name + ': largest force / (largest stiffness x displacement)', abs(forces).max() / (abs(K).max() * 4), 1e-14, 'round-off')


class FiniteRotation(Case):

	def test_linear_strain_would_see_stress(self):
		"""A cube turned by a finite angle about z, by the linear stiffness alone: it shows the stress -(1 - cos)(2 lambda + 2 mu) in x and y, at 0.03 rad
		already larger than the tensile strength of the paper's mortar, 4.6 kPa. That is why a brick is followed in a frame that turns with it."""
		nodes, lame, shear = SIGNS * .1, YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)), YOUNG / (2 * (1 + POISSON))
		for angle in (1e-3, 1e-2, .1):
			c, s = math.cos(angle), math.sin(angle)
			u = nodes @ (np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) - np.eye(3)).T
			got = meanStress(nodes, (elementStiffness(nodes, YOUNG, POISSON) @ u.ravel()).reshape(8, 3))
			self.judge('%g rad: sigma xx [Pa]' % angle, got[0], -(1 - c) * (2 * lame + 2 * shear), 1e-9, 'closed form')

	def test_turned_joint_has_no_force(self):
		"""Two deformable bricks joined by mortar, both turned together by up to half a turn about an axis askew, through their states. No node moves
		against its brick, no spring is stretched: forces and stresses stay zero."""
		axis = Vector3(1, -2, .5).normalized()
		for angle in (1e-2, .5, math.pi):
			O.reset()
			jointed = material(mortar=Mortar(**UNBREAKABLE))
			pair = [add((.2, .2, .2), center=(.2 * k, 0, 0), material=jointed, contactThickness=.001) for k in range(2)]
			MortarJoints()()
			engines(gravity=(0, 0, 0))
			turn = Quaternion(axis, angle)
			for b in pair: b.state.pos, b.state.ori = turn * b.state.pos, turn * b.state.ori
			O.step()
			stiffness = YOUNG / ((1 - POISSON**2) * .002) * .04
			force = max(O.forces.f(b.id).norm() for b in pair)
			self.atMost('%g rad: force / (stiffness of the joint x 1 m)' % angle, force / stiffness, 1e-15, 'round-off of positions of some 0.1 m')
			stress = max(abs(s) for b in pair for s in b.shape.stress())
			self.atMost('%g rad: stress / E' % angle, stress / YOUNG, 1e-14, 'round-off')

	def test_turning_brick_keeps_its_shape(self):
		"""A free deformable brick turns at 20 rad/s about an axis askew for two seconds, 6.4 turns. Centrifugal load on the element is left out on purpose
		(doc/method.md), so nothing may deform it: the rotation itself must not be taken for strain."""
		b = add((.1, .2, .4), material=material(), contactThickness=.001)
		engines(gravity=(0, 0, 0))
		b.state.angVel = 20 * Vector3(1, -2, .5).normalized()
		b.state.angMom = b.state.ori * Vector3(*[b.state.inertia[k] * (b.state.ori.conjugate() * b.state.angVel)[k] for k in range(3)])
		runFor(2)
		self.atMost('largest displacement of a node [m]', max(u.norm() for u in b.shape.displacement), 1e-15, 'no load on the modes')
		self.atMost('largest stress [Pa]', max(abs(s) for s in b.shape.stress()), 1e-7, 'no load on the modes: round-off')
