// SPDX-License-Identifier: GPL-2.0-or-later
// The search that looks at eight segments at once, and at few of them, beside the plain one: every segment of every face cut as a polygon.
#include "Pairs.hpp"

#include <pkg/brick/kernel/ClippedPolygon.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

using namespace brick;
using pairs::Body;
using pairs::edge;

namespace {

constexpr Real leastCosine = .02; ///< as in the search
constexpr int  heightEntry = 5;
using Polygon              = ClippedPolygon<heightEntry + faceCount, 2 * faceCount>; ///< place, natural coordinates, heights

/// The plain search of one side's faces.
class PlainSearch {
public:
	PlainSearch(const Side& owner, const Side& other, int ownerIndex, std::vector<ContactSpot>& spots)
	        : owner(owner)
	        , other(other)
	        , ownerIndex(ownerIndex)
	        , weight(owner.support || other.support ? 1 : .5)
	        , spots(spots)
	{
		if (owner.support) return;
		for (face = 0; face < faceCount; ++face) {
			findBulges();
			for (int segment = 0; segment < owner.segments * owner.segments; ++segment)
				search(segment);
		}
	}

private:
	static Vector3r displacement(const Side& side, int f, Real xi, Real eta)
	{
		const SurfaceSpot at = surfaceGrid(side.cells).locate(f, xi, eta);
		Vector3r          u  = Vector3r::Zero();
		for (int a = 0; a < 4 && side.placement.displacement; ++a)
			u += at.weights[a] * side.placement.displacement[at.nodes[a]];
		return u;
	}
	/// How far a point of a face is displaced outwards.
	Real lift(int f, Real p, Real q) const { return other.solid->faces[f].normal.dot(displacement(other, f, p, q)); }
	/// Of all nodes of a face.
	std::vector<Real> lifts(int f) const
	{
		std::vector<Real> all;
		for (int row = 0; row <= other.cells; ++row)
			for (int column = 0; column <= other.cells; ++column)
				all.push_back(lift(f, 2. * column / other.cells - 1, 2. * row / other.cells - 1));
		return all;
	}
	Real meanLift(int f) const
	{
		const auto all = lifts(f);
		return std::accumulate(all.begin(), all.end(), Real(0)) / Real(all.size());
	}

	/// Only of faces that can be pressed on, and that could be the nearest by the nodes' heights over the mean planes, the bulging counts.
	void findBulges()
	{
		std::array<Real, faceCount> leastDepth;
		Real                        nearest = std::numeric_limits<Real>::infinity();
		for (int f = 0; f < faceCount; ++f) {
			Real       lowest = std::numeric_limits<Real>::infinity(), highest = -lowest;
			const auto all = lifts(f);
			means[f]       = meanLift(f);
			for (int row = 0; row <= owner.cells; ++row)
				for (int column = 0; column <= owner.cells; ++column) {
					const Vector3r x = place(2. * column / owner.cells - 1, 2. * row / owner.cells - 1);
					const Real     h = other.solid->faces[f].normal.dot(x) - other.solid->faces[f].offset - means[f];
					lowest = std::min(lowest, h), highest = std::max(highest, h);
				}
			leastDepth[f] = -highest;
			nearest       = std::min(nearest, *std::max_element(all.begin(), all.end()) - means[f] - lowest);
		}
		for (int f = 0; f < faceCount; ++f)
			bulges[f] = cosine(f) > 0 && leastDepth[f] <= nearest;
	}
	/// Of a point of the owner's face.
	Vector3r place(Real xi, Real eta) const
	{
		const Vector4r w = bilinear(xi, eta);
		Vector3r       x = displacement(owner, face, xi, eta);
		for (int a = 0; a < 4; ++a)
			x += w[a] * owner.solid->corners[faceNodes[face][a]];
		const auto &mine = owner.placement, &its = other.placement;
		return its.rotation.transpose() * (mine.rotation * x + mine.position - its.position);
	}
	Polygon::Vertex vertex(int column, int row) const
	{
		return fields(2. * column / owner.segments - 1, 2. * row / owner.segments - 1);
	}
	/// Place, natural coordinates and heights of a point of the owner's face.
	Polygon::Vertex fields(Real xi, Real eta) const
	{
		const Vector3r  x = place(xi, eta);
		Polygon::Vertex v;
		v.head<heightEntry>() << x, xi, eta;
		for (int f = 0; f < faceCount; ++f) {
			const Face&    target  = other.solid->faces[f];
			const Vector2r natural = target.coordinates(x);
			v[heightEntry + f]     = target.normal.dot(x) - target.offset - (bulges[f] ? lift(f, natural[0], natural[1]) : means[f]);
		}
		return v;
	}
	Real cosine(int f) const
	{
		return -(owner.placement.rotation * owner.solid->faces[face].normal).dot(other.placement.rotation * other.solid->faces[f].normal);
	}

