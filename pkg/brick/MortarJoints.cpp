// SPDX-License-Identifier: GPL-2.0-or-later
#include "MortarJoints.hpp"

#include <core/Body.hpp>

#include "kernel/Message.hpp"

#include <boost/python/object.hpp>

#include <algorithm>
#include <set>

namespace yade {

YADE_PLUGIN((MortarJoints));

namespace {

	constexpr Real relativeTolerance = 1e-6; // of a brick's diagonal: far above the round-off of corners, far below any joint

	Brick*       brickOf(const Body& b) { return asBrick(b.shape); }
	string       named(const Body& b) { return "#" + std::to_string(b.getId()); }

	bool sameMortar(const shared_ptr<Mortar>& a, const shared_ptr<Mortar>& b)
	{
		if (!a || !b || a == b) return a == b;
		auto same = [](Real x, Real y) { return x == y || (std::isnan(x) && std::isnan(y)); };
		return same(a->young, b->young) && same(a->poisson, b->poisson) && a->thickness == b->thickness && a->tensileStrength == b->tensileStrength
		        && a->cohesion == b->cohesion && a->frictionAngle == b->frictionAngle && a->compressiveStrength == b->compressiveStrength
		        && a->Cs == b->Cs;
	}

	const BrickMat& brickMaterial(const Body& b)
	{
		const auto* material = dynamic_cast<const BrickMat*>(b.material.get());
		if (!material) throw std::invalid_argument("MortarJoints: brick " + named(b) + " needs a BrickMat");
		return *material;
	}

	/// Mortar between two bodies; null: none.
	shared_ptr<Mortar> mortarBetween(const Body& first, const Body& second, const shared_ptr<Mortar>& given)
	{
		if (given) return given;
		const auto& second_ = brickMaterial(second).mortar;
		if (!brickOf(first)) return second_;
		const auto& first_ = brickMaterial(first).mortar;
		if (!sameMortar(first_, second_))
			throw std::invalid_argument(
			        "MortarJoints: the materials of bricks " + named(first) + " and " + named(second)
			        + " have different mortar; give the mortar of this joint to MortarJoints");
		return first_;
	}

	/// Elasticity of the mortar, the bricks' own where none is given.
	brick::Elasticity mortarElasticity(const Mortar& mortar, const Body& first, const Body& second)
	{
		const BrickMat& m = brickMaterial(second);
		if (mortar.thickness > 0 && (std::isnan(mortar.young) || std::isnan(mortar.poisson)) && brickOf(first)) {
			const BrickMat& other = brickMaterial(first);
			if (other.young != m.young || other.poisson != m.poisson)
				throw std::invalid_argument(
				        "MortarJoints: bricks " + named(first) + " and " + named(second)
				        + " differ in elasticity, so Mortar.young and Mortar.poisson must be given");
		}
		return { std::isnan(mortar.young) ? m.young : mortar.young, std::isnan(mortar.poisson) ? m.poisson : mortar.poisson };
	}

	/// The largest of the overlaps between faces of two bodies.
	std::optional<brick::Joint>
	largestOverlap(const brick::Side& side0, const brick::Side& side1, Real tolerance, const Vector3r& direction, std::array<int, 2>& faces)
	{
		std::optional<brick::Joint> best;
		Real                        bestArea = 0;
		for (int f0 = 0; f0 < brick::faceCount; ++f0) {
			const Vector3r normal = side0.placement.rotation * side0.solid->faces[f0].normal;
			if (direction != Vector3r::Zero() && std::abs(normal.dot(direction.stableNormalized())) < std::sqrt(.5)) continue;
			for (int f1 = 0; f1 < brick::faceCount; ++f1) {
				auto joint = brick::joinFaces(side0, f0, side1, f1, tolerance);
				if (!joint) continue;
				if (joint->area() > bestArea) best = joint, bestArea = joint->area(), faces = { f0, f1 };
			}
		}
		return best;
	}

	void checkStrengths(const Mortar& m)
	{
		for (const auto& item : { std::make_pair("tensileStrength", m.tensileStrength),
		                          std::make_pair("cohesion", m.cohesion),
		                          std::make_pair("frictionAngle", m.frictionAngle),
		                          std::make_pair("compressiveStrength", m.compressiveStrength) })
			if (std::isnan(item.second))
				throw std::invalid_argument(
				        string("Mortar.") + item.first
				        + " is not given; a joint needs all four strengths (a large value for a mode in which it never fails)");
	}

