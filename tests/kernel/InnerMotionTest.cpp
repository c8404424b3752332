// SPDX-License-Identifier: GPL-2.0-or-later
#include <pkg/brick/kernel/InnerMotion.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace brick;

namespace {

/// Position at a time of an oscillator set off from rest at q = 1 under a constant load, for steps of dt.
Real released(Real omega, Real zeta, Real load, Real time, int steps)
{
	const Real dt = time / steps;
	// rate at -dt/2 of the smooth solution, to second order: -q''(0) dt / 2
	ModeState m { 1, -dt / 2 * (load - omega * omega) };
	for (int i = 0; i < steps; ++i)
		m = advanced(m, load, omega * omega, zeta, 0, dt);
	return m.amplitude;
}

/// The same in closed form.
Real exact(Real omega, Real zeta, Real load, Real time)
{
	const Real rest = load / (omega * omega), damped = omega * std::sqrt(1 - zeta * zeta);
	return rest + (1 - rest) * std::exp(-zeta * omega * time) * (std::cos(damped * time) + zeta * omega / damped * std::sin(damped * time));
}

} // namespace

TEST(InnerMotionTest, oscillator_follows_its_closed_form_to_second_order)
{
	for (Real zeta : { 0., .05, .4 })
		for (Real load : { 0., 70. }) {
			const Real omega = 7, time = 1.3; // 1.4 periods
			Real       error[3];
			for (int i = 0; i < 3; ++i)
				error[i] = std::abs(released(omega, zeta, load, time, 200 << i) - exact(omega, zeta, load, time));
			EXPECT_LT(error[0], 2e-3) << zeta; // (omega dt)^2 omega t / 12, some 2e-3
			// the next order, which is larger the more damping there is, halves from one to the next; first or third order would be 2 or 8
			EXPECT_NEAR(error[0] / error[1], 4, .5) << zeta << " " << load;
			EXPECT_NEAR(error[1] / error[2], 4, .26) << zeta << " " << load;
		}
}

TEST(InnerMotionTest, undamped_energy_is_kept_for_a_hundred_thousand_steps)
{
	for (Real phase : { .01, 1., 10., 1000. }) { // omega dt
		const Real dt = 1e-3, omegaSquared = phase * phase / (dt * dt), inertia = 1 + phase * phase / 4;
		ModeState  m { 1e-3, .2e-3 * phase / dt / std::sqrt(inertia) };
		// kept exactly by leap-frog with that inertia
		const auto energy = [&](const ModeState& before, const ModeState& after) {
			return inertia * after.rate * after.rate / 2 + omegaSquared * before.amplitude * after.amplitude / 2;
		};
		ModeState  next  = advanced(m, 0, omegaSquared, 0, 0, dt);
		const Real first = energy(m, next);
		for (int i = 0; i < 100000; ++i) {
			m    = next;
			next = advanced(m, 0, omegaSquared, 0, 0, dt);
			ASSERT_NEAR(energy(m, next) / first, 1, 1e-9)
			        << phase << " " << i; // 1e5 roundings, added up at the worst: 1e-11; omega dt = 1000 amplifies them
		}
	}
}

TEST(InnerMotionTest, no_step_is_too_long_for_the_modes_own_stiffness)
{
	for (Real phase : { 2.5, 30., 1e4 })
		for (Real zeta : { 0., .05, 1. }) {
			ModeState m { 1, 0 };
			for (int i = 0; i < 10000; ++i) {
				m = advanced(m, 0, phase * phase, zeta, 0, 1);
				// From rest half a step before, the midpoint rule swings up to this much beyond the start (it lies near the border of stability then),
				// but no further; 1e4 roundings.
				ASSERT_LE(std::abs(m.amplitude), std::sqrt(1 + phase * phase / 4) * (1 + 1e-6)) << phase << " " << zeta;
			}
		}
}

TEST(InnerMotionTest, contact_spring_alone_limits_the_step)
{
	// a load -k q from outside: stable up to dt = 2 / sqrt(k), whatever the mode's own stiffness
	for (Real omegaSquared : { 0., 1., 100., 1e6 })
		for (Real factor : { .999, 1.001 }) {
			ModeState m { 1, 0 };
			Real      largest = 0;
			for (int i = 0; i < 200000; ++i) {
				m       = advanced(m, -1 * m.amplitude, omegaSquared, 0, 0, 2 * factor);
				largest = std::max(largest, std::abs(m.amplitude));
				if (!(largest < 1e6)) break;
			}
			if (factor < 1) {
				EXPECT_LT(largest, 23 * std::sqrt(1 + omegaSquared)) << omegaSquared; // 1 / sqrt(1 - 0.999^2) = 22, times the swing above
			} else if (omegaSquared < 1e4) {                                              // slower than 2e5 steps can show beyond
				EXPECT_GT(largest, 1e3) << omegaSquared;
			}
		}
}

