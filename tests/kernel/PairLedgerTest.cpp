// SPDX-License-Identifier: GPL-2.0-or-later
// What the ledgers of joints and contacts book, beside work that is counted from forces and motions alone: over a step the mean of the forces at both ends
// times the displacement between. As far as springs are linear and nothing turns, both agree to round-off; otherwise to an order of the step that is derived.
#include "Pairs.hpp"

#include <pkg/brick/kernel/PairLedger.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace brick;
using pairs::Body;
using pairs::edge;

namespace {

constexpr int  below = 4, above = 5; // faces -z and +z
constexpr Real bed   = edge * edge;
constexpr Real micro = 1e-6; ///< size of openings [m]
/// Relative to the energy turned over: openings of 1e-6 m are differences of places of 0.1 m, which round to 1.4e-17 m; sums of some hundred of them.
constexpr Real roundOff = 1e-9;

MortarStrength unbreakable() { return { 1e30, 1e30, pairs::friction, 1e30, 9 }; }

const Vector3r* surfaceOf(const Body& b) { return b.side().placement.displacement; }

/// Work of forces on a body between two of its placements.
Real workOn(const Body& before, const Body& now, const Loads& loadsBefore, const Loads& loadsNow)
{
	const Eigen::AngleAxis<Real> turn(Matrix3r(now.placement.rotation * before.placement.rotation.transpose()));
	Real                         work = (loadsBefore.force + loadsNow.force).dot(now.placement.position - before.placement.position) / 2
	        + (loadsBefore.torque + loadsNow.torque).dot(turn.angle() * turn.axis()) / 2;
	for (std::size_t a = 0; now.deformable && a < loadsNow.nodal.size(); ++a)
		work += (loadsBefore.nodal[a] + loadsNow.nodal[a]).dot(surfaceOf(now)[a] - surfaceOf(before)[a]) / 2;
	return work;
}

/// Velocities with which a body came from another placement.
void setVelocities(Body& b, const Body& before, Real dt)
{
	const Eigen::AngleAxis<Real> turn(Matrix3r(b.placement.rotation * before.placement.rotation.transpose()));
	b.placement.velocity        = (b.placement.position - before.placement.position) / dt;
	b.placement.angularVelocity = turn.angle() / dt * turn.axis();
	for (int a = 0; a < nodeCount; ++a)
		b.rate[a] = (b.displacement[a] - before.displacement[a]) / dt;
	for (std::size_t a = 0; a < b.surface.size(); ++a)
		b.surfaceRate[a] = (b.surface[a] - before.surface[a]) / dt;
}

/// Energy that came in, and what became of it [J].
struct Books {
	Real elastic = 0, fracture = 0, friction = 0, dashpot = 0, area = 0;
	Real first         = 0; ///< elastic energy at the start
	Real work          = 0; ///< done on the pair since
	Real turned        = 0; ///< sum of its absolute values and of all energy booked
	Real leastFracture = 0;

	void add(const PairEnergy& e, Real done, bool atStart)
	{
		if (atStart) first = e.elastic;
		turned += std::abs(done) + std::abs(e.elastic - elastic) + std::abs(e.fracture) + std::abs(e.friction) + std::abs(e.dashpot) + std::abs(e.area);
		elastic = e.elastic;
		fracture += e.fracture, friction += e.friction, dashpot += e.dashpot, area += e.area, work += done;
		leastFracture = std::min(leastFracture, e.fracture);
	}
	/// Work that is found nowhere.
	Real missing() const { return work - (elastic - first + fracture + friction + dashpot + area); }
};

/// Two bodies that are moved as one pleases.
struct Mover {
	Body                 first, second, before0, before1;
	PairSprings          springs = pairs::springs();
	LawTerms             terms;
	std::array<Loads, 2> loads, loadsBefore;
	Books                books;
	Real                 dt    = 1e-5;
	int                  steps = 0;

