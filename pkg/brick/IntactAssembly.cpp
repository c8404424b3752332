// SPDX-License-Identifier: GPL-2.0-or-later
#include "IntactAssembly.hpp"

#include <core/Body.hpp>
#include <core/Omega.hpp>

#include "kernel/Message.hpp"

#include <algorithm>

namespace yade {

YADE_PLUGIN((IntactAssembly));

namespace {

	brick::AssembledBrick assembledBrick(const Body& b, Brick& shape)
	{
		const auto* material = dynamic_cast<const BrickMat*>(b.material.get());
		if (!material || !shape.solid) throw std::invalid_argument(brick::message("brick #", b.getId(), " needs corners and a BrickMat"));
		const State& s = *b.state;
		if (!s.pos.allFinite() || !s.ori.coeffs().allFinite())
			throw std::invalid_argument(brick::message("brick #", b.getId(), " is at a place or in an orientation that is not finite"));
		if (b.isDynamic() && !(s.mass > 0 && std::isfinite(s.mass) && s.inertia.minCoeff() > 0 && s.inertia.allFinite()))
			throw std::invalid_argument(brick::message(
			        "brick #", b.getId(), " has the mass ", s.mass, " kg and the inertia (", s.inertia.transpose(), ") kg m2; they must be finite and above 0"));
		brick::AssembledBrick part;
		part.position    = s.pos;
		part.orientation = s.ori;
		part.mass        = s.mass;
		part.inertia     = s.inertia;
		if (const auto* inner = shape.innerPart(*material)) {
			part.modes      = &inner->modes;
			part.amplitudes = shape.amplitudes;
		}
		for (int k = 0; k < 6; ++k)
			part.held[k] = s.blockedDOFs & (1u << k);
		return part;
	}

	using Pairs = std::map<std::pair<Body::id_t, Body::id_t>, const Interaction*>;

	Real normalForce(const Interaction& I) { return static_cast<const BrickPhys&>(*I.phys).normalForce.norm(); }
	bool isJoint(const Interaction& I) { return static_cast<const BrickPhys&>(*I.phys).isJoint(); }

	void checkJoints(const Pairs& pairs)
	{
		for (const auto& [key, I] : pairs) {
			const auto& phys = static_cast<const BrickPhys&>(*I->phys);
			if (phys.isJoint() && !phys.joint.holds())
				throw std::invalid_argument(brick::message(
				        "the joint of bodies #",
				        key.first,
				        " and #",
				        key.second,
				        " has failed in part: an intact assembly has joints that hold"));
		}
	}

	/// Bricks of a wall that meet at an edge only touch too, on the width by which they are deformed; that carries next to nothing.
	void checkContacts(const Pairs& pairs)
	{
		constexpr Real share   = 1e-3; // of the largest force of a joint
		Real           largest = 0;
		for (const auto& [key, I] : pairs)
			if (isJoint(*I)) largest = std::max(largest, normalForce(*I));
		for (const auto& [key, I] : pairs)
			if (!isJoint(*I) && normalForce(*I) > share * largest)
				throw std::invalid_argument(brick::message(
				        "bodies #",
				        key.first,
				        " and #",
				        key.second,
				        " press on each other without mortar: an intact assembly has joints only (see MortarJoints)"));
	}

	/// A joint between bodies of the scene; side 0 is the support or the brick with the lower id.
	brick::AssembledJoint assembledJoint(const Interaction& I, const BrickPhys& phys, const std::map<Body::id_t, int>& places, Scene& scene)
	{
		brick::AssembledJoint out;
		out.joint = phys.joint;
		std::array<Body::id_t, 2> id { I.getId1(), I.getId2() };
		if (!places.count(id[1]) || (places.count(id[0]) && id[1] < id[0])) std::swap(id[0], id[1]);
		for (int side = 0; side < 2; ++side)
			if (places.count(id[side])) out.bricks[side] = places.at(id[side]);
		if (out.bricks[0] >= 0) return out;
		const Body&     support = *Body::byId(id[0], &scene);
		const Vector3r& at      = Body::byId(id[1], &scene)->state->pos;
		const Wall*     wall = dynamic_cast<const Wall*>(support.shape.get());
		if (wall && !(wall->axis >= 0 && wall->axis <= 2))
			throw std::invalid_argument(brick::message("wall #", id[0], " has the axis ", wall->axis, "; allowed are 0, 1 and 2"));
		if (wall) out.support = sideOfWall(*wall, *support.state, at).placement;
		else {
			out.support.position = support.state->pos;
			out.support.rotation = support.state->ori.toRotationMatrix();
		}
		return out;
	}