	void search(int segment)
	{
		const int  n = owner.segments, column = segment % n, row = segment / n;
		const auto a = vertex(column, row), b = vertex(column + 1, row), c = vertex(column + 1, row + 1), d = vertex(column, row + 1);
		Polygon    patch(a, b, c, d);
		for (int f = 0; f < faceCount; ++f)
			patch.keepNegative(heightEntry + f);
		if (patch.empty()) return;
		const Polygon::Vertex highest = a.cwiseMax(b).cwiseMax(c).cwiseMax(d), lowest = a.cwiseMin(b).cwiseMin(c).cwiseMin(d);
		std::vector<int>      pressable;
		for (int f = 0; f < faceCount; ++f)
			if (cosine(f) > leastCosine && highest[heightEntry + f] > lowest.tail<faceCount>().maxCoeff()) pressable.push_back(f);
		if (pressable.size() < 2) add(segment, patch, -1);
		else
			for (int f : pressable) {
				Polygon part = patch;
				for (int g : pressable)
					if (g != f) part.keepAbove(heightEntry + f, heightEntry + g);
				if (!part.empty()) add(segment, part, f);
			}
	}

	void add(int segment, const Polygon& part, int expected)
	{
		Polygon::Vertex centre;
		int             nearest;
		const Real      area        = part.areaAndCentroid(centre);
		const auto      there       = fields(centre[3], centre[4]);
		const Real highest = (expected >= 0 ? centre : there).tail<faceCount>().maxCoeff(&nearest);
		if (expected >= 0 && centre[heightEntry + expected] >= highest - 1e-9 * std::abs(highest)) nearest = expected; // not given up for one as near
		const Real penetration = -there[heightEntry + nearest];
		if (!(area > 0) || !(penetration > 0) || cosine(nearest) <= 0 || (expected >= 0 && expected != nearest)) return;
		ContactSpot spot;
		spot.key   = contactKey(ownerIndex, face, nearest, segment);
		spot.owner = ownerIndex, spot.ownerFace = face, spot.otherFace = nearest;
		part.pressedCentroid(heightEntry + nearest, centre);
		spot.ownerNatural = centre.segment<2>(3);
		spot.position     = place(centre[3], centre[4]);
		spot.otherNatural = other.solid->faces[nearest].coordinates(spot.position);
		spot.penetration  = penetration;
		spot.area         = weight * cosine(nearest) * area;
		spots.push_back(spot);
	}

	const Side &                owner, &other;
	int                         ownerIndex, face = 0;
	Real                        weight;
	std::vector<ContactSpot>&   spots;
	std::array<bool, faceCount> bulges;
	std::array<Real, faceCount> means;
};

/// Spots that press with this little are left out: whether round-off makes one is chance [m3].
constexpr Real least = 1e-15;

std::vector<ContactSpot> withoutSlivers(std::vector<ContactSpot> spots)
{
	spots.erase(std::remove_if(spots.begin(), spots.end(), [](const ContactSpot& s) { return s.area * s.penetration < least; }), spots.end());
	return spots;
}

/// Number of spots compared.
int expectSameSpots(std::vector<ContactSpot> found, std::vector<ContactSpot> plain, Real tolerance)
{
	found = withoutSlivers(found), plain = withoutSlivers(plain);
	EXPECT_EQ(found.size(), plain.size());
	for (std::size_t i = 0; i < std::min(found.size(), plain.size()); ++i) {
		const ContactSpot &a = found[i], &b = plain[i];
		EXPECT_EQ(a.key, b.key);
		EXPECT_LE((a.position - b.position).norm(), tolerance * edge);
		EXPECT_LE(std::abs(a.penetration - b.penetration), tolerance * edge);
		EXPECT_LE(std::abs(a.area - b.area), tolerance * edge * edge);
		EXPECT_LE((a.ownerNatural - b.ownerNatural).norm() + (a.otherNatural - b.otherNatural).norm(), tolerance * 8);
	}
	return int(found.size());
}

std::vector<ContactSpot> spotsOf(const Body& first, const Body& second)
{
	std::vector<ContactSpot> found;
	findContact(first.side(), second.side(), found);
	return found;
}

int expectPlainSpots(const Body& first, const Body& second, Real tolerance)
{
	const Side               side0 = first.side(), side1 = second.side();
	std::vector<ContactSpot> plain;
	PlainSearch(side0, side1, 0, plain);
	PlainSearch(side1, side0, 1, plain);
	std::sort(plain.begin(), plain.end(), [](const ContactSpot& a, const ContactSpot& b) { return a.key < b.key; });
	return expectSameSpots(spotsOf(first, second), plain, tolerance);
}

/// Rigid: heights round to 3e-17 m, which places a cut at a slope of 1e-5 to 3e-12 m, some times more in slivers. Warped: a part may be divided into other
/// triangles, the square of 1e-6 m of warping over small pieces.
constexpr Real rigid = 1e-10, warped = 1e-8;

} // namespace

