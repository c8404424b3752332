// SPDX-License-Identifier: GPL-2.0-or-later
#include "PairLedger.hpp"

#include <algorithm>

namespace brick {

namespace {

	/// A field at a segment: normal, tangential components.
	Vector3r at(const SegmentField& field, Real p, Real q)
	{
		return { brick::at(field.normal, p, q), brick::at(field.tangent1, p, q), brick::at(field.tangent2, p, q) };
	}

	void addMoments(SegmentField& field, const Vector3r& force, Real p, Real q)
	{
		Real* const rows[3] { field.normal, field.tangent1, field.tangent2 };
		for (int i = 0; i < 3; ++i)
			rows[i][0] += force[i], rows[i][1] += p * force[i], rows[i][2] += q * force[i], rows[i][3] += p * q * force[i];
	}

	/// Of the mean of two sums of forces, over the displacement between two openings.
	Real work(const SegmentField& force0, const SegmentField& force1, const SegmentField& opening0, const SegmentField& opening1)
	{
		Real sum   = 0;
		auto along = [&](const Real(&f0)[4], const Real(&f1)[4], const Real(&u0)[4], const Real(&u1)[4]) {
			for (int i = 0; i < 4; ++i)
				sum += (f0[i] + f1[i]) / 2 * (u1[i] - u0[i]);
		};
		along(force0.normal, force1.normal, opening0.normal, opening1.normal);
		along(force0.tangent1, force1.tangent1, opening0.tangent1, opening1.tangent1);
		along(force0.tangent2, force1.tangent2, opening0.tangent2, opening1.tangent2);
		return sum;
	}

	/// Springs of a segment: tractions, normal and tangential components [Pa], and the energy that they hold by area [J/m2].
	struct Springs {
		const SpotSprings& k;
		Vector3r           traction(const Vector3r& stretch) const { return { k.normal * stretch[0], k.shear * stretch[1], k.shear * stretch[2] }; }
		Real               energy(const Vector3r& stretch) const { return stretch.dot(traction(stretch)) / 2; }
	};

	/// One segment in a step.
	struct SegmentStep {
		Vector3r     opening0, opening;      // before and now
		Vector3r     slip0, slip;            // plastic part; along the normal none
		SegmentState state0, state;

		SegmentStep(const JointSegments& before, const JointSegments& after, int i, const SegmentField& u0, const SegmentField& u)
		        : opening0(at(u0, before.row(JointSegments::P)[i], before.row(JointSegments::Q)[i]))
		        , opening(at(u, after.row(JointSegments::P)[i], after.row(JointSegments::Q)[i]))
		        , slip0(0, before.row(JointSegments::Slip1)[i], before.row(JointSegments::Slip2)[i])
		        , slip(0, after.row(JointSegments::Slip1)[i], after.row(JointSegments::Slip2)[i])
		        , state0(SegmentState(int(before.row(JointSegments::State)[i])))
		        , state(SegmentState(int(after.row(JointSegments::State)[i])))
		{
		}
		/// Stretch of the springs that are left, in this step and in the one before.
		Vector3r stretch() const { return stretchOf(state, opening, slip); }
		Vector3r stretch0() const { return stretchOf(state0, opening0, slip0); }

	private:
		static Vector3r stretchOf(SegmentState state, const Vector3r& opening, const Vector3r& slip)
		{
			if (state == SegmentState::Intact) return opening;
			return { std::min(0., opening[0]), opening[1] - slip[1], opening[2] - slip[2] };
		}
	};

	/// Traction of the dashpots of a failed segment: what there is besides the springs (JointSegmentsLanes.hpp).
	Vector3r dashpotTraction(const SegmentSweep& sweep, const SegmentStep& s, const Vector3r& elastic, Real p, Real q)
	{
		if (s.state0 == SegmentState::Intact) return Vector3r::Zero();
		const Vector3r rate     = at(sweep.rate, p, q);
		const Real     pressure = s.opening[0] < 0 ? std::max(0., -(elastic[0] + sweep.springs.normalDashpot * rate[0])) : 0;
		const Real     limit    = sweep.terms.friction ? pressure * sweep.tanFriction : 0;
		const Vector3r shear(0, elastic[1] + sweep.springs.shearDashpot * rate[1], elastic[2] + sweep.springs.shearDashpot * rate[2]);
		const Vector3r all = limited(shear, limit) - Vector3r(pressure, 0, 0);
		return all - elastic;
	}

} // namespace

void JointLedger::begin(const Joint& joint)
{
	const std::size_t count = joint.shape->patches.size();
	energy                  = {};
	last                    = patches.size() == count ? present : joint.springs;
	present                 = joint.springs;
	if (patches.size() != count) patches.assign(count, {});
}

namespace {