	void checkThickness(const Mortar& mortar, const Body& b, const brick::Side& side, int face)
	{
		const Real length = (*side.contactLength)[face];
		if (!side.support && mortar.thickness > 2 * length)
			throw std::invalid_argument(
			        "Mortar.thickness: " + std::to_string(mortar.thickness) + " m, but the contact part of brick " + named(b) + " is "
			        + std::to_string(length) + " m thick; allowed is at most twice that (eqs. (2), (16))");
	}

	struct Box3 {
		Vector3r lower, upper;
		int      id;
	};

	/// Bounds of a body's faces, everywhere for a wall.
	Box3 bounds(const Body& b, Real margin)
	{
		std::vector<Vector3r> corners;
		if (brickOf(b)) corners = static_cast<const Brick&>(*b.shape).worldCorners(b.state);
		else if (const Box* box = dynamic_cast<const Box*>(b.shape.get()))
			for (const auto& c : brick::cuboidCorners(2 * box->extents))
				corners.push_back(b.state->pos + b.state->ori * c);
		else
			corners = { Vector3r::Constant(-std::numeric_limits<Real>::infinity()), Vector3r::Constant(std::numeric_limits<Real>::infinity()) };
		Box3 out { corners[0], corners[0], b.getId() };
		for (const auto& c : corners)
			out.lower = out.lower.cwiseMin(c), out.upper = out.upper.cwiseMax(c);
		out.lower.array() -= margin, out.upper.array() += margin;
		return out;
	}

	Real diagonal(const Brick& b) { return (b.solid->corners[6] - b.solid->corners[0]).norm(); }

	bool canBeJoined(const Body& b)
	{
		const Brick* shape = brickOf(b);
		const Wall*  wall  = dynamic_cast<const Wall*>(b.shape.get());
		const Box*   box   = dynamic_cast<const Box*>(b.shape.get());
		if (!shape && !wall && !box) return false;
		const auto refuse = [&b](const string& problem) { throw std::invalid_argument("MortarJoints: " + b.shape->getClassName() + " " + named(b) + " " + problem); };
		if (shape && !shape->solid) refuse("has no corners");
		if (wall && !(wall->axis >= 0 && wall->axis <= 2)) refuse("has the axis " + std::to_string(wall->axis) + "; allowed are 0, 1 and 2");
		if (const string problem = box ? boxProblem(*box) : ""; !problem.empty()) refuse("has " + problem);
		if (!b.state->pos.allFinite() || !b.state->ori.coeffs().allFinite()) refuse("is at a place or in an orientation that is not finite");
		return true;
	}

} // namespace

/// Joints are real before YADE's parallel loop has met them, where a functor that is missing would end the process.
class MortarJoints::FunctorsNeeded {
public:
	explicit FunctorsNeeded(Scene& scene)
	        : loop(scene.engineByName("InteractionLoop"))
	{
	}

	/// @throws std::invalid_argument naming what the InteractionLoop lacks for a pair of bodies that is to be joined; without a loop, nothing is known
	void check(const Body& first, const Body& second)
	{
		if (!loop || !known.insert({ first.shape->getClassName(), first.material->getClassName() }).second) return;
		const bool bricks = brickOf(first), ofBrick = asBrickMat(first.material);
		string     missing;
		if (!has("geomDispatcher", first.shape, second.shape)) missing = "Ig2_" + string(bricks ? "Brick" : first.shape->getClassName()) + "_Brick_BrickGeom";
		else if (!has("physDispatcher", first.material, second.material))
			missing = ofBrick ? "Ip2_BrickMat_BrickMat_BrickPhys" : "Ip2_FrictMat_BrickMat_BrickPhys";
		else if (!has("lawDispatcher", shared_ptr<IGeom>(new BrickGeom), shared_ptr<IPhys>(new BrickPhys)))
			missing = "Law2_BrickGeom_BrickPhys_Mortar";
		if (missing.empty()) return;
		throw std::invalid_argument(
		        "MortarJoints: bodies " + named(first) + " and " + named(second) + " are to be joined, but the InteractionLoop in O.engines has no " + missing
		        + ", which the first step needs; set O.engines before MortarJoints()() (yade_brick.engines() has all that the scene needs)");
	}

private:
	/// The dispatchers' classes are the host's: they are asked as Python does.
	template <class A, class B> bool has(const char* dispatcher, const A& a, const B& b) const
	{
		const PyGILState_STATE state = PyGILState_Ensure();
		bool                   found = false;
		try {
			found = !boost::python::object(loop).attr(dispatcher).attr("dispFunctor")(a, b).is_none();
		} catch (const boost::python::error_already_set&) { // ambiguous
			PyErr_Clear();
		}
		PyGILState_Release(state);
		return found;
	}

