// SPDX-License-Identifier: GPL-2.0-or-later
#include "Drawn.hpp"

#include "DrawingLock.hpp"

#include <algorithm>

namespace yade {

std::vector<Vector3r> DrawnSurface::nodes() const
{
	const brick::SurfaceGrid& grid  = brick::surfaceGrid(cells);
	std::vector<Vector3r>     nodes = grid.positions(solid->corners);
	for (std::size_t a = 0; a < displacement.size(); ++a)
		nodes[a] += displacement[a];
	return nodes;
}

DrawnSurface drawnSurface(const Brick& b, Real magnified)
{
	DrawnSurface surface;
	{
		const DrawingLock lock;
		surface.solid        = b.solid;
		surface.cells        = b.surfaceCells();
		surface.displacement = b.displacement;
	}
	const std::size_t count = brick::surfaceGrid(surface.cells).size();
	if (surface.displacement.size() != count) surface.displacement.clear();
	for (auto& u : surface.displacement)
		u *= magnified;
	return surface;
}

Real DrawnJoint::failedShare() const
{
	if (states.empty()) return 0;
	return 1 - Real(std::count(states.begin(), states.end(), 0)) / Real(states.size());
}

std::optional<DrawnJoint> drawnJoint(const BrickPhys& phys)
{
	DrawnJoint        drawn;
	const DrawingLock lock;
	if (!phys.isJoint()) return {};
	drawn.joint.shape   = phys.joint.shape;
	drawn.joint.springs = phys.joint.springs;
	drawn.joint.restGap = phys.joint.restGap;
	if (!phys.cracked.load(std::memory_order_acquire)) return drawn;
	drawn.joint.segments = phys.joint.segments;
	drawn.joint.failures = phys.joint.failures;
	for (int s = 0; s < drawn.joint.count(); ++s)
		drawn.states.push_back(int(brick::segmentOf(drawn.joint, s).state));
	return drawn;
}

std::vector<std::pair<DrawnJoint, Body::id_t>> drawnLostJoints(const Brick& b)
{
	std::vector<std::pair<DrawnJoint, Body::id_t>> found;
	const DrawingLock                              lock;
	if (!b.lostJoints) return found;
	for (const LostJoint& lost : *b.lostJoints) {
		DrawnJoint drawn;
		drawn.joint.shape   = std::const_pointer_cast<brick::JointShape>(lost.shape); // which a Joint does not write to
		drawn.joint.restGap = lost.restGap;
		drawn.states        = lost.states;
		found.emplace_back(std::move(drawn), lost.other);
	}
	return found;
}

namespace {

	/// Placement of a body of a joint; the surface must live as long.
	brick::Placement placementOf(const Body& b, const DrawnSurface& surface, const Vector3r& position, const Vector3r& brickPosition)
	{
		if (const Wall* wall = dynamic_cast<const Wall*>(b.shape.get())) return sideOfWall(*wall, *b.state, brickPosition).placement;
		brick::Placement p;
		p.position = position;
		p.rotation = b.state->ori.toRotationMatrix();
		if (!surface.displacement.empty()) p.displacement = surface.displacement.data();
		return p;
	}

	/// As far as a side's nodes are among those of the surface, which has been changed meanwhile otherwise.
	bool fits(const brick::JointShape& shape, int side, const DrawnSurface& surface)
	{
		if (surface.displacement.empty()) return true;
		return std::all_of(shape.patches.begin(), shape.patches.end(), [&](const brick::JointPatch& patch) {
			const auto& nodes = patch.sides[side].nodes;
			return *std::max_element(nodes.begin(), nodes.end()) < int(surface.displacement.size());
		});
	}

} // namespace

DrawnMotion drawnMotion(const DrawnJoint& drawn, const Body& first, const Body& second, const Vector3r& shift2, Real magnified)
{
	const Brick *const shapes[2] = { asBrick(first.shape), asBrick(second.shape) };
	const Vector3r     positions[2] = { first.state->pos, second.state->pos + shift2 };
	const Body* const  bodies[2]    = { &first, &second };
	const bool         reversed     = shapes[0] && (!shapes[1] || first.getId() > second.getId());
	brick::Placement   placements[2];
	DrawnSurface       surfaces[2];
	for (int side = 0; side < 2; ++side) {
		const int i = side ^ int(reversed); // side 0 is the support, or the brick with the lower id
		if (shapes[i]) surfaces[side] = drawnSurface(*shapes[i], magnified);
		if (!fits(*drawn.joint.shape, side, surfaces[side])) surfaces[side].displacement.clear();
		placements[side] = placementOf(*bodies[i], surfaces[side], positions[i], positions[1 - i]);
	}
	DrawnMotion moved;
	moved.origin = placements[0].position;
	brick::jointMotion(drawn.joint, placements[0], placements[1], moved.motion);
	return moved;
}

Vector3r shiftOf(const Interaction& I, const Scene& scene)
{
	return scene.isPeriodic ? scene.cell->intrShiftPos(I.cellDist) : Vector3r(Vector3r::Zero());
}

} // namespace yade
