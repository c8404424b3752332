// SPDX-License-Identifier: GPL-2.0-or-later
// The search of one body's faces for contact with another: included by ContactSearch.cpp once for each instruction set (InstructionSets.hpp).

#include "SurfaceLanes.hpp"

/// Where a segment can press on several faces of the other body, it is divided into the parts nearest to each, unless it is nearly perpendicular to one:
/// that one's part would press with the square of this cosine, and stacked bricks that lean a little would have the segments at their rims divided for nothing.
constexpr Real leastCosine = .02;

/// The owner's corners in the other body's frame, and the faces of that body; a lane for each face. Lanes that are no face are infinitely far above.
struct View {
	View(const Side& owner, const Side& other);

	/// Some face of the other body has all of the owner outside.
	bool apart() const
	{
		Lanes lowest = cornerHeights[0];
		for (int a = 1; a < nodeCount; ++a)
			lowest = lesser(lowest, cornerHeights[a]);
		if (ownerCells) lowest += lowestLift;
		return bitsOf(lowest >= highestBulge) != 0;
	}
	/// Over the mean planes.
	BRICK_INLINE Lanes heightsOf(const Vector3r& x) const { return (normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2]) - meanOffset; }
	/// Of a face over its mean plane, at natural coordinates of the face.
	BRICK_INLINE Lanes bulgeAt(int f, const Lanes& p, const Lanes& q) const
	{
		if (!otherCells) return bulge[f].at(p, q);
		Lanes h;
		bulgeOfCells(f, p, q, h);
		return h;
	}
	/// Displacement of a refined owner at points of one of its faces, in the other body's axes.
	void displacementAt(int face, const Lanes& xi, const Lanes& eta, Vectors& out) const;

	const Side &       owner, &other;
	const SurfaceGrid *ownerCells, *otherCells;  ///< null where fields are bilinear over a whole face
	Matrix3r           turn;                     ///< owner's axes to the other body's
	Real               corners[nodeCount][3];    ///< of a refined owner: at rest
	Lanes              cornerHeights[nodeCount]; ///< over the mean planes of the faces
	Lanes              normal[3], meanOffset;
	Lanes              highestBulge, lowestBulge; ///< of each face over its mean plane
	BilinearField      bulge[faceCount];          ///< only of deformable bodies
	Real               meanBulge[faceCount];      ///< only of refined bodies
	Lanes              lowestLift;                ///< only of refined owners: least displacement of their nodes along the normals

private:
	void                           lookAtFaces();
	void                           findLowestLift();
	__attribute__((noinline)) void bulgeOfCells(int f, const Lanes& p, const Lanes& q, Lanes& out) const;
};

View::View(const Side& owner, const Side& other)
        : owner(owner)
        , other(other)
        , ownerCells(cellsOf(owner))
        , otherCells(cellsOf(other))
        , turn(other.placement.rotation.transpose() * owner.placement.rotation)
{
	lookAtFaces();
	const Vector3r offset = other.placement.rotation.transpose() * (owner.placement.position - other.placement.position);
	for (int a = 0; a < nodeCount; ++a) {
		const Vector3r corner = ownerCells ? owner.solid->corners[a] : Vector3r(owner.solid->corners[a] + displacementOf(owner.placement, a));
		const Vector3r x      = offset + turn * corner;
		for (int i = 0; i < 3; ++i)
			corners[a][i] = x[i];
		cornerHeights[a] = heightsOf(x);
	}
	if (ownerCells) findLowestLift();
}

void View::lookAtFaces()
{
	meanOffset = allLanes(unbounded);
	normal[0] = normal[1] = normal[2] = highestBulge = lowestBulge = Lanes {};
	for (int f = 0; f < faceCount; ++f) {
		const Face& face = other.solid->faces[f];
		for (int i = 0; i < 3; ++i)
			normal[i][f] = face.normal[i];
		meanOffset[f] = face.offset;
		if (!other.placement.displacement) continue;
		if (otherCells) {
			const FaceLift lift(other, *otherCells, f);
			meanBulge[f] = lift.mean, highestBulge[f] = lift.highest - lift.mean, lowestBulge[f] = lift.lowest - lift.mean;
			meanOffset[f] += lift.mean;
			continue;
		}
		Real up[4];
		for (int a = 0; a < 4; ++a)
			up[a] = face.normal.dot(other.placement.displacement[faceNodes[f][a]]);
		bulge[f]        = BilinearField::of(up[0], up[1], up[2], up[3]);
		const Real mean = bulge[f].c[0];
		bulge[f].c[0]   = 0;
		meanOffset[f] += mean;
		highestBulge[f] = std::max(std::max(up[0], up[1]), std::max(up[2], up[3])) - mean;
		lowestBulge[f]  = std::min(std::min(up[0], up[1]), std::min(up[2], up[3])) - mean;
	}
}

void View::findLowestLift()
{
	lowestLift = allLanes(unbounded);
	for (int node = 0; node < ownerCells->size(); ++node) {
		const Vector3r u = turn * owner.placement.displacement[node];
		lowestLift       = lesser(lowestLift, normal[0] * u[0] + normal[1] * u[1] + normal[2] * u[2]);
	}
}

void View::bulgeOfCells(int f, const Lanes& p, const Lanes& q, Lanes& out) const
{
	SurfaceLanes points;
	Vectors      u;
	points.locate(*otherCells, f, p, q);
	points.interpolate(other.placement.displacement, u);
	out = dot(u, other.solid->faces[f].normal) - meanBulge[f];
}