	Mover(const Body& first, const Body& second)
	        : first(first)
	        , second(second)
	        , before0(first)
	        , before1(second)
	{
		if (first.support) springs = pairs::onSupport(springs, 0);
		if (second.support) springs = pairs::onSupport(springs, 1);
	}
	virtual ~Mover() = default;
	/// Forces as it is placed now, and what was booked.
	virtual PairEnergy look() = 0;

	void step()
	{
		if (steps == 0) before0 = first, before1 = second; // at rest
		setVelocities(first, before0, dt), setVelocities(second, before1, dt);
		const PairEnergy e    = look();
		const Real       done = steps > 0 ? -workOn(before0, first, loadsBefore[0], loads[0]) - workOn(before1, second, loadsBefore[1], loads[1]) : 0;
		books.add(e, done, steps == 0);
		before0 = first, before1 = second, loadsBefore = loads;
		++steps;
	}
	/// Moves the second in equal steps.
	void shift(const Vector3r& by, int count)
	{
		const Vector3r from = second.placement.position;
		for (int i = 1; i <= count; ++i)
			second.placement.position = from + Real(i) / count * by, step();
	}
	/// Along a path in equal steps, time from 0 to 1. @param place puts the bodies, from where they are now
	void follow(int count, const std::function<void(Body& first, Body& second, Real time)>& place)
	{
		const Body from0 = first, from1 = second;
		for (int i = 0; i <= count; ++i) {
			first = from0, second = from1;
			place(first, second, Real(i) / count);
			step();
		}
	}
	void expectClosed(Real share = roundOff) const { EXPECT_LE(std::abs(books.missing()), share * books.turned) << books.turned; }
};

struct JointMover : Mover {
	Joint       joint;
	JointLedger ledger;
	Failures    failures;
	bool        booked = true; ///< whether a ledger is kept

	JointMover(const Body& lower, const Body& upper, const MortarStrength& strength)
	        : Mover(lower, upper)
	{
		joint = *joinFaces(first.side(), above, second.side(), below, 3e-7);
		joint.setMortar(springs.at(first.contactLength[above], second.contactLength[below]), strength);
	}
	static JointMover stacked(const MortarStrength& strength = unbreakable(), int segments = 4)
	{
		return JointMover(Body::cube({ 0, 0, 0 }, segments), Body::cube({ 0, 0, edge }, segments), strength);
	}
	/// Half over half, deformable, faces of cells.
	static JointMover english(int cells, const MortarStrength& strength)
	{
		Body lower = Body::cube({ 0, 0, 0 }, 4), upper = Body::cube({ edge / 2, 0, edge }, 4);
		lower.deformable = upper.deformable = true;
		if (cells > 1) lower.refine(cells), upper.refine(cells);
		return JointMover(lower, upper, strength);
	}
	/// All segments have failed; springs with dashpots.
	void breakAll(Real damping = 0)
	{
		springs.normalDamping = springs.shearDamping = damping;
		joint.setMortar(springs.at(first.contactLength[above], second.contactLength[below]), joint.shape->strength);
		pairs::failAll(joint, SegmentState::Tension);
	}
	PairEnergy look() override
	{
		const JointMotion     motion = pairs::motionOf(joint, first, second);
		const JointPlacements moving { first.side().placement, second.side().placement };
		JointLoads            found;
		PairSummary           sum;
		const Failures        now = jointLoads(joint, motion, &moving, springs.tanFriction, found, sum, booked ? &ledger : nullptr, terms);
		failures.tension += now.tension, failures.shear += now.shear, failures.compression += now.compression;
		for (int s = 0; s < 2; ++s) {
			const Body& b  = s ? second : first;
			loads[s]       = Loads(b.cells);
			loads[s].force = found.forceOn(s), loads[s].torque = found.torque[s];
			addNodalForces(joint, found, s, b.placement.rotation, loads[s].nodal.data());
		}
		return ledger.energy;
	}
	const SpotSprings& k() const { return joint.springs; }
};

struct ContactMover : Mover {
	std::vector<ContactSpot> spots;
	ContactMemory            memory, scratch;
	ContactLedger            ledger;
	Real                     area = 0; ///< at present