TEST(ContactSearchTest, spots_of_stacked_bricks_are_those_of_the_plain_search)
{
	pairs::Random random(21);
	int           compared = 0;
	for (int n : { 1, 3, 4, 10, 17, 64 })
		for (const Vector2r& offset :
		     { Vector2r(3e-6, -5e-6), Vector2r(.1, 4e-6), Vector2r(.063, -.041), Vector2r(.2 - 3e-6, 0), Vector2r(0, .2 + 1e-6) })
			for (Real tilt : { 0., 1e-5, 1e-3, .03 })
				for (bool deformed : { false, true }) {
					Body lower = Body::cube({ 0, 0, 0 }, n), upper = Body::cube({ offset[0], offset[1], edge - 1e-5 }, n == 10 ? 4 : n);
					upper.move(tilt * random.vector(1), { 0, 0, 0 }, upper.placement.position);
					for (Body* b : { &lower, &upper }) {
						b->deformable = deformed, b->displacement = random.nodes(1e-6);
						b->move({ .3, -1.2, .8 }, { .3, .1, -.2 });
					}
					compared += expectPlainSpots(lower, upper, deformed ? warped : rigid);
				}
	EXPECT_GT(compared, 20000);
}

TEST(ContactSearchTest, spots_on_a_support_are_those_of_the_plain_search)
{
	pairs::Random random(22);
	for (int n : { 4, 10 })
		for (int trial = 0; trial < 20; ++trial) {
			Body brick = Body::cube({ 3, 1, edge / 2 - 1e-5 }, n);
			brick.move(random.vector(trial % 2 ? 1e-5 : .01), { 0, 0, 0 }, brick.placement.position);
			brick.deformable = trial % 3, brick.displacement = random.nodes(1e-6);
			expectPlainSpots(Body::slab({ 100, 100, 20 }, { 0, 0, -10 }), brick, brick.deformable ? warped : rigid);
		}
}

TEST(ContactSearchTest, spots_of_edges_and_corners_are_those_of_the_plain_search)
{
	pairs::Random random(23);
	int           compared = 0;
	for (int trial = 0; trial < 400; ++trial) {
		const auto size   = [&] { return Vector3r(random.between(.1, .3), random.between(.1, .3), random.between(.1, .3)); };
		Body       first  = Body::cuboid(size(), { 0, 0, 0 }, 1 + int(random.between(0, 11.99)));
		Body       second = Body::cuboid(size(), random.vector(.2), 1 + int(random.between(0, 11.99)));
		first.move(random.turn()), second.move(random.turn(), { 0, 0, 0 }, second.placement.position);
		compared += expectPlainSpots(first, second, rigid);
	}
	EXPECT_GT(compared, 5000);
}

/// The frustum of a pyramid: its sides are no parallelograms.
TEST(ContactSearchTest, spots_of_tapered_bricks_are_those_of_the_plain_search)
{
	pairs::Random random(24);
	Nodes         corners = cuboidCorners(Vector3r::Constant(edge));
	for (auto& x : corners)
		x.head<2>() *= x[2] > 0 ? .6 : 1;
	const Vector3r centre = solidProperties(corners).centroid;
	for (auto& x : corners)
		x -= centre;
	int compared = 0;
	for (int trial = 0; trial < 40; ++trial) {
		Body first(corners), second(corners);
		second.segments           = 1 + trial % 11;
		const Vector3r n          = first.solid.faces[1].normal;
		second.placement.rotation = Eigen::AngleAxis<Real>(M_PI, n).toRotationMatrix()
		        * Eigen::Quaternion<Real>::FromTwoVectors(second.solid.faces[1].normal, -n).toRotationMatrix();
		second.placement.position = 2 * first.solid.distance(1) * n - 1e-5 * n;
		second.move(random.vector(1e-4), random.vector(.01) - random.vector(.01).dot(n) * n, second.placement.position);
		compared += expectPlainSpots(first, second, rigid);
	}
	EXPECT_GT(compared, 100);
}

