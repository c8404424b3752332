// SPDX-License-Identifier: GPL-2.0-or-later
#include "Utilisation.hpp"

#include <Eigen/Eigenvalues>

#include <limits>

namespace brick {

Real utilisation(const MortarStrength& strength, Real sigma, Real tau)
{
	const auto share = [](Real stress, Real limit) {
		if (stress <= 0) return Real(0);
		return limit > 0 ? stress / limit : std::numeric_limits<Real>::infinity();
	};
	const Real crushing = sigma < 0 ? std::sqrt(sigma * sigma + strength.capShape * tau * tau) : 0;
	const Real held     = strength.cohesion - sigma * strength.tanFriction; // what the shear stress must not exceed; below zero it fails without any
	const Real sliding  = held < 0 ? std::numeric_limits<Real>::infinity() : share(tau, held);
	return std::max({ share(sigma, strength.tension), sliding, share(crushing, strength.compression) });
}

namespace {

	/// Of the outermost segments of a patch that holds and is a whole grid: each of the criteria is convex in the opening.
	Real outermostUtilisation(const Joint& joint, const JointMotion& m, std::size_t patch)
	{
		const CornerVectors d       = joint.shape->patches[patch].outermost * m.patches[patch].opening;
		Real                largest = 0;
		for (int c = 0; c < 4; ++c) {
			const Vector3r opening = d.row(c);
			const Real     un      = opening.dot(m.normal);
			largest = std::max(largest, utilisation(joint.shape->strength, joint.springs.normal * (un - joint.restGap), joint.springs.shear * (opening - un * m.normal).norm()));
		}
		return largest;
	}

} // namespace

Real segmentUtilisation(const Joint& joint, const JointMotion& m, int index)
{
	if (segmentOf(joint, index).state != SegmentState::Intact) return 0;
	const SegmentTraction t = segmentTraction(joint, index, m, joint.shape->strength.tanFriction); // friction is of those that have failed
	return utilisation(joint.shape->strength, t.normal, t.shear.norm());
}

Real utilisation(const Joint& joint, const JointMotion& m)
{
	Real largest = 0;
	int  first   = 0;
	for (std::size_t i = 0; i < m.patches.size(); ++i) {
		const JointPatch& patch = joint.shape->patches[i];
		if (joint.holds() && patch.cut.empty()) largest = std::max(largest, outermostUtilisation(joint, m, i));
		else
			for (int s = first; s < first + patch.count; ++s)
				largest = std::max(largest, segmentUtilisation(joint, m, s));
		first += patch.count;
	}
	return largest;
}

Real largestPrincipalStress(const Matrix3r& moments, Real volume)
{
	const Matrix3r                          stress = (moments + moments.transpose()) / (2 * volume);
	Eigen::SelfAdjointEigenSolver<Matrix3r> solver;
	solver.computeDirect(stress, Eigen::EigenvaluesOnly);
	return solver.eigenvalues().cwiseAbs().maxCoeff();
}

} // namespace brick