	using Mover::Mover;
	static ContactMover onSlab(Real pressed, int segments = 4)
	{
		return ContactMover(Body::slab({ 3, 3, .2 }, { 0, 0, 0 }), Body::cube({ 0, 0, .1 + edge / 2 - pressed }, segments));
	}
	static ContactMover stacked(Real pressed, int segments = 4)
	{
		return ContactMover(Body::cube({ 0, 0, 0 }, segments), Body::cube({ 0, 0, edge - pressed }, segments));
	}
	PairEnergy look() override
	{
		const Side  side0 = first.side(), side1 = second.side();
		PairSummary sum;
		findContact(side0, side1, spots);
		contactLoads(side0, side1, spots, springs, dt, memory, scratch, loads, sum, terms);
		ledger.add(side0, side1, spots, springs, dt, memory, terms);
		area = sum.area;
		return ledger.energy;
	}
	SpotSprings k() const { return springs.at(first.contactLength[above], second.contactLength[below]); }
};

/// About a place, pressed there at some micrometres or less, sideways and turned a little, in random steps.
void wander(Mover& m, const Vector3r& at, int steps, pairs::Random& random)
{
	for (int i = 0; i < steps; ++i) {
		Vector3r to                 = micro * random.vector(4);
		to[2]                       = -micro * random.between(2, 5);
		m.second.placement.position = at + to;
		m.step();
	}
}

const LawTerms leaner[] { { false, true, true }, { true, false, true }, { true, true, false }, { true, false, false }, { false, false, false } };

/// That nothing is booked for what the law leaves out.
void expectLeftOut(const Books& b, const LawTerms& t)
{
	if (!t.failure) { EXPECT_EQ(b.fracture, 0); }
	if (!t.friction) { EXPECT_EQ(b.friction, 0); }
	if (!t.dashpots) { EXPECT_EQ(b.dashpot, 0); }
}

/// What is missing after a path in some steps, in twice and in four times as many.
template <class Make> std::array<Real, 3> missingByStep(Make make, int count, const std::function<void(Body&, Body&, Real)>& place)
{
	std::array<Real, 3> out;
	for (Real& missing : out) {
		auto mover = make();
		mover.follow(count, place);
		missing = mover.books.missing();
		count *= 2;
	}
	return out;
}

} // namespace

// Joints

TEST(JointLedgerTest, opening_and_sliding_of_a_joint_that_holds_close_to_round_off)
{
	pairs::Random random(31);
	JointMover    p = JointMover::stacked();
	p.step();
	EXPECT_NEAR(p.books.elastic, 0, roundOff * p.k().normal * bed * micro * micro);
	for (int i = 0; i < 20; ++i) {
		const Vector3r d            = micro * random.vector(1);
		p.second.placement.position = Vector3r(0, 0, edge) + d;
		p.step();
		const Real U = bed / 2 * (p.k().normal * d[2] * d[2] + p.k().shear * d.head<2>().squaredNorm());
		EXPECT_NEAR(p.books.elastic, U, roundOff * p.books.turned);
	}
	p.expectClosed();
	EXPECT_EQ(p.books.fracture + p.books.friction + p.books.dashpot + p.books.area, 0);
}

TEST(JointLedgerTest, energy_of_two_patches_is_that_of_the_joint)
{
	JointMover p = JointMover::english(2, unbreakable());
	p.follow(10, [](Body& first, Body& second, Real t) {
		first.surface[3] += micro * t * Vector3r(1, -1, 2);
		second.move(1e-5 * t * Vector3r(1, 2, -1), micro * t * Vector3r(1, 1, 1), { 0, 0, .1 });
	});
	ASSERT_EQ(p.joint.shape->patches.size(), 2u);
	EXPECT_NEAR(p.books.elastic, jointEnergy(p.joint, pairs::motionOf(p.joint, p.first, p.second), 0), roundOff * p.books.elastic);
	EXPECT_GT(p.books.elastic, 0);
}

