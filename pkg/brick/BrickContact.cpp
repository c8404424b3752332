// SPDX-License-Identifier: GPL-2.0-or-later
#include "BrickContact.hpp"

#include "DrawingLock.hpp"
#include "Prefetch.hpp"
#include "Stopwatch.hpp"

#include "kernel/Message.hpp"
#include "kernel/Utilisation.hpp"

#include <core/Body.hpp>
#include <core/Omega.hpp>

#include <atomic>

namespace yade {

YADE_PLUGIN((
        BrickGeom)(BrickPhys)(Ig2_Brick_Brick_BrickGeom)(Ig2_Wall_Brick_BrickGeom)(Ig2_Box_Brick_BrickGeom)(Ip2_BrickMat_BrickMat_BrickPhys)(Ip2_FrictMat_BrickMat_BrickPhys)(Law2_BrickGeom_BrickPhys_Mortar));

// Sides

namespace {

	const std::array<Real, brick::faceCount> noLength { 0, 0, 0, 0, 0, 0 };

	// Half sizes of the slab that stands for a wall [m]: wide beyond any scene, thick beyond any penetration, yet thin enough that heights over its
	// face keep fifteen digits of a metre.
	constexpr Real slabWidth = 1e6, slabThickness = 10;

	const brick::Hexahedron& slabAcross(int axis)
	{
		static const std::array<brick::Hexahedron, 3> slabs = [] {
			auto across = [](int k) {
				Vector3r size = Vector3r::Constant(2 * slabWidth);
				size[k]       = 2 * slabThickness;
				return brick::Hexahedron(brick::cuboidCorners(size));
			};
			return std::array<brick::Hexahedron, 3> { across(0), across(1), across(2) };
		}();
		return slabs[axis];
	}

	brick::Side supportSide(const brick::Hexahedron& solid, const State& state)
	{
		brick::Side side;
		side.solid                     = &solid;
		side.contactLength             = &noLength;
		side.support                   = true;
		side.placement.position        = state.pos;
		side.placement.rotation        = state.ori.toRotationMatrix();
		side.placement.velocity        = state.vel;
		side.placement.angularVelocity = state.angVel;
		return side;
	}

} // namespace

brick::Side sideOfWall(const Wall& wall, const State& state, const Vector3r& brickPosition)
{
	const int  axis = wall.axis;
	const Real out  = wall.sense != 0 ? wall.sense : brickPosition[axis] >= state.pos[axis] ? 1 : -1;
	auto       side = supportSide(slabAcross(axis), state);
	side.placement.rotation.setIdentity();
	side.placement.position[axis] -= out * slabThickness;
	return side;
}

brick::Side sideOfBox(const State& state, const brick::Hexahedron& solid) { return supportSide(solid, state); }

brick::Side sideOfBody(const Body& b, const shared_ptr<const brick::Hexahedron>& box, const Vector3r& brickPosition)
{
	if (const Brick* shape = asBrick(b.shape)) return shape->side(b.state->pos, *b.state);
	if (const Wall* wall = dynamic_cast<const Wall*>(b.shape.get())) return sideOfWall(*wall, *b.state, brickPosition);
	return sideOfBox(*b.state, *box);
}

// Fitness for contact

shared_ptr<const brick::Hexahedron> solidOfBox(const Box& box)
{
	return shared_ptr<const brick::Hexahedron>(new brick::Hexahedron(brick::cuboidCorners(2 * box.extents)));
}

string boxProblem(const Box& box)
{
	try {
		solidOfBox(box);
		return "";
	} catch (const std::invalid_argument& problem) {
		return brick::message("the extents (", box.extents.transpose(), ") m: ", problem.what());
	}
}

string touchProblem(const Body& b)
{
	if (asBrick(b.shape)) return asBrickMat(b.material) ? "" : "its material must be a BrickMat";
	if (const Box* box = dynamic_cast<const Box*>(b.shape.get()))
		if (const string problem = boxProblem(*box); !problem.empty()) return "bricks cannot touch a box of " + problem;
	return dynamic_cast<const FrictMat*>(b.material.get()) ? "" : "its material must be a FrictMat where bricks touch it";
}

namespace {

