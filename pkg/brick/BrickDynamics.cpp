// SPDX-License-Identifier: GPL-2.0-or-later
#include "BrickDynamics.hpp"

#include "BrickTimeStepper.hpp"
#include "Prefetch.hpp"
#include "RigidMotion.hpp"
#include "kernel/Message.hpp"

#include <core/Body.hpp>

#include <cstdio>
#include <fstream>

namespace yade {

YADE_PLUGIN((BrickDynamics));

namespace {

	[[noreturn]] void refuse(const Body& b, const string& problem)
	{
		throw std::invalid_argument("Body #" + std::to_string(b.getId()) + " (Brick): " + problem);
	}

	const BrickMat& checkedMaterial(const Body& b, const Brick& shape)
	{
		const auto* material = asBrickMat(b.material);
		if (!material) refuse(b, "its material must be a BrickMat");
		if (!shape.solid) refuse(b, "it has no corners");
		const State& s = *b.state;
		if (b.isDynamic() && !(s.mass > 0 && s.inertia.minCoeff() > 0))
			refuse(b, "mass " + std::to_string(s.mass) + " kg and inertia must be positive (use yade_brick.brick to make bodies)");
		return *material;
	}

	/// Whether a brick can be moved on as it is.
	bool isReady(const Body& b, const Brick& shape)
	{
		const auto* material = asBrickMat(b.material);
		return material && shape.solid && shape.isReady(*material) && (!b.isDynamic() || (b.state->mass > 0 && b.state->inertia.minCoeff() > 0));
	}

	constexpr int worthThreads = 200; // bodies; starting and ending a parallel region costs as much as some dozens

	/// What acts on a brick, summed over its interactions in the order of ids.
	struct Total {
		Vector3r             force { Vector3r::Zero() }, torque { Vector3r::Zero() };
		Matrix3r             rotation;    // of the body
		brick::NodalVectors* nodal;       // null for a rigid body
		int                  holding = 0; // joints all of whose segments hold

		Total(const Matrix3r& rotation, brick::NodalVectors* nodal)
		        : rotation(rotation)
		        , nodal(nodal)
		{
		}
		void add(const BrickPhys& phys, Body::id_t id)
		{
			const int side = phys.ids[0] == id ? 0 : 1;
			if (phys.isJoint()) addJoint(phys, side);
			else
				addContact(phys.contact->loads[side]);
		}

