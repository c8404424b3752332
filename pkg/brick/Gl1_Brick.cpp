// SPDX-License-Identifier: GPL-2.0-or-later
#include "Gl1_Brick.hpp"

#include "Drawn.hpp"

#include <GL/gl.h>

#include <boost/python/handle.hpp>
#include <boost/python/object.hpp>

namespace yade {

YADE_PLUGIN((Gl1_Brick)(Gl1_BrickGeom)(Gl1_BrickPhys));

BrickField Gl1_Brick::field;
Vector2r   Gl1_Brick::range;
Vector2r   Gl1_Brick::shownRange;
Real       Gl1_Brick::deformationScale;
bool       Gl1_Brick::wire;
bool       Gl1_Brick::edges;
Vector3r   Gl1_Brick::edgeColor;
Real       Gl1_Brick::lineWidth;

bool     Gl1_BrickGeom::intact;
bool     Gl1_BrickGeom::contacts;
Real     Gl1_BrickGeom::thickness;
Real     Gl1_BrickGeom::widest;
bool     Gl1_BrickGeom::overlay;
Vector3r Gl1_BrickGeom::intactColor;
Vector3r Gl1_BrickGeom::tensionColor;
Vector3r Gl1_BrickGeom::shearColor;
Vector3r Gl1_BrickGeom::compressionColor;

Real     Gl1_BrickPhys::scale;
Real     Gl1_BrickPhys::largest;
Real     Gl1_BrickPhys::lineWidth;
bool     Gl1_BrickPhys::overlay;
Vector3r Gl1_BrickPhys::pressColor;
Vector3r Gl1_BrickPhys::pullColor;

namespace {

	/// YADE's GUI asks each attribute for its documentation; one that all objects share has only that of its type, and an enumeration has none by itself.
	/// This runs after the enumeration was made, because this file is linked after BrickField.cpp.
	__attribute__((constructor)) void documentEnumeration()
	{
		const auto* const known = py::converter::registry::query(py::type_id<BrickField>());
		if (!known || !known->m_class_object) return;
		py::object(py::handle<>(py::borrowed(reinterpret_cast<PyObject*>(known->m_class_object)))).attr("__doc__") = "What bricks are coloured by.";
	}

} // namespace

// What OpenGL is told

namespace {

	/// Leaves OpenGL's state as it was.
	class KeptState {
	public:
		KeptState() { glPushAttrib(GL_ENABLE_BIT | GL_LIGHTING_BIT | GL_LINE_BIT | GL_POLYGON_BIT | GL_CURRENT_BIT | GL_DEPTH_BUFFER_BIT); }
		~KeptState() { glPopAttrib(); }
		KeptState(const KeptState&) = delete;
		KeptState& operator=(const KeptState&) = delete;
	};

	void setColor(const Vector3r& c) { glColor3d(c[0], c[1], c[2]); }
	void vertex(const Vector3r& x) { glVertex3d(x[0], x[1], x[2]); }

	/// Without the shine and the glow that the view gives to all surfaces, colours are those of the map. The glow of a selected body is left.
	void dullSurface()
	{
		constexpr GLfloat none[4] = { 0, 0, 0, 1 }, glowOfAll = .2f;
		GLfloat           glow[4];
		glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, none);
		glGetMaterialfv(GL_FRONT, GL_EMISSION, glow);
		if (glow[0] == glowOfAll) glMaterialfv(GL_FRONT_AND_BACK, GL_EMISSION, none);
	}

	void unlitLines(Real width)
	{
		glDisable(GL_LIGHTING);
		glLineWidth(GLfloat(width));
	}

	/// Within glBegin(GL_QUADS). Counter-clockwise from outside.
	void quad(const Vector3r& a, const Vector3r& b, const Vector3r& c, const Vector3r& d)
	{
		const Vector3r normal = (c - a).cross(d - b).stableNormalized();
		glNormal3d(normal[0], normal[1], normal[2]);
		for (const auto* x : { &a, &b, &c, &d })
			vertex(*x);
	}

	/// Calls with the nodes of each cell of the surface.
	template <class Use> void forEachCell(int cells, Use use)
	{
		const brick::SurfaceGrid& grid = brick::surfaceGrid(cells);
		for (int f = 0; f < brick::faceCount; ++f)
			for (int row = 0; row < cells; ++row)
				for (int column = 0; column < cells; ++column)
					use(grid.cellNodes(f, column, row));
	}

