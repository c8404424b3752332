// SPDX-License-Identifier: GPL-2.0-or-later
// The jointed bricks of a scene as one structure. The numerics is in kernel/Assembly.
#pragma once

#include "BrickContact.hpp"

#include <lib/serialization/Serializable.hpp>

#include "kernel/Assembly.hpp"

namespace yade {

/// The bricks of a scene, in the order of ids, and their mortar joints as they are now.
struct SceneAssembly {
	std::vector<Body::id_t> ids;
	brick::Assembly         structure;

	int place(Body::id_t) const; ///< index of a body's brick; throws when it is none

	/// @throws std::invalid_argument naming the bodies when a joint has failed in part, or a brick has ordinary contact that bears load
	static SceneAssembly of(Scene&);
};

class IntactAssembly : public Serializable {
public:
	void                gather();
	int                 size() const { return assembly().structure.size(); }
	std::vector<int>    ids() const { return assembly().ids; }
	int                 place(int id) const;
	std::vector<int>    held() const;
	boost::python::list stiffness() const;
	boost::python::list mass() const;

	Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> nodalMap(int id) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(IntactAssembly, Serializable, R"(The bricks of the scene, joined by mortar that holds, as one structure: stiffness and mass for small motion about the present state. ``yade_brick.assembled()`` makes SciPy matrices of it, solves and finds natural frequencies.

Coordinates of each :yref:`Brick`: 3 translations of its centre [m], rotation vector [rad] in world axes, then the :yref:`amplitudes<Brick.amplitudes>` of its modes [sqrt(kg) m]. Geometric stiffness (of the order of stress over Young's modulus) is left out.)",
		/*attrs*/,
		/*ctor*/,
		/*py*/
		.def("gather", &IntactAssembly::gather, "Reads bricks and joints of the scene as they are now. Raises ValueError when a joint has failed in part, or bricks touch without mortar.")
		.add_property("size", &IntactAssembly::size, "Number of coordinates.")
		.add_property("ids", &IntactAssembly::ids, "Bodies of the bricks, in the order of their coordinates.")
		.def("place", &IntactAssembly::place, (boost::python::arg("id")), "Index of a body's first coordinate. Raises ValueError for a body that is no brick.")
		.add_property("held", &IntactAssembly::held, "Coordinates that blocked degrees of freedom hold.")
		.def("stiffnessEntries", &IntactAssembly::stiffness, "Entries of the stiffness matrix that are not zero, for coordinates in SI units (of a translation [N/m]): [rows, columns, values] as bytes of int32, int32 and float64.")
		.def("massEntries", &IntactAssembly::mass, "Likewise of the mass matrix: exact mass [kg] and inertia [kg m2] of the solids, lumped mass of the deformation, which is 1 [-] for each mode.")
		.def("nodalMap", &IntactAssembly::nodalMap, (boost::python::arg("id")), "Displacement of the nodes on the surface of a brick's inner part in world axes (three rows a node: x0 y0 z0 x1 ..., as :yref:`Brick.displacement`) for each of its coordinates. The transpose takes nodal forces [N] to the coordinates. A rigid brick has its corners for nodes.")
	);
	// clang-format on

private:
	std::shared_ptr<const SceneAssembly> gathered;
	const SceneAssembly&                 assembly() const;
};
REGISTER_SERIALIZABLE(IntactAssembly);

} // namespace yade