	private:
		void addJoint(const BrickPhys& phys, int side)
		{
			force += phys.loads.forceOn(side);
			torque += phys.loads.torque[side];
			if (nodal) brick::addNodalForces(phys.joint, phys.loads, side, rotation, nodal->data());
			holding += phys.joint.holds();
		}
		void addContact(const brick::Loads& loads)
		{
			force += loads.force;
			torque += loads.torque;
			for (std::size_t a = 0; nodal && a < nodal->size(); ++a)
				(*nodal)[a] += loads.nodal[a];
		}
	};

} // namespace

void BrickDynamics::postLoad(BrickDynamics&)
{
	if (!(damping >= 0 && damping < 1)) throw std::invalid_argument("BrickDynamics.damping: " + std::to_string(damping) + "; must be in [0, 1)");
	if (levelTime < 0 || std::isinf(levelTime))
		throw std::invalid_argument(brick::message("BrickDynamics.levelTime: ", levelTime, " s; must be finite and >= 0, or NaN for the default"));
}

/// Finds bricks that something was changed at since the last step, and what they need. Raises before anything has moved.
void BrickDynamics::prepare()
{
	if (const Body::id_t id = takeUntouchable(); id >= 0 && scene->bodies->exists(id)) {
		const Body& b = *(*scene->bodies)[id];
		if (const string problem = touchProblem(b); !problem.empty())
			throw std::invalid_argument("Body #" + std::to_string(id) + " (" + b.shape->getClassName() + "): " + problem);
	}
	const int count    = int(scene->bodies->size());
	bool      allReady = true;
#pragma omp parallel for schedule(static) reduction(&& : allReady) if (count > worthThreads)
	for (int id = 0; id < count; ++id) {
		const auto&  b     = (*scene->bodies)[id];
		const Brick* shape = b ? asBrick(b->shape) : nullptr;
		allReady           = allReady && (!shape || isReady(*b, *shape));
	}
	if (allReady) return;
	for (const auto& b : *scene->bodies)
		if (Brick* shape = asBrick(b->shape)) shape->innerPart(checkedMaterial(*b, *shape));
}

/// Whether all that is known to act was computed in this step, and nothing new can have come.
bool BrickDynamics::isCurrent() const
{
	const int count   = int(acting.size());
	bool      current = physMade == BrickPhys::made() && firstActing.size() == scene->bodies->size() + 1;
	if (!current) return false;
#pragma omp parallel for schedule(static) reduction(&& : current) if (count > worthThreads)
	for (int i = 0; i < count; ++i)
		current = current && static_cast<const BrickPhys&>(*acting[i]).step == scene->iter;
	return current;
}

void BrickDynamics::findActing()
{
	physMade = BrickPhys::made();
	acting.clear();
	firstActing.clear();
	for (const auto& b : scene->bodies->body) {
		firstActing.push_back(int(acting.size()));
		if (!b) continue;
		for (const auto& item : b->intrs) {
			const BrickPhys* phys = asBrickPhys(item.second->phys);
			if (phys && item.second->geom && phys->step == scene->iter) acting.push_back(item.second->phys);
		}
	}
	firstActing.push_back(int(acting.size()));
}

/// What the bodies after this one will need.
void BrickDynamics::prefetchFollowing(int id) const
{
	constexpr int far = 6, near = 3; // a chain of two reads
	const auto&   bodies = scene->bodies->body;
	if (id + far < int(bodies.size()) && bodies[id + far]) prefetch(bodies[id + far].get(), sizeof(Body));
	if (id + near >= int(bodies.size()) || !bodies[id + near]) return;
	const Body& next = *bodies[id + near];
	prefetch(next.state.get(), sizeof(State));
	prefetch(next.shape.get(), sizeof(Brick));
	for (int i = firstActing[id + near]; i < firstActing[id + near + 1]; ++i)
		prefetch(acting[i].get(), sizeof(BrickPhys));
}

/// Sums what acts on a body, and moves a brick's deformation on.
void BrickDynamics::moveOn(Body& b, BodyStep& step)
{
	Brick* const   shape = asBrick(b.shape);
	const int      first = firstActing[b.getId()], end = firstActing[b.getId() + 1];
	const State&   s     = *b.state;
	const BodyStep last  = step;
	step                 = {};
	step.any             = first < end;
	step.gained          = last.gained;
	if (!shape && !step.any && !last.any) return;
	thread_local brick::NodalVectors nodal; // keeps its room from brick to brick
	const bool                       deformable = shape && shape->isDeformable();
	if (deformable) nodal.assign(shape->displacement.size(), Vector3r::Zero());
	Total total(s.ori.toRotationMatrix(), deformable ? &nodal : nullptr);
	for (int i = first; i < end; ++i)
		total.add(static_cast<const BrickPhys&>(*acting[i]), b.getId());
	step.force = total.force, step.torque = total.torque;
	if (guard || scene->trackEnergy) step.power = step.powerWith(s), step.lastPower = last.powerWith(s);
	if (guard) step.work = lastDt / 2 * (last.power + step.lastPower);
	if (shape) moveBrickOn(b, *shape, nodal, step, total.holding);
}

/// @param holding joints of the brick all of whose segments hold
void BrickDynamics::moveBrickOn(Body& b, Brick& shape, const brick::NodalVectors& nodal, BodyStep& step, int holding)
{
	const bool held = shape.joints > 0 && holding == shape.joints;
	step.released   = shape.whole && !held && !shape.beside.empty();
	shape.whole     = held;
	shape.moved     = true;
	step.changing   = shape.isChanging();
	// rates of the nodes are for dashpots: of joints that have cracked, and of contact
	const bool dashpots = !shape.whole || shape.contactStep == scene->iter;
	if (shape.isDeformable()) {
		brick::ModeEnergy* const energy = scene->trackEnergy ? &energyLedger.modes[b.getId()] : nullptr;
		Real* const              work   = guard ? &step.work : nullptr;
		shape.advance(nodal, static_cast<const BrickMat&>(*b.material).dampingRatio, damping, scene->dt, dashpots, energy, work);
	}
	if (!scene->doSort && !scene->isPeriodic) askForNewBounds(b, shape);
}

/// The collider's strides watch centres only; a brick that turns or bulges out of its box asks for a new run, before it does.
void BrickDynamics::askForNewBounds(const Body& b, const Brick& shape) const
{
	if (!b.bound || b.bound->lastUpdateIter == scene->iter) return;
	constexpr Real others = 1e-3; // of the stride: for forces that are not ours, such as the weight, and for the arc of a turn
	const State&    s    = *b.state;
	const BodyStep& step = steps[b.getId()];
	const Real      dt = scene->dt, ours = movesFreely(b) ? step.force.norm() / s.mass + step.torque.norm() / s.inertia.minCoeff() * shape.solid->reach.sum() : 0;
	if (!shape.willReachOut(s, dt, dt * dt * ours + others * b.bound->sweepLength, b.bound->min, b.bound->max)) return;
#pragma omp atomic write
	scene->doSort = true;
}

/// Potential interactions of bricks laid edge to edge: as long as their joints hold these would be asked for nothing in every step.
void BrickDynamics::dropHeldApart()
{
	auto& interactions = *scene->interactions;
	if (interactions.size() > interactionsKept) {
		std::vector<std::pair<Body::id_t, Body::id_t>> dropped;
		for (const auto& I : interactions) {
			if (I->geom || I->phys) continue;
			const auto & a = Body::byId(I->getId1(), scene), &b = Body::byId(I->getId2(), scene);
			const Brick *first = a ? asBrick(a->shape) : nullptr, *second = b ? asBrick(b->shape) : nullptr;
			if (first && second && first->isHeldApartFrom(*second, I->getId2())) dropped.emplace_back(I->getId1(), I->getId2());
		}
		for (const auto& pair : dropped)
			if (const auto I = interactions.find(pair.first, pair.second)) interactions.erase(pair.first, pair.second, I->linIx);
	}
	interactionsKept = interactions.size();
}

/// A joint of a brick has failed: those that it was held apart from may touch it from now on. The collider finds the ones whose boxes do not overlap yet.
void BrickDynamics::takeUpReleased(const Body& b)
{
	for (const int id : static_cast<const Brick&>(*b.shape).beside) {
		if (!scene->bodies->exists(id)) continue;
		const auto& other = Body::byId(id, scene);
		if (!other || !other->bound || !b.bound || scene->interactions->find(b.getId(), id)) continue;
		const bool apart = (b.bound->min.array() > other->bound->max.array()).any() || (other->bound->min.array() > b.bound->max.array()).any();
		if (!apart || scene->isPeriodic) scene->interactions->insert(b.getId(), id);
	}
}

/// Goes on with changes of level, from which the next step begins.
void BrickDynamics::changeLevels()
{
	bool softer   = false; // a brick's springs are those of a rigid one again
	Real duration = levelTime;
	for (std::size_t id = 0; id < steps.size() && std::isnan(levelTime); ++id) // one for all: bricks that change together stay alike
		if (steps[id].changing) {
			// not std::fmax: the NaN of YADE's own headers is a signalling one, which takes the other number with it
			const Real time = static_cast<const Brick&>(*(*scene->bodies)[id]->shape).changeTime();
			if (std::isnan(duration) || time > duration) duration = time;
		}
	for (std::size_t id = 0; id < steps.size(); ++id) {
		if (!steps[id].changing) continue;
		const Body& b       = *(*scene->bodies)[id];
		Brick&      shape   = static_cast<Brick&>(*b.shape);
		const auto  before = shape.level;
		if (!shape.isSettled()) energyLedger.dropped += shape.changeLevel(static_cast<const BrickMat&>(*b.material), scene->dt, duration);
		takeUpContactLengths(b, *scene);
		shape.noteTakenUp();
		softer = softer || (shape.level != before && !shape.isDeformable());
		if (shape.level != before) countAnew(b);
	}
	if (softer) forgetStepLimit();
}

/// The stable step of a brick and of those that it touches is not what it was.
void BrickDynamics::countAnew(const Body& b)
{
	static_cast<Brick&>(*b.shape).counted = false;
	for (const auto& item : b.intrs)
		if (Brick* const other = asBrick(Body::byId(item.first, scene)->shape)) other->counted = false;
}

/// The step may grow again.
void BrickDynamics::forgetStepLimit()
{
	for (const auto& b : *scene->bodies)
		if (Brick* const shape = asBrick(b->shape)) shape->counted = false;
	stepWatch = StepWatch();
	if (const auto stepper = scene->engineByName("BrickTimeStepper")) static_cast<BrickTimeStepper&>(*stepper).limit = std::numeric_limits<Real>::infinity();
}

/// What has to be known before the deformation moves on.
void BrickDynamics::begin()
{
	const std::size_t count = scene->bodies->size();
	if (lastStep != scene->iter - 1) steps.clear(), lastDt = 0; // begun anew, or loaded
	steps.resize(count);
	if (guard && energyGuard.isDue(*scene)) energyGuard.begin(*scene);
	if (scene->trackEnergy) energyLedger.modes.assign(count, {});
}

/// A brick that nothing acts on has no force that would tell.
void BrickDynamics::checkFree(Body::id_t id)
{
	const auto&  b     = (*scene->bodies)[id];
	const Brick* shape = b ? asBrick(b->shape) : nullptr;
	if (!shape) return;
	const State& s      = *b->state;
	const bool   finite = std::all_of(shape->amplitudes.begin(), shape->amplitudes.end(), [](Real a) { return std::isfinite(a); });
	if (finite && (s.pos + s.vel + s.angVel).allFinite() && s.ori.coeffs().allFinite()) return;
	stop(brick::message(
	        "place, velocity or deformation of body #",
	        id,
	        " is not finite in step ",
	        scene->iter,
	        "; is a force on it, its velocity, gravity or the time step not finite, or far too large?"));
}

void BrickDynamics::give(int id)
{
	const BodyStep& step = steps[id];
	if (step.released) takeUpReleased(*(*scene->bodies)[id]);
	if (!step.any) return checkFree(id);
	if (!step.force.allFinite() || !step.torque.allFinite()) {
		const string cause = stepWatch.problem(*scene);
		stop(brick::message("the force on body #", id, " is not finite in step ", scene->iter, cause.empty() ? "" : ": ", cause));
	}
	scene->forces.addForce(id, step.force);
	scene->forces.addTorque(id, step.torque);
}

void BrickDynamics::book()
{
	std::vector<const BrickPhys*> once;
	for (std::size_t id = 0; id < steps.size(); ++id)
		for (int i = firstActing[id]; i < firstActing[id + 1]; ++i) {
			const auto& phys = static_cast<const BrickPhys&>(*acting[i]);
			if (phys.ids[0] == int(id)) once.push_back(&phys);
		}
	energyLedger.book(*scene, lastDt, steps, once);
}

/// Saves the scene and raises an error.
void BrickDynamics::stop(const string& why) const
{
	if (stopFile.empty()) throw std::runtime_error("BrickDynamics: " + why);
	string problem = ": is its folder there, and may it be written to?";
	std::remove(stopFile.c_str()); // YADE does not say when it cannot write
	try {
		Omega::instance().saveSimulation(stopFile);
	} catch (const std::exception& e) {
		problem = string(": ") + e.what();
	}
	const bool saved = std::ifstream(stopFile).good();
	throw std::runtime_error("BrickDynamics: " + why + (saved ? "; the scene was saved as '" : "; the scene could not be saved as '") + stopFile + "'" + (saved ? "" : problem));
}

namespace {