void View::displacementAt(int face, const Lanes& xi, const Lanes& eta, Vectors& out) const
{
	SurfaceLanes points;
	Vectors      u;
	points.locate(*ownerCells, face, xi, eta);
	points.interpolate(owner.placement.displacement, u);
	for (int i = 0; i < 3; ++i)
		out[i] = turn(i, 0) * u[0] + turn(i, 1) * u[1] + turn(i, 2) * u[2];
}

/// Natural coordinates on a face, as Face::coordinates.
BRICK_INLINE void coordinatesOn(const Face& face, const Lanes (&x)[3], Lanes& p, Lanes& q)
{
	if (face.parallelogram) {
		Lanes d[3];
		for (int i = 0; i < 3; ++i)
			d[i] = x[i] - face.centre[i];
		const Lanes one = allLanes(1.);
		p               = greater(-one, lesser(face.dual1[0] * d[0] + face.dual1[1] * d[1] + face.dual1[2] * d[2], one));
		q               = greater(-one, lesser(face.dual2[0] * d[0] + face.dual2[1] * d[1] + face.dual2[2] * d[2], one));
		return;
	}
	for (int i = 0; i < lanes; ++i) {
		const Vector2r natural = face.coordinates({ x[0][i], x[1][i], x[2][i] });
		p[i] = natural[0], q[i] = natural[1];
	}
}

/// Rows or columns of segments: the first, and the one after the last.
struct Range {
	int  begin, end;
	bool empty() const { return begin >= end; }
};

/// One face of the owner and what it may meet.
struct FacePair {
	const View&   view;
	int           ownerIndex, face;
	Real          weight; ///< of the spots
	int           segments;
	Lanes         lowest, highest; ///< of the owner's face over the mean planes of the other body's
	Real          cosine[lanes];   ///< between the owner's inward normal and the outward normal of each face of the other body
	Range         rows, columns;   ///< where segments could touch
	unsigned      bulging;         ///< faces of the other body whose bulging matters, a bit each
	int           count;           ///< of the faces of the other body that cut the owner's or could be the nearest:
	int           faces[faceCount];
	BilinearField place[3], height[faceCount];                     ///< of the owner's face, of a refined owner at rest; heights over `faces`
	Lanes         nodeHeights[largestCells + 1][largestCells + 1]; ///< only of refined owners: over the mean planes, row by row

	BRICK_INLINE FacePair(const View& view, int ownerIndex, int face, Real weight)
	        : view(view)
	        , ownerIndex(ownerIndex)
	        , face(face)
	        , weight(weight)
	        , segments(view.owner.segments)
	{
	}
	BRICK_INLINE const Lanes& cornerHeight(int a) const { return view.cornerHeights[faceNodes[face][a]]; }
	BRICK_INLINE bool         canTouch();
	BRICK_INLINE Range        nearOverlap(int from0, int to0, int from1, int to1) const;
	BRICK_INLINE void         prepareFields();

private:
	/// Part of some edges that is not beyond a face of the other body; 0 to 1 along an edge.
	struct Reach {
		Lanes begin, end;

		BRICK_INLINE Reach()
		        : begin(allLanes(unbounded))
		        , end(allLanes(-unbounded))
		{
		}
		BRICK_INLINE void add(const Lanes& from, const Lanes& to);
	};
	BRICK_INLINE Range             segmentsIn(const Reach&) const;
	__attribute__((noinline)) void lookAtNodes();
	__attribute__((noinline)) void findRanges();
};

/// Cheap refusal, by the nodes alone: entirely beyond a face of the other body, or everywhere nearer to a face that it cannot press on.
BRICK_INLINE bool FacePair::canTouch()
{
	lowest = lesser(lesser(cornerHeight(0), cornerHeight(1)), lesser(cornerHeight(2), cornerHeight(3)));
	if (view.ownerCells) {
		if (bitsOf(lowest + view.lowestLift >= view.highestBulge)) return false;
		lookAtNodes();
	}
	const Lanes greatestDepth = view.highestBulge - lowest;
	if (bitsOf(greatestDepth <= 0)) return false;

	if (!view.ownerCells) highest = greater(greater(cornerHeight(0), cornerHeight(1)), greater(cornerHeight(2), cornerHeight(3)));
	const Vector3r n       = view.turn * view.owner.solid->faces[face].normal;
	const Lanes    cosines = -(view.normal[0] * n[0] + view.normal[1] * n[1] + view.normal[2] * n[2]), none = allLanes(unbounded);
	const Mask     pressed = cosines > 0;
	if (leastOf(pressed ? -highest : none) > leastOf(pressed ? none : greatestDepth)) return false;

	Mask bulges = pressed & (-highest <= leastOf(greatestDepth));
	if (!view.other.placement.displacement) bulges = Mask {};
	const Lanes least = bulges ? lowest - view.highestBulge : lowest, most = bulges ? highest - view.lowestBulge : highest;
	const Mask  near = most >= mostOf(least);
	if (!bitsOf(near & pressed)) return false;
	storeLanes(cosine, cosines);
	bulging             = bitsOf(bulges);
	const unsigned meet = bitsOf(near | (most >= 0));
	count               = 0;
	for (int f = 0; f < faceCount; ++f)
		if (meet >> f & 1) faces[count++] = f;
	if (view.ownerCells) findRanges();
	else
		rows = nearOverlap(0, 3, 1, 2), columns = nearOverlap(0, 1, 3, 2);
	return !rows.empty() && !columns.empty();
}

/// Rows (or columns) of which neither end is beyond a face of the other body, by two edges of the owner's face that run across them.
BRICK_INLINE Range FacePair::nearOverlap(int from0, int to0, int from1, int to1) const
{
	Reach reach;
	reach.add(cornerHeight(from0) - view.highestBulge, cornerHeight(to0) - view.highestBulge);
	reach.add(cornerHeight(from1) - view.highestBulge, cornerHeight(to1) - view.highestBulge);
	return segmentsIn(reach);
}

