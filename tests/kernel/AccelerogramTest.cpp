// SPDX-License-Identifier: GPL-2.0-or-later
#include <pkg/brick/kernel/Accelerogram.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

using namespace brick;

namespace {

constexpr Real roundOff = 1e-13; ///< sums of a few numbers of order 1 to 10

const std::vector<Vector3r> samples { { 1, 0, 0 }, { 3, -1, 0 }, { -2, 4, 1 }, { 0, 2, 5 } };

Accelerogram record(Real start = .4) { return Accelerogram(.5, samples, start); }

std::string refusal(Real interval, const std::vector<Vector3r>& values, Real start)
{
	try {
		Accelerogram(interval, values, start);
	} catch (const std::invalid_argument& problem) {
		return problem.what();
	}
	return "";
}

} // namespace

TEST(AccelerogramTest, acceleration_passes_through_the_samples_and_is_linear_between)
{
	const auto a = record();
	for (int i = 0; i < 4; ++i)
		EXPECT_LT((a.acceleration(.4 + .5 * i) - samples[i]).norm(), roundOff);
	for (int i = 0; i < 3; ++i)
		for (Real s : { .1, .5, .77 })
			EXPECT_LT((a.acceleration(.4 + .5 * (i + s)) - ((1 - s) * samples[i] + s * samples[i + 1])).norm(), roundOff);
	EXPECT_NEAR(a.end(), 1.9, roundOff);
}

TEST(AccelerogramTest, velocity_and_displacement_are_the_exact_integrals)
{
	const auto a = record();
	// Simpson's rule is exact for the parabola of velocity and, of the cubic displacement, for its own velocity
	for (int i = 0; i < 3; ++i)
		for (Real s : { .3, 1. }) {
			const Real from = .4 + .5 * i, to = from + .5 * s, middle = (from + to) / 2, sixth = (to - from) / 6;
			EXPECT_LT(
			        (a.velocity(to) - a.velocity(from) - sixth * (a.acceleration(from) + 4 * a.acceleration(middle) + a.acceleration(to))).norm(),
			        roundOff);
			EXPECT_LT(
			        (a.displacement(to) - a.displacement(from) - sixth * (a.velocity(from) + 4 * a.velocity(middle) + a.velocity(to))).norm(),
			        roundOff);
		}
	// by hand, first component: trapezia .5 (1+3)/2, .5 (3-2)/2, .5 (-2+0)/2
	EXPECT_NEAR(a.velocity(1.9)[0], 1 + .25 - .5, roundOff);
	EXPECT_NEAR(a.velocity(.9)[0], 1, roundOff);
	EXPECT_NEAR(a.displacement(.9)[0], .25 * (2 * 1 + 3) / 6, roundOff);
}

TEST(AccelerogramTest, ground_rests_before_and_coasts_after)
{
	const auto a = record();
	for (Real t : { -100., 0., .4 - 1e-9 }) {
		EXPECT_EQ(a.acceleration(t).norm(), 0);
		EXPECT_EQ(a.velocity(t).norm(), 0);
		EXPECT_EQ(a.displacement(t).norm(), 0);
	}
	EXPECT_EQ(a.velocity(.4).norm(), 0);
	EXPECT_EQ(a.displacement(.4).norm(), 0);
	const Vector3r v = a.velocity(1.9), x = a.displacement(1.9);
	EXPECT_EQ(a.acceleration(1.9 + 1e-9).norm(), 0);
	EXPECT_LT((a.velocity(10) - v).norm(), roundOff);
	EXPECT_LT((a.displacement(10) - (x + 8.1 * v)).norm(), 10 * roundOff);
	EXPECT_LT((a.displacement(1.9 + 1e-9) - x).norm(), 1e-8); // no jump
}

TEST(AccelerogramTest, half_sine_gives_its_known_velocity)
{
	std::vector<Vector3r> half;
	const int             n = 1000;
	for (int i = 0; i <= n; ++i)
		half.push_back({ std::sin(M_PI * i / n), 0, 0 });
	const Accelerogram a(1. / n, half, 0);
	EXPECT_NEAR(a.velocity(1)[0], 2 / M_PI, 1e-6); // trapezia: (pi/n)^2 / 12 of it
	EXPECT_NEAR(a.displacement(1)[0], 1 / M_PI, 1e-6);
}

TEST(AccelerogramTest, record_not_given_is_ground_at_rest)
{
	const Accelerogram none;
	for (Real t : { -1., 0., .5, 7. }) {
		EXPECT_EQ(none.acceleration(t).norm(), 0);
		EXPECT_EQ(none.velocity(t).norm(), 0);
		EXPECT_EQ(none.displacement(t).norm(), 0);
	}
}

TEST(AccelerogramTest, bad_input_is_refused_with_the_value_and_what_is_allowed)
{
	const Real nan = std::numeric_limits<Real>::quiet_NaN(), infinite = std::numeric_limits<Real>::infinity();
	for (Real interval : { 0., -.01, nan, infinite })
		EXPECT_NE(refusal(interval, samples, 0).find("must be finite and > 0"), std::string::npos) << interval;
	EXPECT_NE(refusal(-.01, samples, 0).find("-0.01"), std::string::npos);
	EXPECT_NE(refusal(.01, samples, infinite).find("time of the first sample"), std::string::npos);
	EXPECT_NE(refusal(.01, { Vector3r::Zero() }, 0).find("1 samples"), std::string::npos);
	EXPECT_NE(refusal(.01, {}, 0).find("at least 2"), std::string::npos);
	auto broken   = samples;
	broken[2][1]  = nan;
	const auto is = refusal(.01, broken, 0);
	EXPECT_NE(is.find("sample 2"), std::string::npos);
	EXPECT_NE(is.find("nan"), std::string::npos);
	EXPECT_EQ(refusal(.01, samples, -3), "");
}
