// SPDX-License-Identifier: GPL-2.0-or-later
// Bricks, mortar joints and contact forces in YADE's 3-D view. Drawing reads and changes nothing; what makes that safe while a simulation runs is in
// DrawingLock.hpp.
#pragma once

#include "BrickContact.hpp"
#include "BrickField.hpp"

#include <pkg/common/GLDrawFunctors.hpp>

namespace yade {

class Gl1_Brick : public GlShapeFunctor {
public:
	void go(const shared_ptr<Shape>&, const shared_ptr<State>&, bool wire, const GLViewInfo&) override;
	// clang-format off
	YADE_CLASS_BASE_DOC_STATICATTRS(Gl1_Brick, GlShapeFunctor, R"(Draws each :yref:`Brick` as it is deformed, in its own colour or coloured by a :yref:`field<Gl1_Brick.field>`.

The colour map goes from dark blue over grey to yellow, lighter all the way, so that it can be read in grey and by the colour-blind. A brick whose value is not known is light grey. Stresses are means over the inner part, tension positive; those of a rigid brick are zero.

Attributes are set for all views at once, in a script, such as ``Gl1_Brick.field = 'verticalStress'``, or in the display tab of the controller.

Limitations: bricks that share one shape object have one colour.)",
		((BrickField, field, BrickField::color, , "What bricks are coloured by: 'color' (:yref:`Shape.color` of each), 'displacement' (from :yref:`State.refPos` [m]), 'speed' [m/s], 'meanStress', 'verticalStress' (along z), 'principalStress' (the largest), 'vonMisesStress' [Pa], 'level' (of deformation: 0 rigid, 1 uniform, 2 trilinear, 3 refined), 'utilisation' (of the brick's mortar joints, the largest of all segments that hold: 1 at failure) or 'failed' (share of the segments of its joints that have failed)."))
		((Vector2r, range, Vector2r(NaN, NaN), , "Values that the first and the last colour stand for. NaN: the least or the largest of all bricks at present; from 0 to 3 or to 1 for 'level', 'utilisation' and 'failed'."))
		((Vector2r, shownRange, Vector2r(NaN, NaN), Attr::readonly, "The range in use when the view was last painted [unit of the field]."))
		((Real, deformationScale, 1, , "Factor by which the deformation of bricks is magnified, about their rigid motion [-]. See also ``yade.qt.Renderer().dispScale``."))
		((bool, wire, false, , "Draw edges of the surface only."))
		((bool, edges, true, , "Draw the twelve edges of each brick in :yref:`edgeColor<Gl1_Brick.edgeColor>`."))
		((Vector3r, edgeColor, Vector3r(.13, .11, .10), , "Colour of the edges."))
		((Real, lineWidth, 1.5, , "Width of lines [pixels]."))
	);
	// clang-format on
	RENDERS(Brick)

private:
	BrickValues values;
	Vector3r    colorOf(const Brick&);
};
REGISTER_SERIALIZABLE(Gl1_Brick);

class Gl1_BrickGeom : public GlIGeomFunctor {
public:
	void go(const shared_ptr<IGeom>&, const shared_ptr<Interaction>&, const shared_ptr<Body>&, const shared_ptr<Body>&, bool wire) override;
	// clang-format off
	YADE_CLASS_BASE_DOC_STATICATTRS(Gl1_BrickGeom, GlIGeomFunctor, R"(Draws the segments of mortar joints, between the present places of the two faces, coloured by what has become of them. Seen when ``yade.qt.Renderer().intrGeom`` is on.

Each segment is a plate that stands out of the faces a little, so that joints are seen from outside between the bricks. Joints all of whose segments have failed are shown, too, with the mode of each segment, but not those that had failed before a file was saved from which the scene was loaded.

Joints are drawn where bodies are, whatever ``Renderer().dispScale`` is; they follow :yref:`Gl1_Brick.deformationScale`.)",
		((bool, intact, true, , "Draw segments that hold, too; of a joint that holds, as one plate."))
		((bool, contacts, false, , "Draw contacts that are no joints, as a cross at their middle."))
		((Real, thickness, NaN, , "Thickness of the plates [m]; they stand out by half of it. NaN: a twentieth of the square root of the joint's area."))
		((Real, widest, NaN, , "Failed segments whose sides have moved apart or slid by more [m] are not drawn: such a crack shows by itself. NaN: a quarter of the square root of the joint's area."))
		((bool, overlay, false, , "Draw in front of all bricks, also those that hide the joint."))
		((Vector3r, intactColor, Vector3r(.80, .77, .71), , "Colour of segments that hold, and of contacts."))
		((Vector3r, tensionColor, Vector3r(.07, .71, .90), , "Colour of segments that failed in tension."))
		((Vector3r, shearColor, Vector3r(1, .82, .25), , "Colour of segments that failed in shear."))
		((Vector3r, compressionColor, Vector3r(.42, .05, .68), , "Colour of segments that failed in compression."))
	);
	// clang-format on
	RENDERS(BrickGeom)

private:
	int  last = -1; ///< place of the interaction that was drawn last, among all: they come in ascending order
	void drawLostJoints(bool wire) const;
};
REGISTER_SERIALIZABLE(Gl1_BrickGeom);

class Gl1_BrickPhys : public GlIPhysFunctor {
public:
	void go(const shared_ptr<IPhys>&, const shared_ptr<Interaction>&, const shared_ptr<Body>&, const shared_ptr<Body>&, bool wire) override;
	// clang-format off
	YADE_CLASS_BASE_DOC_STATICATTRS(Gl1_BrickPhys, GlIPhysFunctor, R"(Draws the forces of joints and contacts of bricks as arrows: the force on the body with the higher id (:yref:`Interaction.id2`), normal and shear together, from the middle of the contact. Seen when ``yade.qt.Renderer().intrPhys`` is on.)",
		((Real, scale, NaN, , "Length of the arrows [m/N]. NaN: the :yref:`largest<Gl1_BrickPhys.largest>` force is as long as the largest brick."))
		((Real, largest, 0, , "Largest force drawn so far [N]; set to 0 to begin anew."))
		((Real, lineWidth, 2, , "Width of the arrows [pixels]."))
		((bool, overlay, true, , "Draw in front of all bricks."))
		((Vector3r, pressColor, Vector3r(.16, .33, .78), , "Colour of forces that press the two bodies together."))
		((Vector3r, pullColor, Vector3r(.85, .25, .10), , "Colour of forces that hold them together."))
	);
	// clang-format on
	RENDERS(BrickPhys)

private:
	Real longest = 0; // brick so far [m]
};
REGISTER_SERIALIZABLE(Gl1_BrickPhys);

} // namespace yade
