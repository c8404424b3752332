# SPDX-License-Identifier: GPL-2.0-or-later
# Fragility curves against closed forms, brute force, and experiments whose truth is known.
"""Tests of yade_brick.fragility; no YADE needed."""

import doctest
import math
import os
import tempfile
import unittest

import numpy as np
from scipy.optimize import brentq, minimize_scalar
from scipy.special import log_ndtr, ndtr, ndtri
from scipy.stats import chi2

import standalone

fragility = standalone.load("fragility")


def logLikelihood(fit, median, dispersion):
	eta = np.log(fit.intensities / median) / dispersion
	return fit.collapsed @ log_ndtr(eta) + (fit.runs - fit.collapsed) @ log_ndtr(-eta)


def experiment(seed, levels, runs, median, dispersion):
	"""Runs that collapsed at each level, for a known curve."""
	return np.random.RandomState(seed).binomial(runs, ndtr(np.log(np.array(levels) / median) / dispersion))


class Fitting(unittest.TestCase):

	def test_doctests(self):
		self.assertEqual(doctest.testmod(fragility).failed, 0)

	def test_two_levels_are_fitted_exactly(self):
		fit = fragility.fitFragility([1.5, 4.0], [7, 33], runs=[50, 45])
		low, high = ndtri(7 / 50), ndtri(33 / 45)
		dispersion = math.log(4 / 1.5) / (high - low)
		self.assertAlmostEqual(fit.dispersion, dispersion, delta=1e-9)  # of the root search
		self.assertAlmostEqual(fit.median, 1.5 * math.exp(-low * dispersion), delta=1e-9)
		np.testing.assert_allclose(fit.probability([1.5, 4.0]), [7 / 50, 33 / 45], rtol=1e-9)

	def test_no_curve_of_a_fine_grid_is_more_likely(self):
		levels = [1, 2, 3, 4, 5, 6]
		fit = fragility.fitFragility(levels, experiment(1, levels, 10, 3.2, 0.4), [10] * 6)
		grid = [(logLikelihood(fit, m, d), m, d) for m in np.linspace(1, 8, 141) for d in np.linspace(0.05, 2, 79)]
		best = max(grid)
		self.assertGreaterEqual(logLikelihood(fit, fit.median, fit.dispersion), best[0])
		self.assertLess(abs(best[1] - fit.median), 0.05)  # the grid's spacing
		self.assertLess(abs(best[2] - fit.dispersion), 0.025)

	def test_single_runs_and_counts_give_the_same_curve(self):
		levels, counts = [2.0, 3.0, 5.0], [1, 3, 4]
		single = [(x, k < count) for x, count in zip(levels, counts) for k in range(5)]
		a = fragility.fitFragility([x for x, _ in single], [fell for _, fell in single])
		b = fragility.fitFragility(levels, counts, [5, 5, 5])
		self.assertEqual(a[:2], b[:2])

	def test_units_of_intensity_do_not_matter(self):
		levels, counts = np.array([2.0, 3.0, 5.0]), [1, 3, 4]
		a, b = fragility.fitFragility(levels, counts, [5] * 3), fragility.fitFragility(1e-6 * levels, counts, [5] * 3)
		self.assertAlmostEqual(1e6 * b.median / a.median, 1, delta=1e-9)
		self.assertAlmostEqual(b.dispersion / a.dispersion, 1, delta=1e-9)
		np.testing.assert_allclose(a.band([2.5])[0], b.band([2.5e-6])[0], rtol=1e-6)

	def test_many_runs_give_back_the_curve_they_were_drawn_from(self):
		levels = [1.5, 2.5, 3.5, 5.0, 7.0]
		fit = fragility.fitFragility(levels, experiment(5, levels, 20000, 3.2, 0.4), [20000] * 5)
		# three standard errors by Fisher's information of (ln median, ln dispersion)
		eta = np.log(np.array(levels) / 3.2) / 0.4
		weight = 20000 * np.exp(-eta**2) / (2 * math.pi) / (ndtr(eta) * ndtr(-eta))
		gradient = np.array([np.full(5, -1 / 0.4), -eta])
		errors = np.sqrt(np.diag(np.linalg.inv(weight * gradient @ gradient.T)))
		self.assertLess(abs(math.log(fit.median / 3.2)), 3 * errors[0])
		self.assertLess(abs(math.log(fit.dispersion / 0.4)), 3 * errors[1])
		# with so many runs likelihood ratios are Fisher's information: ends at 1.96 standard errors, to some percent of these
		for found, error, interval in ((fit.median, errors[0], fit.medianInterval()), (fit.dispersion, errors[1], fit.dispersionInterval())):
			np.testing.assert_allclose(np.log(np.array(interval) / found) / error, [-1.96, 1.96], rtol=0.03)

	def test_capacities_of_motions_have_mean_and_deviation_of_their_logarithms(self):
		values = np.exp(1.2 + 0.3 * np.random.RandomState(2).normal(size=4000))
		median, dispersion = fragility.lognormalCapacity(values)
		self.assertLess(abs(math.log(median) - 1.2), 3 * 0.3 / math.sqrt(4000))
		self.assertLess(abs(dispersion - 0.3), 3 * 0.3 / math.sqrt(8000))