	shared_ptr<Engine>                  loop;
	std::set<std::pair<string, string>> known; // shape and material of the first body
};

void MortarJoints::postLoad(MortarJoints&)
{
	if (tolerance < 0 || std::isinf(tolerance))
		throw std::invalid_argument("MortarJoints.tolerance: " + std::to_string(tolerance) + " m; must be finite and >= 0, or NaN for the default");
	if (!normal.allFinite()) throw std::invalid_argument(brick::message("MortarJoints.normal: (", normal.transpose(), "); must be finite"));
}

/// Largest gap or overlap of faces that touch.
Real MortarJoints::gapOf(const Body& b) const
{
	if (!std::isnan(tolerance)) return tolerance;
	return brickOf(b) ? relativeTolerance * diagonal(*brickOf(b)) : 0;
}

/// The smaller brick's, whatever the order; a support has none.
Real MortarJoints::gapBetween(const Body& a, const Body& b) const
{
	if (!brickOf(a)) return gapOf(b);
	return brickOf(b) ? std::min(gapOf(a), gapOf(b)) : gapOf(a);
}

void MortarJoints::join(const shared_ptr<Body>& a, const shared_ptr<Body>& b, FunctorsNeeded& functors)
{
	if (areJoined(a->getId(), b->getId())) return;
	// canonical order: the support, or the lower id, first
	const bool  swap  = brickOf(*a) && (!brickOf(*b) || b->getId() < a->getId());
	const Body &first = swap ? *b : *a, &second = swap ? *a : *b;
	const auto  found = scene->interactions->find(first.getId(), second.getId());

	shared_ptr<const brick::Hexahedron> box;
	if (const Box* shape = dynamic_cast<const Box*>(first.shape.get())) box = solidOfBox(*shape);
	const brick::Side           side0 = sideOfBody(first, box, second.state->pos), side1 = sideOfBody(second, nullptr, second.state->pos);
	std::array<int, 2>          faces { 0, 0 };
	std::optional<brick::Joint> joint = largestOverlap(side0, side1, gapBetween(first, second), normal, faces);
	if (!joint) return;
	const shared_ptr<Mortar> filling = mortarBetween(first, second, mortar);
	if (!filling) return;
	checkStrengths(*filling);
	checkThickness(*filling, first, side0, faces[0]);
	checkThickness(*filling, second, side1, faces[1]);

	if (!dynamic_cast<const FrictMat*>(first.material.get()))
		throw std::invalid_argument("MortarJoints: support " + named(first) + " needs a FrictMat or BrickMat, since its friction counts once the joint has failed");
	functors.check(first, second);

	shared_ptr<BrickPhys> phys(new BrickPhys);
	brick::PairSprings    pair = pairSprings(*first.material, side0.support, brickMaterial(second));
	pair.setMortar(mortarElasticity(*filling, first, second), filling->thickness);
	pair.tanFriction             = std::tan(filling->frictionAngle);
	phys->tangensOfFrictionAngle = pair.tanFriction;
	joint->setMortar(
	        pair.at((*side0.contactLength)[faces[0]], (*side1.contactLength)[faces[1]]),
	        { filling->tensileStrength, filling->cohesion, pair.tanFriction, filling->compressiveStrength, filling->Cs },
	        pair);
	shareShape(*joint, side0, side1);
	phys->contactPart            = thinnestContactPart({ side0, side1 });
	phys->joint                  = *joint;

	shared_ptr<BrickGeom> geom(new BrickGeom);
	geom->supportSolid = box;
	if (found) scene->interactions->erase(found->getId1(), found->getId2(), found->linIx);
	shared_ptr<Interaction> I(new Interaction(first.getId(), second.getId()));
	I->geom         = geom;
	I->phys         = phys;
	I->iterMadeReal = scene->iter;
	scene->interactions->insert(I);
	++made;
	for (const Body* b : { &first, &second })
		if (Brick* shape = brickOf(*b)) {
			shape->whole   = shape->whole || shape->joints == 0;
			shape->counted = false;
			++shape->joints;
		}
}

/// Has a joint share its shape with one laid before, if there is one alike.
void MortarJoints::shareShape(brick::Joint& joint, const brick::Side& side0, const brick::Side& side1)
{
	constexpr Real     roundOff = 1e-12; // of a joint's size: what remains of coordinates up to some hundred metres
	const Real         size     = std::sqrt(joint.area());
	const long         key      = std::lround(1e6 * std::log(size)); // a few shapes each
	brick::JointMotion motion;
	for (auto found = shapes.lower_bound(key - 1); found != shapes.end() && found->first <= key + 1; ++found)
		if (brick::alike(*found->second, *joint.shape, roundOff * size)) {
			joint.shape = found->second;
			brick::jointMotion(joint, side0.placement, side1.placement, motion);
			joint.restGap = motion.meanOpening();
			return;
		}
	shapes.emplace(key, joint.shape);
}

bool MortarJoints::areJoined(Body::id_t a, Body::id_t b) const
{
	const auto&      found = scene->interactions->find(a, b);
	const BrickPhys* phys  = found ? asBrickPhys(found->phys) : nullptr;
	return phys && phys->isJoint();
}

/// Two bricks whose faces do not overlap, with a neighbour that both are joined to.
void MortarJoints::noteBeside(const shared_ptr<Body>& a, const shared_ptr<Body>& b) const
{
	Brick *first = brickOf(*a), *second = brickOf(*b);
	if (!first || !second || areJoined(a->getId(), b->getId())) return;
	if (std::find(first->beside.begin(), first->beside.end(), b->getId()) != first->beside.end()) return;
	const bool held = std::any_of(a->intrs.begin(), a->intrs.end(), [&](const auto& item) {
		return areJoined(a->getId(), item.first) && areJoined(b->getId(), item.first);
	});
	std::array<int, 2> faces;
	if (!held || largestOverlap(sideOfBody(*a, nullptr, a->state->pos), sideOfBody(*b, nullptr, b->state->pos), gapBetween(*a, *b), Vector3r::Zero(), faces)) return;
	first->beside.push_back(b->getId());
	second->beside.push_back(a->getId());
}

void MortarJoints::action()
{
	made = 0;
	shapes.clear();
	std::vector<Box3> boxes;
	for (const auto& b : *scene->bodies) {
		if (!b || !b->shape || !canBeJoined(*b)) continue;
		if (!ids.empty() && std::find(ids.begin(), ids.end(), b->getId()) == ids.end()) continue;
		boxes.push_back(bounds(*b, gapOf(*b)));
	}
	std::sort(
	        boxes.begin(), boxes.end(), [](const Box3& a, const Box3& b) { return a.lower[0] < b.lower[0] || (a.lower[0] == b.lower[0] && a.id < b.id); });
	std::vector<std::pair<shared_ptr<Body>, shared_ptr<Body>>> near;
	for (std::size_t i = 0; i < boxes.size(); ++i)
		for (std::size_t j = i + 1; j < boxes.size() && boxes[j].lower[0] <= boxes[i].upper[0]; ++j) {
			if ((boxes[i].lower.array() > boxes[j].upper.array()).any() || (boxes[j].lower.array() > boxes[i].upper.array()).any()) continue;
			const auto &a = Body::byId(boxes[i].id, scene), &b = Body::byId(boxes[j].id, scene);
			if ((brickOf(*a) || brickOf(*b)) && (a->isDynamic() || b->isDynamic())) near.emplace_back(a, b);
		}
	// in the order of ids, which is the order in memory
	std::sort(near.begin(), near.end(), [](const auto& x, const auto& y) {
		return std::minmax(x.first->getId(), x.second->getId()) < std::minmax(y.first->getId(), y.second->getId());
	});
	FunctorsNeeded functors(*scene);
	for (const auto& [a, b] : near)
		join(a, b, functors);
	for (const auto& [a, b] : near)
		noteBeside(a, b);
	dead = true;
}

} // namespace yade
