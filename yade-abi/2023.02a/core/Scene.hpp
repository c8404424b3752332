// SPDX-License-Identifier: GPL-2.0-or-later
//
// The whole simulation. Loading a file makes a new one: never keep a pointer to it over steps.
#pragma once

#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/Cell.hpp>
#include <core/EnergyTracker.hpp>
#include <core/ForceContainer.hpp>
#include <core/InteractionContainer.hpp>
#include <core/Material.hpp>

namespace yade {

class Engine;
class OpenGLRenderer;
class DisplayParameters;

class Scene : public Serializable {
	unsigned int hostNameMax;

public:
	ForceContainer                             forces;
	double                                     SpeedElements[10];
	shared_ptr<OpenGLRenderer>                 renderer;
	long                                       prevTime;
	Real                                       dt;
	long                                       iter;
	bool                                       subStepping;
	int                                        subStep;
	Real                                       time, speed;
	long                                       stopAtIter;
	Real                                       stopAtTime;
	bool                                       isPeriodic, trackEnergy, doSort, runInternalConsistencyChecks;
	Body::id_t                                 selectedBody;
	int                                        subdomain;
	shared_ptr<Shape>                          subD;
	std::vector<std::string>                   tags;
	std::vector<shared_ptr<Engine>>            engines, _nextEngines;
	shared_ptr<BodyContainer>                  bodies;
	shared_ptr<InteractionContainer>           interactions;
	shared_ptr<EnergyTracker>                  energy;
	std::vector<shared_ptr<Material>>          materials;
	shared_ptr<Bound>                          bound;
	shared_ptr<Cell>                           cell;
	std::vector<shared_ptr<Serializable>>      miscParams;
	std::vector<shared_ptr<DisplayParameters>> dispParams;

	Scene() = delete; // YADE makes them
	YADE_HOST_CLASS(Scene)

	shared_ptr<Engine> engineByName(const std::string& className);
};
YADE_ABI_SIZE(Scene, 752)
YADE_ABI_OFFSET(Scene, forces, 32)
YADE_ABI_OFFSET(Scene, dt, 440)
YADE_ABI_OFFSET(Scene, iter, 448)
YADE_ABI_OFFSET(Scene, time, 464)
YADE_ABI_OFFSET(Scene, isPeriodic, 496)
YADE_ABI_OFFSET(Scene, selectedBody, 500)
YADE_ABI_OFFSET(Scene, engines, 552)
YADE_ABI_OFFSET(Scene, bodies, 600)
YADE_ABI_OFFSET(Scene, interactions, 616)
YADE_ABI_OFFSET(Scene, energy, 632)
YADE_ABI_OFFSET(Scene, cell, 688)
YADE_ABI_OFFSET(Scene, dispParams, 728)

} // namespace yade