TEST(JointLedgerTest, bending_twisting_and_deformation_close_with_the_square_of_the_step)
{
	for (int cells : { 1, 2 }) {
		const auto missing = missingByStep(
		        [&] { return JointMover::english(cells, unbreakable()); },
		        8,
		        [&](Body& first, Body& second, Real t) {
			        for (int s = 0; s < 2; ++s) {
				        Body&      b = s ? second : first;
				        const Real a = micro * std::sin(3 * t + s);
				        for (int n = 0; n < nodeCount; ++n)
					        b.displacement[n] += a * Vector3r(std::sin(n + s), std::cos(2 * n), std::sin(3 * n - s));
				        for (std::size_t n = 0; n < b.surface.size(); ++n)
					        b.surface[n] += a * Vector3r(std::sin(n + s), std::cos(2 * n), std::sin(3 * n - s));
			        }
			        second.move(1e-4 * t * Vector3r(1, 2 * t, -1), micro * t * Vector3r(1, 1 - 3 * t, 1), { .05, 0, .1 });
			        const Vector3r turn(.5 * t, -.3 * t * t, .4 * std::sin(2 * t)); // both as a whole
			        first.move(turn, { 1, -2, .5 }), second.move(turn, { 1, -2, .5 });
		        });
		// the next order, which is a tenth of it with eight steps, halves from one to the next
		EXPECT_NEAR(missing[0] / missing[1], 4, .4) << cells;
		EXPECT_NEAR(missing[1] / missing[2], 4, .2) << cells;
	}
}

TEST(JointLedgerTest, failure_in_each_mode_closes_to_round_off_and_never_gives_energy)
{
	struct Case {
		MortarStrength strength;
		Vector3r       shift;
		int Failures::*mode;
	};
	const Real k = pairs::springs().at(.001, .001).normal * micro, tau = pairs::springs().at(.001, .001).shear * micro;
	for (const Case& c : { Case { { k, 1e30, .6, 1e30, 9 }, { 1, -.5, 3 }, &Failures::tension },
	                       Case { { 1e30, tau, .6, 1e30, 9 }, { 3, 2, 0 }, &Failures::shear },
	                       Case { { 1e30, tau, .6, 1e30, 9 }, { 9, -6, -2 }, &Failures::shear },
	                       Case { { 1e30, 1e30, .6, k, 9 }, { 9, 3, -3 }, &Failures::compression } })
		for (int count : { 2, 7, 40 }) {
			JointMover p          = JointMover::stacked(c.strength);
			p.springs.tanFriction = c.strength.tanFriction;
			p.step();
			p.shift(micro * c.shift, count);
			EXPECT_EQ(p.failures.*c.mode, 16);
			EXPECT_EQ(p.failures.total(), 16);
			p.expectClosed();
			EXPECT_GE(p.books.leastFracture, -roundOff * p.books.turned);
			EXPECT_TRUE(count == 2 || p.books.fracture > 0); // what fails in the first step had no work done on it at all
			EXPECT_EQ(p.books.area, 0);
		}
}

TEST(JointLedgerTest, tension_takes_what_the_springs_held)
{
	JointMover p = JointMover::stacked({ pairs::springs().at(.001, .001).normal * micro, 1e30, .6, 1e30, 9 });
	p.step();
	const Real step = micro / 100;
	p.shift({ 0, 0, 2 * micro }, 200);
	// by the end of the step in which it fails, less the half of its work that is not done any more: strength reached to a hundredth
	EXPECT_NEAR(p.books.fracture, bed / 2 * p.k().normal * micro * micro, 1.01 * bed / 2 * p.k().normal * micro * step);
	EXPECT_EQ(p.books.elastic, 0);
}