	std::atomic<Body::id_t> untouchable { -1 };

	bool canTouch(const Interaction& I, Scene* scene)
	{
		for (const Body::id_t id : { I.getId1(), I.getId2() })
			if (!touchProblem(*Body::byId(id, scene)).empty()) {
				untouchable.store(id, std::memory_order_relaxed);
				return false;
			}
		return true;
	}

} // namespace

Body::id_t takeUntouchable() { return untouchable.load(std::memory_order_relaxed) < 0 ? -1 : untouchable.exchange(-1); }

// Geometry

namespace {

	BrickPhys* physOf(const Interaction& I) { return static_cast<BrickPhys*>(I.phys.get()); }

	BrickGeom& geomOf(const shared_ptr<Interaction>& I)
	{
		if (!I->geom) I->geom = shared_ptr<IGeom>(new BrickGeom);
		return static_cast<BrickGeom&>(*I->geom);
	}

	/// The geometry of a joint in this step.
	void updateJoint(const brick::Placement& placement0, const brick::Placement& placement1, const brick::Joint& joint, BrickGeom& geom)
	{
		geom.origin = placement0.position;
		brick::jointMotion(joint, placement0, placement1, geom.motion);
	}

	/// The geometry of a contact in this step; false when there is none, there was none before and none was asked for.
	bool updateContact(const brick::Side& side0, const brick::Side& side1, bool force, const shared_ptr<Interaction>& I)
	{
		thread_local std::vector<brick::ContactSpot> found;
		brick::findContact(side0, side1, found);
		if (found.empty() && !I->geom && !force) return false;
		BrickGeom& geom = geomOf(I);
		if (!geom.contact) geom.contact.reset(new BrickGeom::Contact);
		geom.contact->sides = { side0, side1 };
		std::swap(geom.contact->spots, found);
		geom.spotCount = int(geom.contact->spots.size());
		return true;
	}

