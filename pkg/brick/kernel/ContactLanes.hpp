// SPDX-License-Identifier: GPL-2.0-or-later
// Forces of spots of contact, eight spots of a pair of faces at a time: included by Contact.cpp once for each instruction set (InstructionSets.hpp).

#include "SurfaceLanes.hpp"

BRICK_INLINE Lanes lengthOf(const Vectors& a) { return root(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

/// The owner of spots and the other body, in whose axes and about whose position everything is computed.
struct OwnerAndOther {
	const Side &owner, &other;
	Matrix3r    turn;     ///< owner's axes to the other's
	Vector3r    offset;   ///< from the owner's position to the other's
	Vector3r    velocity; ///< of the owner's rigid motion at the other's position, relative to the other's
	Vector3r    spin;     ///< relative angular velocity

	OwnerAndOther(const Side& owner, const Side& other)
	        : owner(owner)
	        , other(other)
	{
		const Placement &mine = owner.placement, &its = other.placement;
		const Matrix3r   toOther = its.rotation.transpose();
		const Vector3r   between = its.position - mine.position;
		turn                     = toOther * mine.rotation;
		offset                   = toOther * between;
		velocity                 = toOther * (mine.velocity + mine.angularVelocity.cross(between) - its.velocity);
		spin                     = toOther * (mine.angularVelocity - its.angularVelocity);
	}
};

/// Velocities that the deformation gives to a face that is a single cell: coefficients of bilinear fields.
struct RateField {
	bool          any = false;
	BilinearField component[3];

	RateField() = default;
	RateField(const Side& side, int face)
	        : any(side.placement.displacementRate && side.cells == 1)
	{
		if (!any) return;
		const auto&     n = faceNodes[face];
		const Vector3r* v = side.placement.displacementRate;
		for (int i = 0; i < 3; ++i)
			component[i] = BilinearField::of(v[n[0]][i], v[n[1]][i], v[n[2]][i], v[n[3]][i]);
	}
	void turn(const Matrix3r& rotation)
	{
		for (int c = 0; c < 4 && any; ++c) {
			const Vector3r v = rotation * Vector3r(component[0].c[c], component[1].c[c], component[2].c[c]);
			for (int i = 0; i < 3; ++i)
				component[i].c[c] = v[i];
		}
	}
};

/// Spots of the same two faces.
struct Run {
	const OwnerAndOther& bodies;
	const ContactSpot*   spots;
	int                  count;
	SpotSprings          springs;
	Real                 tanFriction, dt;
	Vector3r             normal;
	RateField            ownerRate, otherRate;
	const SurfaceGrid *  ownerCells, *otherCells; ///< null where a face is a single cell

	/// @param rates whether velocities matter
	Run(const OwnerAndOther& bodies, const ContactSpot* spots, int count, const SpotSprings& springs, Real tanFriction, Real dt, bool rates)
	        : bodies(bodies)
	        , spots(spots)
	        , count(count)
	        , springs(springs)
	        , tanFriction(tanFriction)
	        , dt(dt)
	        , normal(bodies.other.solid->faces[spots->otherFace].normal)
	        , ownerCells(cellsOf(bodies.owner))
	        , otherCells(cellsOf(bodies.other))
	{
		if (!rates) return;
		ownerRate = RateField(bodies.owner, spots->ownerFace), otherRate = RateField(bodies.other, spots->otherFace);
		ownerRate.turn(bodies.turn);
	}
};

/// Sums over a run; forces on the owner.
struct RunSums {
	Lanes force[3] {}, torque[3] {};          ///< about the other's position
	Lanes onOwner[3][3] {}, onOther[3][3] {}; ///< moments of the force with xi, eta, xi eta of either face
	Lanes area {}, pressed {}, place[3] {};   ///< sums of area, area times pressure, area times place
	Lanes deepest {};
};

/// Eight spots of a run; beyond its end the last one again, without area.
struct SpotLanes {
	Lanes   area, penetration, xi, eta, p, q;
	Vectors x;

	BRICK_INLINE SpotLanes(const Run& run, int first)
	{
		for (int i = 0; i < lanes; ++i) {
			const ContactSpot& spot = run.spots[std::min(first + i, run.count - 1)];
			area[i] = spot.area, penetration[i] = spot.penetration;
			xi[i] = spot.ownerNatural[0], eta[i] = spot.ownerNatural[1], p[i] = spot.otherNatural[0], q[i] = spot.otherNatural[1];
			x[0][i] = spot.position[0], x[1][i] = spot.position[1], x[2][i] = spot.position[2];
		}
		area = laneNumbers < allLanes((long long)run.count - first) ? area : Lanes {};
	}
};

/// Velocity of the owner at the spots relative to the other body; without deformation where a face has several cells.
BRICK_INLINE Vectors velocityBetween(const Run& run, const SpotLanes& s)
{
	const Vector3r &v = run.bodies.velocity, &w = run.bodies.spin;
	Vectors         out;
	for (int i = 0; i < 3; ++i) {
		const int j = (i + 1) % 3, k = (i + 2) % 3;
		out[i] = v[i] + (w[j] * s.x[k] - w[k] * s.x[j]);
		if (run.ownerRate.any) out[i] += run.ownerRate.component[i].at(s.xi, s.eta);
		if (run.otherRate.any) out[i] -= run.otherRate.component[i].at(s.p, s.q);
	}
	return out;
}

/// What friction holds, from the tractions of the step before (owner's axes), which are replaced by the present ones.
BRICK_INLINE Vectors elasticShear(const Run& run, const Vectors& sliding, const Lanes& limit, Vector3r* tractions, int count)
{
	const Matrix3r& turn = run.bodies.turn;
	Vectors         was, tau;
	for (int lane = 0; lane < lanes; ++lane) {
		const Vector3r& from = tractions[std::min(lane, count - 1)];
		was[0][lane] = from[0], was[1][lane] = from[1], was[2][lane] = from[2];
	}
	for (int i = 0; i < 3; ++i)
		tau[i] = turn(i, 0) * was[0] + turn(i, 1) * was[1] + turn(i, 2) * was[2];
	const Lanes along = dot(tau, run.normal);
	for (int i = 0; i < 3; ++i)
		tau[i] = (tau[i] - along * run.normal[i]) - run.springs.shear * run.dt * sliding[i];
	const Lanes held = shortening(lengthOf(tau), limit);
	for (int i = 0; i < 3; ++i)
		tau[i] *= held;
	for (int i = 0; i < 3; ++i)
		was[i] = turn(0, i) * tau[0] + turn(1, i) * tau[1] + turn(2, i) * tau[2];
	for (int lane = 0; lane < std::min(lanes, count); ++lane)
		tractions[lane] = { was[0][lane], was[1][lane], was[2][lane] };
	return tau;
}

/// Tractions on the owner. What is left out is as in sweepGroup of joints: signs of zeros are all that may differ.
struct SpotTractions {
	Lanes   pressure;
	Vectors all;

	template <bool friction, bool dashpots, class Cells>
	BRICK_INLINE void set(const Run& run, const SpotLanes& s, int first, Vector3r* tractions, Cells& cells)
	{
		Vectors sliding;
		Lanes   pushing = run.springs.normal * s.penetration;
		if constexpr (friction || dashpots) {
			const Vectors velocity = cells.relativeVelocity(run, s);
			const Lanes   leaving  = dot(velocity, run.normal);
			for (int i = 0; i < 3; ++i)
				sliding[i] = velocity[i] - leaving * run.normal[i];
			if constexpr (dashpots) pushing -= run.springs.normalDashpot * leaving;
		}
		pressure = greater(pushing, Lanes {});
		for (int i = 0; i < 3; ++i)
			all[i] = pressure * run.normal[i];
		if constexpr (friction) addShear<dashpots>(run, sliding, tractions + first, run.count - first);
	}

private:
	template <bool dashpots> BRICK_INLINE void addShear(const Run& run, const Vectors& sliding, Vector3r* tractions, int count)
	{
		const Lanes limit = pressure * run.tanFriction;
		Vectors     shear = elasticShear(run, sliding, limit, tractions, count);
		for (int i = 0; i < 3 && dashpots; ++i)
			shear[i] -= run.springs.shearDashpot * sliding[i];
		const Lanes kept = shortening(lengthOf(shear), limit);
		for (int i = 0; i < 3; ++i)
			all[i] += shear[i] * kept;
	}
};

/// @param cells WholeFaces or CellsOfSpots
template <bool friction, bool dashpots, class Cells> BRICK_INLINE void addGroup(const Run& run, int first, Vector3r* tractions, RunSums& sums, Cells& cells)
{
	const SpotLanes s(run, first);
	cells.locate(run, s);
	SpotTractions traction;
	traction.set<friction, dashpots>(run, s, first, tractions, cells);

	const Lanes xiEta = s.xi * s.eta, pq = s.p * s.q;
	Vectors     force;
	for (int i = 0; i < 3; ++i) {
		force[i] = s.area * traction.all[i];
		sums.force[i] += force[i];
		sums.onOwner[i][0] += s.xi * force[i], sums.onOwner[i][1] += s.eta * force[i], sums.onOwner[i][2] += xiEta * force[i];
		sums.onOther[i][0] += s.p * force[i], sums.onOther[i][1] += s.q * force[i], sums.onOther[i][2] += pq * force[i];
		sums.place[i] += s.area * s.x[i];
	}
	for (int i = 0; i < 3; ++i) {
		const int j = (i + 1) % 3, k = (i + 2) % 3;
		sums.torque[i] += s.x[j] * force[k] - s.x[k] * force[j];
	}
	sums.area += s.area, sums.pressed += s.area * traction.pressure;
	sums.deepest = greater(sums.deepest, s.penetration);
	cells.addForces(run, force, run.count - first);
}

/// Both faces are single cells, whose nodal forces follow from the sums.
struct WholeFaces {
	BRICK_INLINE         WholeFaces(const Run&, Loads&, Loads&) { }
	BRICK_INLINE void    locate(const Run&, const SpotLanes&) const { }
	BRICK_INLINE Vectors relativeVelocity(const Run& run, const SpotLanes& s) const { return velocityBetween(run, s); }
	BRICK_INLINE void    addForces(const Run&, const Vectors&, int) const { }
};

/// A face has several cells. Neighbouring spots are mostly in different ones: each is shared out to the nodes of its own.
class CellsOfSpots {
public:
	BRICK_INLINE CellsOfSpots(const Run&, Loads& onOwner, Loads& onOther)
	        : onOwner(onOwner)
	        , onOther(onOther)
	{
	}
	BRICK_INLINE void locate(const Run& run, const SpotLanes& s)
	{
		if (run.ownerCells) owner.locate(*run.ownerCells, run.spots->ownerFace, s.xi, s.eta);
		if (run.otherCells) other.locate(*run.otherCells, run.spots->otherFace, s.p, s.q);
	}
	BRICK_INLINE Vectors relativeVelocity(const Run& run, const SpotLanes& s) const
	{
		const Matrix3r& turn = run.bodies.turn;
		const Vector3r *mine = run.bodies.owner.placement.displacementRate, *its = run.bodies.other.placement.displacementRate;
		Vectors         velocity = velocityBetween(run, s), rate;
		if (run.ownerCells && mine) {
			owner.interpolate(mine, rate);
			for (int i = 0; i < 3; ++i)
				velocity[i] += turn(i, 0) * rate[0] + turn(i, 1) * rate[1] + turn(i, 2) * rate[2];
		}
		if (run.otherCells && its) {
			other.interpolate(its, rate);
			for (int i = 0; i < 3; ++i)
				velocity[i] -= rate[i];
		}
		return velocity;
	}
	BRICK_INLINE void addForces(const Run& run, const Vectors& force, int count) const
	{
		const Matrix3r& turn = run.bodies.turn;
		Vectors         mine, its;
		for (int i = 0; i < 3; ++i)
			mine[i] = turn(0, i) * force[0] + turn(1, i) * force[1] + turn(2, i) * force[2], its[i] = -force[i];
		if (run.ownerCells) owner.addForces(mine, count, onOwner.nodal.data());
		if (run.otherCells) other.addForces(its, count, onOther.nodal.data());
	}

private:
	Loads &      onOwner, &onOther;
	SurfaceLanes owner, other;
};

template <bool friction, bool dashpots, class Cells>
__attribute__((noinline)) void addGroups(const Run& run, Vector3r* tractions, Loads& onOwner, Loads& onOther, RunSums& sums)
{
	RunSums local;
	Cells   cells(run, onOwner, onOther);
	for (int first = 0; first < run.count; first += lanes)
		addGroup<friction, dashpots>(run, first, tractions, local, cells);
	sums = local;
}

template <class Cells> void addGroupsWith(const LawTerms& terms, const Run& run, Vector3r* tractions, Loads& onOwner, Loads& onOther, RunSums& sums)
{
	static constexpr decltype(&addGroups<true, true, Cells>) variants[2][2] { { addGroups<false, false, Cells>, addGroups<false, true, Cells> },
		                                                                  { addGroups<true, false, Cells>, addGroups<true, true, Cells> } };
	variants[terms.friction][terms.dashpots](run, tractions, onOwner, onOther, sums);
}

Vector3r sumOf(const Lanes (&x)[3]) { return { sumOf(x[0]), sumOf(x[1]), sumOf(x[2]) }; }

/// Nodal forces from a force and its moments, weighted by sign.
void addNodal(Loads& loads, int face, const Vector3r& force, const Lanes (&moments)[3][3], Real sign, const Matrix3r* toBody)
{
	Vector3r m[3];
	for (int c = 0; c < 3; ++c)
		m[c] = { sumOf(moments[0][c]), sumOf(moments[1][c]), sumOf(moments[2][c]) };
	for (int a = 0; a < 4; ++a) {
		const Real     xi = a == 1 || a == 2 ? 1 : -1, eta = a >= 2 ? 1 : -1;
		const Vector3r f = sign / 4 * ((force + xi * m[0]) + (eta * m[1] + xi * eta * m[2]));
		loads.nodal[faceNodes[face][a]] += toBody ? Vector3r(toBody->transpose() * f) : f;
	}
}

/// Of all spots with one owner, in the other's axes.
struct OwnerSums {
	Vector3r force { Vector3r::Zero() }, torque { Vector3r::Zero() }, normal { Vector3r::Zero() }, pressed { Vector3r::Zero() }, place { Vector3r::Zero() };
	Real     area = 0;
};

void addRun(const Run& run, const RunSums& lane, Loads& onOwner, Loads& onOther, OwnerSums& sums, PairSummary& pair)
{
	const Vector3r force = sumOf(lane.force);
	const Real     area  = sumOf(lane.area);
	if (!run.ownerCells) addNodal(onOwner, run.spots->ownerFace, force, lane.onOwner, 1, &run.bodies.turn);
	if (!run.otherCells) addNodal(onOther, run.spots->otherFace, force, lane.onOther, -1, nullptr);
	sums.force += force, sums.torque += sumOf(lane.torque), sums.place += sumOf(lane.place), sums.area += area;
	sums.normal += area * run.normal, sums.pressed += sumOf(lane.pressed) * run.normal;
	pair.kn += area * run.springs.normal, pair.ks += area * run.springs.shear, pair.area += area;
	pair.penetration = std::max(pair.penetration, mostOf(lane.deepest));
}

/// To world axes, once.
void addOwner(const OwnerAndOther& bodies, bool ownerIsFirst, const OwnerSums& sums, Loads& onOwner, Loads& onOther, PairSummary& pair)
{
	const Matrix3r& axes  = bodies.other.placement.rotation;
	const Vector3r  force = axes * sums.force;
	onOwner.force += force, onOther.force -= force;
	onOwner.torque += axes * (sums.torque + bodies.offset.cross(sums.force)), onOther.torque -= axes * sums.torque;
	const Real towards1 = ownerIsFirst ? -1 : 1; // of the other's normal
	pair.normal += towards1 * (axes * sums.normal), pair.normalForce += towards1 * (axes * sums.pressed);
	pair.point += axes * (ownerIsFirst ? Vector3r(sums.place + sums.area * bodies.offset) : sums.place);
}

/// Forces of all spots; the tractions are those of the step before, and become those of this one. Without friction they are not looked at.
void addLoads(
        const Side&                     side0,
        const Side&                     side1,
        const std::vector<ContactSpot>& spots,
        const PairSprings&              pair,
        Real                            dt,
        const LawTerms&                 terms,
        Vector3r*                       tractions,
        std::array<Loads, 2>&           loads,
        PairSummary&                    sum)
{
	for (std::size_t first = 0; first < spots.size();) {
		const int           owner = spots[first].owner;
		const OwnerAndOther bodies(owner == 0 ? side0 : side1, owner == 0 ? side1 : side0);
		OwnerSums           sums;
		while (first < spots.size() && spots[first].owner == owner) {
			std::size_t end = first + 1;
			while (end < spots.size() && sameFaces(spots[first], spots[end]))
				++end;
			const Run run(
			        bodies,
			        &spots[first],
			        int(end - first),
			        springsOf(spots[first], side0, side1, pair),
			        pair.tanFriction,
			        dt,
			        terms.friction || terms.dashpots);
			Vector3r* const shear = terms.friction ? tractions + first : nullptr;
			RunSums         lane;
			if (run.ownerCells || run.otherCells) addGroupsWith<CellsOfSpots>(terms, run, shear, loads[owner], loads[!owner], lane);
			else
				addGroupsWith<WholeFaces>(terms, run, shear, loads[owner], loads[!owner], lane);
			addRun(run, lane, loads[owner], loads[!owner], sums, sum);
			first = end;
		}
		addOwner(bodies, owner == 0, sums, loads[owner], loads[!owner], sum);
	}
}
