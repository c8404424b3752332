// SPDX-License-Identifier: GPL-2.0-or-later
#include "Brick.hpp"

#include "DrawingLock.hpp"

#include <core/Body.hpp>
#include <core/Cell.hpp>
#include <core/Scene.hpp>

#include <boost/python/list.hpp>

#include "kernel/Contact.hpp"
#include "kernel/InnerMotion.hpp"
#include "kernel/Message.hpp"
#include "kernel/Stiffness.hpp"

#include <map>

namespace yade {

YADE_PLUGIN((Brick)(Bo1_Brick_Aabb));

namespace {

	template <class Value> using Names = std::vector<std::pair<const char*, Value>>;

	const Names<brick::Deformation> deformations { { "rigid", brick::Deformation::Rigid },
		                                       { "uniform", brick::Deformation::Uniform },
		                                       { "trilinear", brick::Deformation::Trilinear },
		                                       { "refined", brick::Deformation::Refined } };
	const Names<brick::Element> elements { { "full", brick::Element::Full }, { "incompatible", brick::Element::Incompatible }, { "bbar", brick::Element::Bbar } };
	const Names<brick::Inner>   inners { { "inset", brick::Inner::Inset }, { "full", brick::Inner::FullSize } };

	template <class Value> Value fromName(const char* attribute, const string& name, const Names<Value>& known)
	{
		string allowed;
		for (const auto& item : known) {
			if (name == item.first) return item.second;
			allowed += (allowed.empty() ? "'" : ", '") + string(item.first) + "'";
		}
		throw std::invalid_argument(string("Brick.") + attribute + ": '" + name + "' is not known; allowed are " + allowed);
	}

	template <class Value> const char* nameOf(Value value, const Names<Value>& known)
	{
		return std::find_if(known.begin(), known.end(), [value](const auto& item) { return item.second == value; })->first;
	}

	brick::Nodes nodesOf(const std::vector<Vector3r>& corners)
	{
		if (corners.size() != brick::nodeCount)
			throw std::invalid_argument("Brick.corners: " + std::to_string(corners.size()) + " given; a hexahedron has 8");
		brick::Nodes nodes;
		std::copy(corners.begin(), corners.end(), nodes.begin());
		return nodes;
	}

	Real longestEdge(const brick::Nodes& c) { return (c[6] - c[0]).norm(); }

	/// The dynamics of a brick is written in its principal frame.
	void checkPrincipalFrame(const brick::Nodes& corners)
	{
		constexpr Real tolerance  = 1e-6;
		const auto     properties = brick::solidProperties(corners);
		const Real     offset = properties.centroid.norm(), size = longestEdge(corners);
		if (offset > tolerance * size)
			throw std::invalid_argument(
			        "Brick.corners: the centre of gravity is " + std::to_string(offset)
			        + " m from the origin; corners must be given from the centre of gravity, in principal axes (Brick.solidProperties computes "
			          "them)");
		const Matrix3r inertia = properties.inertia;
		Real           product = 0;
		for (int i = 0; i < 3; ++i)
			product = std::max(product, std::abs(inertia(i, (i + 1) % 3)) / inertia.diagonal().maxCoeff());
		if (product > tolerance)
			throw std::invalid_argument(
			        "Brick.corners: the axes are not principal axes of inertia (product of inertia " + std::to_string(product)
			        + " of the largest moment; allowed is 1e-6); Brick.solidProperties computes the principal frame");
	}

	/// Types of inner parts in use, so that equal bricks share one.
	shared_ptr<const brick::InnerPart> sharedInnerPart(const brick::InnerPartType& type)
	{
		static std::map<std::vector<Real>, boost::weak_ptr<const brick::InnerPart>> inUse;
		std::vector<Real>                                                           key {
                        Real(int(type.deformation)), Real(int(type.element)), Real(int(type.inner)), Real(type.cells), type.thickness, type.young, type.poisson, type.density
		};
		for (const auto& c : type.corners)
			key.insert(key.end(), c.data(), c.data() + 3);
		auto& entry = inUse[key];
		auto  found = entry.lock();
		if (found) return found;
		try {
			found = shared_ptr<const brick::InnerPart>(new brick::InnerPart(type));
		} catch (const std::invalid_argument& problem) {
			throw std::invalid_argument(brick::message(
			        "Brick with young = ", type.young, " Pa, poisson = ", type.poisson, ", density = ", type.density, " kg/m3: ", problem.what()));
		}
		entry = found;
		return found;
	}