/// @param from, to heights of the ends of an edge over what they must not be beyond
BRICK_INLINE void FacePair::Reach::add(const Lanes& from, const Lanes& to)
{
	const Lanes crossing = from / (from - to);
	begin                = lesser(begin, from < 0 ? allLanes(0.) : to < 0 ? crossing : allLanes(unbounded));
	end                  = greater(end, to < 0 ? allLanes(1.) : from < 0 ? crossing : allLanes(-unbounded));
}

BRICK_INLINE Range FacePair::segmentsIn(const Reach& reach) const
{
	const Real first = mostOf(reach.begin) * segments, last = leastOf(reach.end) * segments;
	if (!(first < last)) return { 0, 0 };
	constexpr Real roundOff = 1e-9; // a segment more costs less than a sliver lost
	return { std::max(0, int(first - roundOff)), std::min(segments, 1 + int(last + roundOff)) };
}

/// Heights of all nodes of a refined owner's face.
void FacePair::lookAtNodes()
{
	const SurfaceGrid& grid = *view.ownerCells;
	const auto         rest = [this](int corner) { return Vector3r(Eigen::Map<const Vector3r>(view.corners[faceNodes[face][corner]])); };
	const Vector3r     x[4] = { rest(0), rest(1), rest(2), rest(3) };
	const Real         n    = grid.cells();
	lowest = allLanes(unbounded), highest = allLanes(-unbounded);
	for (int row = 0; row <= grid.cells(); ++row) {
		const Vector3r left = x[0] + row / n * (x[3] - x[0]), right = x[1] + row / n * (x[2] - x[1]);
		for (int column = 0; column <= grid.cells(); ++column) {
			const Vector3r& u = view.owner.placement.displacement[grid.faceNode(face, column, row)];
			const Lanes     h = view.heightsOf(left + column / n * (right - left) + view.turn * u);
			lowest = lesser(lowest, h), highest = greater(highest, h), nodeHeights[row][column] = h;
		}
	}
}

/// As nearOverlap, by the edges of all cells.
void FacePair::findRanges()
{
	const int  n    = view.ownerCells->cells();
	const Real part = 1. / n;
	Reach      across, along;
	const auto add = [&](Reach& reach, int cell, const Lanes& from, const Lanes& to) {
		Reach piece;
		piece.add(from - view.highestBulge, to - view.highestBulge);
		reach.begin = lesser(reach.begin, (piece.begin + Real(cell)) * part), reach.end = greater(reach.end, (piece.end + Real(cell)) * part);
	};
	for (int cell = 0; cell < n; ++cell)
		for (int line = 0; line <= n; ++line) {
			add(across, cell, nodeHeights[cell][line], nodeHeights[cell + 1][line]);
			add(along, cell, nodeHeights[line][cell], nodeHeights[line][cell + 1]);
		}
	rows = segmentsIn(across), columns = segmentsIn(along);
}

BRICK_INLINE void FacePair::prepareFields()
{
	const auto& nodes = faceNodes[face];
	const auto& x     = view.corners;
	for (int i = 0; i < 3; ++i)
		place[i] = BilinearField::of(x[nodes[0]][i], x[nodes[1]][i], x[nodes[2]][i], x[nodes[3]][i]);
	for (int k = 0; k < count; ++k) {
		const int f = faces[k];
		height[k]   = BilinearField::of(cornerHeight(0)[f], cornerHeight(1)[f], cornerHeight(2)[f], cornerHeight(3)[f]);
	}
}

/// Vertices of segments, some rows of them, one after the other, with what varies over them.
struct Vertices {
	static constexpr int capacity = 256; ///< at least two rows of largestSegments + 1
	static constexpr int readable = capacity + largestSegments + 3 * lanes;
	static constexpr int none     = -1;

	int  stride, rows;      ///< rows of segments
	int  segment[readable]; ///< that starts at a vertex, or none
	Real xi[readable], eta[readable], place[3][readable], height[faceCount][readable];

	BRICK_INLINE void                         fill(const FacePair&, int firstRow);
	template <bool refined> BRICK_INLINE void fillLanes(const FacePair&, int first);
	__attribute__((noinline)) void            fillRefined(const FacePair&, int count);
	BRICK_INLINE Lanes                        lowest(const Real* values, int first) const
	{
		return lesser(
		        lesser(loadLanes(values + first), loadLanes(values + first + 1)),
		        lesser(loadLanes(values + first + stride), loadLanes(values + first + stride + 1)));
	}
	BRICK_INLINE Lanes highest(const Real* values, int first) const
	{
		return greater(
		        greater(loadLanes(values + first), loadLanes(values + first + 1)),
		        greater(loadLanes(values + first + stride), loadLanes(values + first + stride + 1)));
	}
	int starts() const { return rows * stride - 1; } ///< vertices at which segments may start
};

/// As many rows as there is room for.
BRICK_INLINE void Vertices::fill(const FacePair& pair, int first)
{
	const int n = pair.segments;
	stride      = pair.columns.end - pair.columns.begin + 1;
	rows        = std::min(pair.rows.end - first, capacity / stride - 1);
	int i       = 0;
	for (int row = first; row <= first + rows; ++row)
		for (int column = pair.columns.begin; column <= pair.columns.end; ++column, ++i)
			xi[i] = 2. * column / n - 1, eta[i] = 2. * row / n - 1, segment[i] = column < pair.columns.end ? row * n + column : none;
	// the last eight starts are read as a whole, although not all of them are segments
	const int read = (starts() + lanes - 1) / lanes * lanes + stride + 1;
	for (; i < read + lanes; ++i)
		xi[i] = eta[i] = 0;
	if (pair.view.ownerCells || pair.view.otherCells) {
		fillRefined(pair, read);
		return;
	}
	for (i = 0; i < read; i += lanes)
		fillLanes<false>(pair, i);
}