	void drawFaces(const std::vector<Vector3r>& nodes, int cells)
	{
		glBegin(GL_QUADS);
		forEachCell(cells, [&](const std::array<int, 4>& n) { quad(nodes[n[0]], nodes[n[1]], nodes[n[2]], nodes[n[3]]); });
		glEnd();
	}

	void drawCellEdges(const std::vector<Vector3r>& nodes, int cells)
	{
		forEachCell(cells, [&](const std::array<int, 4>& n) {
			glBegin(GL_LINE_LOOP);
			for (const int a : n)
				vertex(nodes[a]);
			glEnd();
		});
	}

	/// The outlines of the faces: each edge of the brick twice.
	void drawOutlines(const std::vector<Vector3r>& nodes, int cells)
	{
		const brick::SurfaceGrid& grid = brick::surfaceGrid(cells);
		for (int f = 0; f < brick::faceCount; ++f) {
			glBegin(GL_LINE_LOOP);
			for (int k = 0; k < cells; ++k)
				vertex(nodes[grid.faceNode(f, k, 0)]);
			for (int k = 0; k < cells; ++k)
				vertex(nodes[grid.faceNode(f, cells, k)]);
			for (int k = cells; k > 0; --k)
				vertex(nodes[grid.faceNode(f, k, cells)]);
			for (int k = cells; k > 0; --k)
				vertex(nodes[grid.faceNode(f, 0, k)]);
			glEnd();
		}
	}

} // namespace

// Bricks

Vector3r Gl1_Brick::colorOf(const Brick& b)
{
	if (field == BrickField::color) return b.color;
	const Real     value = values.of(b, *scene, field);
	const Vector2r fixed = field == BrickField::level ? Vector2r(0, 3) : isOfJoints(field) ? Vector2r(0, 1) : values.range();
	for (int end = 0; end < 2; ++end)
		shownRange[end] = std::isnan(range[end]) ? fixed[end] : range[end];
	const Real width = shownRange[1] - shownRange[0];
	return fieldColor(width != 0 ? (value - shownRange[0]) / width : 0 * value);
}

void Gl1_Brick::go(const shared_ptr<Shape>& shape, const shared_ptr<State>&, bool wireAsked, const GLViewInfo&)
{
	const Brick&       b       = static_cast<const Brick&>(*shape);
	const DrawnSurface surface = drawnSurface(b, deformationScale);
	if (!surface.solid) return;
	const std::vector<Vector3r> nodes = surface.nodes();
	const KeptState             kept;
	setColor(colorOf(b));
	if (wire || wireAsked) {
		unlitLines(lineWidth);
		drawCellEdges(nodes, surface.cells);
		return;
	}
	dullSurface();
	glEnable(GL_POLYGON_OFFSET_FILL); // faces a little farther away, so that edges are not half hidden by them
	glPolygonOffset(1, 1);
	drawFaces(nodes, surface.cells);
	if (!edges) return;
	unlitLines(lineWidth);
	setColor(edgeColor);
	drawOutlines(nodes, surface.cells);
}

// Joints

namespace {

	/// Part of a patch between two pairs of its coordinates p and q; it may reach over the patch's ends.
	struct Plate {
		Real p0, p1, q0, q1;
	};

	/// A patch as it is placed, half way between its two sides, to draw plates on.
	class PlacedPatch {
	public:
		PlacedPatch(const brick::PatchMotion& m, const Vector3r& origin, const Vector3r& jointNormal, Real thickness)
		        : corners((m.place + m.opening / 2).rowwise() + origin.transpose())
		        , half(thickness / 2 * jointNormal)
		        , opening(m.opening)
		{
			const Real alongP = (corners.row(1) - corners.row(0)).norm(), alongQ = (corners.row(3) - corners.row(0)).norm();
			beyond = { alongP > 0 ? thickness / 2 / alongP : 0, alongQ > 0 ? thickness / 2 / alongQ : 0 };
			// the sides of a plate are wound as p, q and the normal are
			const Vector3r up = Vector3r(corners.row(1) - corners.row(0)).cross(Vector3r(corners.row(3) - corners.row(0)));
			if (up.dot(half) < 0) half = -half;
		}

		/// Of a segment; one that is cut by the joint's border is made smaller about its middle.
		Plate plateOf(const brick::JointPatch& patch, const brick::JointSegment& s) const
		{
			const Real whole = patch.cut.empty() ? 0 : area() / (patch.rows[0] * patch.rows[1]);
			const Real share = whole > 0 ? std::min<Real>(1, std::sqrt(s.area / whole)) : 1;
			const Real hp = share / 2 / patch.rows[0], hq = share / 2 / patch.rows[1];
			return { s.p - hp, s.p + hp, s.q - hq, s.q + hq };
		}