	/// The deepest contact of a body: how deep it has been, by the thickness of the contact part, and the other body.
	std::pair<Real, Body::id_t> deepestContact(const Body& b)
	{
		std::pair<Real, Body::id_t> deepest { 0, -1 };
		for (const auto& item : b.intrs) {
			const BrickPhys* phys = asBrickPhys(item.second->phys);
			if (phys && phys->deepest > deepest.first) deepest = { phys->deepest, item.first };
		}
		return deepest;
	}

} // namespace

string BrickDynamics::textOf(const EnergyGuard::Gain& found)
{
	string      cause = stepWatch.problem(*scene);
	const auto& body  = Body::byId(found.body, scene);
	if (const auto deepest = deepestContact(*body); cause.empty() && deepest.first > 1)
		cause = brick::message(
		        "bodies #", found.body, " and #", deepest.second, " have been inside each other by ", deepest.first, " contact parts; were they put so?");
	if (cause.empty())
		cause = "neither the time step nor deep contact accounts for it; were bodies, materials or joints changed during the run";
	return brick::message(
	        "joints and contacts have made energy from nothing: ",
	        found.work,
	        " J of work on the bodies within ",
	        found.steps,
	        " steps, where springs and bricks held ",
	        found.held,
	        " J; body #",
	        found.body,
	        " gained most. Likely cause: ",
	        cause,
	        ". BrickDynamics.guard = False lets it run on");
}

void BrickDynamics::action()
{
	if (const string found = std::exchange(alarm, {}); !found.empty() && guard) stop(found);
	prepare();
	stepWatch.look(*scene);
	if (!isCurrent()) findActing();
	begin();
	const int  count = int(steps.size());
	const bool large = isLarge(*scene);
#pragma omp parallel for schedule(static) if (count > worthThreads)
	for (int id = 0; id < count; ++id) {
		if (large) prefetchFollowing(id);
		if (const auto& b = (*scene->bodies)[id]; b && b->shape) moveOn(*b, steps[id]);
		else
			steps[id] = {};
	}
	dropHeldApart();
	// one thread writes all forces, so that sums with other engines' forces have one order too
	for (int id = 0; id < count; ++id)
		give(id);
	if (guard)
		if (const auto gain = energyGuard.add(*scene, steps)) alarm = textOf(*gain);
	if (scene->trackEnergy) book();
	if (std::any_of(steps.begin(), steps.end(), [](const BodyStep& step) { return step.changing; })) changeLevels();
	lastStep = scene->iter;
	lastDt   = scene->dt;
}

} // namespace yade