/// Apart, so that the loop above keeps its registers.
void Vertices::fillRefined(const FacePair& pair, int count)
{
	for (int i = 0; i < count; i += lanes)
		fillLanes<true>(pair, i);
}

/// Place of points of the owner's face. @param moved of a refined owner: from rest
template <bool refined> BRICK_INLINE void placeOf(const FacePair& pair, const Lanes& u, const Lanes& v, Lanes (&x)[3], Vectors& moved)
{
	const bool moves = refined && pair.view.ownerCells;
	if (moves) pair.view.displacementAt(pair.face, u, v, moved);
	for (int i = 0; i < 3; ++i) {
		x[i] = pair.place[i].at(u, v);
		if (moves) x[i] += moved[i];
	}
}

/// Place of points of the owner's face, and their heights over the faces of the other body.
template <bool refined> BRICK_INLINE void fieldsOf(const FacePair& pair, const Lanes& u, const Lanes& v, Lanes (&x)[3], Lanes (&h)[faceCount])
{
	Vectors moved;
	placeOf<refined>(pair, u, v, x, moved);
	for (int k = 0; k < pair.count; ++k) {
		const Face& face = pair.view.other.solid->faces[pair.faces[k]];
		h[k]             = pair.height[k].at(u, v);
		if (refined && pair.view.ownerCells) h[k] += dot(moved, face.normal);
		if (pair.bulging >> pair.faces[k] & 1) {
			Lanes p, q;
			coordinatesOn(face, x, p, q);
			h[k] -= refined ? pair.view.bulgeAt(pair.faces[k], p, q) : pair.view.bulge[pair.faces[k]].at(p, q);
		}
	}
}

__attribute__((noinline)) void placeOfRefined(const FacePair& pair, const Lanes& u, const Lanes& v, Lanes (&x)[3])
{
	Vectors moved;
	placeOf<true>(pair, u, v, x, moved);
}
__attribute__((noinline)) void fieldsOfRefined(const FacePair& pair, const Lanes& u, const Lanes& v, Lanes (&x)[3], Lanes (&h)[faceCount])
{
	fieldsOf<true>(pair, u, v, x, h);
}

/// The same of any bodies; code for refined ones stands apart, so that loops keep their registers.
BRICK_INLINE void placeAt(const FacePair& pair, const Lanes& u, const Lanes& v, Lanes (&x)[3])
{
	Vectors none;
	if (pair.view.ownerCells) placeOfRefined(pair, u, v, x);
	else
		placeOf<false>(pair, u, v, x, none);
}
BRICK_INLINE void fieldsAt(const FacePair& pair, const Lanes& u, const Lanes& v, Lanes (&x)[3], Lanes (&h)[faceCount])
{
	if (pair.view.ownerCells || pair.view.otherCells) fieldsOfRefined(pair, u, v, x, h);
	else
		fieldsOf<false>(pair, u, v, x, h);
}

template <bool refined> BRICK_INLINE void Vertices::fillLanes(const FacePair& pair, int first)
{
	Lanes x[3], h[faceCount];
	fieldsOf<refined>(pair, loadLanes(xi + first), loadLanes(eta + first), x, h);
	for (int i = 0; i < 3; ++i)
		storeLanes(place[i] + first, x[i]);
	for (int k = 0; k < pair.count; ++k)
		storeLanes(height[k] + first, h[k]);
}

/// Spot of the part of a segment, still without its places.
BRICK_INLINE ContactSpot& addSpot(const FacePair& pair, int segment, int otherFace, std::vector<ContactSpot>& spots)
{
	spots.emplace_back();
	ContactSpot& spot = spots.back();
	spot.key          = contactKey(pair.ownerIndex, pair.face, otherFace, segment);
	spot.owner        = pair.ownerIndex;
	spot.ownerFace    = pair.face;
	spot.otherFace    = otherFace;
	return spot;
}

// Segments that are cut

/// A segment that is cut, or that is nearest to more than one face. Only the faces that matter to it are carried along.
class CutSegment {
public:
	CutSegment(const FacePair& pair, const Vertices& vertices, int start)
	        : pair(pair)
	        , vertices(vertices)
	        , start(start)
	{
		Real floor = -unbounded;
		Real lowest[faceCount], highest[faceCount];
		for (int k = 0; k < pair.count; ++k) {
			const Real *h = vertices.height[k] + start, *g = h + vertices.stride;
			lowest[k]  = std::min(std::min(h[0], h[1]), std::min(g[0], g[1]));
			highest[k] = std::max(std::max(h[0], h[1]), std::max(g[0], g[1]));
			floor      = std::max(floor, lowest[k]);
		}
		for (int k = 0; k < pair.count; ++k) {
			if (highest[k] < 0 && highest[k] < floor) continue;
			if (highest[k] >= 0) cuts |= 1 << count;
			if (pair.cosine[pair.faces[k]] > leastCosine && highest[k] > floor) pressable[pressableCount++] = count;
			which[count++] = k;
		}
	}
	void addSpots(std::vector<ContactSpot>& spots) const
	{
		if (heightEntry + count <= lanes) addSpotsOf<lanes>(spots);
		else
			addSpotsOf<heightEntry + faceCount>(spots);
	}

private:
	static constexpr int  naturalEntry = 3, heightEntry = 5, anyFace = -1; ///< of a vertex
	static constexpr Real tie = 1e-9; ///< relative: a part's own face is not given up for one as near