	/// Rest geometries in use, likewise.
	shared_ptr<const brick::Hexahedron> sharedSolid(const brick::Nodes& corners)
	{
		static std::map<std::vector<Real>, boost::weak_ptr<const brick::Hexahedron>> inUse;
		std::vector<Real>                                                            key;
		for (const auto& c : corners)
			key.insert(key.end(), c.data(), c.data() + 3);
		auto& entry = inUse[key];
		auto  found = entry.lock();
		if (!found) entry = found = shared_ptr<const brick::Hexahedron>(new brick::Hexahedron(corners));
		return found;
	}

	template <class Values> bool allZero(const Values& values)
	{
		return std::all_of(values.begin(), values.end(), [](const auto& value) { return value == 0 * value; });
	}

	template <class Value> void checkKnown(const char* what, Value value, const Names<Value>& known)
	{
		for (const auto& item : known)
			if (item.second == value) return;
		throw std::invalid_argument(brick::message("Brick.level: ", what, " number ", int(value), " is not known"));
	}

	/// Refuses what only a file can hold: a deformation that is not finite, or a level that there is not.
	void checkLoaded(const Brick& b)
	{
		const auto allFinite = [](const std::vector<Vector3r>& vectors) {
			return std::all_of(vectors.begin(), vectors.end(), [](const Vector3r& v) { return v.allFinite(); });
		};
		const auto allNumbers = [](const std::vector<Real>& values) { return std::all_of(values.begin(), values.end(), [](Real x) { return std::isfinite(x); }); };
		if (!allNumbers(b.amplitudes) || !allNumbers(b.rates) || !allFinite(b.displacement) || !allFinite(b.displacementRate))
			throw std::invalid_argument("Brick: amplitudes, rates, displacement and displacementRate must be finite; one of their values is not");
		for (const Real x : { b.share, b.progress })
			if (!(x > 0 && x <= 1)) throw std::invalid_argument(brick::message("Brick.share and progress: ", x, "; must be above 0, and at most 1"));
		checkKnown("deformation", b.level.deformation, deformations);
		checkKnown("element", b.level.element, elements);
		checkKnown("inner", b.level.inner, inners);
		if (b.level.cells < 1 || b.level.cells > brick::largestCells) throw std::invalid_argument(brick::message("Brick.level: ", b.level.cells, " cells"));
	}

	/// Refuses a deformation of other modes or nodes than the level in use has, as a file may hold, or drops it where it is zero.
	void checkDeformation(Brick& b)
	{
		const bool        rigid = b.level.isRigid();
		const std::size_t nodes = rigid ? 0 : brick::surfaceGrid(b.level.cells).size();
		const std::size_t modes = rigid ? 0 : b.level.deformation == brick::Deformation::Uniform ? 6 : 3 * nodes - 6;
		const auto        fits  = [](const auto& values, std::size_t count) { return values.empty() || values.size() == count; };
		if (fits(b.amplitudes, modes) && b.rates.size() == b.amplitudes.size() && fits(b.displacement, nodes) && fits(b.displacementRate, nodes)) return;
		if (!allZero(b.amplitudes) || !allZero(b.rates) || !allZero(b.displacement))
			throw std::invalid_argument(brick::message(
			        "Brick: it has ",
			        b.amplitudes.size(),
			        " amplitudes and ",
			        b.displacement.size(),
			        " nodes that are deformed, where ",
			        nameOf(b.level.deformation, deformations),
			        " has ",
			        modes,
			        " and ",
			        nodes));
		b.amplitudes.clear(), b.rates.clear(), b.displacement.clear(), b.displacementRate.clear();
	}

	/// Room for the numbers of a brick's modes or nodes, a thread's own.
	Real* workingSpace(int count)
	{
		thread_local std::vector<Real> space;
		if (int(space.size()) < count) space.resize(count);
		return space.data();
	}