	/// Joint or contact of a brick with a support.
	bool updateOnSupport(const brick::Side& support, const brick::Side& side1, bool force, const shared_ptr<Interaction>& I)
	{
		const BrickPhys* phys = physOf(*I);
		if (!phys || !phys->isJoint()) return updateContact(support, side1, force, I);
		updateJoint(support.placement, side1.placement, phys->joint, geomOf(I));
		return true;
	}

} // namespace

bool Ig2_Brick_Brick_BrickGeom::go(
        const shared_ptr<Shape>&       shape1,
        const shared_ptr<Shape>&       shape2,
        const State&                   state1,
        const State&                   state2,
        const Vector3r&                shift2,
        const bool&                    force,
        const shared_ptr<Interaction>& I)
{
	const Stopwatch watch(seconds);
	prefetchFollowing(*scene, *I, sizeof(BrickGeom), sizeof(BrickPhys));
	const Brick &   first = static_cast<const Brick&>(*shape1), &second = static_cast<const Brick&>(*shape2);
	if (!first.solid || !second.solid) return false;
	const bool       reversed = I->getId1() > I->getId2();
	const Brick &    shape0   = reversed ? second : first, &other = reversed ? first : second;
	const State &    state0   = reversed ? state2 : state1, &state = reversed ? state1 : state2;
	const Vector3r   position0 = reversed ? Vector3r(state2.pos + shift2) : state1.pos, position = reversed ? state1.pos : Vector3r(state2.pos + shift2);
	const BrickPhys* phys = physOf(*I);
	if (phys && phys->isJoint()) {
		if (!I->functorCache.phys && !canTouch(*I, scene)) return false;
		BrickGeom& geom = geomOf(I);
		geom.reversed   = reversed;
		updateJoint(shape0.placement(position0, state0), other.placement(position, state), phys->joint, geom);
		return true;
	}
	if (!phys && !force && first.isHeldApartFrom(second, I->getId2())) return false;
	if (!updateContact(shape0.side(position0, state0), other.side(position, state), force, I)) return false;
	if (!I->functorCache.phys && !canTouch(*I, scene)) return false;
	static_cast<BrickGeom&>(*I->geom).reversed = reversed;
	return true;
}

bool Ig2_Wall_Brick_BrickGeom::go(
        const shared_ptr<Shape>&       wall,
        const shared_ptr<Shape>&       shape,
        const State&                   state1,
        const State&                   state2,
        const Vector3r&                shift2,
        const bool&                    force,
        const shared_ptr<Interaction>& I)
{
	const Stopwatch watch(seconds);
	const Brick&    b = static_cast<const Brick&>(*shape);
	if (!b.solid || (!I->functorCache.phys && !canTouch(*I, scene))) return false;
	const Vector3r position = state2.pos + shift2;
	return updateOnSupport(sideOfWall(static_cast<const Wall&>(*wall), state1, position), b.side(position, state2), force, I);
}

bool Ig2_Box_Brick_BrickGeom::go(
        const shared_ptr<Shape>&       box,
        const shared_ptr<Shape>&       shape,
        const State&                   state1,
        const State&                   state2,
        const Vector3r&                shift2,
        const bool&                    force,
        const shared_ptr<Interaction>& I)
{
	const Stopwatch watch(seconds);
	const Brick&    b = static_cast<const Brick&>(*shape);
	if (!b.solid) return false;
	shared_ptr<const brick::Hexahedron> solid;
	if (I->geom) solid = static_cast<const BrickGeom&>(*I->geom).supportSolid;
	if ((!solid || !I->functorCache.phys) && !canTouch(*I, scene)) return false;
	if (!solid) solid = solidOfBox(static_cast<const Box&>(*box));
	if (!updateOnSupport(sideOfBox(state1, *solid), b.side(state2.pos + shift2, state2), force, I)) return false;
	static_cast<BrickGeom&>(*I->geom).supportSolid = solid;
	return true;
}

// Physics

brick::PairSprings pairSprings(const Material& material0, bool support, const BrickMat& material1)
{
	brick::PairSprings      s;
	const brick::Elasticity elastic1 { material1.young, material1.poisson };
	s.normalCompliance[1] = elastic1.normalCompliance();
	s.shearCompliance[1]  = elastic1.shearCompliance();
	s.density[1]          = material1.density;
	s.normalDamping       = material1.hn;
	s.shearDamping        = material1.hs;
	s.tanFriction         = std::tan(std::min(static_cast<const FrictMat&>(material0).frictionAngle, material1.frictionAngle));
	if (support) return s;
	const BrickMat&         first = static_cast<const BrickMat&>(material0);
	const brick::Elasticity elastic0 { first.young, first.poisson };
	s.normalCompliance[0] = elastic0.normalCompliance();
	s.shearCompliance[0]  = elastic0.shearCompliance();
	s.density[0]          = first.density;
	s.normalDamping       = (first.hn + material1.hn) / 2;
	s.shearDamping        = (first.hs + material1.hs) / 2;
	return s;
}

Real thinnestContactPart(const std::array<brick::Side, 2>& sides)
{
	Real thinnest = std::numeric_limits<Real>::infinity();
	for (const auto& side : sides)
		if (!side.support) thinnest = std::min(thinnest, *std::min_element(side.contactLength->begin(), side.contactLength->end()));
	return thinnest;
}

namespace {

	/// Contact length of a joint's face; of a support none.
	Real contactLengthAt(const Body& b, const brick::JointFace& at)
	{
		const Brick* shape = asBrick(b.shape);
		return shape ? shape->contactLength[at.face] : 0;
	}