	template <int dimensions> void addSpotsOf(std::vector<ContactSpot>& spots) const
	{
		ClippedPolygon<dimensions, 2 * faceCount> polygon;
		for (int corner = 0; corner < 4; ++corner)
			fill(polygon.vertex(corner), start + (corner == 1 || corner == 2) + (corner >= 2 ? vertices.stride : 0));
		for (int i = 0; i < count; ++i)
			if (cuts >> i & 1) polygon.keepNegative(heightEntry + i);
		if (polygon.empty()) return;
		if (pressableCount < 2) {
			addPart(polygon, anyFace, spots);
			return;
		}
		const auto whole = polygon.present();
		for (int i = 0; i < pressableCount; ++i) {
			polygon.goBackTo(whole);
			for (int j = 0; j < pressableCount; ++j)
				if (j != i) polygon.keepAbove(heightEntry + pressable[i], heightEntry + pressable[j]);
			if (!polygon.empty()) addPart(polygon, pressable[i], spots);
		}
	}

	template <class Vertex> void fill(Vertex& v, int vertex) const
	{
		for (int i = 0; i < 3; ++i)
			v[i] = vertices.place[i][vertex];
		v[naturalEntry] = vertices.xi[vertex], v[naturalEntry + 1] = vertices.eta[vertex];
		for (int i = 0; i < count; ++i)
			v[heightEntry + i] = vertices.height[which[i]][vertex];
		for (int i = heightEntry + count; i < v.size(); ++i)
			v[i] = 0;
	}

	/// @param expected the nearest face, otherwise there is no spot; or anyFace
	template <class Polygon> void addPart(const Polygon& polygon, int expected, std::vector<ContactSpot>& spots) const
	{
		typename Polygon::Vertex centre;
		const Real               area = polygon.areaAndCentroid(centre);
		if (!(area > 0)) return;
		Lanes x[3], heights[faceCount];
		fieldsAt(pair, allLanes(centre[naturalEntry]), allLanes(centre[naturalEntry + 1]), x, heights);
		// of a part, by what it was cut by
		const auto height  = [&](int i) { return expected == anyFace ? heights[which[i]][0] : centre[heightEntry + i]; };
		int        nearest = std::max(expected, 0);
		for (int i = 0; i < count; ++i)
			if (height(i) > height(nearest) + (expected == anyFace ? 0 : tie * std::abs(height(nearest)))) nearest = i;
		const Real penetration = -heights[which[nearest]][0];
		const int  otherFace   = pair.faces[which[nearest]];
		if (!(penetration > 0) || pair.cosine[otherFace] <= 0) return;
		if (expected != anyFace && nearest != expected) return;
		polygon.pressedCentroid(heightEntry + nearest, centre);
		placeAt(pair, allLanes(centre[naturalEntry]), allLanes(centre[naturalEntry + 1]), x);
		ContactSpot& spot = addSpot(pair, vertices.segment[start], otherFace, spots);
		spot.position     = { x[0][0], x[1][0], x[2][0] };
		spot.ownerNatural = { centre[naturalEntry], centre[naturalEntry + 1] };
		spot.otherNatural = pair.view.other.solid->faces[otherFace].coordinates(spot.position);
		spot.penetration  = penetration;
		spot.area         = pair.weight * pair.cosine[otherFace] * area;
	}

	const FacePair& pair;
	const Vertices& vertices;
	int             start, count = 0, which[faceCount];
	unsigned        cuts           = 0;
	int             pressableCount = 0, pressable[faceCount];
};

/// Not part of the loop over segments, whose code stays small.
__attribute__((noinline)) void addCutSegment(const FacePair& pair, const Vertices& vertices, int start, std::vector<ContactSpot>& spots)
{
	CutSegment(pair, vertices, start).addSpots(spots);
}

// Eight segments at once

/// Eight segments, mostly neighbours in a row.
struct EightSegments {
	const Vertices& vertices;
	const int*      starts;
	bool            adjacent;

	BRICK_INLINE EightSegments(const Vertices& vertices, const int* starts)
	        : vertices(vertices)
	        , starts(starts)
	        , adjacent(starts[lanes - 1] - starts[0] == lanes - 1)
	{
	}
	/// Values at corner 0-3, in the order of a face's nodes.
	BRICK_INLINE Lanes at(const Real* values, int corner) const
	{
		const Real* from = values + (corner == 1 || corner == 2) + (corner >= 2 ? vertices.stride : 0);
		if (adjacent) return loadLanes(from + starts[0]);
		Lanes x;
		for (int lane = 0; lane < lanes; ++lane)
			x[lane] = from[starts[lane]];
		return x;
	}
};

/// The part of a segment in contact, as triangles about the middle of its outline (as ClippedPolygon has them): a point is told by weights of the segment's corners.
struct Part {
	Lanes weight[4], area; ///< at the centroid
};

/// Twice the area of triangles that two sides span.
BRICK_INLINE Lanes spanned(const Lanes (&u)[3], const Lanes (&v)[3])
{
	Lanes sum {};
	for (int i = 0; i < 3; ++i) {
		const int   j = (i + 1) % 3, k = (i + 2) % 3;
		const Lanes c = u[j] * v[k] - u[k] * v[j];
		sum += c * c;
	}
	return root(sum);
}

struct WholePart : Part {
	Lanes triangle[4]; ///< areas: the middle, a corner and the next
	Lanes middle[4];   ///< weights of the middle

