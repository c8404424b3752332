# SPDX-License-Identifier: GPL-2.0-or-later
# A column of bonded cubes on a rigid base: deflection under a force at the top, compression, and natural frequencies.
import unittest

import numpy as np
from scipy.linalg import eigh
from scipy.sparse.linalg import eigsh

from cases import *
from refined import *
from yade_brick.assembly import assembled

GROUP = 'Cantilever and frequencies'
SIDE = .2
COUNTS, THICKNESSES = (5, 10), (1e-4, 1e-3, 5e-3)
DIGITS = 'same discrete model: eight digits of the reference'


class Column:
	"""A column in the scene, assembled.

	:param count: of bricks
	:param n: each brick is made of n^3 parts that are glued
	:param bonded: joints between the bricks and with the base are mortar, with the springs of the contact parts; else glue: no layers at all
	:param options: of the bricks
	"""

	def __init__(self, count, n=1, bonded=True, segments=4, contactThickness=1e-3, **options):
		O.reset()
		brickMaterial = material(mortar=Mortar(**UNBREAKABLE))
		self.base = ground(brickMaterial)
		given = dict(options, material=brickMaterial, segments=segments, contactThickness=contactThickness)
		place = lambda k: (0, 0, SIDE * (k + .5))
		if n == 1: self.bricks = [[add([SIDE] * 3, center=place(k), **given)] for k in range(count)]
		else: self.bricks = [refine([SIDE] * 3, place(k), [n] * 3, **given) for k in range(count)]
		if n > 1 and bonded:
			for parts in self.bricks: glue([b.id for b in parts], of=parts[0])
		if not bonded: glue(of=self.bricks[0][0])
		MortarJoints()()
		engines(gravity=(0, 0, 0))
		self.assembly, self.parts = assembled(), [b for parts in self.bricks for b in parts]
		self.maps = {b.id: cornerMap(self.assembly, b) for b in self.parts}

	def coordinates(self, b):
		start = self.assembly.place(b.id)
		return slice(start, start + self.maps[b.id].shape[1])

	def topLoad(self, axis):
		"""Loads of 1 N along an axis, uniform over the top."""
		top = max(corners(b)[:, 2].max() for b in self.parts)
		bearing = [b for b in self.bricks[-1] if corners(b)[:, 2].max() > top - 1e-9]
		loads = np.zeros(self.assembly.stiffness.shape[0])
		for b in bearing:
			force = np.zeros((8, 3))
			force[corners(b)[:, 2] > top - 1e-9, axis] = 1 / (4 * len(bearing))
			loads[self.coordinates(b)] += self.maps[b.id].T @ force.ravel()
		return loads

	def compliance(self, axis):
		"""Mean displacement of the top under `topLoad` [m/N]."""
		loads = self.topLoad(axis)
		return loads @ self.assembly.solve(loads)

	def mass(self, ofABrick):
		"""Of the structure, from ofABrick(b): the matrix of a brick in its coordinates."""
		mass = self.assembly.mass.tolil()
		for b in self.parts: mass[self.coordinates(b), self.coordinates(b)] = ofABrick(b)
		return mass.tocsc()

	def lumpedMass(self):
		"""An eighth of a brick's mass at each corner, for the rotation too, which the product does not lump."""
		return self.mass(lambda b: b.state.mass / 8 * self.maps[b.id].T @ self.maps[b.id])

	def consistentMass(self):
		return self.mass(lambda b: self.maps[b.id].T @ consistentMass(b) @ self.maps[b.id])

	def vibrations(self, mass, count=12, stiffness=None):
		"""Lowest frequencies [Hz] and their shapes; stiffness: the assembly's where none is given."""
		stiffness = self.assembly.stiffness if stiffness is None else stiffness
		if stiffness.shape[0] < 300:
			# for the largest of 1/omega^2: what is stiff does no harm to the lowest frequencies
			inverse, shapes = eigh(mass.toarray(), stiffness.toarray())
			values = 1 / inverse
		else:
			values, shapes = eigsh(stiffness.tocsc(), count, mass, sigma=0)
		order = np.argsort(values)[:count]
		return np.sqrt(values[order]) / (2 * math.pi), shapes[:, order].T

	def named(self, mass, stiffness=None):
		"""Lowest frequencies by kind: first and second bending (each a pair), torsion, axial [Hz]."""
		kinds = {'B': [], 'T': [], 'A': []}
		for frequency, shape in zip(*self.vibrations(mass, stiffness=stiffness)):
			energy = dict.fromkeys(kinds, 0)
			for b in self.parts:
				u = shape[self.coordinates(b)]
				energy['B'] += b.state.mass * (u[0]**2 + u[1]**2)
				energy['A'] += b.state.mass * u[2]**2
				energy['T'] += b.state.inertia[2] * u[5]**2
			kinds[max(energy, key=energy.get)].append(frequency)
		return {'B1': kinds['B'][0], 'B2': kinds['B'][2], 'T1': kinds['T'][0], 'A1': kinds['A'][0]}