	Real contactPartOf(const Body& b)
	{
		const Brick* shape = asBrick(b.shape);
		return shape ? *std::min_element(shape->contactLength.begin(), shape->contactLength.end()) : std::numeric_limits<Real>::infinity();
	}

} // namespace

void takeUpContactLengths(const Body& b, Scene& scene)
{
	for (const auto& item : b.intrs) {
		BrickPhys* const phys = asBrickPhys(item.second->phys);
		if (!phys) continue;
		const auto& other      = Body::byId(item.first, &scene);
		const bool  otherFirst = !asBrick(other->shape) || other->getId() < b.getId();
		const Body &first = otherFirst ? *other : b, &second = otherFirst ? b : *other;
		phys->contactPart = std::min(contactPartOf(first), contactPartOf(second));
		if (!phys->isJoint()) continue;
		const auto& shape = *phys->joint.shape;
		if (const Real length = static_cast<const Brick&>(*b.shape).settledContactLength(shape.faces[otherFirst].face); shape.pair.mortarThickness > 2 * length)
			throw std::invalid_argument(brick::message(
			        "Brick #",
			        b.getId(),
			        ": its contact part of ",
			        length,
			        " m is thinner than half of the mortar that joins it to #",
			        item.first,
			        " (Mortar.thickness = ",
			        shape.pair.mortarThickness,
			        " m), so it cannot be ",
			        static_cast<const Brick&>(*b.shape).deformation));
		phys->joint.springs = shape.pair.at(contactLengthAt(first, shape.faces[0]), contactLengthAt(second, shape.faces[1]));
	}
}

namespace {

	void makePhys(const Interaction& I, Scene* scene, shared_ptr<IPhys>& out)
	{
		const BrickGeom&      geom   = static_cast<const BrickGeom&>(*I.geom);
		const auto&           first  = Body::byId(geom.reversed ? I.getId2() : I.getId1(), scene);
		const auto&           second = Body::byId(geom.reversed ? I.getId1() : I.getId2(), scene);
		shared_ptr<BrickPhys> phys(new BrickPhys);
		phys->contact                = std::make_shared<OrdinaryContact>();
		phys->contact->springs       = pairSprings(*first->material, geom.contact->sides[0].support, static_cast<const BrickMat&>(*second->material));
		phys->tangensOfFrictionAngle = phys->contact->springs.tanFriction;
		phys->contactPart            = thinnestContactPart(geom.contact->sides);
		out                          = phys;
	}

} // namespace

void Ip2_BrickMat_BrickMat_BrickPhys::go(const shared_ptr<Material>&, const shared_ptr<Material>&, const shared_ptr<Interaction>& I)
{
	if (!I->phys) makePhys(*I, scene, I->phys);
}

void Ip2_FrictMat_BrickMat_BrickPhys::go(const shared_ptr<Material>&, const shared_ptr<Material>&, const shared_ptr<Interaction>& I)
{
	if (!I->phys) makePhys(*I, scene, I->phys);
}

namespace {
	std::atomic<long> physMade { 0 };
}

void BrickPhys::count() { physMade.fetch_add(1, std::memory_order_relaxed); }
long BrickPhys::made() { return physMade.load(std::memory_order_relaxed); }

std::vector<int> BrickPhys::segmentState() const
{
	if (!isJoint()) return contact ? contact->failureModes : std::vector<int>();
	return ofSegments<int>([this](int s) { return int(brick::segmentOf(joint, s).state); });
}

std::vector<Real> BrickPhys::segmentArea() const
{
	return ofSegments<Real>([this](int s) { return brick::segmentOf(joint, s).area; });
}

namespace {