	BRICK_INLINE explicit WholePart(const EightSegments& segments)
	{
		Lanes x[4][3], side[4], around {};
		for (int corner = 0; corner < 4; ++corner)
			for (int i = 0; i < 3; ++i)
				x[corner][i] = segments.at(segments.vertices.place[i], corner);
		for (int corner = 0; corner < 4; ++corner) {
			const auto &here = x[corner], &next = x[(corner + 1) % 4];
			const Lanes d[3] { next[0] - here[0], next[1] - here[1], next[2] - here[2] };
			around += side[corner] = root(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
		}
		for (int corner = 0; corner < 4; ++corner)
			middle[corner] = (side[corner] + side[(corner + 3) % 4]) / (2 * around);
		for (int i = 0; i < 3; ++i) {
			const Lanes centre = (middle[0] * x[0][i] + middle[2] * x[2][i]) + (middle[1] * x[1][i] + middle[3] * x[3][i]);
			for (int corner = 0; corner < 4; ++corner)
				x[corner][i] -= centre;
		}
		for (int corner = 0; corner < 4; ++corner)
			triangle[corner] = spanned(x[corner], x[(corner + 1) % 4]) / 2;
		area = (triangle[0] + triangle[2]) + (triangle[1] + triangle[3]);
		for (int corner = 0; corner < 4; ++corner)
			weight[corner] = middle[corner] / 3 + (triangle[corner] + triangle[(corner + 3) % 4]) / (3 * area);
	}
	/// Twelve times the integrals of the depth times the weight of each corner.
	BRICK_INLINE void pressed(const Lanes (&depth)[4], Lanes (&sum)[4]) const
	{
		const Lanes deep = (middle[0] * depth[0] + middle[2] * depth[2]) + (middle[1] * depth[1] + middle[3] * depth[3]);
		Lanes       byMiddle {}, all[4];
		for (int corner = 0; corner < 4; ++corner) {
			all[corner] = deep + (depth[corner] + depth[(corner + 1) % 4]);
			byMiddle += triangle[corner] * (deep + all[corner]);
		}
		for (int corner = 0; corner < 4; ++corner) {
			const int before = (corner + 3) % 4;
			sum[corner]      = byMiddle * middle[corner] + (triangle[corner] * (depth[corner] + all[corner]) + triangle[before] * (depth[corner] + all[before]));
		}
	}
};

/// A vertex of a polygon in a segment: weights of the segment's corners, and place.
struct PolygonVertex {
	Lanes weight[4], place[3];

	/// On the side of the segment that leads from one corner to another.
	BRICK_INLINE void set(const Lanes (&corners)[4][3], int from, int to, const Lanes& t)
	{
		for (int i = 0; i < 4; ++i)
			weight[i] = i == from ? 1 - t : i == to ? t : Lanes {};
		for (int i = 0; i < 3; ++i)
			place[i] = corners[from][i] + t * (corners[to][i] - corners[from][i]);
	}
	BRICK_INLINE void replace(const Mask& where, const PolygonVertex& by)
	{
		for (int i = 0; i < 4; ++i)
			weight[i] = where ? by.weight[i] : weight[i];
		for (int i = 0; i < 3; ++i)
			place[i] = where ? by.place[i] : place[i];
	}
};

/// Of segments of which one face of the other body cuts something off.
class CutPart : public Part {
public:
	/// @param height of the corners over that face
	BRICK_INLINE CutPart(const EightSegments& segments, const Lanes (&height)[4])
	{
		Lanes x[4][3];
		for (int corner = 0; corner < 4; ++corner)
			for (int i = 0; i < 3; ++i)
				x[corner][i] = segments.at(segments.vertices.place[i], corner);
		for (int here = 0; here < 4; ++here) {
			const int  next = (here + 1) % 4;
			const Mask in = height[here] < 0, crosses = in ^ (height[next] < 0);
			present[2 * here] = in, present[2 * here + 1] = crosses;
			vertex[2 * here].set(x, here, next, Lanes {});
			vertex[2 * here + 1].set(x, here, next, crosses ? height[here] / (height[here] - height[next]) : Lanes {});
		}
		findMean();
		findTriangles();
	}
	/// As of WholePart.
	BRICK_INLINE void pressed(const Lanes (&depth)[4], Lanes (&sum)[4]) const
	{
		for (auto& s : sum)
			s = Lanes {};
		const auto depthAt = [&](const PolygonVertex& v) __attribute__((always_inline))
		{
			return (v.weight[0] * depth[0] + v.weight[2] * depth[2]) + (v.weight[1] * depth[1] + v.weight[3] * depth[3]);
		};
		const Lanes   middle = depthAt(mean);
		PolygonVertex last   = before;
		Lanes         lastDepth = depthAt(last);
		for (int v = 0; v < vertices; ++v) {
			const Lanes nextDepth = depthAt(vertex[v]), all = middle + (lastDepth + nextDepth);
			for (int i = 0; i < 4; ++i)
				sum[i] += triangle[v] * (((middle + all) * mean.weight[i] + (lastDepth + all) * last.weight[i]) + (nextDepth + all) * vertex[v].weight[i]);
			last.replace(present[v], vertex[v]);
			lastDepth = present[v] ? nextDepth : lastDepth;
		}
	}

private:
	static constexpr int vertices = 8; ///< the corners, and where the sides from each are cut

	PolygonVertex vertex[vertices], mean, before; ///< `before`: the last vertex, which comes before the first
	Mask          present[vertices];
	Lanes         triangle[vertices]; ///< area: the middle, the present vertex before and this one; none where this one is not present