def error(got, expected):
	return abs(got / expected - 1)


class OneElementABrick(Case):

	def test_rigid_bricks(self):
		"""A column of 5 and of 10 rigid bricks, joined with each other and with a rigid base: deflection and shortening of the top under 1 N
		uniform over it, and frequencies. Expected: an independent solution of the same rigid bodies and springs; with exact rotary inertia both of
		its masses are ours."""
		for count in COUNTS:
			expected = reference('col.N%d.face.rigid.r0.seg4' % count)
			column = Column(count, deformation='rigid')
			self.judge('N=%d: deflection [m/N]' % count, column.compliance(0), expected['tip'], 1e-7, DIGITS)
			self.judge('N=%d: shortening [m/N]' % count, column.compliance(2), expected['axial'], 1e-7, DIGITS)
			for kind, frequency in column.named(column.assembly.mass).items():
				for mass in ('lumped', 'consistent'):
					self.judge('N=%d: %s, against %s [Hz]' % (count, kind, mass), frequency, expected[mass][kind], 1e-7, DIGITS)

	def worst(self, column, mass, expected, kinds=('B1', 'B2', 'T1', 'A1')):
		got = column.named(mass)
		return max(error(got[kind], expected[kind]) for kind in kinds)

	def columns(self, layout):
		"""(label, reference, Column) of all deformable columns of a layout."""
		for count in COUNTS:
			for name, element in ELEMENTS.items():
				for r in THICKNESSES:
					expected = reference('col.N%d.%s.%s.r%g.seg4' % (count, layout, name, r))
					column = Column(count, element=element, inner={'face': 'full'}.get(layout, layout), contactThickness=r)
					yield 'N=%d %s r=%g mm: ' % (count, element, 1e3 * r), expected, column

	def test_inner_part_of_full_size(self):
		"""Columns of deformable bricks whose element fills the brick (inner='full'), for the three elements and three thicknesses r of the contact
		part. Expected: an independent solution in nodal displacements. 'lumped': an eighth of the mass at each node, also for the rotation;
		'consistent': trilinear mass, both built by the test from the product's modes and stiffness. The frequencies are the first two in bending,
		the first in torsion and along the axis."""
		for label, expected, column in self.columns('face'):
			self.judge(label + 'deflection [m/N]', column.compliance(0), expected['tip'], 1e-7, DIGITS)
			self.judge(label + 'shortening [m/N]', column.compliance(2), expected['axial'], 1e-7, DIGITS)
			for name, mass in (('lumped', column.lumpedMass()), ('consistent', column.consistentMass())):
				self.atMost(label + 'worst of four frequencies, %s mass, relative error' % name, self.worst(column, mass, expected[name]), 1e-7, DIGITS)

	def test_inner_part_inset(self):
		"""The same with the element inset by r (the paper's layout). Deflection and shortening: as before. The reference's frequencies of this
		layout are off: it takes the rotation of a brick with its nodes in a wrong order, so that two bending frequencies that must be one differ.
		With that mistake made on purpose our matrices give all its digits, which is judged; what the product gives without it is compared."""
		for label, expected, column in self.columns('inset'):
			self.judge(label + 'deflection [m/N]', column.compliance(0), expected['tip'], 1e-7, DIGITS)
			self.judge(label + 'shortening [m/N]', column.compliance(2), expected['axial'], 1e-7, DIGITS)
			nodes = {b.id: misorderedNodes(column.assembly, b) for b in column.parts}
			stiffness = column.assembly.stiffness.tolil()
			for b in column.parts:
				at, nodal, element = column.coordinates(b), column.assembly.nodalMap(b.id), innerStiffness(b)
				stiffness[at, at] += nodes[b.id].T @ element @ nodes[b.id] - nodal.T @ element @ nodal
			masses = {'lumped': lambda b: b.state.mass / 8 * np.eye(24), 'consistent': consistentMass}
			for name, mass in masses.items():
				misordered = column.mass(lambda b: nodes[b.id].T @ mass(b) @ nodes[b.id])
				got = column.named(misordered, stiffness.tocsc())
				worst = max(error(got[kind], expected[name][kind]) for kind in got)
				self.atMost(label + 'its mistake, %s mass: worst of four frequencies, relative error' % name, worst, 1e-7, DIGITS)
			reason = "the reference's mistake, and its mass, which is consistent: the product's is exact in rotation, else lumped"
			for kind, frequency in column.named(column.assembly.mass).items():
				self.compare(label + kind + ' [Hz]', frequency, expected['consistent'][kind], reason)