	/// Values at the corners of the rectangle.
	Vector4r atCorners(const Real (&c)[4]) { return { c[0], c[0] + c[1], (c[0] + c[1]) + (c[2] + c[3]), c[0] + c[2] }; }

	/// What stiffer springs hold more, by stretches of the step before and of this one.
	Real stiffening(const SpotSprings& from, const SpotSprings& to, const Vector3r& stretch0, const Vector3r& stretch)
	{
		const Real normal = (to.normal - from.normal) / 2, shear = (to.shear - from.shear) / 2;
		return normal * stretch0[0] * stretch[0] + shear * (stretch0[1] * stretch[1] + stretch0[2] * stretch[2]);
	}

} // namespace

void JointLedger::addHolding(const Joint& joint, std::size_t number, const SegmentField& opening, Real elastic)
{
	Patch& patch = patches[number];
	energy.elastic += elastic;
	if (patch.known && !(present == last)) {
		const CornerWeights& weight = joint.shape->patches[number].weight;
		const auto product = [&](const Real(&u0)[4], const Real(&u)[4]) { return atCorners(u0).dot(weight * atCorners(u)); };
		energy.level -= (present.normal - last.normal) / 2 * product(patch.opening.normal, opening.normal)
		        + (present.shear - last.shear) / 2 * (product(patch.opening.tangent1, opening.tangent1) + product(patch.opening.tangent2, opening.tangent2));
	}
	patch.known   = true;
	patch.opening = opening;
}

void JointLedger::addSwept(std::size_t number, const JointSegments& before, const JointSegments& after, const SegmentSweep& sweep)
{
	Patch&     patch   = patches[number];
	const bool slipped = sweep.terms.friction || patch.known; // the slip before was up to an opening that a ledger which begins does not know
	if (!patch.known) patch.opening = sweep.opening, patch.known = true;
	const Springs springs { sweep.springs };
	SegmentField  dashpots {};
	for (int i = 0; i < after.count(); ++i) {
		const SegmentStep s(before, after, i, patch.opening, sweep.opening);
		const Real        p = after.row(JointSegments::P)[i], q = after.row(JointSegments::Q)[i], area = after.row(JointSegments::Area)[i];
		const Vector3r    stretch = s.stretch(), elastic = springs.traction(stretch);
		energy.elastic += area * springs.energy(stretch);
		energy.level -= area * stiffening(last, present, s.stretch0(), s.state0 == SegmentState::Intact ? s.opening : stretch);
		if (s.state == SegmentState::Intact) continue;
		if (s.state0 == SegmentState::Intact) {
			const Vector3r lost = springs.traction(s.opening) - elastic;
			energy.fracture += area * (springs.energy(s.opening) - springs.energy(stretch) - lost.dot(s.opening - s.opening0) / 2);
		} else if (slipped) {
			const Vector3r elastic0 = Springs { last }.traction(s.stretch0());
			energy.friction += area / 2 * (elastic0 + elastic).dot(s.slip - s.slip0);
		}
		if (sweep.terms.dashpots) addMoments(dashpots, area * dashpotTraction(sweep, s, elastic, p, q), p, q);
	}
	energy.dashpot += work(patch.dashpot, dashpots, patch.opening, sweep.opening);
	patch.opening = sweep.opening;
	patch.dashpot = dashpots;
}

namespace {

	/// Velocity that a body's deformation gives to a place of one of its faces, body axes.
	Vector3r deformationRate(const Side& side, int face, const Vector2r& natural)
	{
		Vector3r rate = Vector3r::Zero();
		if (!side.placement.displacementRate) return rate;
		const SurfaceSpot spot = surfaceGrid(side.cells).locate(face, natural[0], natural[1]);
		for (int a = 0; a < 4; ++a)
			rate += spot.weights[a] * side.placement.displacementRate[spot.nodes[a]];
		return rate;
	}