TEST(JointLedgerTest, bending_to_failure_closes_segment_by_segment)
{
	const Real strength = 1e3;
	for (int cells : { 1, 2 })
		for (int count : { 100, 1000 }) {
			JointMover p = JointMover::english(cells, { strength, 1e30, pairs::friction, 1e30, 9 });
			p.follow(count, [](Body&, Body& second, Real t) { second.move(t * Vector3r(0, -1e-4, 3e-5), { 0, 0, -micro * t }, { 0, 0, .1 }); });
			EXPECT_EQ(p.failures.tension, 8);
			p.expectClosed(); // axes turn by 1e-4: to the square of what they turn in a step
			EXPECT_GE(p.books.leastFracture, 0);
			EXPECT_GT(p.books.fracture, 0);
			// cracked joints fail by their edges as well, and so hold less in the middle of the segment
			EXPECT_LT(p.books.fracture, bed / 2 * strength * strength / p.k().normal / 2);
		}
}

TEST(JointLedgerTest, friction_is_slip_times_limit)
{
	JointMover p = JointMover::stacked();
	p.breakAll();
	p.second.placement.position[2] -= micro;
	p.step();
	const Real     limit = pairs::friction * p.k().normal * micro, stick = limit / p.k().shear;
	const Vector3r along(.6, -.8, 0);
	p.shift(stick * along, 10); // until it slides
	EXPECT_NEAR(p.books.friction, 0, roundOff * p.books.turned);
	EXPECT_NEAR(p.books.elastic - p.books.first, bed / 2 * limit * stick, roundOff * p.books.turned);
	p.shift(2 * stick * along, 20);
	EXPECT_NEAR(p.books.friction, bed * limit * 2 * stick, roundOff * p.books.turned);
	p.shift(-4 * stick * along, 40); // back: unloads, slides the other way from twice `stick` on
	EXPECT_NEAR(p.books.friction, bed * limit * 4 * stick, roundOff * p.books.turned);
	p.expectClosed();
	EXPECT_NEAR(p.books.fracture + p.books.dashpot + p.books.area, 0, roundOff * p.books.turned);
}

TEST(JointLedgerTest, friction_of_paths_that_turn_aside_closes_to_round_off)
{
	for (int cells : { 1, 2 }) {
		JointMover p = JointMover::english(cells, unbreakable());
		p.breakAll();
		Real last = 0;
		p.follow(200, [&](Body&, Body& second, Real t) {
			EXPECT_GE(p.books.friction, last - roundOff * p.books.turned);
			last = p.books.friction;
			second.placement.position += micro * Vector3r(9 * std::sin(9 * t), 7 * std::sin(13 * t), -2 - std::sin(20 * t)); // stays closed
		});
		EXPECT_GT(p.books.friction, .1 * p.books.turned);
		p.expectClosed();
	}
}

TEST(JointLedgerTest, dashpots_take_what_they_brake)
{
	JointMover p = JointMover::stacked();
	p.breakAll(.05);
	p.second.placement.position[2] -= micro;
	p.step();
	const Real speed = .1 * micro / p.dt; // at once
	p.shift({ 0, 0, -.1 * micro }, 1);
	const Real first = p.books.dashpot;
	EXPECT_NEAR(first, bed * p.k().normalDashpot * speed / 2 * .1 * micro, roundOff * p.books.turned); // the mean of nothing and all of it
	p.shift({ 0, 0, -micro }, 10);
	EXPECT_NEAR(p.books.dashpot - first, bed * p.k().normalDashpot * speed * micro, roundOff * p.books.turned);
	p.expectClosed();

	pairs::Random random(33);
	JointMover    q = JointMover::english(2, unbreakable());
	q.breakAll(.05);
	q.second.placement.position[2] -= 3 * micro;
	q.step();
	for (int i = 0; i < 40; ++i) {
		Vector3r to                 = micro * random.vector(4);
		to[2]                       = -micro * random.between(2, 5);
		q.second.placement.position = Vector3r(edge / 2, 0, edge) + to;
		q.step();
	}
	EXPECT_GT(std::abs(q.books.dashpot), .01 * q.books.turned);
	q.expectClosed();
}