ONE_ELEMENT = 'one element a brick: full integration is too stiff in bending, B-bar too soft, incompatible modes miss only the warping at the base'


class AgainstElasticity(Case):

	def truth(self, count, r):
		return reference('col.N%d.truth.r%g' % (count, r))

	def refined(self, count, n, r, element):
		"""(deflection, first frequency) of a column whose bricks are n^3 elements each."""
		column = Column(count, n, bonded=r > 0, segments=12 // n, contactThickness=r or 1e-3, element=element, inner='full')
		return column.compliance(0), column.assembly.frequencies(2)[0]

	def test_what_the_method_gives(self):
		"""Deflection and first frequency of the method as it is used, with one element a brick and the product's mass (exact rotary inertia), for
		all elements, layouts and thicknesses, against three-dimensional elasticity with the same layers, and against beams (without layers). The
		difference is the method's: see the refinement, and the same discrete model solved independently."""
		for count in COUNTS:
			beam = reference('col.N%d.beam' % count)
			for r in THICKNESSES:
				truth = self.truth(count, r)
				for inner in ('full', 'inset'):
					for element in ELEMENTS.values():
						column = Column(count, element=element, inner=inner, contactThickness=r)
						label = 'N=%d %s, inner %s, r=%g mm: ' % (count, element, inner, 1e3 * r)
						reason = ONE_ELEMENT + ('; inset: softer by 1/(1-2r/L)^2, the contact part carries nothing along its faces' if inner == 'inset' else '')
						self.compare(label + 'deflection [m/N]', column.compliance(0), truth['tip'], reason)
						self.compare(label + 'f1 [Hz]', column.assembly.frequencies(2)[0], truth['f1'], reason)
			rigid, continuum = Column(count, deformation='rigid'), self.truth(count, 0)
			self.compare('N=%d rigid: deflection [m/N]' % count, rigid.compliance(0), continuum['tip'], 'all compliance is in the joints')
			self.compare('N=%d rigid: f1 [Hz]' % count, rigid.assembly.frequencies(2)[0], continuum['f1'], 'the same')
			column = Column(count, bonded=False, element='incompatible', inner='full')
			label, reason = 'N=%d incompatible, no layers: ' % count, 'a beam does not know that the base holds the width'
			for quantity, got in (('timo', column.compliance(0)), ('axial', column.compliance(2))):
				self.compare(label + quantity + ' [m/N]', got, beam[quantity], reason)
			named = column.named(column.assembly.mass)
			for quantity, kind in (('f1_timo', 'B1'), ('f2_timo', 'B2'), ('f_ax', 'A1')):
				self.compare(label + quantity + ' [Hz]', named[kind], beam[quantity], reason + '; one element a brick')

	def test_refinement_of_the_element(self):
		"""Bricks of n^3 glued elements, n = 1, 2, 4, in a column of 5 with r = 1 mm: deflection and first frequency approach elasticity for every
		element. What is left at n = 4 is the edge of the clamped base, where stresses are singular: errors of a compliance fall with h^1.4 there,
		and that of full integration, which is more than the singularity's, with h^2 until it has come down to it."""
		truth = self.truth(5, 1e-3)
		for element, limit, leastRate in (('full', .04, 1.6), ('incompatible', .006, 1.2), ('bbar', .01, 1.1)):
			counts = 1, 2, 4
			results = [self.refined(5, n, 1e-3, element) for n in counts]
			tips, frequencies = ([error(result[k], truth[key]) for result in results] for k, key in enumerate(('tip', 'f1')))
			reason = 'between n=2 and n=4; second order where the solution is smooth, 2 x 0.7 at the clamped edge'
			self.atMost(element + ', n=4: deflection, relative error', tips[2], limit, 'measured 3.4, 0.46, 0.86 %: what the singular edge leaves')
			self.atMost(element + ', n=4: f1, relative error', frequencies[2], .6 * limit, 'half of that of the compliance')
			self.atMost(element + ': error left by halving h', tips[2] / tips[1], 2**-leastRate, reason)
			for what, errors in (('Deflection', tips), ('First frequency', frequencies)):
				figure = what + ' of a column of 5 against elasticity'
				self.curve(figure, element, counts, errors, 'elements along an edge of a brick', 'relative error', True, True)

	def test_refinement_for_all_thicknesses(self):
		"""Columns of 5 and 10 of incompatible elements, with n = 1 and 3 along an edge, for layers of 2 r = 0 (all glued) to 10 mm: the truth has
		the same layers, so that what is left does not depend on them."""
		for count, limit in ((5, .008), (10, .0035)):
			for r in (0, *THICKNESSES):
				truth = self.truth(count, r)
				one, three = (self.refined(count, n, r, 'incompatible') for n in (1, 3))
				label = 'N=%d r=%g mm: ' % (count, 1e3 * r)
				self.atMost(label + 'deflection at n=3, relative error', error(three[0], truth['tip']), limit, 'the clamped edge; its share falls with the length')
				self.atMost(label + 'its part of that at n=1', error(three[0], truth['tip']) / error(one[0], truth['tip']), .5, 'it falls')
				self.atMost(label + 'f1 at n=3, relative error', error(three[1], truth['f1']), .7 * limit, 'half of that of the compliance')


class AgainstCalculiX(Case):
	"""Columns without layers: all faces glued, also to the base."""

	def column(self, count, element, n):
		return Column(count, n, bonded=False, segments=2, element=element, inner='full')

	def test_same_elements(self):
		"""Glued columns with n^3 elements a brick, against CalculiX 2.20: its C3D8 is 'full', its C3D8I 'incompatible'. Deflections, and for C3D8
		ten frequencies with the consistent mass that the test builds. C3D8I's frequencies are compared only: CalculiX's mass is another for that
		element (its static stiffness is ours)."""
		reason = 'glue gives way by 2e-6 of an element, more in bending; round-off of its stiffness; seven digits'
		for count in COUNTS:
			for n in (1, 2):
				expected = reference('ccx.cant_%d_C3D8_%d' % (count, n))
				column = self.column(count, 'full', n)
				self.judge('N=%d C3D8 n=%d: deflection [m/N]' % (count, n), column.compliance(0), expected['tip'], 1e-5, reason)
				got = column.vibrations(column.consistentMass(), 14)[0]
				worst = max(error(ours, theirs) for ours, theirs in zip(got, expected['freq']))
				self.atMost('N=%d C3D8 n=%d: ten frequencies, worst relative error' % (count, n), worst, 1e-5, reason)
				expected = reference('ccx.cant_%d_C3D8I_%d' % (count, n))
				column = self.column(count, 'incompatible', n)
				self.judge('N=%d C3D8I n=%d: deflection [m/N]' % (count, n), column.compliance(0), expected['tip'], 1e-5, reason)
				got = column.vibrations(column.consistentMass(), 14)[0][0]
				self.compare('N=%d C3D8I n=%d: f1 [Hz]' % (count, n), got, expected['freq'][0], "CalculiX's mass of C3D8I is not ours")

	def test_quadratic_elements(self):
		"""What three linear elements along an edge (27 a brick) give against CalculiX's quadratic ones with reduced integration, 2 and 4 along an
		edge."""
		for count in COUNTS:
			column = self.column(count, 'incompatible', 3)
			for n in (2, 4):
				expected = reference('ccx.cant_%d_C3D20R_%d' % (count, n))
				label = 'N=%d, C3D20R n=%d: ' % (count, n)
				self.compare(label + 'deflection [m/N]', column.compliance(0), expected['tip'], 'linear against quadratic elements')
				self.compare(label + 'f1 [Hz]', column.assembly.frequencies(2)[0], expected['freq'][0], 'linear against quadratic elements')
			self.atMost(label + 'deflection, relative difference', error(column.compliance(0), expected['tip']), .008, 'what is left of the clamped edge at n=3')


class InTheLoop(Case):

	def test_release(self):
		"""A column of 5 with r = 5 mm stands bent under 0.5 N at its top brick (StaticEquilibrium) and is released in the engine loop. Its part in
		the first mode, taken with the mass, has to be a cosine with the structure's first frequency and undamped. Rigid bricks and all elements."""
		for deformation, element in (('rigid', 'full'), ('trilinear', 'full'), ('trilinear', 'incompatible'), ('trilinear', 'bbar')):
			column = Column(5, deformation=deformation, element=element, inner='full', contactThickness=5e-3)
			mass = column.assembly.mass
			frequency = column.assembly.frequencies(2)[0]
			top = column.bricks[-1][0]
			shape = column.assembly.solve(column.topLoad(0))
			for _ in range(8): shape = column.assembly.solve(mass @ shape)  # inverse iteration: 1/36 of the second mode's part is left by each
			weights = mass @ shape / (shape @ mass @ shape)
			O.forces.setPermF(top.id, (.5, 0, 0))
			StaticEquilibrium()()
			O.forces.setPermF(top.id, (0, 0, 0))
			start = weights @ self.state(column)
			times, parts = [], []
			while O.time < 2.25 / frequency:
				O.step()
				times.append(O.time)
				parts.append(weights @ self.state(column) / start)
			times, parts = np.array(times), np.array(parts)
			crossing = [i for i in range(1, len(parts)) if parts[i - 1] * parts[i] < 0]
			zeros = [times[i] - O.dt * parts[i] / (parts[i] - parts[i - 1]) for i in crossing]
			label = '%s %s: ' % (deformation, element)
			got = (len(zeros) - 1) / (2 * (zeros[-1] - zeros[0]))
			# leap-frog is fast by (omega dt)^2/24, 2e-5 with the step of rigid bricks; with that of deformable ones, 1e-6 at most, modes with their own stiffness also
			stepped = math.asin(math.pi * frequency * O.dt) / (math.pi * O.dt) if deformation == 'rigid' else frequency
			self.judge(label + 'f1 in such steps [Hz]', got, stepped, 1e-5, 'crossings of zero by straight lines')
			amplitude = parts[times > 1.9 / frequency].max()
			swing = 1 / math.cos(math.pi * frequency * O.dt)  # the start is at rest half a step before
			self.judge(label + 'amplitude after two periods', amplitude, swing, 5e-5, 'nothing damps; the largest is between two steps')
			self.curve('A column of 5 released', label[:-2], times[::20] * frequency, parts[::20], 'periods', 'first mode, part of its start')

	def state(self, column):
		"""Coordinates of the assembly (see assembled) against those at rest."""
		out = []
		for b in column.parts:
			turn = b.state.ori * b.state.refOri.conjugate()
			axis, angle = turn.toAxisAngle()
			out += [*(b.state.pos - b.state.refPos), *(axis * angle), *b.shape.amplitudes]
		return np.array(out)