	/// Velocity of the owner at a spot relative to the other body, world axes.
	Vector3r relativeVelocity(const ContactSpot& spot, const Side& owner, const Side& other)
	{
		const Placement &mine = owner.placement, &its = other.placement;
		const Vector3r   x = its.position + its.rotation * spot.position;
		auto             rigid = [&](const Placement& p) { return Vector3r(p.velocity + p.angularVelocity.cross(x - p.position)); };
		return rigid(mine) + mine.rotation * deformationRate(owner, spot.ownerFace, spot.ownerNatural)
		        - (rigid(its) + its.rotation * deformationRate(other, spot.otherFace, spot.otherNatural));
	}

} // namespace

void ContactLedger::begin(
        const PairEnergy& ofJoint, const Side& side0, const Side& side1, const std::vector<ContactSpot>& spots, const PairSprings& pair, const ContactMemory& memory)
{
	energy         = ofJoint;
	energy.elastic = contactEnergy(side0, side1, spots, pair, memory);
	energy.area += ofJoint.elastic - energy.elastic;
	last.clear();
	for (const ContactSpot& spot : spots) {
		const auto found = std::lower_bound(memory.keys.begin(), memory.keys.end(), spot.key);
		if (found == memory.keys.end() || *found != spot.key) continue;
		const Vector3r& traction = memory.tractions[found - memory.keys.begin()];
		const SpotSprings k      = springsOf(spot, side0, side1, pair);
		const Real        pressed = spot.area * spot.penetration * pressedDepth(spot, spot.owner == 0 ? side1 : side0);
		last.push_back({ spot.key, spot.area, spot.area / 2 * traction.squaredNorm() / k.shear, traction, Vector3r::Zero(), k, pressed });
	}
}

/// Gives a spot of the step before the springs of this one. Its shear traction stays; of the penetrations at both ends the geometric mean counts.
/// @return what this takes [J]
Real ContactLedger::stiffen(Spot& was, const SpotSprings& k, Real pressed)
{
	if (was.springs == k) return 0;
	const Real shearEnergy = was.shearEnergy * was.springs.shear / k.shear;
	const Real put         = (k.normal - was.springs.normal) / 2 * std::sqrt(std::max(0., was.pressed * pressed)) + shearEnergy - was.shearEnergy;
	was.springs = k, was.shearEnergy = shearEnergy;
	return -put;
}

void ContactLedger::add(
        const Side&                     side0,
        const Side&                     side1,
        const std::vector<ContactSpot>& spots,
        const PairSprings&              pair,
        Real                            dt,
        const ContactMemory&            memory,
        const LawTerms&                 terms)
{
	const Real tanFriction = terms.friction ? pair.tanFriction : 0;
	energy                 = {};
	std::vector<Spot> present;
	auto              before = last.begin();
	for (std::size_t i = 0; i < spots.size(); ++i) {
		const ContactSpot& spot = spots[i];
		for (; before != last.end() && before->key < spot.key; ++before)
			energy.area += before->shearEnergy; // it has left
		const Side &      owner = spot.owner == 0 ? side0 : side1, &other = spot.owner == 0 ? side1 : side0;
		const Matrix3r&   axes   = owner.placement.rotation;
		const SpotSprings k      = springsOf(spot, side0, side1, pair);
		Spot              was { spot.key, spot.area, 0, Vector3r::Zero(), Vector3r::Zero(), k, 0 };
		if (before != last.end() && before->key == spot.key) was = *before++;
		const Real pressed = spot.area * spot.penetration * pressedDepth(spot, other);
		energy.level += stiffen(was, k, pressed);

		const Vector3r    normal = other.placement.rotation * other.solid->faces[spot.otherFace].normal, moved = dt * relativeVelocity(spot, owner, other);
		const Vector3r    sliding = moved - moved.dot(normal) * normal, turned = axes * was.traction;
		const Vector3r    traction = terms.friction ? memory.tractions[i] : Vector3r(Vector3r::Zero());
		const Vector3r    tau0 = turned - turned.dot(normal) * normal, tau = axes * traction;
		const Real        shearEnergy = spot.area / 2 * tau.squaredNorm() / k.shear;
		energy.elastic += k.normal / 2 * pressed + shearEnergy;
		energy.friction -= spot.area / 2 * (tau0 + tau).dot(sliding + (tau - tau0) / k.shear);
		energy.area += (1 - spot.area / was.area) * was.shearEnergy + (spot.area - was.area) / 2 * tau0.dot(sliding);

		// as SpotTractions in ContactLanes.hpp
		Vector3r dashpot = Vector3r::Zero();
		if (terms.dashpots && dt > 0) {
			const Real     spring = k.normal * spot.penetration, pressure = std::max(0., spring - k.normalDashpot * moved.dot(normal) / dt);
			const Vector3r shear = limited(Vector3r(tau - k.shearDashpot / dt * sliding), pressure * tanFriction);
			dashpot              = spot.area * ((pressure - spring) * normal + shear - tau);
		}
		energy.dashpot -= (axes * was.dashpot + dashpot).dot(moved) / 2;
		present.push_back({ spot.key, spot.area, shearEnergy, traction, axes.transpose() * dashpot, k, pressed });
	}
	for (; before != last.end(); ++before)
		energy.area += before->shearEnergy;
	last.swap(present);
}

} // namespace brick