class Confidence(unittest.TestCase):

	def test_band_is_that_of_a_binomial_share_where_two_levels_are_fitted_exactly(self):
		# the other level is free, so that the likelihood ratio is that of 7 in 50 alone
		fit = fragility.fitFragility([1.5, 4.0], [7, 33], runs=[50, 45])
		logarithm = lambda p: 7 * math.log(p) + 43 * math.log(1 - p)
		excess = lambda p: logarithm(p) - logarithm(7 / 50) + 0.5 * chi2.ppf(0.95, 1)
		low, high = fit.band([1.5])
		self.assertAlmostEqual(low[0], brentq(excess, 1e-3, 0.14), delta=2e-5)  # of 121 slopes
		self.assertAlmostEqual(high[0], brentq(excess, 0.14, 0.9), delta=2e-5)

	def test_band_and_median_agree_with_a_search_along_each_probability(self):
		levels = [1, 2, 3, 4, 5, 6]
		fit = fragility.fitFragility(levels, experiment(1, levels, 10, 3.2, 0.4), [10] * 6)
		greatest = logLikelihood(fit, fit.median, fit.dispersion)

		def excess(x0, c):
			# the most likely line through (x0, c)
			found = minimize_scalar(lambda b: -logLikelihood(fit, x0 * math.exp(-c / math.exp(b)), 1 / math.exp(b)), bounds=(-4, 4), method="bounded")
			return -found.fun - greatest + 0.5 * chi2.ppf(0.9, 1)

		for x0, (low, high) in zip((1.7, 4.4), np.transpose(fit.band([1.7, 4.4], 0.9))):
			best = ndtri(fit.probability(x0))
			self.assertAlmostEqual(low, ndtr(brentq(lambda c: excess(x0, c), best - 5, best)), delta=5e-5)
			self.assertAlmostEqual(high, ndtr(brentq(lambda c: excess(x0, c), best, best + 5)), delta=5e-5)
		low, high = fit.medianInterval(0.9)
		self.assertAlmostEqual(low, brentq(lambda x0: excess(x0, 0), 0.5, fit.median), delta=1e-3)
		self.assertAlmostEqual(high, brentq(lambda x0: excess(x0, 0), fit.median, 20), delta=1e-3)

	def test_intervals_hold_the_truth_as_often_as_they_say(self):
		levels, trials = [2, 3, 4, 5], 50
		self.addCleanup(setattr, fragility._Region, "slopeCount", fragility._Region.slopeCount)
		fragility._Region.slopeCount = 15  # a quicker one: the median's ends move by less than 1e-3
		fits = [fragility.fitFragility(levels, experiment(seed, levels, 12, 3.2, 0.4), [12] * 4) for seed in range(trials)]
		regions = [fragility._Region(fit, 0.9) for fit in fits]
		for name, truth in (("medianInterval", 3.2), ("dispersionInterval", 0.4)):
			intervals = [getattr(region, name)() for region in regions]
			held = sum(low <= truth <= high for low, high in intervals)
			self.assertLess(abs(held - 0.9 * trials), 3 * math.sqrt(0.9 * 0.1 * trials), name)  # of a binomial