	/// A geometry of another interaction has other faces, and one of a scene that is gone points at bricks that are.
	void needPresent(const BrickPhys& phys, const shared_ptr<BrickGeom>& geom)
	{
		if (!geom) throw std::invalid_argument("geom is None; it must be the BrickGeom of the same interaction");
		if (!geom->isKnown() || phys.step < 0)
			throw std::runtime_error("The geometry of this joint is known after the first step: run O.step() before asking for it.");
		const auto& I = Omega::instance().getScene()->interactions->find(phys.ids[0], phys.ids[1]);
		if (!I || I->phys.get() != &phys || I->geom != geom)
			throw std::invalid_argument("geom and phys are not those of one interaction of the present scene; ask an interaction for both anew");
	}

} // namespace

std::vector<Vector3r> BrickPhys::segmentPoints(const shared_ptr<BrickGeom>& geom) const
{
	needPresent(*this, geom);
	return ofSegments<Vector3r>([&](int s) {
		return Vector3r(geom->origin + geom->motion.middle(brick::segmentOf(joint, s)));
	});
}

std::vector<Real> BrickPhys::normalStress(const shared_ptr<BrickGeom>& geom) const
{
	needPresent(*this, geom);
	return ofSegments<Real>([&](int s) { return brick::segmentTraction(joint, s, geom->motion, springs().tanFriction).normal; });
}

std::vector<Vector3r> BrickPhys::shearStress(const shared_ptr<BrickGeom>& geom) const
{
	needPresent(*this, geom);
	return ofSegments<Vector3r>([&](int s) { return brick::segmentTraction(joint, s, geom->motion, springs().tanFriction).shear; });
}

std::vector<Real> BrickPhys::opening(const shared_ptr<BrickGeom>& geom) const
{
	needPresent(*this, geom);
	return ofSegments<Real>([&](int s) { return brick::segmentOpening(joint, s, geom->motion).dot(geom->motion.normal); });
}

std::vector<Vector3r> BrickPhys::slip(const shared_ptr<BrickGeom>& geom) const
{
	needPresent(*this, geom);
	const Vector3r& normal = geom->motion.normal;
	return ofSegments<Vector3r>([&](int s) {
		const Vector3r opening = brick::segmentOpening(joint, s, geom->motion);
		return Vector3r(opening - opening.dot(normal) * normal);
	});
}

std::vector<Real> BrickPhys::utilisation(const shared_ptr<BrickGeom>& geom) const
{
	needPresent(*this, geom);
	return ofSegments<Real>([&](int s) { return brick::segmentUtilisation(joint, geom->motion, s); });
}

std::vector<Vector3r> BrickPhys::segmentOutlines(const shared_ptr<BrickGeom>& geom) const
{
	needPresent(*this, geom);
	std::vector<Vector3r> out;
	for (int s = 0; s < joint.count(); ++s)
		for (const Vector3r& corner : brick::segmentOutline(joint, s, geom->motion))
			out.push_back(geom->origin + corner);
	return out;
}

boost::python::object BrickPhys::segmentTable(const shared_ptr<BrickGeom>& geom) const
{
	const auto            outlines = segmentOutlines(geom), points = segmentPoints(geom), slips = slip(geom), shears = shearStress(geom);
	const auto            openings = opening(geom), normals = normalStress(geom), shares = utilisation(geom);
	std::vector<Real>     table;
	const auto            add = [&table](const Vector3r& v) { table.insert(table.end(), v.data(), v.data() + 3); };
	for (std::size_t s = 0; s < points.size(); ++s) {
		for (std::size_t c = 0; c < 4; ++c)
			add(outlines[4 * s + c]);
		add(points[s]);
		table.push_back(openings[s]);
		add(slips[s]);
		table.push_back(normals[s]);
		add(shears[s]);
		table.push_back(shares[s]);
	}
	const char* const bytes = reinterpret_cast<const char*>(table.data());
	return boost::python::object(boost::python::handle<>(PyBytes_FromStringAndSize(bytes, Py_ssize_t(table.size() * sizeof(Real)))));
}

Real BrickPhys::elasticEnergy(const shared_ptr<BrickGeom>& geom) const
{
	needPresent(*this, geom);
	if (isJoint()) return brick::jointEnergy(joint, geom->motion, springs().tanFriction);
	if (!contact || !geom->contact) return 0;
	return brick::contactEnergy(geom->contact->sides[0], geom->contact->sides[1], geom->contact->spots, contact->springs, contact->memory);
}

// Law

namespace {

