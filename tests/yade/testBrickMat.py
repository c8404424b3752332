# SPDX-License-Identifier: GPL-2.0-or-later
# Materials: defaults, refusal of impossible values, archives.
import math, os, pickle, tempfile, unittest

from yade import O
from yade_brick import BrickMat, Mortar, _core

nan = float('nan')


class Defaults(unittest.TestCase):

	def test_a_brick_is_dry_and_undamped_inside(self):
		m = BrickMat()
		self.assertIsNone(m.mortar)
		self.assertEqual((m.hn, m.hs, m.dampingRatio), (.1, .1, 0))

	def test_mortar_strengths_are_required(self):
		m = Mortar()
		for name in ('young', 'poisson', 'tensileStrength', 'cohesion', 'frictionAngle', 'compressiveStrength'):
			self.assertTrue(math.isnan(getattr(m, name)), name)
		self.assertEqual((m.thickness, m.Cs), (0, 9))

	def test_brick_material_is_dispatched_as_frictional(self):
		self.assertEqual(BrickMat().dispHierarchy(), ['BrickMat', 'FrictMat', 'ElastMat', 'Material'])

	def test_attributes_are_documented_with_unit_type_and_default(self):
		doc = Mortar.thickness.__doc__
		for part in ('[m]', ':ydefault:`0`', ':yattrtype:`Real`', ':yattrflags:`4`'):
			self.assertIn(part, doc)


class Refusal(unittest.TestCase):

	def refused(self, Class, allowed, **attribute):
		(name, value), = attribute.items()
		with self.assertRaises(ValueError) as caught:
			Class(**attribute)
		text = str(caught.exception)
		self.assertIn(name, text)
		self.assertIn('%g' % value, text)
		self.assertIn(allowed, text)

	def test_poisson_ratio_out_of_range(self):
		for value in (-1, .5, .7, nan):
			self.refused(BrickMat, 'between -1 and 0.5', poisson=value)
		for value in (-1, .5):
			self.refused(Mortar, 'between -1 and 0.5', poisson=value)

	def test_stiffness_and_density_must_be_positive(self):
		for value in (0, -1, nan, math.inf):
			self.refused(BrickMat, 'positive', young=value)
			self.refused(BrickMat, 'positive', density=value)
		self.refused(Mortar, 'positive', young=-1)

	def test_damping_must_not_be_negative(self):
		for name in ('hn', 'hs', 'dampingRatio'):
			for value in (-.1, nan):
				self.refused(BrickMat, 'not negative', **{name: value})
		self.refused(BrickMat, 'below 1', dampingRatio=1)

	def test_mortar_values(self):
		for name in ('thickness', 'tensileStrength', 'cohesion', 'Cs'):
			self.refused(Mortar, 'not negative', **{name: -1})
		for name in ('thickness', 'Cs'):
			self.refused(Mortar, 'not negative', **{name: nan})
		self.refused(Mortar, 'positive', compressiveStrength=0)
		self.refused(Mortar, 'pi/2', frictionAngle=2)

	@unittest.skipIf(_core.headers != 'yade-abi', "YADE's own macros keep the refused value")
	def test_assignment_is_checked_and_taken_back(self):
		m = BrickMat(hn=.3)
		with self.assertRaises(ValueError):
			m.hn = -1
		self.assertEqual(m.hn, .3)

	def test_unknown_attribute(self):
		with self.assertRaises(AttributeError):
			BrickMat(stickiness=1)

	def test_wrong_type(self):
		with self.assertRaises(TypeError):
			BrickMat(hn='much')
		with self.assertRaises(TypeError):
			BrickMat(mortar=BrickMat())


class Archives(unittest.TestCase):

	def setUp(self):
		O.reset()
		mortar = Mortar(young=.2e9, poisson=.2, thickness=.01, tensileStrength=.1e6, cohesion=.3e6, frictionAngle=.6, compressiveStrength=4e6, Cs=8)
		O.materials.append(BrickMat(young=1e9 / 3, poisson=.15, density=1800, frictionAngle=.7, hn=.2, hs=.3, dampingRatio=.05, mortar=mortar, label='clay'))
		O.materials.append(BrickMat(mortar=mortar, label='lime'))
		O.materials.append(BrickMat(label='dry'))

	def tearDown(self):
		O.reset()

	def content(self):

		def plain(attributes):
			attributes = dict(attributes)
			mortar = attributes.pop('mortar', None)
			return attributes, mortar and repr(sorted(mortar.dict().items()))

		return [plain(m.dict()) for m in O.materials]

	def test_files_keep_every_bit(self):
		before = self.content()
		with tempfile.TemporaryDirectory() as folder:
			for name in ('a.xml', 'a.xml.gz', 'a.yade', 'a.yade.gz'):
				path = os.path.join(folder, name)
				O.save(path)
				O.reset()
				O.load(path)
				self.assertEqual(self.content(), before, name)

	def test_shared_mortar_stays_shared(self):
		O.saveTmp()
		O.loadTmp()
		self.assertEqual(O.materials['clay'].mortar, O.materials['lime'].mortar)
		self.assertIsNone(O.materials['dry'].mortar)

	def test_not_given_stays_not_given(self):
		O.materials['lime'].mortar = Mortar()
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, 'a.xml')
			O.save(path)
			O.load(path)
		self.assertTrue(math.isnan(O.materials['lime'].mortar.cohesion))

	def test_pickle(self):
		m = pickle.loads(pickle.dumps(O.materials['clay']))
		self.assertEqual((m.young, m.mortar.Cs, m.label), (1e9 / 3, 8, 'clay'))
