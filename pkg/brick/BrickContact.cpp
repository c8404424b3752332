// SPDX-License-Identifier: GPL-2.0-or-later
#include "BrickContact.hpp"

#include <core/Body.hpp>

namespace yade {

YADE_PLUGIN((
        BrickGeom)(BrickPhys)(Ig2_Brick_Brick_BrickGeom)(Ig2_Wall_Brick_BrickGeom)(Ig2_Box_Brick_BrickGeom)(Ip2_BrickMat_BrickMat_BrickPhys)(Ip2_FrictMat_BrickMat_BrickPhys)(Law2_BrickGeom_BrickPhys_Mortar));

// --------------------------------------------------------------------------------------------------------------- sides

namespace {

	const std::array<Real, brick::faceCount> noLength { 0, 0, 0, 0, 0, 0 };

	// Half sizes of the slab that stands for a wall [m]: wide beyond any scene, thick beyond any penetration, yet thin enough that heights over its
	// face keep fourteen digits of a metre.
	constexpr Real slabWidth = 1e7, slabThickness = 100;

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

// ------------------------------------------------------------------------------------------------------------ geometry

namespace {

	/// The geometry of this step; false when there is neither a joint nor contact, and none was asked for.
	bool updateGeom(
	        const brick::Side&                         side0,
	        const brick::Side&                         side1,
	        bool                                       reversed,
	        const shared_ptr<const brick::Hexahedron>& supportSolid,
	        bool                                       force,
	        const shared_ptr<Interaction>&             I)
	{
		thread_local std::vector<brick::ContactSpot> found;
		const BrickPhys*                             phys    = static_cast<const BrickPhys*>(I->phys.get());
		const bool                                   jointed = phys && phys->isJoint();
		if (!jointed) {
			brick::findContact(side0, side1, found);
			if (found.empty() && !I->geom && !force) return false;
		}
		if (!I->geom) I->geom = shared_ptr<IGeom>(new BrickGeom);
		BrickGeom& geom   = static_cast<BrickGeom&>(*I->geom);
		geom.sides        = { side0, side1 };
		geom.reversed     = reversed;
		geom.supportSolid = supportSolid;
		if (jointed) {
			geom.motion = brick::jointMotion(phys->joint, side0.placement, side1.placement);
			geom.spots.clear();
		} else
			std::swap(geom.spots, found);
		geom.spotCount = int(geom.spots.size());
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
	const Brick &first = static_cast<const Brick&>(*shape1), &second = static_cast<const Brick&>(*shape2);
	if (!first.solid || !second.solid) return false;
	const brick::Side side1 = first.side(state1.pos, state1), side2 = second.side(state2.pos + shift2, state2);
	const bool        reversed = I->getId1() > I->getId2();
	return updateGeom(reversed ? side2 : side1, reversed ? side1 : side2, reversed, nullptr, force, I);
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
	const Brick& b = static_cast<const Brick&>(*shape);
	if (!b.solid) return false;
	const Vector3r position = state2.pos + shift2;
	return updateGeom(sideOfWall(static_cast<const Wall&>(*wall), state1, position), b.side(position, state2), false, nullptr, force, I);
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
	const Brick& b = static_cast<const Brick&>(*shape);
	if (!b.solid) return false;
	shared_ptr<const brick::Hexahedron> solid;
	if (I->geom) solid = static_cast<const BrickGeom&>(*I->geom).supportSolid;
	if (!solid) solid.reset(new brick::Hexahedron(brick::cuboidCorners(2 * static_cast<const Box&>(*box).extents)));
	return updateGeom(sideOfBox(state1, *solid), b.side(state2.pos + shift2, state2), false, solid, force, I);
}

// ------------------------------------------------------------------------------------------------------------- physics

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

namespace {