TEST(ContactSearchTest, pairs_that_one_face_parts_are_told_at_once)
{
	std::vector<ContactSpot> spots;
	for (Real gap : { 1e-12, 1e-6, 1e-2 })
		for (int f = 0; f < faceCount; ++f) {
			Body first = Body::cube(), second = Body::cube((edge + gap) * Vector3r(f / 2 == 0, f / 2 == 1, f / 2 == 2) * (f % 2 ? 1 : -1));
			findContact(first.side(), second.side(), spots);
			EXPECT_TRUE(spots.empty());
		}
}

// Refined bodies

namespace {

/// Gives a body cells, or one, whose nodes move as they please.
void refineAtRandom(Body& b, int cells, Real size, pairs::Random& random)
{
	b.deformable = true, b.displacement = random.nodes(size);
	b.refine(cells);
	for (auto& u : b.surface)
		u = random.vector(size);
}

/// A cube, a little tilted, on a cube.
std::array<Body, 2> stacked(pairs::Random& random, int segments0, int segments1)
{
	const Vector2r offset(random.between(-.15, .15), random.between(-.15, .15));
	Body           lower = Body::cube({ 0, 0, 0 }, segments0), upper = Body::cube({ offset[0], offset[1], edge - 1e-5 }, segments1);
	upper.move(random.between(0, 1e-4) * random.vector(1), { 0, 0, 0 }, upper.placement.position);
	for (Body* b : { &lower, &upper })
		b->move({ .3, -1.2, .8 }, { .3, .1, -.2 });
	return { lower, upper };
}

/// Of what presses.
Real volumeOf(const std::vector<ContactSpot>& spots)
{
	Real sum = 0;
	for (const auto& spot : spots)
		sum += spot.area * spot.penetration;
	return sum;
}

/// Boxes that hang together by an edge or a corner: along the line between the centres, as far from touching as said.
std::array<Body, 2> almostTouching(pairs::Random& random, int segments0, int segments1, Real overlap)
{
	const auto     size  = [&] { return Vector3r(random.between(.1, .3), random.between(.1, .3), random.between(.1, .3)); };
	Body           first = Body::cuboid(size(), { 0, 0, 0 }, segments0), second = Body::cuboid(size(), { 0, 0, 0 }, segments1);
	const Vector3r away = random.vector(1).normalized();
	first.move(random.turn()), second.move(random.turn());
	Real touching = .05, apart = 1;
	for (int i = 0; i < 40; ++i) {
		const Real middle                                   = (touching + apart) / 2;
		second.placement.position                           = middle * away;
		(spotsOf(first, second).empty() ? apart : touching) = middle;
	}
	second.placement.position = (touching - overlap) * away;
	return { first, second };
}

} // namespace

TEST(ContactSearchTest, spots_of_refined_bricks_are_those_of_the_plain_search)
{
	pairs::Random random(25);
	int           compared = 0;
	for (int trial = 0; trial < 60; ++trial)
		for (int n : { 2, 3, 4, 8 }) {
			auto pair
			        = trial % 2 ? stacked(random, n * (1 + trial % 3), 6) : almostTouching(random, n * (1 + trial % 3), 6, random.between(0, .02));
			// Displacements are not linear over a segment that is as large as a cell. Where an edge of the other body ends a part, it is by round-off at which vertex
			// the division into triangles begins, and the mean of such heights is another by a small part of the displacements.
			const Real size = trial % 2 ? 1e-6 : 1e-7;
			refineAtRandom(pair[0], n, size, random);
			if (trial % 3) refineAtRandom(pair[1], 1 + trial % 3, size, random);
			if (trial % 5 == 0) std::swap(pair[0], pair[1]);
			compared += expectPlainSpots(pair[0], pair[1], warped);
		}
	EXPECT_GT(compared, 5000);
}