TEST(JointLedgerTest, what_the_law_leaves_out_takes_nothing_and_the_rest_closes)
{
	for (const LawTerms& terms : leaner) {
		pairs::Random  random(35);
		JointMover     p = JointMover::english(2, unbreakable());
		const Vector3r at(edge / 2, 0, edge);
		p.breakAll(.05);
		p.terms = terms;
		p.second.placement.position[2] -= 3 * micro;
		p.step();
		wander(p, at, 40, random);
		expectLeftOut(p.books, terms);
		p.expectClosed();
		p.ledger = JointLedger(); // energy is tracked from here on
		p.books  = Books();
		p.steps  = 0;
		wander(p, at, 40, random);
		expectLeftOut(p.books, terms);
	}
}

TEST(JointLedgerTest, joint_that_cannot_fail_has_no_fracture_beyond_its_strength)
{
	JointMover p    = JointMover::english(2, { 1e3, 5e3, pairs::friction, 2e4, 9 });
	p.terms.failure = false;
	p.step();
	p.shift(30 * micro * Vector3r(1, -2, 3), 10);
	EXPECT_TRUE(p.joint.holds());
	p.shift(-60 * micro * Vector3r(1, -2, 3), 10);
	EXPECT_TRUE(p.joint.holds());
	expectLeftOut(p.books, p.terms);
	p.expectClosed();
}

TEST(JointLedgerTest, shear_that_is_let_go_with_friction_is_taken_by_it_once)
{
	JointMover p = JointMover::stacked();
	p.breakAll();
	p.second.placement.position[2] -= micro;
	p.step();
	p.shift(.5 * pairs::friction * micro * Vector3r(1, 0, 0), 4); // sticks
	EXPECT_NEAR(p.books.friction, 0, roundOff * p.books.turned);
	const Real held  = p.books.elastic - p.books.first;
	p.terms.friction = false;
	p.shift(micro * Vector3r(0, 0, -.1), 1);
	EXPECT_NEAR(p.books.friction, held, roundOff * p.books.turned);
	const Real taken = p.books.friction;
	p.shift(micro * Vector3r(3, 1, 0), 3);
	EXPECT_EQ(p.books.friction, taken);
	p.terms.friction = true;
	p.shift(.1 * micro * Vector3r(3, 1, 0), 3);
	p.expectClosed();
}

TEST(JointLedgerTest, closing_within_a_step_misses_what_the_chord_does_beside_the_law)
{
	// a failed segment from u0 > 0 to u1 < 0: the chord does kn u1 (u1 - u0) / 2, the spring takes kn u1^2 / 2
	for (Real u0 : { 1., .3 }) {
		JointMover p = JointMover::stacked();
		p.breakAll();
		p.second.placement.position[2] += u0 * micro;
		p.step();
		const Real u1 = -.7;
		p.shift({ 0, 0, (u1 - u0) * micro }, 1);
		const Real missing = -bed * p.k().normal * u0 * u1 / 2 * micro * micro;
		EXPECT_NEAR(p.books.missing(), missing, roundOff * p.books.turned);
	}
}

TEST(JointLedgerTest, forces_are_bitwise_the_same_with_and_without_a_ledger)
{
	for (int cells : { 1, 2 }) {
		JointMover p = JointMover::english(cells, { 1e3, 5e3, pairs::friction, 2e4, 9 }), q = p;
		q.booked = false;
		for (int i = 0; i < 300; ++i) {
			const Real t = i / 300.;
			for (JointMover* m : { &p, &q }) {
				m->first = JointMover::english(cells, unbreakable()).first, m->second = JointMover::english(cells, unbreakable()).second;
				m->second.move(1e-4 * std::sin(9 * t) * Vector3r(1, 2, -1), 2 * micro * std::sin(20 * t) * Vector3r(1, 1, -1), { 0, 0, .1 });
				m->step();
			}
			for (int s = 0; s < 2; ++s) {
				ASSERT_EQ(p.loads[s].force, q.loads[s].force);
				ASSERT_EQ(p.loads[s].torque, q.loads[s].torque);
				for (std::size_t a = 0; a < p.loads[s].nodal.size(); ++a)
					ASSERT_EQ(p.loads[s].nodal[a], q.loads[s].nodal[a]);
			}
		}
		EXPECT_GT(p.failures.tension, 0);
		EXPECT_GT(p.failures.shear + p.failures.compression, 0);
		EXPECT_EQ(q.books.elastic, 0);
	}
}