		Real openingAt(Real p, Real q) const { return (brick::cornerWeights(p, q).transpose() * opening).norm(); } ///< [m]

		/// Within glBegin(GL_QUADS).
		void draw(const Plate& given) const
		{
			const auto  c = cornersOf(given);
			const auto& h = half;
			quad(c[0] + h, c[1] + h, c[2] + h, c[3] + h);
			quad(c[3] - h, c[2] - h, c[1] - h, c[0] - h);
			for (int k = 0; k < 4; ++k) {
				const Vector3r &a = c[k], &b = c[(k + 1) % 4];
				quad(a - h, b - h, b + h, a + h);
			}
		}

		void drawOutline(const Plate& given) const
		{
			glBegin(GL_LINE_LOOP);
			for (const auto& x : cornersOf(given))
				vertex(x);
			glEnd();
		}

	private:
		brick::CornerVectors corners;
		Vector3r             half;
		brick::CornerVectors opening;
		Vector2r             beyond; // how far plates stand out at the ends of the patch, in p and q

		Real     area() const { return Vector3r(corners.row(2) - corners.row(0)).cross(Vector3r(corners.row(3) - corners.row(1))).norm() / 2; }
		Vector3r at(Real p, Real q) const { return (brick::cornerWeights(p, q).transpose() * corners).transpose(); }
		std::array<Vector3r, 4> cornersOf(const Plate& s) const
		{
			constexpr Real end = 1e-9;
			const Real     p0 = s.p0 < end ? s.p0 - beyond[0] : s.p0, p1 = s.p1 > 1 - end ? s.p1 + beyond[0] : s.p1;
			const Real     q0 = s.q0 < end ? s.q0 - beyond[1] : s.q0, q1 = s.q1 > 1 - end ? s.q1 + beyond[1] : s.q1;
			return { at(p0, q0), at(p1, q0), at(p1, q1), at(p0, q1) };
		}
	};

	const Vector3r& stateColor(int state)
	{
		switch (brick::SegmentState(state)) {
			case brick::SegmentState::Tension: return Gl1_BrickGeom::tensionColor;
			case brick::SegmentState::Shear: return Gl1_BrickGeom::shearColor;
			case brick::SegmentState::Compression: return Gl1_BrickGeom::compressionColor;
			default: return Gl1_BrickGeom::intactColor;
		}
	}

	/// The segments of a joint, or of one that holds its patches.
	template <class Use> void forEachPlate(const DrawnJoint& drawn, const std::vector<PlacedPatch>& placed, Real widest, Use use)
	{
		const auto& patches = drawn.joint.shape->patches;
		if (drawn.holds() && Gl1_BrickGeom::intact)
			for (std::size_t i = 0; i < patches.size(); ++i)
				if (patches[i].cut.empty()) use(placed[i], Plate { 0, 1, 0, 1 }, 0);
		const int count = drawn.joint.count();
		for (int s = 0; s < count; ++s) {
			const brick::JointSegment segment = brick::segmentOf(drawn.joint, s);
			const brick::JointPatch&  patch   = patches[segment.patch];
			const PlacedPatch&        at      = placed[segment.patch];
			const int                 state   = drawn.holds() ? 0 : drawn.states[s];
			if (drawn.holds() && patch.cut.empty()) continue; // drawn as a whole
			if (state == 0 ? !Gl1_BrickGeom::intact : at.openingAt(segment.p, segment.q) > widest) continue;
			use(at, at.plateOf(patch, segment), state);
		}
	}

	void drawJoint(const DrawnJoint& drawn, const DrawnMotion& moved, bool wire)
	{
		if (!drawn.holds() && int(drawn.states.size()) != drawn.joint.count()) return;
		const Real size = std::sqrt(drawn.joint.area());
		const Real thickness = std::isnan(Gl1_BrickGeom::thickness) ? size / 20 : Gl1_BrickGeom::thickness;
		const Real widest    = std::isnan(Gl1_BrickGeom::widest) ? size / 4 : Gl1_BrickGeom::widest;
		std::vector<PlacedPatch> placed;
		for (const auto& patch : moved.motion.patches)
			placed.emplace_back(patch, moved.origin, moved.motion.normal, thickness);
		if (!wire) glBegin(GL_QUADS);
		forEachPlate(drawn, placed, widest, [wire](const PlacedPatch& patch, const Plate& plate, int state) {
			setColor(stateColor(state));
			if (wire) patch.drawOutline(plate);
			else
				patch.draw(plate);
		});
		if (!wire) glEnd();
	}

