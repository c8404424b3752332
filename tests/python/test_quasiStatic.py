# SPDX-License-Identifier: GPL-2.0-or-later
# Tilting table and pushover as motions, and capacity curves from made-up histories; in a scene: tests/yade/testQuasiStatic.py.
"""Tests of yade_brick.quasiStatic and capacity; no YADE needed."""

import doctest
import math
import os
import unittest

import numpy as np

import standalone
from motionCase import FileCase

quasiStatic, capacity = standalone.load("quasiStatic"), standalone.load("capacity")


class QuasiStaticTest(FileCase):

	def test_docstring_examples_hold(self):
		self.assertEqual(doctest.testmod(quasiStatic).failed + doctest.testmod(capacity).failed, 0)

	def test_table_turns_evenly_between_a_smooth_start_and_end_and_is_held(self):
		table = quasiStatic.tiltingTable(rate=0.1, upTo=0.4, ease=0.5, hold=2.0)
		self.assertAlmostEqual(table.duration, 4 + 0.5 + 2, places=12)
		times = table.times()
		angle = quasiStatic.tiltAt(table, times)
		middle = (times > 0.5) & (times < 4.0)
		np.testing.assert_allclose(angle[middle], 0.1 * (times[middle] - 0.25), atol=1e-12)
		np.testing.assert_allclose(angle[times >= 4.5 - 1e-9], 0.4, atol=1e-12)
		np.testing.assert_array_equal(table.acceleration[0], 0)
		# the rate itself changes by pi/2 rate/ease at most: no jump in the load or in its rate
		self.assertLess(np.abs(np.diff(angle, 2)).max() / quasiStatic.interval**2, 1.01 * math.pi / 2 * 0.1 / 0.5)

	def test_load_of_the_table_with_gravity_is_gravity_turned(self):
		table = quasiStatic.tiltingTable(rate=0.2, upTo=1.5, direction="-x", gravity=9.8)
		felt = quasiStatic.loadAt(table, table.times()) + np.array([0, 0, -9.8])
		angle = quasiStatic.tiltAt(table, table.times(), 9.8)
		np.testing.assert_allclose(felt, 9.8 * np.column_stack([-np.sin(angle), 0 * angle, -np.cos(angle)]), atol=1e-12)

	def test_push_grows_evenly_by_rate_or_by_duration(self):
		by = quasiStatic.pushover(upTo=3.0, rate=1.5, hold=1.0), quasiStatic.pushover(upTo=3.0, duration=2.0, hold=1.0)
		np.testing.assert_array_equal(by[0].acceleration, by[1].acceleration)
		np.testing.assert_allclose(quasiStatic.loadAt(by[0], [1.0, 2.6, 3.5]), [[1.5 * 0.75, 0, 0], [3, 0, 0], [3, 0, 0]], atol=1e-12)
		np.testing.assert_array_equal(quasiStatic.loadAt(by[0], [-1, 3.6]), 0)  # GroundMotion gives nothing before and after

	def test_both_say_that_they_are_synthetic_and_where_they_push(self):
		for motion, words in ((quasiStatic.tiltingTable(0.1, 0.4, "-y"), ("-y", "22.92 degrees")), (quasiStatic.pushover(2.0, rate=1.0), ("+x", "2 m/s2"))):
			self.assertTrue(motion.synthetic)
			for word in words:
				self.assertIn(word, motion.name)

	def test_wrong_parameters_are_refused_with_the_value(self):
		for call, words in (
		        (lambda: quasiStatic.tiltingTable(0, 1), ("rate is 0",)), (lambda: quasiStatic.tiltingTable(0.1, 2), ("upTo is 2", "pi/2")),
		        (lambda: quasiStatic.tiltingTable(0.1, 1, "z"), ("'z'", "horizontal")), (lambda: quasiStatic.tiltingTable(0.1, 1, gravity=-9.8), ("gravity is -9.8",)),
		        (lambda: quasiStatic.tiltingTable(1, 0.2), ("ease is 0.5", "0.2")), (lambda: quasiStatic.tiltingTable(0.1, 1, hold=-1), ("hold is -1",)),
		        (lambda: quasiStatic.pushover(1), ("rate is None", "exactly one")), (lambda: quasiStatic.pushover(1, rate=1, duration=1), ("exactly one",)),
		        (lambda: quasiStatic.pushover(0, rate=1), ("upTo is 0",)), (lambda: quasiStatic.pushover(1, rate=-1), ("rate is -1",)),
		        (lambda: quasiStatic.pushover(1, duration=-1), ("duration is -1",)),
		):
			self.refused(call, *words)


