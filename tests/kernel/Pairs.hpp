// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies and pairs of bodies for the tests of joints and contacts. Unless a test says otherwise: cubes of 0.2 m, E = 9.8e6 Pa, nu = 0.25,
// rho = 1800 kg/m3, the mortar of Furukawa et al. 2014, and the numbers of the reference dyn.bond (references.json), which has eight digits.
#pragma once

#include <pkg/brick/kernel/Contact.hpp>

#include <random>

namespace brick::pairs {

constexpr Real edge = .2, young = 9.8e6, poisson = .25, density = 1800;
constexpr Real knThin = 5.2266667e9, ksThin = 1.96e9;   ///< dyn.bond: kn_r1, ks_r1, two contact parts of 1 mm [Pa/m]
constexpr Real knRigid = 5.2266667e7, ksRigid = 1.96e7; ///< dyn.bond: kn_rigid, ks_rigid, l = 0.1 m
constexpr Real tensile = 4.6e3, cohesive = 2.9e3, friction = .62486935, crush = 4.9e5;

/// A body that owns what its Side points at.
struct Body {
	Hexahedron          solid;
	std::array<Real, 6> contactLength;
	int                 segments = 4;
	bool                support = false, deformable = false;
	Placement           placement;
	Nodes               displacement, rate;

	int                   cells = 1;            ///< of a refined body, which has the next two instead
	std::vector<Vector3r> surface, surfaceRate; ///< displacement and rate of the nodes of its surface

	explicit Body(const Nodes& corners, Real length = .001)
	        : solid(corners)
	{
		contactLength.fill(length);
		displacement.fill(Vector3r::Zero()), rate.fill(Vector3r::Zero());
	}
	static Body cuboid(const Vector3r& size, const Vector3r& at = Vector3r::Zero(), int segments = 4)
	{
		Body b(cuboidCorners(size));
		b.placement.position = at;
		b.segments           = segments;
		return b;
	}
	static Body cube(const Vector3r& at = Vector3r::Zero(), int segments = 4) { return cuboid(Vector3r::Constant(edge), at, segments); }
	static Body slab(const Vector3r& size, const Vector3r& at)
	{
		Body b    = cuboid(size, at);
		b.support = true;
		b.contactLength.fill(0);
		return b;
	}

