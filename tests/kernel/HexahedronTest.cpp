// SPDX-License-Identifier: GPL-2.0-or-later
#include "References.hpp"
#include "Refusal.hpp"
#include <pkg/brick/kernel/Hexahedron.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

using namespace brick;

namespace {

/// A few roundings of numbers of order 1; lengths here are 0.1 to 1 m, so it also serves lengths and, times their size, volumes.
constexpr Real roundOff = 1e-14;

const Matrix3r turned = Quaternionr(Eigen::AngleAxis<Real>(0.3, Vector3r(1, 2, -1).normalized())).toRotationMatrix();

Nodes moved(Nodes corners, const Matrix3r& rotation, const Vector3r& shift)
{
	for (auto& x : corners)
		x = rotation * x + shift;
	return corners;
}

/// A voussoir: section a trapezoid of width `below` at z = 0 and `above` at z = height, symmetric in x; depth along y from 0.
Nodes voussoir(Real below, Real above, Real height, Real depth)
{
	Nodes corners;
	for (int a = 0; a < nodeCount; ++a) {
		const Real width = nodeSigns[a][2] > 0 ? above : below;
		corners[a]       = { nodeSigns[a][0] * width / 2, nodeSigns[a][1] > 0 ? depth : 0, nodeSigns[a][2] > 0 ? height : 0 };
	}
	return corners;
}

/// The same, its centre of gravity at the origin: a body frame.
Nodes centredVoussoir()
{
	const Nodes corners = voussoir(.2, .3, .25, .15);
	return moved(corners, Matrix3r::Identity(), -solidProperties(corners).centroid);
}

/// All six faces are trapezoids or parallelograms with different angles: a cuboid sheared and tapered by a projective map, which keeps planes plane.
Nodes skewed()
{
	Nodes corners = cuboidCorners({ .3, .2, .25 });
	for (auto& x : corners)
		x = Vector3r(x[0] + .2 * x[1], x[1] - .1 * x[2], x[2] + .15 * x[0]) / (1 + .8 * x[0] - .5 * x[1] + .6 * x[2]);
	return moved(corners, Matrix3r::Identity(), -solidProperties(corners).centroid);
}

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST(HexahedronTest, shape_functions_are_one_at_their_node_and_reproduce_linear_fields)
{
	for (int a = 0; a < nodeCount; ++a) {
		const Vector3r corner(nodeSigns[a][0], nodeSigns[a][1], nodeSigns[a][2]);
		EXPECT_EQ(shapeFunctions(corner), Vector24::Unit(a).head<nodeCount>());
	}
	const Vector3r natural(.3, -.8, .1);
	EXPECT_NEAR(shapeFunctions(natural).sum(), 1, roundOff);
	const Nodes cuboid = cuboidCorners({ 2, 2, 2 }); // x = natural coordinates
	EXPECT_LT((jacobian(cuboid, natural) - Matrix3r::Identity()).norm(), roundOff);
}

TEST(HexahedronTest, shape_derivatives_agree_with_differences)
{
	const Vector3r at(.3, -.8, .1);
	for (int i = 0; i < 3; ++i) { // the functions are linear in each coordinate: a central difference is exact
		const Eigen::Matrix<Real, nodeCount, 1> difference = shapeFunctions(at + .1 * Vector3r::Unit(i)) - shapeFunctions(at - .1 * Vector3r::Unit(i));
		EXPECT_LT((difference / .2 - shapeDerivatives(at).col(i)).norm(), roundOff);
	}
}

TEST(HexahedronTest, cuboid_has_volume_centre_and_inertia_of_the_closed_form)
{
	const Vector3r        size(.1, .2, .4), centre(3, -2, 5);
	const SolidProperties solid   = solidProperties(moved(cuboidCorners(size), Matrix3r::Identity(), centre));
	const Real            volume  = size.prod();
	const Vector3r        square  = size.cwiseAbs2();
	const Vector3r        inertia = volume / 12 * Vector3r(square[1] + square[2], square[2] + square[0], square[0] + square[1]);
	// corners 5 m from the origin lose a factor 5 / 0.1 of the digits
	EXPECT_NEAR(solid.volume, volume, 50 * roundOff * volume);
	EXPECT_LT((solid.centroid - centre).norm(), 50 * roundOff);
	EXPECT_LT((solid.inertia - Matrix3r(inertia.asDiagonal())).norm(), 50 * roundOff * inertia.maxCoeff());
}

TEST(HexahedronTest, inertia_turns_with_the_corners)
{
	const SolidProperties before = solidProperties(skewed()), after = solidProperties(moved(skewed(), turned, Vector3r(.1, .2, .3)));
	EXPECT_NEAR(after.volume, before.volume, roundOff * before.volume * 10);
	EXPECT_LT((after.inertia - turned * before.inertia * turned.transpose()).norm(), 10 * roundOff * before.inertia.norm());
}

TEST(HexahedronTest, voussoir_has_volume_centre_and_inertia_of_the_closed_form)
{
	const Real            a = .2, b = .3, h = .25, t = .15;
	const SolidProperties solid = solidProperties(voussoir(a, b, h, t));

	const Real area = (a + b) / 2 * h, volume = area * t;
	const Real xx = t * h * (a + b) * (a * a + b * b) / 48;                       // integral of x^2, of a trapezoid about its axis of symmetry
	const Real zz = t * h * h * h * (a * a + 4 * a * b + b * b) / (36 * (a + b)); // of (z - z_c)^2, about its centroid
	const Real yy = volume * t * t / 12;
	EXPECT_NEAR(solid.volume, volume, roundOff * volume);
	EXPECT_LT((solid.centroid - Vector3r(0, t / 2, h * (a + 2 * b) / (3 * (a + b)))).norm(), roundOff);
	EXPECT_LT((solid.inertia - Matrix3r(Vector3r(yy + zz, zz + xx, xx + yy).asDiagonal())).norm(), roundOff * solid.inertia.norm());
}

TEST(HexahedronTest, distorted_hexahedron_has_the_reference_volume)
{
	EXPECT_NEAR(solidProperties(references::distortedNodes()).volume, references::distortedVolume, references::printedDigits * references::distortedVolume);
}

TEST(HexahedronTest, principal_frame_of_a_cuboid_along_its_axes_is_exactly_the_identity)
{
	for (const Vector3r& size : { Vector3r(.1, .2, .4), Vector3r(.4, .1, .2), Vector3r(.2, .2, .2), Vector3r(.2, .2, .5) }) {
		const SolidProperties solid = solidProperties(moved(cuboidCorners(size), Matrix3r::Identity(), Vector3r(7, -3, 2)));
		const PrincipalFrame  frame = principalFrame(solid.inertia);
		EXPECT_EQ(frame.orientation.coeffs(), Quaternionr::Identity().coeffs());
		EXPECT_EQ(frame.inertia, solid.inertia.diagonal());
	}
}

TEST(HexahedronTest, principal_frame_of_a_turned_cuboid_is_the_turn)
{
	for (const Vector3r& size : { Vector3r(.1, .2, .4), Vector3r(.4, .1, .2), Vector3r(.2, .4, .1) }) {
		const PrincipalFrame frame = principalFrame(solidProperties(moved(cuboidCorners(size), turned, Vector3r::Zero())).inertia);
		// 0.3 rad is below the 45 degrees from which another naming of the axes would be closer; moments differ by a quarter or more, so round-off hardly grows
		EXPECT_LT((frame.orientation.toRotationMatrix() - turned).norm(), 10 * roundOff);
		const Vector3r inertia = solidProperties(cuboidCorners(size)).inertia.diagonal();
		EXPECT_LT((frame.inertia - inertia).norm(), 10 * roundOff * inertia.norm());
	}
}

TEST(HexahedronTest, principal_frame_of_a_square_prism_turned_about_its_axis_stays_where_it_is)
{
	// Two moments are equal: any axes in their plane are principal, and the smallest rotation is the one that tilts the axis and no more.
	const Matrix3r       tilt  = Eigen::AngleAxis<Real>(.4, Vector3r(std::cos(1), std::sin(1), 0)).toRotationMatrix();
	const Matrix3r       twist = Eigen::AngleAxis<Real>(.7, Vector3r::UnitZ()).toRotationMatrix();
	const PrincipalFrame frame = principalFrame(solidProperties(moved(cuboidCorners({ .2, .2, .5 }), tilt * twist, Vector3r::Zero())).inertia);
	EXPECT_LT((frame.orientation.toRotationMatrix() - tilt).norm(), 10 * roundOff);
}

TEST(HexahedronTest, principal_frame_half_way_between_two_names_of_the_axes_does_not_depend_on_round_off)
{
	const auto frameAt = [](Real angle) {
		const Matrix3r turn = Eigen::AngleAxis<Real>(angle, Vector3r::UnitZ()).toRotationMatrix();
		return principalFrame(solidProperties(moved(cuboidCorners({ .1, .2, .4 }), turn, Vector3r::Zero())).inertia).orientation.toRotationMatrix();
	};
	const Real half = std::atan(1.); // 45 degrees: x or y is as close to the long side
	for (Real noise : { -1e-13, -1e-15, 1e-15, 1e-13 })
		EXPECT_LT((frameAt(half + noise) - frameAt(half)).norm(), 1e-12); // the noise itself, not a quarter turn
}

TEST(HexahedronTest, principal_frame_is_right_handed_and_diagonalises_for_any_turn)
{
	const Matrix3r inertia = solidProperties(skewed()).inertia;
	for (int i = 0; i < 50; ++i) {
		const Matrix3r R = Quaternionr(Eigen::AngleAxis<Real>(.37 * i, Vector3r(std::sin(i), std::cos(2 * i), std::sin(3 * i + 1)).normalized()))
		                           .toRotationMatrix();
		const Matrix3r       given = R * inertia * R.transpose();
		const PrincipalFrame frame = principalFrame((given + given.transpose()) / 2);
		const Matrix3r       axes  = frame.orientation.toRotationMatrix();
		EXPECT_GT(axes.determinant(), 0);
		EXPECT_LT((axes * frame.inertia.asDiagonal() * axes.transpose() - given).norm(), 10 * roundOff * inertia.norm());
		// no orientation is further than 62.8 degrees from the nearest of the 24
		EXPECT_GE(axes.trace(), .5 + std::sqrt(2.) - roundOff);
	}
}

TEST(HexahedronTest, principal_frame_refuses_what_is_no_inertia)
{
	Matrix3r inertia = Matrix3r::Identity();
	inertia(0, 0)    = -1;
	EXPECT_TRUE(mentions(refusal([&] { principalFrame(inertia); }), "smallest moment is -1"));
	inertia(0, 0) = std::numeric_limits<Real>::quiet_NaN();
	EXPECT_TRUE(mentions(refusal([&] { principalFrame(inertia); }), "finite"));
	inertia       = Matrix3r::Identity();
	inertia(0, 1) = .1;
	EXPECT_TRUE(mentions(refusal([&] { principalFrame(inertia); }), "differ by 0.1"));
}

TEST(HexahedronTest, cuboids_voussoirs_and_skewed_bricks_are_admissible_wherever_they_are)
{
	for (const Nodes& corners : { cuboidCorners({ .2, .2, .2 }), cuboidCorners({ 1, 1, 1e-3 }), voussoir(.2, .3, .25, .15), skewed() }) {
		EXPECT_EQ(cornersProblem(corners), "");
		EXPECT_EQ(cornersProblem(moved(corners, turned, Vector3r(100, -50, 20))), "");
	}
}

TEST(HexahedronTest, corners_that_are_not_finite_are_refused_by_number)
{
	Nodes corners = cuboidCorners({ .2, .2, .2 });
	corners[5][1] = std::numeric_limits<Real>::infinity();
	EXPECT_TRUE(mentions(cornersProblem(corners), "corner 5 is")) << cornersProblem(corners);
	corners[5][1] = std::numeric_limits<Real>::quiet_NaN();
	EXPECT_TRUE(mentions(cornersProblem(corners), "finite"));
}

TEST(HexahedronTest, inverted_or_misnumbered_corners_are_refused)
{
	Nodes mirrored = cuboidCorners({ .2, .2, .2 });
	for (auto& x : mirrored)
		x[0] = -x[0];
	EXPECT_TRUE(mentions(cornersProblem(mirrored), "det J at the Gauss point nearest corner 0 is -1 ")) << cornersProblem(mirrored);
	Nodes rows = cuboidCorners({ .2, .2, .2 }); // numbered line by line, the commonest mistake
	std::swap(rows[2], rows[3]);
	std::swap(rows[6], rows[7]);
	EXPECT_TRUE(mentions(cornersProblem(rows), "another order")) << cornersProblem(rows);
}

TEST(HexahedronTest, flat_hexahedra_and_edges_without_length_are_refused)
{
	Nodes flat = cuboidCorners({ .2, .2, .2 });
	for (auto& x : flat)
		x[2] = .1 * x[0];
	for (int a = 4; a < nodeCount; ++a)
		flat[a] += Vector3r(.3, 0, .03);
	EXPECT_TRUE(mentions(cornersProblem(flat), "flat")) << cornersProblem(flat);
	Nodes edge = cuboidCorners({ .2, .2, .2 });
	edge[6]    = edge[2];
	EXPECT_TRUE(mentions(cornersProblem(edge), "corner 2 to 6 has length 0 m") || mentions(cornersProblem(edge), "corner 6 to 2 has length 0 m"))
	        << cornersProblem(edge);
}

TEST(HexahedronTest, hexahedra_that_are_not_convex_are_refused)
{
	Nodes dart = cuboidCorners({ .2, .2, .2 }); // corners 2 and 6 pushed in a little past the diagonal
	dart[2] = dart[6] = Vector3r(-.005, -.005, 0);
	dart[2][2]        = -.1;
	dart[6][2]        = .1;
	EXPECT_TRUE(mentions(cornersProblem(dart), "det J at corner 2")) << cornersProblem(dart);

	// Two wedges that meet at the line x = -0.2: det J = k (xi + 0.2)^2 / 2 is positive wherever an element looks, and every face is plane.
	Nodes wedges;
	for (int a = 0; a < nodeCount; ++a) {
		const Real xi = nodeSigns[a][0], eta = nodeSigns[a][1];
		wedges[a] = { xi, (xi + .2) * eta, nodeSigns[a][2] > 0 ? xi + .2 : 0 };
	}
	EXPECT_TRUE(mentions(cornersProblem(wedges), "not convex: corner")) << cornersProblem(wedges);
}

TEST(HexahedronTest, warped_faces_are_refused_with_the_measured_warp)
{
	Nodes corners = cuboidCorners({ .2, .2, .2 });
	corners[6] += Vector3r(0, 0, 4e-6); // the corners of face 5 are a quarter of it off their plane, 1e-6 m: five times what a longest edge of 0.2 m allows
	const std::string problem = cornersProblem(corners);
	EXPECT_TRUE(mentions(problem, "face 5 is not planar")) << problem;
	EXPECT_TRUE(mentions(problem, " 1e-06 m off") || mentions(problem, " 9.99999")) << problem;
	EXPECT_EQ(nodesProblem(corners), "");
	corners[6] = Vector3r(.1, .1, .1 + .4e-6); // 1e-7 m
	EXPECT_EQ(cornersProblem(corners), "");
}

TEST(HexahedronTest, construction_refuses_bad_corners_and_an_origin_outside)
{
	Nodes corners = cuboidCorners({ .2, .2, .2 });
	EXPECT_EQ(refusal([&] { Hexahedron { corners }; }), "");
	EXPECT_TRUE(mentions(refusal([&] { Hexahedron { moved(corners, Matrix3r::Identity(), Vector3r(.3, 0, 0)) }; }), "face 0"));
	corners[0] = corners[1];
	EXPECT_TRUE(mentions(refusal([&] { Hexahedron { corners }; }), "length 0 m"));
}

TEST(HexahedronTest, faces_of_a_cuboid_are_its_sides)
{
	const Vector3r   size(.1, .2, .4);
	const Hexahedron brick(cuboidCorners(size));
	for (int face = 0; face < faceCount; ++face) {
		const int   axis = face / 2;
		const Face& f    = brick.faces[face];
		EXPECT_LT((f.normal - (face % 2 ? 1 : -1) * Vector3r::Unit(axis)).norm(), roundOff);
		EXPECT_NEAR(brick.distance(face), size[axis] / 2, roundOff);
		EXPECT_NEAR(f.area, size.prod() / size[axis], roundOff);
		EXPECT_LT(f.e12.norm(), roundOff);
		for (int i = 0; i < 4; ++i) {
			const Real xi = i == 1 || i == 2 ? 1 : -1, eta = i > 1 ? 1 : -1;
			EXPECT_LT((f.at(xi, eta) - brick.corners[faceNodes[face][i]]).norm(), roundOff);
			EXPECT_EQ(bilinear(xi, eta), Vector4r(Vector4r::Unit(i)));
		}
	}
}

TEST(HexahedronTest, normals_point_outward_and_areas_close_the_surface)
{
	for (const Nodes& corners : { centredVoussoir(), skewed() }) {
		const Hexahedron brick(corners);
		Vector3r         sum    = Vector3r::Zero();
		Real             volume = 0;
		for (const Face& f : brick.faces) {
			EXPECT_GT(f.offset, 0);
			sum += f.area * f.normal;
			volume += f.area * f.offset / 3; // pyramids from the origin
			EXPECT_NEAR(f.dual1.dot(f.e1), 1, roundOff);
			EXPECT_NEAR(f.dual2.dot(f.e2), 1, roundOff);
			EXPECT_NEAR(f.dual1.dot(f.e2), 0, roundOff);
			EXPECT_NEAR(f.dual2.dot(f.e1), 0, roundOff);
			EXPECT_NEAR(f.dual1.dot(f.normal), 0, roundOff / f.e1.norm());
		}
		EXPECT_LT(sum.norm(), roundOff);
		EXPECT_NEAR(volume, solidProperties(corners).volume, roundOff);
	}
}

TEST(HexahedronTest, face_coordinates_return_the_point_that_was_put_in)
{
	for (const Nodes& corners : { cuboidCorners({ .1, .2, .4 }), centredVoussoir(), skewed() }) {
		const Hexahedron brick(corners);
		for (int face = 0; face < faceCount; ++face)
			for (Real xi = -1; xi <= 1; xi += .25)
				for (Real eta = -1; eta <= 1; eta += .25) {
					const Face& f = brick.faces[face];
					Vector3r    x = Vector3r::Zero();
					for (int i = 0; i < 4; ++i)
						x += bilinear(xi, eta)[i] * corners[faceNodes[face][i]];
					EXPECT_LT((f.at(xi, eta) - x).norm(), roundOff);
					x += .3 * f.normal; // the projection counts, not the distance
					EXPECT_LT((f.coordinates(x) - Vector2r(xi, eta)).norm(), 10 * roundOff);
				}
	}
}

TEST(HexahedronTest, face_coordinates_of_points_beside_the_face_are_on_its_edge)
{
	for (const Nodes& corners : { cuboidCorners({ .1, .2, .4 }), centredVoussoir(), skewed() }) {
		const Hexahedron brick(corners);
		for (const Face& f : brick.faces)
			for (Real angle = 0; angle < 6.28; angle += .1)
				for (Real distance : { 1.5, 3., 10., 1000. }) {
					const Vector2r natural = f.coordinates(f.centre + distance * 2 * (std::cos(angle) * f.e1 + std::sin(angle) * f.e2));
					EXPECT_NEAR(natural.cwiseAbs().maxCoeff(), 1, roundOff); // on the edge, finite and not beyond
				}
	}
	for (const Face& f : Hexahedron(skewed()).faces) // beyond a side of constant xi the point slides along its line of constant eta
		EXPECT_LT((f.coordinates(f.at(1.2, .3)) - Vector2r(1, .3)).norm(), 10 * roundOff);
	const Face top = Hexahedron(cuboidCorners({ .2, .2, .2 })).faces[5];
	EXPECT_LT((top.coordinates({ .3, .05, .1 }) - Vector2r(1, .5)).norm(), roundOff);
}

TEST(HexahedronTest, inset_of_a_cuboid_is_a_smaller_cuboid)
{
	const Vector3r   size(.1, .2, .4);
	const Hexahedron brick(cuboidCorners(size));
	const Nodes      inner = insetCorners(brick, .01), expected = cuboidCorners(size - Vector3r::Constant(.02));
	for (int a = 0; a < nodeCount; ++a)
		EXPECT_LT((inner[a] - expected[a]).norm(), roundOff);
	EXPECT_NEAR(insetLimit(brick), .05, roundOff);
}

TEST(HexahedronTest, inset_of_a_voussoir_has_parallel_faces_at_the_thickness)
{
	const Real r = .02;
	for (const Nodes& corners : { centredVoussoir(), skewed() }) {
		const Hexahedron brick(corners);
		const Nodes      inner = insetCorners(brick, r);
		EXPECT_EQ(cornersProblem(inner), "");
		for (int face = 0; face < faceCount; ++face)
			for (int node : faceNodes[face])
				EXPECT_NEAR(brick.faces[face].offset - brick.faces[face].normal.dot(inner[node]), r, roundOff);
	}
	// closed form: the sides lean outward by s = (b - a) / 2h, so at a height z they are r sqrt(1 + s^2) further in
	const Nodes corners = centredVoussoir(), inner = insetCorners(Hexahedron(corners), r);
	const Real  s = (.3 - .2) / 2 / .25;
	EXPECT_NEAR(inner[1][0], .1 + s * r - r * std::sqrt(1 + s * s), roundOff);
	EXPECT_NEAR(inner[5][0], .15 - s * r - r * std::sqrt(1 + s * s), roundOff);
}

TEST(HexahedronTest, contact_parts_that_are_too_thick_or_no_thickness_are_refused_with_the_limit)
{
	const Hexahedron cuboid(cuboidCorners({ .1, .2, .4 }));
	EXPECT_EQ(refusal([&] { insetCorners(cuboid, .0499); }), "");
	const std::string message = refusal([&] { insetCorners(cuboid, .05); });
	EXPECT_TRUE(mentions(message, "is 0.05 m") && mentions(message, "below 0.05 m")) << message;
	for (Real r : { .3, 0., -.01, std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity() })
		EXPECT_TRUE(mentions(refusal([&] { insetCorners(cuboid, r); }), "below 0.05 m")) << r;
	// what vanishes first is an edge of some face: just below the limit the inner hexahedron is sound, in every shape
	for (const Nodes& corners : { centredVoussoir(), skewed() }) {
		const Hexahedron brick(corners);
		EXPECT_EQ(cornersProblem(insetCorners(brick, .999 * insetLimit(brick))), "");
		EXPECT_NE(refusal([&] { insetCorners(brick, 1.001 * insetLimit(brick)); }), "");
	}
}

TEST(HexahedronTest, cuboids_without_size_are_refused)
{
	for (Real bad : { 0., -.2, std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity() })
		EXPECT_TRUE(mentions(refusal([&] { cuboidCorners({ .2, bad, .2 }); }), "above 0")) << bad;
}