// Contact

TEST(ContactLedgerTest, pressing_is_half_kn_times_the_square_of_the_depth)
{
	for (bool slab : { false, true }) {
		ContactMover p = slab ? ContactMover::onSlab(micro) : ContactMover::stacked(micro);
		p.step();
		p.shift({ 0, 0, -4 * micro }, 7);
		EXPECT_NEAR(p.books.elastic, bed / 2 * p.k().normal * 25 * micro * micro, roundOff * p.books.turned);
		p.expectClosed();
		EXPECT_EQ(p.books.friction + p.books.dashpot + p.books.area + p.books.fracture, 0);
	}
}

TEST(ContactLedgerTest, friction_of_a_constant_area_is_slip_times_limit)
{
	ContactMover p = ContactMover::onSlab(micro);
	p.step();
	const Real     limit = pairs::friction * p.k().normal * micro, stick = limit / p.k().shear;
	const Vector3r along(.6, -.8, 0);
	p.shift(stick * along, 10);
	EXPECT_NEAR(p.books.friction, 0, roundOff * p.books.turned);
	EXPECT_NEAR(p.books.elastic - p.books.first, bed / 2 * limit * stick, roundOff * p.books.turned);
	p.shift(2 * stick * along, 20);
	EXPECT_NEAR(p.books.friction, bed * limit * 2 * stick, roundOff * p.books.turned);
	p.shift(-4 * stick * along, 40);
	EXPECT_NEAR(p.books.friction, bed * limit * 4 * stick, roundOff * p.books.turned);
	EXPECT_NEAR(p.books.area, 0, roundOff * p.books.turned);
	p.expectClosed();
}

TEST(ContactLedgerTest, dashpots_take_what_they_brake)
{
	ContactMover p          = ContactMover::onSlab(micro);
	p.springs.normalDamping = p.springs.shearDamping = .05;
	p.step();
	const Real speed = .1 * micro / p.dt;
	p.shift({ 0, 0, -.1 * micro }, 1);
	const Real first = p.books.dashpot;
	EXPECT_NEAR(first, bed * p.k().normalDashpot * speed / 2 * .1 * micro, roundOff * p.books.turned);
	p.shift({ 0, 0, -micro }, 10);
	EXPECT_NEAR(p.books.dashpot - first, bed * p.k().normalDashpot * speed * micro, roundOff * p.books.turned);
	p.expectClosed();

	pairs::Random  random(34);
	const Vector3r at = p.second.placement.position;
	for (int i = 0; i < 40; ++i) {
		Vector3r to                 = micro * random.vector(4);
		to[2]                       = micro * random.between(-2, 1);
		p.second.placement.position = at + to;
		p.step();
	}
	EXPECT_GT(p.books.friction, .01 * p.books.turned);
	p.expectClosed();
}

TEST(ContactLedgerTest, what_the_law_leaves_out_takes_nothing_and_the_rest_closes)
{
	for (const LawTerms& terms : leaner) {
		pairs::Random  random(36);
		ContactMover   p        = ContactMover::onSlab(micro);
		const Vector3r at       = p.second.placement.position;
		p.springs.normalDamping = p.springs.shearDamping = .05;
		p.terms                                          = terms;
		p.step();
		wander(p, at, 40, random);
		expectLeftOut(p.books, terms);
		p.expectClosed();
		p.ledger = ContactLedger();
		p.books  = Books();
		p.steps  = 0;
		wander(p, at, 40, random);
		expectLeftOut(p.books, terms);
	}
}