TEST(InnerMotionTest, mode_at_rest_under_its_load_stays_there)
{
	for (Real omegaSquared : { 4., 1e8 })
		for (Real damping : { 0., .3 }) {
			const ModeState rest { 8 / omegaSquared, 0 }, next = advanced(rest, 8, omegaSquared, .1, damping, .01);
			EXPECT_EQ(next.rate, 0);
			EXPECT_EQ(next.amplitude, rest.amplitude);
		}
}

TEST(InnerMotionTest, free_oscillation_decays_by_the_given_fraction_of_critical_damping)
{
	for (Real zeta : { .02, .1, .5 }) {
		const Real omega = 3, dt = 1e-3 / omega;
		ModeState  m { 1, 0 };
		Real       last = 0;
		for (int swings = 0; swings < 2;) { // two maxima after the start: logarithmic decrement
			const ModeState next = advanced(m, 0, omega * omega, zeta, 0, dt);
			if (m.rate > 0 && next.rate <= 0) {
				if (++swings == 1) last = m.amplitude;
				else
					EXPECT_NEAR(
					        std::log(last / m.amplitude),
					        2 * M_PI * zeta / std::sqrt(1 - zeta * zeta),
					        1e-5 * 2 * M_PI); // flat at the top: (omega dt)^2
			}
			m = next;
		}
	}
}

TEST(InnerMotionTest, local_damping_takes_a_fraction_of_the_net_force_against_the_motion)
{
	// net force 8 with the motion, then against it
	EXPECT_NEAR(advanced({ 0, 1 }, 8, 0, 0, .25, .01).rate, 1 + .01 * 8 * .75, 1e-15);
	EXPECT_NEAR(advanced({ 0, -1 }, 8, 0, 0, .25, .01).rate, -1 + .01 * 8 * 1.25, 1e-15);
	ModeState m { 1, 0 };
	for (int i = 0; i < 2000; ++i)
		m = advanced(m, 0, 1, 0, .2, .05);
	EXPECT_LT(std::abs(m.amplitude), 1e-3); // sixteen periods, each losing most of a half
}

TEST(ModeColumns, give_the_products_with_the_shapes_bitwise_whatever_the_instruction_set)
{
	for (const int dofs : { 1, 8, 24, 78 })
		for (const int modes : { 1, 6, 18, 72 }) {
			std::vector<Real> shapes(std::size_t(dofs) * modes), q(modes), f(dofs);
			Real              x = .3;
			for (auto* values : { &shapes, &q, &f })
				for (Real& value : *values)
					value = x = 3.7 * x * (1 - x); // chaotic: no two alike
			const ModeColumns columns(shapes.data(), dofs, modes);
			std::vector<Real> u(columns.paddedDofs()), load(columns.paddedModes());
			columns.displacements(q.data(), u.data());
			columns.loads(f.data(), load.data());
			for (int j = 0; j < columns.paddedDofs(); ++j) {
				Real sum = 0;
				for (int k = 0; k < modes && j < dofs; ++k)
					sum += q[k] * shapes[std::size_t(k) * dofs + j];
				ASSERT_EQ(u[j], sum);
			}
			for (int k = 0; k < columns.paddedModes(); ++k) {
				Real sum = 0;
				for (int j = 0; j < dofs && k < modes; ++j)
					sum += f[j] * shapes[std::size_t(k) * dofs + j];
				ASSERT_EQ(load[k], sum);
			}
		}
}

TEST(AdvanceModes, is_bitwise_what_each_mode_does_whatever_the_instruction_set)
{
	for (const int count : { 1, 6, 8, 18, 72 })
		for (const Real zeta : { 0., .02 })
			for (const Real localDamping : { 0., .3 }) {
				std::vector<Real> omegaSquared(count), loads(count), q(count), rate(count);
				Real              x = .3;
				for (auto* values : { &omegaSquared, &loads, &q, &rate })
					for (Real& value : *values)
						value = 1e3 * (x = 3.7 * x * (1 - x));
				std::vector<ModeState> expected;
				for (int k = 0; k < count; ++k)
					expected.push_back(advanced({ q[k], rate[k] }, loads[k], omegaSquared[k], zeta, localDamping, .01));
				advanceModes(omegaSquared, loads.data(), zeta, localDamping, .01, q.data(), rate.data());
				for (int k = 0; k < count; ++k) {
					ASSERT_EQ(q[k], expected[k].amplitude);
					ASSERT_EQ(rate[k], expected[k].rate);
				}
			}
}