	/// The middle of the outline: the mean of the vertices would jump where round-off makes one vertex two.
	BRICK_INLINE void findMean()
	{
		for (auto& w : before.weight)
			w = Lanes {};
		for (auto& p : before.place)
			p = Lanes {};
		for (int v = 0; v < vertices; ++v)
			before.replace(present[v], vertex[v]);
		mean = PolygonVertex {};
		Lanes         around {};
		PolygonVertex last = before;
		for (int v = 0; v < vertices; ++v) {
			Lanes side[3];
			for (int i = 0; i < 3; ++i)
				side[i] = vertex[v].place[i] - last.place[i];
			const Lanes length = present[v] ? root(side[0] * side[0] + side[1] * side[1] + side[2] * side[2]) : Lanes {};
			around += length;
			for (int i = 0; i < 4; ++i)
				mean.weight[i] += length / 2 * (last.weight[i] + vertex[v].weight[i]);
			for (int i = 0; i < 3; ++i)
				mean.place[i] += length / 2 * (last.place[i] + vertex[v].place[i]);
			last.replace(present[v], vertex[v]);
		}
		for (auto& w : mean.weight)
			w /= around;
		for (auto& p : mean.place)
			p /= around;
	}
	BRICK_INLINE void findTriangles()
	{
		area = Lanes {};
		for (auto& w : weight)
			w = Lanes {};
		PolygonVertex last = before;
		for (int v = 0; v < vertices; ++v) {
			Lanes one[3], other[3];
			for (int i = 0; i < 3; ++i)
				one[i] = last.place[i] - mean.place[i], other[i] = vertex[v].place[i] - mean.place[i];
			triangle[v] = present[v] ? spanned(one, other) / 2 : Lanes {};
			area += triangle[v];
			for (int i = 0; i < 4; ++i)
				weight[i] += triangle[v] / 3 * (mean.weight[i] + (last.weight[i] + vertex[v].weight[i]));
			last.replace(present[v], vertex[v]);
		}
		for (auto& w : weight)
			w /= area;
	}
};

/// Spots of eight segments, each in contact with its nearest face.
struct EightSpots {
	Real place[3][lanes], ownerNatural[2][lanes], otherNatural[2][lanes], penetration[lanes], area[lanes], nearest[lanes];

	template <class AnyPart> BRICK_INLINE void set(const FacePair&, const EightSegments&, const AnyPart&);
	BRICK_INLINE void add(const FacePair& pair, int segment, int lane, std::vector<ContactSpot>& spots) const
	{
		if (!(area[lane] > 0) || !(penetration[lane] > 0)) return;
		ContactSpot& spot = addSpot(pair, segment, int(nearest[lane]), spots);
		spot.position     = { place[0][lane], place[1][lane], place[2][lane] };
		spot.ownerNatural = { ownerNatural[0][lane], ownerNatural[1][lane] };
		spot.otherNatural = { otherNatural[0][lane], otherNatural[1][lane] };
		spot.penetration  = penetration[lane];
		spot.area         = area[lane];
	}
};

template <class AnyPart> BRICK_INLINE void EightSpots::set(const FacePair& pair, const EightSegments& segments, const AnyPart& part)
{
	const auto& vertices = segments.vertices;
	const auto  weighted = [&](const Lanes(&weight)[4], const Real* values) __attribute__((always_inline))
	{
		return (weight[0] * segments.at(values, 0) + weight[2] * segments.at(values, 2)) + (weight[1] * segments.at(values, 1) + weight[3] * segments.at(values, 3));
	};
	// The force of a spot must move what presses there, or deformation in a loop would do work: depth is read where the centroid is, not between corners.
	Lanes x[3], heights[faceCount];
	fieldsAt(pair, weighted(part.weight, vertices.xi), weighted(part.weight, vertices.eta), x, heights);
	Lanes top = allLanes(-unbounded), face {}, cosine {}, depth[4] {};
	for (int k = 0; k < pair.count; ++k) {
		const Mask higher = heights[k] > top;
		top               = higher ? heights[k] : top;
		face              = higher ? allLanes(Real(pair.faces[k])) : face;
		cosine            = higher ? allLanes(pair.cosine[pair.faces[k]]) : cosine;
		for (int corner = 0; corner < 4; ++corner)
			depth[corner] = higher ? -segments.at(vertices.height[k], corner) : depth[corner];
	}
	Lanes weight[4];
	part.pressed(depth, weight);
	const Lanes sum = (weight[0] + weight[2]) + (weight[1] + weight[3]);
	for (int corner = 0; corner < 4; ++corner)
		weight[corner] = sum > 0 ? weight[corner] / sum : part.weight[corner];
	const Lanes xi = weighted(weight, vertices.xi), eta = weighted(weight, vertices.eta);
	placeAt(pair, xi, eta, x);
	for (int i = 0; i < 3; ++i)
		storeLanes(place[i], x[i]);
	storeLanes(ownerNatural[0], xi), storeLanes(ownerNatural[1], eta);
	Lanes p {}, q {};
	for (int k = 0; k < pair.count; ++k) {
		const Mask nearestHere = face == Real(pair.faces[k]);
		if (pair.cosine[pair.faces[k]] <= 0 || !bitsOf(nearestHere)) continue;
		Lanes pk, qk;
		coordinatesOn(pair.view.other.solid->faces[pair.faces[k]], x, pk, qk);
		p = nearestHere ? pk : p, q = nearestHere ? qk : q;
	}
	storeLanes(otherNatural[0], p), storeLanes(otherNatural[1], q);
	storeLanes(penetration, -top), storeLanes(nearest, face);
	storeLanes(area, pair.weight * cosine * part.area);
}

// Search

/// How segments touch: as a whole, cut by one face, or otherwise.
enum class Touch : signed char { None, Whole, CutOnce, Other };

/// A sweep over the segments between some rows of vertices.
class Sweep {
public:
	BRICK_INLINE Sweep(const FacePair& pair, const Vertices& vertices, std::vector<ContactSpot>& spots)
	        : pair(pair)
	        , vertices(vertices)
	        , spots(spots)
	{
	}
	BRICK_INLINE void run();

private:
	BRICK_INLINE void classify(int first);
	BRICK_INLINE void findCutOnce(int number);