	void makePhys(const Interaction& I, Scene* scene, shared_ptr<IPhys>& out)
	{
		const BrickGeom&      geom   = static_cast<const BrickGeom&>(*I.geom);
		const auto&           first  = Body::byId(geom.reversed ? I.getId2() : I.getId1(), scene);
		const auto&           second = Body::byId(geom.reversed ? I.getId1() : I.getId2(), scene);
		shared_ptr<BrickPhys> phys(new BrickPhys);
		phys->springs                = pairSprings(*first->material, geom.sides[0].support, static_cast<const BrickMat&>(*second->material));
		phys->tangensOfFrictionAngle = phys->springs.tanFriction;
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

std::vector<int> BrickPhys::segmentState() const
{
	if (!isJoint()) return failureModes;
	std::vector<int> out;
	for (const auto& s : joint.segments)
		out.push_back(int(s.state));
	return out;
}

std::vector<Real> BrickPhys::segmentArea() const
{
	std::vector<Real> out;
	for (const auto& s : joint.segments)
		out.push_back(s.area);
	return out;
}

namespace {

	void needStep(const shared_ptr<BrickGeom>& geom)
	{
		if (!geom) throw std::invalid_argument("geom is None; it must be the BrickGeom of the same interaction");
		if (!geom->sides[0].solid)
			throw std::runtime_error("The geometry of this joint is known after the first step: run O.step() before asking for it.");
	}

} // namespace

std::vector<Vector3r> BrickPhys::segmentPoints(const shared_ptr<BrickGeom>& geom) const
{
	needStep(geom);
	std::vector<Vector3r> out;
	for (const auto& s : joint.segments) {
		Vector3r x = Vector3r::Zero();
		for (int a = 0; a < 4; ++a)
			x += (s.weights[0][a] * geom->motion.positions[0][a] + s.weights[1][a] * geom->motion.positions[1][a]) / 2;
		out.push_back(geom->sides[0].placement.position + geom->sides[0].placement.rotation * x);
	}
	return out;
}

std::vector<Real> BrickPhys::normalStress(const shared_ptr<BrickGeom>& geom) const
{
	needStep(geom);
	std::vector<Real> out;
	for (const auto& s : joint.segments)
		out.push_back(brick::segmentTraction(joint, s, geom->motion, springs.tanFriction).normal);
	return out;
}

std::vector<Vector3r> BrickPhys::shearStress(const shared_ptr<BrickGeom>& geom) const
{
	needStep(geom);
	std::vector<Vector3r> out;
	for (const auto& s : joint.segments)
		out.push_back(geom->sides[0].placement.rotation * brick::segmentTraction(joint, s, geom->motion, springs.tanFriction).shear);
	return out;
}

Real BrickPhys::elasticEnergy(const shared_ptr<BrickGeom>& geom) const
{
	needStep(geom);
	return isJoint() ? brick::jointEnergy(joint, geom->motion, springs.tanFriction)
	                 : brick::contactEnergy(geom->sides[0], geom->sides[1], geom->spots, springs, memory);
}

// ----------------------------------------------------------------------------------------------------------------- law

namespace {

	Real thinnestContactPart(const std::array<brick::Side, 2>& sides)
	{
		Real thinnest = std::numeric_limits<Real>::infinity();
		for (const auto& side : sides)
			if (!side.support) thinnest = std::min(thinnest, *std::min_element(side.contactLength->begin(), side.contactLength->end()));
		return thinnest;
	}

	/// What readers of YADE's own geometry and physics expect, in the interaction's order of bodies.
	void fillReport(const brick::PairSummary& sum, BrickGeom& geom, BrickPhys& phys)
	{
		const Real sign   = geom.reversed ? -1 : 1;
		geom.normal       = sign * sum.normal;
		geom.contactPoint = geom.sides[0].placement.position + sum.point;
		geom.refR1 = geom.refR2 = std::sqrt(sum.area) / 2;
		geom.penetration        = sum.penetration;
		geom.area               = sum.area;
		phys.kn                 = sum.kn;
		phys.ks                 = sum.ks;
		phys.normalForce        = sign * sum.normalForce;
		phys.shearForce         = sign * sum.shearForce;
	}

} // namespace

bool Law2_BrickGeom_BrickPhys_Mortar::go(shared_ptr<IGeom>& ig, shared_ptr<IPhys>& ip, Interaction* I)
{
	BrickGeom&         geom  = static_cast<BrickGeom&>(*ig);
	BrickPhys&         phys  = static_cast<BrickPhys&>(*ip);
	const auto&        sides = geom.sides;
	brick::PairSummary sum;
	phys.ids = { geom.reversed ? I->getId2() : I->getId1(), geom.reversed ? I->getId1() : I->getId2() };
	if (phys.isJoint()) {
		const auto failures = brick::jointLoads(phys.joint, geom.motion, phys.springs, sides[0].placement.rotation, phys.loads, sum);
		if (failures.total() > 0) {
#pragma omp atomic
			tensionFailures += failures.tension;
#pragma omp atomic
			shearFailures += failures.shear;
#pragma omp atomic
			compressionFailures += failures.compression;
		}
		if (phys.joint.intact == 0) {
			phys.memory       = brick::tractionsOfJoint(phys.joint, geom.motion, phys.springs.tanFriction, sides[0], sides[1]);
			phys.failureModes = phys.segmentState();
			phys.joint        = brick::Joint();
		}
	} else {
		if (geom.spots.empty()) return false;
		brick::contactLoads(sides[0], sides[1], geom.spots, phys.springs, scene->dt, phys.memory, phys.scratch, phys.loads, sum);
	}
	if (sides[0].support) {
		const Vector3r& centre = Body::byId(phys.ids[0], scene)->state->pos;
		phys.loads[0].torque += (sides[0].placement.position - centre).cross(phys.loads[0].force);
	}
	fillReport(sum, geom, phys);

	const Real depth = sum.penetration / thinnestContactPart(sides);
	if (depth > 1 && phys.deepest <= 1) {
#pragma omp atomic
		++crushedContacts;
	}
	phys.deepest = std::max(phys.deepest, depth);
	return true;
}

} // namespace yade