/// A brick at the edge of one whose side is dented there: it does not press where it hangs over.
TEST(ContactSearchTest, spots_at_a_dented_edge_are_those_of_the_plain_search)
{
	const Real half = .05, inwards = 5e-6;
	for (int n : { 2, 4, 8 })
		for (Real tilt : { -1e-5, 1e-5 }) { // the side cannot be pressed on, so that its mean dent counts, or can
			Body lower = Body::cube({ 0, 0, 0 }, n),
			     upper = Body::cuboid({ .1, .1, .1 }, { edge / 2 - inwards - half, .03, edge / 2 + half - 1e-5 }, 8);
			upper.move({ 0, tilt, 0 }, { 0, 0, 0 }, upper.placement.position);
			lower.deformable = true;
			lower.refine(n);
			const Real whole = volumeOf(spotsOf(lower, upper));

			lower.surface[surfaceGrid(n).faceNode(1, n / 2, n)] = -1e-4 * Vector3r::UnitX(); // in the middle of the upper edge
			EXPECT_GT(expectPlainSpots(lower, upper, warped), 30);
			EXPECT_LT(volumeOf(spotsOf(lower, upper)), whole * (1 - 5e-5)); // of a strip as wide as the mean dent, a hundred-thousandth of the edge
		}
}

TEST(ContactSearchTest, refined_bricks_with_a_trilinear_field_have_the_spots_of_eight_nodes)
{
	pairs::Random random(26);
	int           compared = 0;
	for (int trial = 0; trial < 60; ++trial)
		for (const auto& cells : { std::array<int, 2> { 2, 1 }, { 1, 3 }, { 3, 2 }, { 6, 6 } }) {
			auto pair = trial % 2 ? stacked(random, 6, 6) : almostTouching(random, 6, 6, random.between(0, .02));
			for (Body& b : pair)
				b.deformable = true, b.displacement = random.nodes(1e-6);
			const auto expected = spotsOf(pair[0], pair[1]);
			for (int s = 0; s < 2; ++s)
				pair[s].refine(cells[s]);
			compared += expectSameSpots(spotsOf(pair[0], pair[1]), expected, warped);
		}
	EXPECT_GT(compared, 5000);
}

namespace {

/// A cube on a larger one; at one inner node the upper face of the lower one stands out by a bulge. Swapped: the upper one's lower face.
std::array<Body, 2> bulging(int cells, int segments, Real gap, Real bulge, bool swapped)
{
	Body      lower  = Body::cuboid({ swapped ? .3 : edge, swapped ? .3 : edge, .2 }, { 0, 0, -.1 }, segments);
	Body      upper  = Body::cuboid({ swapped ? edge : .3, swapped ? edge : .3, .2 }, { 0, 0, .1 + gap }, segments);
	Body &    bulged = swapped ? upper : lower, &flat = swapped ? lower : upper;
	const int face    = swapped ? 4 : 5;
	bulged.deformable = true, bulged.refine(cells), flat.segments = segments;
	bulged.surface[surfaceGrid(cells).faceNode(face, 1, 1)] = bulge * bulged.solid.faces[face].normal;
	for (Body* b : { &lower, &upper })
		b->move({ .3, -1.2, .8 }, { .3, .1, -.2 });
	return { lower, upper };
}

} // namespace

TEST(ContactSearchTest, volume_under_a_bulging_node_converges_to_its_integral)
{
	const Real bulge = 1e-5;
	for (bool swapped : { false, true })
		for (int n : { 2, 4 }) {
			const Real cell = (edge / n) * (edge / n);
			for (Real gap : { -1e-5, bulge / 2 }) {
				// the bulge (1 - |x|)(1 - |y|) has the integral 1 over the four cells; what of it is higher than half, above that, ln 2 / 2 - 1/4
				const Real volume = gap < 0 ? edge * edge * -gap + cell * bulge : cell * bulge * (std::log(2.) / 2 - .25);
				for (int perCell : { 1, 2, 4, 8, 16 }) {
					const auto pair = bulging(n, n * perCell, gap, bulge, swapped);
					// Segments are taken as two triangles: in each cell the mean of xy over the triangles is off by up to 1/12 of a segment's, and the
					// vertices of the other body miss the node; both are second order in the size of segments.
					EXPECT_NEAR(volumeOf(spotsOf(pair[0], pair[1])), volume, cell * bulge / 2 / (perCell * perCell))
					        << n << ", " << perCell << ", " << gap;
				}
			}
		}
}