	const FacePair&           pair;
	const Vertices&           vertices;
	std::vector<ContactSpot>& spots;
	Touch                     touch[Vertices::readable];
	int                       cutOnce[Vertices::readable], cutBy[Vertices::readable]; ///< starts of segments, numbers of the cutting face
	int                       cutOnceCount = 0;
	EightSpots                cut;
};

/// Eight segments.
BRICK_INLINE void Sweep::classify(int first)
{
	const Lanes one = allLanes(1.), zero {};
	Lanes       lowest[faceCount], highest[faceCount], floor = allLanes(-unbounded);
	for (int k = 0; k < pair.count; ++k) {
		lowest[k] = vertices.lowest(vertices.height[k], first), highest[k] = vertices.highest(vertices.height[k], first);
		floor = greater(floor, lowest[k]);
	}
	const unsigned touching = bitsOf(floor < 0);
	Lanes          pressable {}, cuts {}, by {};
	for (int k = 0; k < pair.count && touching; ++k) {
		if (pair.cosine[pair.faces[k]] > leastCosine) pressable += highest[k] > floor ? one : zero;
		cuts += highest[k] >= 0 ? one : zero, by += highest[k] >= 0 ? allLanes(Real(k)) : zero;
	}
	const unsigned whole = bitsOf((cuts == 0) & (pressable < 2)), once = bitsOf((cuts == 1) & (pressable < 2));
	for (int lane = 0; lane < lanes; ++lane) {
		const int i = first + lane;
		touch[i]    = Touch::None;
		if (!(touching >> lane & 1) || i >= vertices.starts() || vertices.segment[i] == Vertices::none) continue;
		touch[i] = whole >> lane & 1 ? Touch::Whole : once >> lane & 1 ? Touch::CutOnce : Touch::Other;
		if (touch[i] == Touch::CutOnce) cutOnce[cutOnceCount] = i, cutBy[cutOnceCount++] = int(by[lane]);
	}
}

/// The spots of this and the next seven segments that are cut once.
BRICK_INLINE void Sweep::findCutOnce(int number)
{
	const EightSegments eight(vertices, cutOnce + number);
	Lanes               height[4];
	for (int lane = 0; lane < lanes; ++lane) {
		const Real *h = vertices.height[cutBy[number + lane]] + cutOnce[number + lane], *g = h + vertices.stride;
		height[0][lane] = h[0], height[1][lane] = h[1], height[2][lane] = g[1], height[3][lane] = g[0];
	}
	cut.set(pair, eight, CutPart(eight, height));
}

BRICK_INLINE void Sweep::run()
{
	const int starts = vertices.starts();
	for (int first = 0; first < starts; first += lanes)
		classify(first);
	// the last group is filled up with its first, which is not one of a row then
	const int last = cutOnceCount - cutOnceCount % lanes;
	for (int i = cutOnceCount; i < last + lanes && i > last; ++i)
		cutOnce[i] = cutOnce[last], cutBy[i] = cutBy[last];
	const int together = cutOnceCount % lanes == 1 ? cutOnceCount - 1 : cutOnceCount; // one alone is cut sooner as a polygon
	int       number   = 0;
	for (int first = 0; first < starts; first += lanes) {
		EightSpots whole;
		bool       known = false;
		for (int i = first; i < first + lanes; ++i) {
			if (touch[i] == Touch::None) continue;
			if (touch[i] == Touch::Whole) {
				int here[lanes];
				for (int lane = 0; lane < lanes; ++lane)
					here[lane] = first + lane;
				const EightSegments eight(vertices, here);
				if (!known) whole.set(pair, eight, WholePart(eight));
				known = true;
				whole.add(pair, vertices.segment[i], i - first, spots);
			} else if (touch[i] == Touch::CutOnce && number < together) {
				if (number % lanes == 0) findCutOnce(number);
				cut.add(pair, vertices.segment[i], number++ % lanes, spots);
			} else
				addCutSegment(pair, vertices, i, spots);
		}
	}
}

void searchSide(const View& view, int ownerIndex, Real weight, std::vector<ContactSpot>& spots)
{
	for (int face = 0; face < faceCount; ++face) {
		FacePair pair(view, ownerIndex, face, weight);
		if (!pair.canTouch()) continue;
		pair.prepareFields();
		const std::size_t before = spots.size();
		Vertices          vertices;
		for (int row = pair.rows.begin; row < pair.rows.end; row += vertices.rows) {
			vertices.fill(pair, row);
			Sweep(pair, vertices, spots).run();
		}
		// by the other's faces; mostly there is only one
		const auto inOrder = [](const ContactSpot& a, const ContactSpot& b) { return a.key < b.key; };
		if (!std::is_sorted(spots.begin() + before, spots.end(), inOrder)) std::sort(spots.begin() + before, spots.end(), inOrder);
	}
}

void findTouching(const Side& side0, const Side& side1, std::vector<ContactSpot>& spots)
{
	const View view0(side0, side1), view1(side1, side0);
	if (view0.apart() || view1.apart()) return;
	const Real weight = side0.support || side1.support ? 1 : .5;
	if (!side0.support) searchSide(view0, 0, weight, spots);
	if (!side1.support) searchSide(view1, 1, weight, spots);
}