TEST(ContactLedgerTest, shear_that_is_let_go_with_friction_is_taken_by_it_once)
{
	ContactMover p = ContactMover::onSlab(micro);
	p.step();
	p.shift(.5 * pairs::friction * micro * Vector3r(1, 0, 0), 4); // sticks
	const Real held = p.books.elastic - p.books.first, before = p.books.friction;
	EXPECT_NEAR(before, 0, roundOff * p.books.turned);
	p.terms.friction = false;
	p.shift(micro * Vector3r(0, 0, -.1), 1);
	EXPECT_NEAR(p.books.friction, held, roundOff * p.books.turned);
	const Real taken = p.books.friction;
	p.shift(micro * Vector3r(3, 1, 0), 3);
	EXPECT_EQ(p.books.friction, taken);
	p.terms.friction = true;
	p.shift(.1 * micro * Vector3r(3, 1, 0), 3);
	p.expectClosed();
}

TEST(ContactLedgerTest, area_that_changes_is_closed_by_its_own_entry)
{
	for (const Vector3r& path : { Vector3r(.02, .03, 0), Vector3r(-.01, .03, 0) }) // within a segment: no spot leaves
		for (int count : { 3, 60 }) {
			ContactMover p = ContactMover::stacked(micro);
			p.step();
			const Real before = p.area;
			p.shift(path, count);
			// The normal springs of what slides off are let go without a force that would do their work.
			const Real normal = p.k().normal * micro * micro / 2 * (before - p.area);
			EXPECT_NEAR(p.books.missing(), normal, roundOff * p.books.turned);
			EXPECT_NE(p.books.area, 0);
		}
}

TEST(ContactLedgerTest, spot_that_leaves_takes_its_shear_along)
{
	ContactMover p = ContactMover::onSlab(micro);
	p.step();
	const Real slide = pairs::friction * p.k().normal * micro / p.k().shear / 2;
	p.shift({ slide, 0, 0 }, 1);
	EXPECT_EQ(p.books.area, 0);
	p.shift({ 0, 0, 10 * micro }, 1);
	EXPECT_NEAR(p.books.area, bed / 2 * p.k().shear * slide * slide, roundOff * p.books.turned);
	EXPECT_EQ(p.books.elastic, 0);
	EXPECT_TRUE(p.spots.empty());
}

TEST(ContactLedgerTest, shear_of_spots_that_leave_is_missed_for_half_a_step)
{
	// The end of a segment is passed after .055 m, in the middle of a step whatever the step: the strip that leaves then is half a step wide, and sliding friction
	// works on it for half a step, since it is not there at its end.
	for (int count : { 10, 30, 90 }) {
		ContactMover p                 = ContactMover::stacked(micro);
		p.second.placement.position[0] = -.005;
		p.step();
		const Real before = p.area, step = .1 / count, limit = pairs::friction * p.k().normal * micro;
		p.shift({ .1, 0, 0 }, count);
		const Real normal = p.k().normal * micro * micro / 2 * (before - p.area), strip = edge * step / 2;
		EXPECT_NEAR(p.books.missing() - normal, strip * limit * step / 2, roundOff * p.books.turned) << count;
	}
}

TEST(ContactLedgerTest, rocking_closes_with_the_square_of_the_step)
{
	for (bool slab : { true, false }) {
		const auto missing = missingByStep(
		        [&] {
			        auto p                = slab ? ContactMover::onSlab(0) : ContactMover::stacked(0);
			        p.springs.tanFriction = 0;
			        return p;
		        },
		        50,
		        [](Body&, Body& second, Real t) {
			        second.move(1e-3 * Vector3r(std::sin(4 * t), t, 0), { 0, 0, -1e-5 * (1 + t) }, second.world({ 0, 0, -edge / 2 }));
		        });
		// each strip begins to press somewhere within a step: a tenth
		EXPECT_NEAR(missing[0] / missing[1], 4, .4) << slab;
		EXPECT_NEAR(missing[1] / missing[2], 4, .4) << slab;
	}
}