	/// What readers of YADE's own geometry and physics expect, in the interaction's order of bodies.
	void fillReport(const brick::PairSummary& sum, const Vector3r& origin, BrickGeom& geom, BrickPhys& phys)
	{
		const Real sign   = geom.reversed ? -1 : 1;
		geom.normal       = sign * sum.normal;
		geom.contactPoint = origin + sum.point;
		geom.refR1 = geom.refR2 = std::sqrt(sum.area) / 2;
		geom.penetration        = sum.penetration;
		geom.area               = sum.area;
		phys.kn                 = sum.kn;
		phys.ks                 = sum.ks;
		phys.normalForce        = sign * sum.normalForce;
		phys.shearForce         = sign * sum.shearForce;
	}

	/// For the 3-D view.
	void noteLost(Brick& shape, Body::id_t other, const BrickPhys& phys)
	{
		if (!shape.lostJoints) shape.lostJoints = std::make_unique<std::vector<LostJoint>>();
		shape.lostJoints->push_back({ other, phys.joint.shape, phys.joint.restGap, phys.segmentState() });
	}

	/// The last segment has failed: the pair goes on as an ordinary contact, with the same shear, and with the joint's forces in this step.
	void endJoint(const brick::Side& side0, const brick::Side& side1, const brick::LawTerms& terms, BrickGeom& geom, BrickPhys& phys)
	{
		phys.contact          = std::make_shared<OrdinaryContact>();
		phys.contact->springs = phys.springs();
		if (terms.friction) phys.contact->memory = brick::tractionsOfJoint(phys.joint, geom.motion, phys.springs().tanFriction, side0, side1);
		phys.contact->failureModes = phys.segmentState();
		for (int side = 0; side < 2; ++side) {
			brick::Loads&      loads = phys.contact->loads[side];
			const brick::Side& body  = side == 0 ? side0 : side1;
			loads                    = brick::Loads(body.cells);
			loads.force              = phys.loads.forceOn(side);
			loads.torque             = phys.loads.torque[side];
			if (!body.support) brick::addNodalForces(phys.joint, phys.loads, side, body.placement.rotation, loads.nodal.data());
		}
		geom.contact.reset(new BrickGeom::Contact);
		geom.contact->sides = { side0, side1 };
		brick::findContact(side0, side1, geom.contact->spots); // for those who read energy and stiffness in this step
		phys.joint = brick::Joint();
		if (!phys.ledger) return;
		phys.ledger->contact.begin(phys.ledger->joint.energy, side0, side1, geom.contact->spots, phys.contact->springs, phys.contact->memory);
	}

} // namespace

/// The ledger of an interaction; null while O.trackEnergy is off. One that has missed a step begins anew.
PairLedger* Law2_BrickGeom_BrickPhys_Mortar::ledgerOf(BrickPhys& phys) const
{
	if (!scene->trackEnergy) phys.ledger.reset();
	else if (!phys.ledger || phys.step != scene->iter - 1)
		phys.ledger.reset(new PairLedger);
	return phys.ledger.get();
}

/// What is computed of an interaction in this step.
brick::LawTerms Law2_BrickGeom_BrickPhys_Mortar::termsOf(BrickPhys& phys) const
{
	if (phys.damped != dashpots) {
		phys.damped = dashpots;
		for (const Body::id_t id : phys.ids)
			if (Brick* shape = asBrick(Body::byId(id, scene)->shape)) {
#pragma omp atomic write
				shape->counted = false; // dashpots bear on the time step
			}
	}
	const brick::LawTerms asked { failure, friction, dashpots };
	return phys.isJoint() && phys.joint.holds() ? asked : asked.neededBy(phys.springs()); // a joint that holds has none of what that leaves out
}

void Law2_BrickGeom_BrickPhys_Mortar::applyJoint(BrickGeom& geom, BrickPhys& phys)
{
	const Stopwatch                       watch(jointSeconds);
	const Body &                          first = *Body::byId(phys.ids[0], scene), &second = *Body::byId(phys.ids[1], scene);
	brick::PairSummary                    sum;
	std::optional<brick::JointPlacements> moving;
	const brick::LawTerms                 terms = termsOf(phys);
	if (terms.dashpots && !phys.joint.holds()) {
		const Vector3r& at = second.state->pos;
		moving             = { sideOfBody(first, geom.supportSolid, at).placement, sideOfBody(second, geom.supportSolid, at).placement };
	}
	PairLedger* const ledger = ledgerOf(phys);
	const auto        failures = brick::jointLoads(
                phys.joint, geom.motion, moving ? &*moving : nullptr, phys.springs().tanFriction, phys.loads, sum, ledger ? &ledger->joint : nullptr, terms);
	if (phys.joint.shape->faces[0].face < 0) phys.loads.torque[0] += (geom.origin - first.state->pos).cross(phys.loads.forceOn(0));
	fillReport(sum, geom.origin, geom, phys);
	if (failures.total() == 0) return;
	phys.cracked.store(true, std::memory_order_release);
#pragma omp atomic
	tensionFailures += failures.tension;
#pragma omp atomic
	shearFailures += failures.shear;
#pragma omp atomic
	compressionFailures += failures.compression;
	if (phys.joint.intact() > 0) return;
	const Vector3r&   at = second.state->pos;
	const DrawingLock lock;
	noteLost(static_cast<Brick&>(*second.shape), first.getId(), phys);
	endJoint(sideOfBody(first, geom.supportSolid, at), sideOfBody(second, geom.supportSolid, at), terms, geom, phys);
}

void Law2_BrickGeom_BrickPhys_Mortar::applyContact(BrickGeom& geom, BrickPhys& phys)
{
	const Stopwatch                   watch(contactSeconds);
	thread_local brick::ContactMemory scratch;
	brick::PairSummary                sum;
	const auto&                       sides = geom.contact->sides;
	auto&                             contact = *phys.contact;
	auto&                             loads = contact.loads;
	const brick::LawTerms             terms   = termsOf(phys);
	brick::contactLoads(sides[0], sides[1], geom.contact->spots, contact.springs, scene->dt, contact.memory, scratch, loads, sum, terms);
	if (PairLedger* const ledger = ledgerOf(phys))
		ledger->contact.add(sides[0], sides[1], geom.contact->spots, contact.springs, scene->dt, contact.memory, terms);
	if (sides[0].support) loads[0].torque += (sides[0].placement.position - Body::byId(phys.ids[0], scene)->state->pos).cross(loads[0].force);
	fillReport(sum, sides[0].placement.position, geom, phys);
	for (const Body::id_t id : phys.ids)
		if (Brick* shape = asBrick(Body::byId(id, scene)->shape)) shape->noteContact(scene->iter);
}

bool Law2_BrickGeom_BrickPhys_Mortar::go(shared_ptr<IGeom>& ig, shared_ptr<IPhys>& ip, Interaction* I)
{
	BrickGeom& geom = static_cast<BrickGeom&>(*ig);
	BrickPhys& phys = static_cast<BrickPhys&>(*ip);
	phys.ids        = { geom.reversed ? I->getId2() : I->getId1(), geom.reversed ? I->getId1() : I->getId2() };
	if (phys.isJoint()) applyJoint(geom, phys);
	else if (geom.contact->spots.empty())
		return false;
	else
		applyContact(geom, phys);
	phys.step = scene->iter;

	const Real depth = geom.penetration / phys.contactPart;
	if (depth > 1 && phys.deepest <= 1) {
#pragma omp atomic
		++crushedContacts;
	}
	phys.deepest = std::max(phys.deepest, depth);
	return true;
}

} // namespace yade
