// SPDX-License-Identifier: GPL-2.0-or-later
// Bricks that are rigid until their deformation matters. What tells is in kernel/Utilisation; the change itself is BrickDynamics'.
#pragma once

#include "BrickContact.hpp"

#include <core/GlobalEngine.hpp>

namespace yade {

class DeformationOnDemand : public GlobalEngine {
public:
	void action() override;
	void postLoad(DeformationOnDemand&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(DeformationOnDemand, GlobalEngine, R"(Lets bricks be rigid until their deformation matters, and again when it does no more. Make them with ``deformation='rigid'`` and a :yref:`contactThickness<Brick.contactThickness>`; stands after :yref:`InteractionLoop` and before :yref:`BrickDynamics`, which makes the change without a jump within :yref:`BrickDynamics.levelTime`.

A brick deforms from the look on at which a joint of it uses :yref:`utilisation<DeformationOnDemand.utilisation>` of its mortar's strength, or its mean stress passes :yref:`stress<DeformationOnDemand.stress>`. It is rigid again when both have stayed below :yref:`release<DeformationOnDemand.release>` of these for :yref:`patience<DeformationOnDemand.patience>`, so also when it flies free; bricks whose mortar has all failed count with their stress only. While no brick deforms, :yref:`BrickTimeStepper` takes the longer steps of rigid bricks.)",
		((string, level, "trilinear", Attr::triggerPostLoad, "How bricks deform that do: 'uniform' or 'trilinear'. Bricks of another level, but 'rigid', are left alone."))
		((Real, utilisation, .5, Attr::triggerPostLoad, "Stress of a joint as a share of its mortar's strength, in the mode nearest to failure, from which its bricks deform; above 0."))
		((Real, stress, NaN, Attr::triggerPostLoad, "Magnitude of the largest principal stress of a brick's mean stress, by the forces on its surface, from which it deforms [Pa]; above 0, NaN: does not count."))
		((Real, release, .5, Attr::triggerPostLoad, "Share of utilisation and stress below which bricks may be rigid again, 0 (never) to 1."))
		((Real, patience, .1, Attr::triggerPostLoad, "Time that they have to be below for that [s]."))
		((int, interval, 10, Attr::triggerPostLoad, "Steps from look to look, 1 or more."))
		((vector<int>, ids, , , "Only these bricks; empty: all that can move."))
		((long, promoted, 0, Attr::readonly, "Changes to deformable so far."))
		((long, demoted, 0, Attr::readonly, "Changes to rigid so far."))
		((vector<Real>, lowSince, , Attr::hidden, "Time since which a deformable brick is below, by id; NaN: it is not."))
	);
	// clang-format on

private:
	std::vector<Body::id_t> candidates() const;
	Real                    demand(const Body&) const;
	void                    decide(Body&, Real demand);
};
REGISTER_SERIALIZABLE(DeformationOnDemand);

} // namespace yade