TEST(ContactSearchTest, a_bulging_node_is_as_deep_and_as_wide_as_it_stands_out)
{
	// Segments of the bulged face with the node at a corner: three corners at the level of the face, one out by b; a gap of b / 2 leaves the tip
	const Real b = 1e-5;
	for (bool swapped : { false, true })
		for (int n : { 2, 4 }) {
			const auto pair = bulging(n, n, b / 2, b, swapped);
			int        tips = 0;
			for (const auto& spot : spotsOf(pair[0], pair[1])) {
				if (spot.owner != swapped) continue;
				++tips;
				EXPECT_NEAR(spot.penetration, b * 25 / 36 - b / 2, 1e-15); // at the triangle's centroid the face is out by b 5/6 5/6; places round to 1e-16 m
				EXPECT_NEAR(spot.area, (edge / n / 2) * (edge / n / 2) / 4, 1e-8 * edge * edge); // half its weight; the slope is up to 2e-4
				EXPECT_LE(std::abs(spot.ownerNatural[0] - (2. / n - 1)), 2. / n / 6 + 1e-9);
				EXPECT_LE(std::abs(spot.ownerNatural[1] - (2. / n - 1)), 2. / n / 6 + 1e-9);
			}
			EXPECT_EQ(tips, 4);
		}
}

namespace {

/// Heights of a vertex of one body's segments over the deformed faces of another.
std::array<Real, faceCount> heightsOver(const Body& body, int face, Real xi, Real eta, const Body& other)
{
	const auto moved = [](const Body& b, int f, Real p, Real q) {
		const SurfaceSpot at = surfaceGrid(b.cells).locate(f, p, q);
		Vector3r          u  = Vector3r::Zero();
		for (int a = 0; a < 4; ++a)
			u += at.weights[a] * b.side().placement.displacement[at.nodes[a]];
		return u;
	};
	const Vector3r              world = body.world(body.solid.faces[face].at(xi, eta) + moved(body, face, xi, eta));
	const Vector3r              x     = other.placement.rotation.transpose() * (world - other.placement.position);
	std::array<Real, faceCount> heights;
	for (int f = 0; f < faceCount; ++f) {
		const Face&    target  = other.solid.faces[f];
		const Vector2r natural = target.coordinates(x);
		heights[f]             = target.normal.dot(x - moved(other, f, natural[0], natural[1])) - target.offset;
	}
	return heights;
}

/// Whether a vertex lies inside another body, plainly nearest to a face that its own can press on. Of other faces the bulging does not count, so these have to
/// be farther away than displacements are large.
bool hasPressedVertex(const Body& body, const Body& other, Real size)
{
	for (int face = 0; face < faceCount; ++face)
		for (int row = 0; row <= body.segments; ++row)
			for (int column = 0; column <= body.segments; ++column) {
				auto       h      = heightsOver(body, face, 2. * column / body.segments - 1, 2. * row / body.segments - 1, other);
				const auto f      = std::max_element(h.begin(), h.end());
				const Real cosine = -(body.placement.rotation * body.solid.faces[face].normal)
				                             .dot(other.placement.rotation * other.solid.faces[f - h.begin()].normal);
				const Real nearest = *f;
				*f                 = -1;
				// not round-off; segments nearly perpendicular are not divided
				if (nearest < -1e-12 && *std::max_element(h.begin(), h.end()) < nearest - 8 * size && cosine > .1) return true;
			}
	return false;
}

} // namespace

TEST(ContactSearchTest, refined_bricks_of_which_one_has_a_vertex_in_the_other_touch)
{
	pairs::Random random(27);
	const Real    size     = 1e-4; // of displacements
	int           touching = 0, apart = 0;
	for (int trial = 0; trial < 400; ++trial) {
		const int n0 = 2 + trial % 4, n1 = 1 + trial % 3;
		auto      pair = trial % 4 ? almostTouching(random, n0, 2 * n1, random.between(-3, 3) * size) : stacked(random, 2 * n0, n1);
		if (trial % 4 == 0) pair[1].placement.position += random.between(-2, 2) * size * pair[0].placement.rotation.col(2);
		refineAtRandom(pair[0], n0, size, random), refineAtRandom(pair[1], n1, size, random);
		const bool pressed = hasPressedVertex(pair[0], pair[1], size) || hasPressedVertex(pair[1], pair[0], size),
		           found   = !spotsOf(pair[0], pair[1]).empty();
		++(found ? touching : apart);
		EXPECT_TRUE(found || !pressed) << trial;
	}
	EXPECT_GT(touching, 100);
	EXPECT_GT(apart, 100);
}