class CapacityTest(FileCase):

	def test_multiplier_is_the_largest_coefficient_without_the_load(self):
		curve = capacity.capacityCurve([0, 1, 2, 3], [0, 30, 20, 25], 100)
		self.assertEqual((curve.multiplier, curve.displacementAtMultiplier, curve.collapsed), (0.3, 1, False))

	def test_shear_that_grows_while_a_block_falls_is_not_its_capacity(self):
		# A block of b/h = 0.2 under a growing push: its base feels a quarter of what is beyond, see the kinetics of turning about an edge.
		load = np.linspace(0, 0.4, 401)
		shear = np.where(load < 0.2, load, 0.2 + 0.25 * (load - 0.2))
		moved = np.where(load < 0.2, 1e-3 * load, 2e-4 + (load - 0.2)**2)
		self.assertAlmostEqual(capacity.capacityCurve(moved, 50 * shear, 50).multiplier, 0.25, places=12)
		curve = capacity.capacityCurve(moved, 50 * shear, 50, load)
		self.assertTrue(curve.collapsed)
		self.assertAlmostEqual(curve.multiplier, 0.2, delta=0.01 / 3 + 1e-3)  # a third of the tolerance, and one sample

	def test_shaking_by_cracks_is_neither_a_loss_of_equilibrium_nor_a_capacity(self):
		load = np.linspace(0, 0.4, 401)
		shaken = load + 0.03 * np.sin(np.arange(401) / 10) * (load > 0.1)
		fallen = load > 0.3
		curve = capacity.capacityCurve(load, np.where(fallen, 0.2, shaken), 1, load)
		# the last time that all of the load was borne may be half a cycle of 31 samples, of 0.001 each, before
		self.assertTrue(0 <= np.flatnonzero(fallen)[0] - curve.balanced <= 32)
		self.assertTrue(0.3 - 0.032 <= curve.multiplier <= 0.3)
		self.assertFalse(capacity.capacityCurve(load, shaken, 1, load).collapsed)
		self.assertTrue(capacity.capacityCurve(load, shaken, 1, load, patience=20).collapsed)  # less than the half cycle

	def test_normal_force_may_change(self):
		angle = np.linspace(0, 0.5, 51)
		curve = capacity.capacityCurve(angle, 30 * np.sin(angle), 30 * np.cos(angle), np.tan(angle))
		self.assertFalse(curve.collapsed)
		self.assertAlmostEqual(curve.multiplier, math.tan(0.5), places=12)

	def test_wrong_histories_are_refused(self):
		for arguments, words in (
		        (([0, 1], [0], 1), ("baseShear",)), (([0, 1], [0, float("nan")], 1), ("baseShear",)), (([0, 1], [0, 1], 0), ("normal is 0",)),
		        (([0, 1], [0, 1], [1, 0]), ("normal falls to 0",)), (([0, 1], [0, 1], 1, [0, 1, 2]), ("applied",)), (("ab", [0, 1], 1), ("displacement",)),
		        (([0, 1], [0, 1], 1, [5, 3]), ("baseShear is 0", "begin at rest")),
		        (([0, 1], [0, 1], 1, None, 0.1, 0), ("patience is 0",)),
		):
			self.refused(lambda: capacity.capacityCurve(*arguments), *words)

	def test_plot_is_a_picture_and_needs_a_curve(self):
		curve = capacity.capacityCurve([0, 1e-3, 2e-3, 1e-2], [0, 10, 15, 12], 100, [0, 0.1, 0.15, 0.2])
		path = os.path.join(self.folder.name, "curve.png")
		capacity.capacityPlot(path, {"column": curve}, {"b/h": 0.16}, title="A column")
		with open(path, "rb") as file:
			self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
		self.refused(lambda: capacity.capacityPlot(path, {}), "curves is empty")


if __name__ == "__main__":
	unittest.main()