namespace {

/// Modes that are moved by loads as they please, and their energy at a step.
struct LoadedModes {
	std::vector<Real> omegaSquared, amplitude, rate, load;
	Real              zeta, localDamping, dt;
	ModeEnergy        energy;

	LoadedModes(const std::vector<Real>& phases, Real zeta, Real localDamping, Real dt)
	        : zeta(zeta)
	        , localDamping(localDamping)
	        , dt(dt)
	{
		for (Real phase : phases) {
			omegaSquared.push_back(phase * phase / (dt * dt));
			amplitude.push_back(1e-3), rate.push_back(.2e-3 / dt), load.push_back(0);
		}
	}
	/// To the next step. @return work of the loads, the mean of those of both ends, on the way @param loadAt of a mode at a step
	template <class Load> Real step(int number, Load loadAt)
	{
		const auto before = amplitude, loadBefore = load;
		Real       work = 0;
		if (number > 0) advance();
		for (std::size_t k = 0; k < load.size(); ++k) {
			load[k] = loadAt(int(k), number);
			work += (loadBefore[k] + load[k]) / 2 * (amplitude[k] - before[k]);
		}
		auto rateAfter = rate, next = amplitude;
		advanceModes(omegaSquared, load.data(), zeta, localDamping, dt, next.data(), rateAfter.data());
		energy = modeEnergy(omegaSquared, load.data(), amplitude.data(), rate.data(), rateAfter.data(), zeta, localDamping, dt);
		return work;
	}

private:
	void advance() { advanceModes(omegaSquared, load.data(), zeta, localDamping, dt, amplitude.data(), rate.data()); }
};

} // namespace

TEST(ModeEnergy, changes_by_the_work_of_loads_and_of_damping_alone)
{
	for (const Real dt : { 1e-5, 1. })
		for (const Real zeta : { 0., .05, 1. })
			for (const Real localDamping : { 0., .3 }) {
				LoadedModes m({ 0, .01, .5, 2, 10 }, zeta, localDamping, dt);
				Real        last = 0, late = 0, turned = 0, x = .3;
				for (int i = 0; i < 300; ++i) {
					// chaotic, of the size of the stiffness of the third mode
					const Real work = m.step(i, [&](int, int) { return 1e-3 * ((x = 3.7 * x * (1 - x)) - .5) / (dt * dt); });
					const Real all  = m.energy.kinetic + m.energy.elastic;
					turned          = std::max(turned, std::abs(all) + std::abs(work) + std::abs(m.energy.kinetic) + m.energy.elastic);
					if (i > 0) {
						// sums of some thirty numbers of this size
						ASSERT_NEAR(all - last, work - late - m.energy.dampedBefore, 1e-14 * 30 * turned)
						        << i << " " << zeta << " " << localDamping;
					}
					last = all, late = m.energy.dampedAfter;
					EXPECT_TRUE(zeta + localDamping > 0 || (late == 0 && m.energy.dampedBefore == 0));
				}
			}
}

TEST(ModeEnergy, of_free_vibration_stays)
{
	for (const Real phase : { .01, 1., 10., 1000. }) {
		LoadedModes m({ phase }, 0, 0, 1e-3);
		const auto  none = [](int, int) { return 0.; };
		m.step(0, none);
		const Real first = m.energy.kinetic + m.energy.elastic;
		EXPECT_GT(first, 0);
		for (int i = 1; i < 10000; ++i) {
			m.step(i, none);
			// 1e4 roundings, added up at the worst: 1e-12; the two parts, of which kinetic may be negative, are up to phase^2/4 times their sum
			ASSERT_NEAR((m.energy.kinetic + m.energy.elastic) / first, 1, 1e-12 * (1 + phase * phase / 4)) << phase << " " << i;
		}
	}
}

TEST(ModeEnergy, is_that_of_the_oscillator_in_the_limit_of_small_steps)
{
	// closed form of amplitude 1: omega^2 / 2; midway between rest and the greatest speed both parts have half
	for (int steps : { 100, 200 }) {
		const Real  omega = 7, dt = M_PI / 4 / omega / steps;
		LoadedModes m({ omega * dt }, 0, 0, dt);
		m.amplitude = { 1 }, m.rate = { dt / 2 * omega * omega };
		const auto none = [](int, int) { return 0.; };
		for (int i = 0; i <= steps; ++i)
			m.step(i, none);
		const Real half = omega * omega / 4;
		EXPECT_NEAR(m.energy.elastic, half, half * omega * dt * omega * dt); // second order
		EXPECT_NEAR(m.energy.kinetic, half, half * omega * dt * omega * dt);
	}
}