	void nodesFrom(const brick::ModeColumns& columns, const std::vector<Real>& modal, std::vector<Vector3r>& nodal)
	{
		if (columns.paddedDofs() == columns.dofs()) return columns.displacements(modal.data(), nodal[0].data());
		Real* const padded = workingSpace(columns.paddedDofs());
		columns.displacements(modal.data(), padded);
		std::copy(padded, padded + columns.dofs(), nodal[0].data());
	}

} // namespace

BrickLevel Brick::wantedLevel() const
{
	BrickLevel found { fromName("deformation", deformation, deformations), fromName("element", element, elements), fromName("inner", inner, inners), 1, contactThickness };
	if (segments < 1 || segments > brick::largestSegments)
		throw std::invalid_argument("Brick.segments: " + std::to_string(segments) + "; allowed is 1 to " + std::to_string(brick::largestSegments));
	if (found.deformation != brick::Deformation::Refined) return found;
	if (cells < 1 || cells > brick::largestCells)
		throw std::invalid_argument(brick::message("Brick.cells: ", cells, "; allowed is 1 to ", brick::largestCells));
	if (segments % cells != 0)
		throw std::invalid_argument(
		        brick::message("Brick.segments: ", segments, " segments with cells = ", cells, "; the segments of a refined brick must be a multiple of its cells"));
	found.cells = cells;
	return found;
}

void Brick::postLoad(Brick&)
{
	checkLoaded(*this);
	const BrickLevel asked = wantedLevel();
	if (joints > 0 && solid && asked.cells != level.cells)
		throw std::invalid_argument(brick::message(
		        "Brick: a brick with joints cannot change from ", level.cells, " to ", asked.cells, " cells along an edge: its joints are at nodes of its surface"));
	shared_ptr<const brick::Hexahedron> shape = solid;
	if (!corners.empty()) {
		const brick::Nodes nodes = nodesOf(corners);
		shape                    = sharedSolid(nodes);
		checkPrincipalFrame(nodes);
		// refuses a thickness that the brick cannot have, wherever the inner part ends
		if (!asked.isRigid()) brick::insetCorners(*shape, contactThickness);
		keepDeformation(nodes);
	} else if (solid)
		throw std::invalid_argument("Brick.corners: none given; a brick that has corners can only be given eight others");
	solid  = shape;
	wanted = asked;
	if (!moved && level != wanted) beginLevel();
	checkDeformation(*this);
	setContactLengths();
	if (!inside) lastShare = share; // as loaded
	counted  = false;
	changing = joints > 0 || !isSettled();
	// joints and contacts of the first step, before the material is known, must find a deformable brick
	displacement.resize(isDeformable() ? surfaceNodes() : 0, Vector3r::Zero());
}

/// Takes up the level that is wanted, undeformed.
void Brick::beginLevel()
{
	const DrawingLock lock;
	level = wanted;
	share = progress = lastShare = 1;
	inside.reset();
	amplitudes.clear(), rates.clear(), displacementRate.clear();
	displacement.assign(isDeformable() ? surfaceNodes() : 0, Vector3r::Zero());
}

void Brick::setContactLengths()
{
	for (int f = 0; f < brick::faceCount && solid; ++f) {
		const Real settled = settledContactLength(f), rigid = solid->distance(f);
		contactLength[f]   = share < 1 ? rigid + share * (settled - rigid) : settled;
	}
}

Real Brick::changeTime() const
{
	constexpr Real periods = 4; // the element follows its load to some per cent
	return inside ? periods * 2 * M_PI / std::sqrt(inside->modes.omegaSquared.front()) : NaN;
}

Real Brick::changeLevel(const BrickMat& material, Real dt, Real duration)
{
	const auto part = [&] { // of the whole change
		const Real whole = std::isnan(duration) ? changeTime() : duration;
		return whole > dt ? dt / whole : 1;
	};
	Real dropped = 0;
	innerPart(material);
	if (level == wanted) progress = isDeformable() ? std::min<Real>(1, progress + part()) : 1;
	else if (isDeformable() && progress > part())
		progress -= part();
	else {
		dropped = kineticEnergy() - elasticEnergy(); // letting go, it stretches the springs at its faces by twice what it holds at rest
		beginLevel();
		if (innerPart(material)) progress = part();
	}
	share = progress * progress * (3 - 2 * progress); // without a jump of its rate, which would leave vibration
	setContactLengths();
	return dropped;
}

brick::InnerPartType Brick::innerPartType() const
{
	brick::InnerPartType type;
	type.corners     = solid->corners;
	type.deformation = level.deformation;
	type.element     = level.element;
	type.inner       = level.inner;
	type.thickness   = level.thickness;
	type.cells       = level.cells;
	return type;
}

/// The amplitudes belong to the modes of the corners that they were made with.
void Brick::keepDeformation(const brick::Nodes& nodes)
{
	if (!solid || solid->corners == nodes) return;
	if (!allZero(displacement)) throw std::invalid_argument("Brick.corners: a brick that is deformed cannot change them; make a new one");
	inside.reset();
	amplitudes.clear(), rates.clear(), displacement.clear(), displacementRate.clear();
}

const brick::InnerPart* Brick::innerPart(const BrickMat& material)
{
	if (!isDeformable()) return nullptr;
	if (isReady(material)) return inside.get();
	brick::InnerPartType type = innerPartType();
	type.young                = material.young;
	type.poisson              = material.poisson;
	type.density              = material.density;
	const auto part           = sharedInnerPart(type);
	{
		const DrawingLock lock;
		inside = part;
	}
	counted = false;
	amplitudes.resize(inside->modes.count(), 0);
	rates.resize(inside->modes.count(), 0);
	return inside.get();
}

void Brick::advance(
        const brick::NodalVectors& forces, Real dampingRatio, Real localDamping, Real dt, bool nodeRates, brick::ModeEnergy* energy, Real* work)
{
	constexpr Real changeDamping = .3; // of critical: a change of level leaves no vibration behind, and a stiffening element does not gain energy from what it has
	if (share < 1) dampingRatio = std::max(dampingRatio, changeDamping);
	const auto& omegaSquared = presentOmegaSquared();
	const int   count        = inside->modes.count();
	Real* const load  = workingSpace(inside->columns.paddedModes());
	inside->columns.loads(forces[0].data(), load);
	const Eigen::Map<const brick::VectorX> f(load, count), rate(rates.data(), count);
	const Real                             before = work ? f.dot(rate) : 0;
	std::vector<Real>                      amplitudes0, rates0;
	if (energy) amplitudes0 = amplitudes, rates0 = rates;
	brick::advanceModes(omegaSquared, load, dampingRatio, localDamping, dt, amplitudes.data(), rates.data());
	if (energy) *energy = brick::modeEnergy(omegaSquared, load, amplitudes0.data(), rates0.data(), rates.data(), dampingRatio, localDamping, dt);
	if (energy && share != lastShare)
		energy->stiffened = brick::stiffeningEnergy(inside->modes.omegaSquared, 1 / share - 1 / lastShare, amplitudes0.data(), rates0.data(), dt);
	lastShare = share;
	if (work) *work += dt / 2 * (before + f.dot(rate));
	updateNodes(nodeRates); // overwrites the loads
}

/// Of the element, by the share of the compliance that it has.
const std::vector<Real>& Brick::presentOmegaSquared() const
{
	if (share == 1) return inside->modes.omegaSquared;
	thread_local std::vector<Real> stiffened;
	stiffened = inside->modes.omegaSquared;
	for (Real& w : stiffened)
		w /= share;
	return stiffened;
}

void Brick::setAmplitudes(const std::vector<Real>& given)
{
	amplitudes = given;
	std::fill(rates.begin(), rates.end(), 0);
	updateNodes(false);
}

/// Displacement of the nodes from the modes, and its rate where it is wanted.
void Brick::updateNodes(bool withRates)
{
	nodesFrom(inside->columns, amplitudes, displacement);
	displacementRate.resize(withRates ? displacement.size() : 0);
	if (withRates) nodesFrom(inside->columns, rates, displacementRate);
}

std::vector<Vector3r> Brick::innerNodes() const { return inside ? inside->nodes : corners; }

Real Brick::elasticEnergy() const
{
	if (!isDeformable()) return 0;
	if (!inside) return NaN;
	Real energy = 0;
	for (std::size_t k = 0; k < amplitudes.size(); ++k)
		energy += inside->modes.omegaSquared[k] / share * amplitudes[k] * amplitudes[k] / 2;
	return energy;
}

Real Brick::kineticEnergy() const
{
	Real energy = 0;
	for (const Real rate : rates)
		energy += rate * rate / 2;
	return energy;
}

brick::Placement Brick::placement(const Vector3r& position, const State& state) const
{
	brick::Placement p;
	p.position        = position;
	p.rotation        = state.ori.toRotationMatrix();
	p.velocity        = state.vel;
	p.angularVelocity = state.angVel;
	if (!displacement.empty()) p.displacement = displacement.data();
	if (!displacementRate.empty()) p.displacementRate = displacementRate.data();
	return p;
}

brick::Side Brick::side(const Vector3r& position, const State& state) const
{
	brick::Side s;
	s.solid         = solid.get();
	s.contactLength = &contactLength;
	s.segments      = segments;
	s.placement     = placement(position, state);
	s.cells         = surfaceCells();
	return s;
}

Vector3r Brick::deformedNode(int a) const
{
	const int      n     = surfaceCells();
	const Vector3r place = a < brick::nodeCount ? corners[a] : brick::gridPoint(solid->corners, brick::surfaceGrid(n).gridPlace(a), n);
	return displacement.empty() ? place : Vector3r(place + displacement[a]);
}

bool Brick::willReachOut(const State& state, Real dt, Real margin, const Vector3r& lower, const Vector3r& upper) const
{
	// a box around all of it first, which mostly tells
	const Matrix3r R      = state.ori.toRotationMatrix();
	Vector3r       bulged = solid->reach;
	if (!displacement.empty()) {
		const Eigen::Map<const Eigen::Matrix<Real, 3, Eigen::Dynamic>> u(displacement[0].data(), 3, displacement.size());
		bulged.array() += u.cwiseAbs().maxCoeff();
	}
	const Real     turned = dt * state.angVel.cwiseAbs().sum() * bulged.sum() + margin;
	const Vector3r half   = (R.cwiseAbs() * bulged + dt * state.vel.cwiseAbs()).array() + turned;
	if (((state.pos - half).array() >= lower.array()).all() && ((state.pos + half).array() <= upper.array()).all()) return false;
	const Vector3r from = lower.array() + margin, to = upper.array() - margin;
	for (int a = 0; a < surfaceNodes(); ++a) {
		const Vector3r arm = R * deformedNode(a), x = state.pos + arm + dt * (state.vel + state.angVel.cross(arm));
		if ((x.array() < from.array()).any() || (x.array() > to.array()).any()) return true;
	}
	return false;
}

std::vector<Vector3r> Brick::worldCorners(const shared_ptr<State>& state) const
{
	if (!state) throw std::invalid_argument("state is None; it must be the State of the brick's body");
	std::vector<Vector3r> out;
	for (std::size_t a = 0; a < corners.size(); ++a)
		out.push_back(state->pos + state->ori * deformedNode(int(a)));
	return out;
}

std::vector<Vector3r> Brick::worldVelocities(const shared_ptr<State>& state) const
{
	if (!state) throw std::invalid_argument("state is None; it must be the State of the brick's body");
	std::vector<Vector3r> out, deforming(displacement.size());
	if (inside && !displacement.empty()) nodesFrom(inside->columns, rates, deforming);
	for (int a = 0; a < (corners.empty() ? 0 : surfaceNodes()); ++a) {
		const Vector3r arm = state->ori * deformedNode(a);
		out.push_back(state->vel + state->angVel.cross(arm) + (deforming.empty() ? Vector3r::Zero() : Vector3r(state->ori * deforming[a])));
	}
	return out;
}

Vector6r Brick::stress() const
{
	if (!isDeformable()) return Vector6r::Zero();
	if (!inside) return Vector6r::Constant(NaN);
	return inside->meanStress(Eigen::Map<const brick::VectorX>(displacement[0].data(), 3 * int(displacement.size()))) / share;
}

Real Brick::volume() const { return corners.empty() ? NaN : brick::solidProperties(nodesOf(corners)).volume; }

boost::python::dict Brick::solidProperties(const std::vector<Vector3r>& given)
{
	brick::Nodes nodes   = nodesOf(given);
	const string problem = brick::cornersProblem(nodes);
	if (!problem.empty()) throw std::invalid_argument("corners: " + problem);
	const auto            solid = brick::solidProperties(nodes);
	const auto            frame = brick::principalFrame(solid.inertia);
	boost::python::list local; // YADE's own conversion of vectors keeps every list for good
	for (const auto& x : nodes)
		local.append(Vector3r(frame.orientation.conjugate() * (x - solid.centroid)));
	boost::python::dict out;
	out["volume"]      = solid.volume;
	out["centroid"]    = Vector3r(solid.centroid);
	out["inertia"]     = Vector3r(frame.inertia);
	out["orientation"] = Quaternionr(frame.orientation);
	out["corners"]     = local;
	return out;
}

Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> Brick::stiffness(const std::vector<Vector3r>& nodes, Real young, Real poisson, const string& element)
{
	const auto K = brick::stiffness(nodesOf(nodes), young, poisson, fromName("element", element, elements));
	if (!K.allFinite())
		throw std::invalid_argument(brick::message("Brick.stiffness: young = ", young, " Pa is too large for this hexahedron: entries of the matrix overflow"));
	return K;
}

void Bo1_Brick_Aabb::go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body* body)
{
	const Brick& b = static_cast<const Brick&>(*shape);
	// Without a box it meets nothing in the parallel loop, where an error would end the process; BrickDynamics refuses it later in the same step.
	if (!b.solid || !dynamic_cast<const BrickMat*>(body->material.get())) return;
	if (!bound) bound = shared_ptr<Bound>(new Aabb);
	Vector3r lower, upper;
	for (int a = 0; a < b.surfaceNodes(); ++a) {
		const Vector3r turned = se3.orientation * b.deformedNode(a);
		lower                 = a ? Vector3r(lower.cwiseMin(turned)) : turned;
		upper                 = a ? Vector3r(upper.cwiseMax(turned)) : turned;
	}
	const Vector3r centre = scene->isPeriodic ? scene->cell->unshearPt(se3.position) : se3.position;
	bound->min            = centre + lower;
	bound->max            = centre + upper;
}

} // namespace yade