class NoCurve(unittest.TestCase):

	def fitted(self, levels, collapsed):
		fit = fragility.fitFragility(levels, collapsed)
		self.assertTrue(math.isnan(fit.median) and math.isnan(fit.dispersion))
		self.assertTrue(np.isnan(fit.probability([1.0, 2.0])).all())
		return fit

	def test_none_collapsed(self):
		fit = self.fitted([1, 2, 4], [0, 0, 0])
		self.assertIn("none of 3 runs collapsed: the median is above 4", fit.note)
		low, high = fit.band([1, 4])
		np.testing.assert_array_equal(low, 0)
		# with collapse equally probable everywhere, (1 - p)^3 is the likelihood
		self.assertAlmostEqual(high[0], 1 - math.exp(-0.5 * chi2.ppf(0.95, 1) / 3), delta=1e-6)
		self.assertEqual(fit.medianInterval()[1], math.inf)
		self.assertGreater(fit.medianInterval()[0], 2)

	def test_all_collapsed(self):
		fit = self.fitted([1, 2, 4], [1, 1, 1])
		self.assertIn("all of 3 runs collapsed: the median is below 1", fit.note)
		np.testing.assert_array_equal(fit.band([1, 4])[1], 1)
		self.assertEqual(fit.medianInterval()[0], 0)

	def test_perfectly_separated(self):
		fit = self.fitted([1, 2, 3, 4], [0, 0, 1, 1])
		self.assertIn("the median is from 2 to 3", fit.note)
		low, high = fit.medianInterval()
		self.assertTrue(1 < low < 2 and 3 < high < 4)
		self.assertEqual(fit.dispersionInterval()[0], 0)
		self.assertTrue(0 < fit.dispersionInterval()[1] < 3)

	def test_separated_but_for_one_mixed_level(self):
		fit = self.fitted([1, 2, 2, 2, 3], [0, 0, 1, 1, 1])
		self.assertIn("the median is from 2 to 2", fit.note)
		# a step at 2 with the probability 2/3 there is the most likely; the band at 2 is at least that of 2 in 3
		self.assertAlmostEqual(fragility._Region(fit, 0.95).greatest(fit), 2 * math.log(2 / 3) + math.log(1 / 3))

	def test_one_level_and_falling_shares(self):
		self.assertIn("nothing of the dispersion", self.fitted([2, 2], [0, 1]).note)
		self.assertIn("not more frequent", self.fitted([1, 2, 3], [1, 0, 0]).note)
		self.assertIn("not more frequent", self.fitted([1, 1, 2, 2, 2, 3, 3], [1, 1, 0, 1, 0, 0, 1]).note)

	def test_plot_of_curves_with_and_without(self):
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, "both.png")
			fits = {"curve": fragility.fitFragility([1, 2, 3], [1, 3, 4], [5] * 3), "none": fragility.fitFragility([1, 2, 3], [0, 0, 0])}
			fragility.fragilityPlot(path, fits, "PGA [m/s$^2$]", title="both")
			self.assertGreater(os.path.getsize(path), 20000)


class Refusals(unittest.TestCase):

	def test_what_is_wrong_is_said_with_its_value(self):
		for arguments, words in (
		        (([], []), "intensities is empty"), (([1, 0], [0, 1]), "allowed are numbers > 0"), (([1, 2], [0]), "2 intensities, 1 outcomes"),
		        (([1, 2], [0, 2]), "collapsed at intensity 2 is 2 of 1 runs"), (([1, 2], [0, 0.5]), "is 0.5 of 1"), (([1, math.nan], [0, 1]), "finite"),
		        (([1, 2], [0, 1], [0, 2]), "is 0 of 0"), ((["a"], [1]), "intensities is")
		):
			with self.assertRaisesRegex(ValueError, words):
				fragility.fitFragility(*arguments)
		fit = fragility.fitFragility([1, 2], [1, 2], [3, 3])
		for level in (0, 1, 95, math.nan):
			with self.assertRaisesRegex(ValueError, "level is"):
				fit.band([1.0], level)
		with self.assertRaisesRegex(ValueError, "capacities"):
			fragility.lognormalCapacity([1.0])
		with self.assertRaisesRegex(ValueError, "limits"):
			fragility.fragilityPlot("x.png", fit, "PGA", limits=(2, 1))


if __name__ == "__main__":
	unittest.main()