	template <class Value> boost::python::object bytesOf(const std::vector<Value>& values)
	{
		return boost::python::object(boost::python::handle<>(
		        PyBytes_FromStringAndSize(reinterpret_cast<const char*>(values.data()), Py_ssize_t(values.size() * sizeof(Value)))));
	}

	boost::python::list entriesOf(const brick::SparseMatrix& matrix)
	{
		std::vector<std::int32_t> rows, columns;
		std::vector<double>       values;
		for (int column = 0; column < matrix.outerSize(); ++column)
			for (brick::SparseMatrix::InnerIterator k(matrix, column); k; ++k)
				rows.push_back(k.row()), columns.push_back(column), values.push_back(k.value());
		boost::python::list out;
		out.append(bytesOf(rows));
		out.append(bytesOf(columns));
		out.append(bytesOf(values));
		return out;
	}

} // namespace

SceneAssembly SceneAssembly::of(Scene& scene)
{
	std::vector<Body::id_t>            ids;
	std::vector<brick::AssembledBrick> bricks;
	std::map<Body::id_t, int>          places;
	for (const auto& b : *scene.bodies) {
		Brick* shape = b ? dynamic_cast<Brick*>(b->shape.get()) : nullptr;
		if (!shape) continue;
		if (!shape->isSettled())
			throw std::invalid_argument(brick::message("brick #", b->getId(), " is changing its level of deformation: its stiffness is known after BrickDynamics.levelTime"));
		if (shape->isChanging()) takeUpContactLengths(*b, scene);
		places[b->getId()] = int(ids.size());
		ids.push_back(b->getId());
		bricks.push_back(assembledBrick(*b, *shape));
	}
	// in the order of ids, so that sums do not depend on the order in which interactions came to be
	Pairs pairs;
	for (const auto& I : *scene.interactions)
		if (dynamic_cast<const BrickPhys*>(I->phys.get())) pairs[std::minmax(I->getId1(), I->getId2())] = I.get();
	checkJoints(pairs);
	checkContacts(pairs);
	std::vector<brick::AssembledJoint> joints;
	for (const auto& [key, I] : pairs) {
		const auto& phys = static_cast<const BrickPhys&>(*I->phys);
		if (phys.isJoint()) joints.push_back(assembledJoint(*I, phys, places, scene));
	}
	return { ids, brick::Assembly(std::move(bricks), std::move(joints)) };
}

int SceneAssembly::place(Body::id_t id) const
{
	const auto found = std::lower_bound(ids.begin(), ids.end(), id);
	if (found == ids.end() || *found != id)
		throw std::invalid_argument(brick::message("id is ", id, "; allowed are bodies that were bricks when this was gathered"));
	return int(found - ids.begin());
}

const SceneAssembly& IntactAssembly::assembly() const
{
	if (!gathered) throw std::runtime_error("IntactAssembly is empty: call gather() first");
	return *gathered;
}

void IntactAssembly::gather() { gathered = std::make_shared<const SceneAssembly>(SceneAssembly::of(*Omega::instance().getScene())); }

int IntactAssembly::place(int id) const { return assembly().structure.place(assembly().place(id)); }

std::vector<int> IntactAssembly::held() const
{
	std::vector<int> out;
	for (int i = 0; i < size(); ++i)
		if (assembly().structure.isHeld(i)) out.push_back(i);
	return out;
}

boost::python::list IntactAssembly::stiffness() const { return entriesOf(assembly().structure.stiffness()); }

boost::python::list IntactAssembly::mass() const { return entriesOf(assembly().structure.mass()); }

Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> IntactAssembly::nodalMap(int id) const
{
	const int    place  = assembly().place(id);
	const auto&  bodies = *Omega::instance().getScene()->bodies;
	const Brick* shape  = bodies.exists(id) ? asBrick(bodies[id]->shape) : nullptr;
	if (!shape) throw std::invalid_argument(brick::message("IntactAssembly.nodalMap: body #", id, " is gone since gather(), or is no Brick any more"));
	return assembly().structure.nodalMap(place, shape->innerNodes());
}

} // namespace yade