	void drawCross(const Vector3r& middle, Real size)
	{
		glBegin(GL_LINES);
		for (int k = 0; k < 3; ++k) {
			const Vector3r arm = size / 2 * Vector3r::Unit(k);
			vertex(middle - arm), vertex(middle + arm);
		}
		glEnd();
	}

} // namespace

/// Of all bricks of the scene.
void Gl1_BrickGeom::drawLostJoints(bool wire) const
{
	for (const auto& b : *scene->bodies) {
		const Brick* shape = asBrick(b->shape);
		if (!shape || !b->state) continue;
		for (const auto& [joint, other] : drawnLostJoints(*shape)) {
			if (!scene->bodies->exists(other)) continue;
			const auto& first = (*scene->bodies)[other];
			if (first->shape && first->state) drawJoint(joint, drawnMotion(joint, *first, *b, Vector3r::Zero(), Gl1_Brick::deformationScale), wire);
		}
	}
}

void Gl1_BrickGeom::go(const shared_ptr<IGeom>& geom, const shared_ptr<Interaction>& I, const shared_ptr<Body>& first, const shared_ptr<Body>& second, bool wire)
{
	const KeptState kept;
	dullSurface();
	if (overlay) glDisable(GL_DEPTH_TEST);
	if (wire) unlitLines(Gl1_Brick::lineWidth);
	if (I->linIx <= last) drawLostJoints(wire); // a new painting
	last = I->linIx;
	const shared_ptr<IPhys> phys = I->phys; // kept, should the interaction end meanwhile
	const BrickPhys* const  p    = asBrickPhys(phys);
	if (!p || !first || !second) return;
	if (const auto drawn = drawnJoint(*p))
		drawJoint(*drawn, drawnMotion(*drawn, *first, *second, shiftOf(*I, *scene), Gl1_Brick::deformationScale), wire);
	else if (contacts) {
		const BrickGeom& g = static_cast<const BrickGeom&>(*geom);
		unlitLines(2 * Gl1_Brick::lineWidth);
		setColor(intactColor);
		drawCross(g.contactPoint, g.refR1);
	}
}

// Forces

namespace {

	/// Within KeptState.
	void drawArrow(const Vector3r& from, const Vector3r& to)
	{
		const Vector3r along = to - from;
		if (!(along.norm() > 0)) return;
		const Vector3r side = .12 * along.norm() * along.unitOrthogonal(), other = along.normalized().cross(side), neck = from + .7 * along;
		glBegin(GL_LINES);
		vertex(from), vertex(neck);
		glEnd();
		glBegin(GL_TRIANGLE_FAN);
		vertex(to);
		for (int k = 0; k <= 12; ++k) {
			const Real angle = k * M_PI / 6;
			vertex(neck + std::cos(angle) * side + std::sin(angle) * other);
		}
		glEnd();
	}

} // namespace

void Gl1_BrickPhys::go(const shared_ptr<IPhys>& phys, const shared_ptr<Interaction>& I, const shared_ptr<Body>& first, const shared_ptr<Body>& second, bool)
{
	const shared_ptr<IGeom> geom = I->geom; // kept, should the interaction end meanwhile
	if (!geom || !first || !second) return;
	const BrickGeom& g     = static_cast<const BrickGeom&>(*geom);
	const BrickPhys& p     = static_cast<const BrickPhys&>(*phys);
	const Vector3r   force = p.normalForce + p.shearForce;
	if (!(force.norm() > 0) || !g.contactPoint.allFinite()) return;
	largest = std::max(largest, force.norm());
	for (const auto& b : { first, second })
		if (const Brick* shape = asBrick(b->shape))
			if (const auto solid = drawnSurface(*shape, 0).solid) longest = std::max(longest, 2 * solid->reach.maxCoeff());
	const KeptState kept;
	unlitLines(lineWidth);
	glDisable(GL_CULL_FACE);
	if (overlay) glDisable(GL_DEPTH_TEST);
	setColor(p.normalForce.dot(g.normal) >= 0 ? pressColor : pullColor);
	drawArrow(g.contactPoint, g.contactPoint + (std::isnan(scale) ? longest / largest : scale) * force);
}

} // namespace yade