	Side side() const
	{
		Side s { &solid, &contactLength, segments, support, placement };
		s.placement.displacement     = !deformable ? nullptr : cells > 1 ? surface.data() : displacement.data();
		s.placement.displacementRate = !deformable ? nullptr : cells > 1 ? surfaceRate.data() : rate.data();
		s.cells                      = cells;
		return s;
	}
	/// With n cells along an edge, it moves as it did: trilinear fields.
	void refine(int n)
	{
		cells = n, segments = (segments + n - 1) / n * n;
		surface.clear(), surfaceRate.clear();
		for (int node = 0; node < surfaceGrid(n).size(); ++node) {
			const auto N = shapeFunctions(surfaceGrid(n).naturalCoordinates(node));
			Vector3r   u = Vector3r::Zero(), v = Vector3r::Zero();
			for (int a = 0; a < nodeCount; ++a)
				u += N[a] * displacement[a], v += N[a] * rate[a];
			surface.push_back(u), surfaceRate.push_back(v);
		}
	}
	/// Moves it about a fixed point by an axis-angle vector [rad], then by a shift.
	void move(const Vector3r& turn, const Vector3r& shift = Vector3r::Zero(), const Vector3r& about = Vector3r::Zero())
	{
		const Matrix3r R          = turn.norm() > 0 ? Matrix3r(Eigen::AngleAxis<Real>(turn.norm(), turn.normalized())) : Matrix3r(Matrix3r::Identity());
		placement.position        = about + R * (placement.position - about) + shift;
		placement.rotation        = R * placement.rotation;
		placement.velocity        = R * placement.velocity;
		placement.angularVelocity = R * placement.angularVelocity;
	}
	Vector3r world(const Vector3r& local) const { return placement.position + placement.rotation * local; }
};

inline PairSprings springs(Real tanFriction = friction)
{
	const Elasticity brick { young, poisson };
	PairSprings      p;
	p.normalCompliance = { brick.normalCompliance(), brick.normalCompliance() };
	p.shearCompliance  = { brick.shearCompliance(), brick.shearCompliance() };
	p.density          = { density, density };
	p.tanFriction      = tanFriction;
	return p;
}

inline PairSprings onSupport(PairSprings p, int support)
{
	p.normalCompliance[support] = p.shearCompliance[support] = p.density[support] = 0;
	return p;
}

/// Numbers that are the same with every standard library.
class Random {
public:
	explicit Random(unsigned seed)
	        : generator(seed)
	{
	}
	Real     between(Real a, Real b) { return a + (b - a) * (Real(generator()) / 4294967295.); }
	Vector3r vector(Real size) { return { between(-size, size), between(-size, size), between(-size, size) }; }
	Vector3r turn() { return vector(1).normalized() * between(0, 3.14); }
	Nodes    nodes(Real size)
	{
		Nodes out;
		for (auto& x : out)
			x = vector(size);
		return out;
	}

private:
	std::mt19937 generator;
};

/// What a joint does, by body and node.
inline std::array<Loads, 2> loadsOf(const Joint& joint, const JointLoads& found, const Body& first, const Body& second)
{
	std::array<Loads, 2> out;
	for (int s = 0; s < 2; ++s) {
		const Body& b = s ? second : first;
		out[s].force = found.forceOn(s), out[s].torque = found.torque[s];
		if (joint.shape->faces[s].face >= 0) addNodalForces(joint, found, s, b.placement.rotation, out[s].nodal.data());
	}
	return out;
}

inline JointMotion motionOf(const Joint& joint, const Body& first, const Body& second)
{
	JointMotion motion;
	jointMotion(joint, first.side().placement, second.side().placement, motion);
	return motion;
}

/// One step of a joint as it is placed.
inline Failures
stepJoint(Joint& joint, const PairSprings& springs, const Body& first, const Body& second, std::array<Loads, 2>& loads, PairSummary& sum)
{
	const JointMotion     motion = motionOf(joint, first, second);
	const JointPlacements moving { first.side().placement, second.side().placement };
	JointLoads            found;
	const Failures        failures = jointLoads(joint, motion, &moving, springs.tanFriction, found, sum);
	loads                          = loadsOf(joint, found, first, second);
	return failures;
}

/// Has a segment of a joint fail in a mode.
inline void fail(Joint& joint, int segment, SegmentState mode)
{
	makeSegments(joint);
	const int patch = takePatch(joint, segment);
	joint.segments[patch].row(JointSegments::State)[segment] = int(mode);
	++(mode == SegmentState::Tension ? joint.failures.tension : mode == SegmentState::Shear ? joint.failures.shear : joint.failures.compression);
}
inline void failAll(Joint& joint, SegmentState mode)
{
	for (int s = 0; s < joint.count(); ++s)
		fail(joint, s, mode);
}

inline std::vector<JointSegment> segmentsOf(const Joint& joint)
{
	std::vector<JointSegment> out;
	for (int s = 0; s < joint.count(); ++s)
		out.push_back(segmentOf(joint, s));
	return out;
}

/// Moment that forces on the nodes of a body have about its position, where the nodes are now, world axes.
inline Vector3r nodalForce(const Body& b, const Loads& loads)
{
	Vector3r f = Vector3r::Zero();
	for (const auto& x : loads.nodal)
		f += b.placement.rotation * x;
	return f;
}
inline Vector3r nodalMoment(const Body& b, const Loads& loads)
{
	Vector3r m = Vector3r::Zero();
	for (int a = 0; a < nodeCount; ++a)
		m += b.placement.rotation
		        * Vector3r(b.solid.corners[a] + (b.deformable ? b.displacement[a] : Vector3r(Vector3r::Zero()))).cross(loads.nodal[a]);
	return m;
}

/// Sum of both torques about a point of the world: zero when angular momentum is conserved.
inline Vector3r totalMoment(const Body& b0, const Body& b1, const std::array<Loads, 2>& loads, const Vector3r& about)
{
	return loads[0].torque + loads[1].torque + (b0.placement.position - about).cross(loads[0].force)
	        + (b1.placement.position - about).cross(loads[1].force);
}

} // namespace brick::pairs
