# SPDX-License-Identifier: GPL-2.0-or-later
# The engine loop of a scene of bricks, chosen in one place: from what the scene contains and what the caller asks. What comes out is YADE's own list of
# engines; the words about it are found from the engines and the scene as they are when asked, so that edits show.
"""The engine loop: `engines` builds it, `effects` says which effects are on, which are off, and why."""

import math
import numbers
import sys
from collections import Counter
from typing import NamedTuple

#: The shortest edge of a brick over the stride of the collider for which none is asked: boxes grow by the stride, so that the collider sleeps until a body
#: may have come so far. Where nothing moves fast any stride above 0 does; a larger one means more pairs of boxes that overlap.
stridesInEdge = 20

#: Kinds of functors that a loop takes, by the class they derive from.
functorKinds = ("BoundFunctor", "IGeomFunctor", "IPhysFunctor", "LawFunctor")

#: Effects that the law leaves out by choice, by its attribute.
lawChoices = ("failure", "friction", "dashpots")

# The loop


def engines(
        *, gravity=(0, 0, -9.81), damping=0, dt=None, safety=0.9, motion=None, failure=None, friction=None, dashpots=None, contact=True, onDemand=None,
        ledger=None, guard=True, stopFile="stopped.yade.gz", verletDist=None, functors=()
):
	"""The loop for the bodies that are in the scene: `O.engines = yade_brick.engines()`; `print` of it says what is on, what is off, and why.

	:param gravity: three numbers [m/s2]; None or 0: none
	:param damping: local non-viscous damping of rigid motion and deformation, 0 <= damping < 1 [-]; 0 for dynamics
	:param dt: fixed time step [s], > 0, which O.dt is set to; None: BrickTimeStepper finds a stable one
	:param safety: share of its bound that BrickTimeStepper takes, in (0, 1]; not used with `dt`
	:param motion: Motion, which begins at the present O.time and pushes all bodies that are free to move, or a GroundMotion engine; None: none
	:param failure: False: mortar is elastic and never fails; None or True: as the strengths of the mortar say
	:param friction: False: none in contacts and failed segments; None or True: by the angles of materials and mortar
	:param dashpots: False: none in contacts and failed segments; None or True: by hn and hs of the materials
	:param contact: False: joints alone, for work in which nothing comes loose: no collider, so no pairs but those that are joined
	:param onDemand: True, a dict of attributes of DeformationOnDemand, or that engine: bricks deform where it matters; None or False: each keeps its level
	:param ledger: True or False: O.trackEnergy is set to it; None: it stays as it is
	:param guard: whether a run that makes energy from nothing is stopped, see BrickDynamics.guard
	:param stopFile: where the scene is saved when a run is stopped; empty: nowhere
	:param verletDist: stride of the collider [m], >= 0; None: a twentieth of the shortest edge of a brick; not used without `contact`
	:param functors: further functors, of bounds, geometry, physics or law, in any order; one for the same types takes the place of ours
	:returns: Loop, a list of engines with functors for the shapes and materials in the scene, ready for O.engines, to be edited at will
	:raises ValueError: naming the argument, its value and what is allowed; or when the scene has no bricks. O.dt and O.trackEnergy are then as they were
	"""
	from yade import BrickDynamics, BrickTimeStepper, ForceResetter, NewtonIntegrator, O
	from . import _core
	if O.running:
		raise ValueError("the simulation is running; allowed is to ask for engines while it is paused")
	gravity = _gravity(gravity)
	damping = _number(damping, "damping", lambda value: 0 <= value < 1, "0 <= damping < 1")
	safety = _number(safety, "safety", lambda value: 0 < value <= 1, "0 < safety <= 1")
	if dt is not None:
		dt = _number(dt, "dt", lambda value: value > 0, "a number of seconds > 0, or None for BrickTimeStepper")
	for name, value in (("contact", contact), ("guard", guard)):
		_choice(value, name, (True, False))
	_choice(ledger, "ledger", (None, True, False))
	if not isinstance(stopFile, str):
		raise ValueError(f"stopFile is {stopFile!r}; allowed is the name of a file, or an empty text")
	given = _byKind(functors)
	scene = _Scene()
	if not scene.levels:
		raise ValueError("the scene has no bricks; add the bodies first, then ask for their engines")
	interaction = _interactionLoop(scene, given, dict(failure=failure, friction=friction, dashpots=dashpots))
	loop = Loop([ForceResetter()])
	loop += _colliders(scene, given, contact, verletDist)
	loop.append(interaction)
	loop += _onDemandEngines(onDemand)
	if dt is None:
		loop.append(BrickTimeStepper(safety=safety))
	loop.append(BrickDynamics(damping=damping, guard=guard, stopFile=stopFile))
	loop += _groundMotions(motion)
	loop.append(NewtonIntegrator(damping=damping, gravity=gravity))
	if dt is not None:
		O.dt = dt
	if ledger is not None:
		O.trackEnergy = ledger
	_core.forgetFunctors()  # or pairs that are in touch already would go on with those of the loop before
	return loop


class Loop(list):
	"""A list of engines, whose parts also have names: each the first of its class in the list as it is now, None when there is none.
	`print` says which effects are on, as `effects` does."""

	@property
	def collider(self):
		"""The collider, None with `contact=False`."""
		return self._first("Collider")

	@property
	def interactionLoop(self):
		"""The InteractionLoop."""
		return self._first("InteractionLoop")

	@property
	def law(self):
		"""The Law2_BrickGeom_BrickPhys_Mortar of the InteractionLoop."""
		return next((functor for functor in self.functors if _isA(functor, "Law2_BrickGeom_BrickPhys_Mortar")), None)

	@property
	def stepper(self):
		"""The BrickTimeStepper or another TimeStepper, None when the step is fixed."""
		return self._first("TimeStepper")

	@property
	def onDemand(self):
		"""The DeformationOnDemand, None when it was not asked for."""
		return self._first("DeformationOnDemand")

	@property
	def dynamics(self):
		"""The BrickDynamics."""
		return self._first("BrickDynamics")

	@property
	def ground(self):
		"""The GroundMotion, None when there is no motion."""
		return self._first("GroundMotion")

	@property
	def newton(self):
		"""The NewtonIntegrator."""
		return self._first("NewtonIntegrator")

	@property
	def functors(self):
		"""All functors of collider and InteractionLoop; a list of its own."""
		dispatchers = [self.collider.boundDispatcher] if self.collider else []
		if self.interactionLoop:
			dispatchers += [self.interactionLoop.geomDispatcher, self.interactionLoop.physDispatcher, self.interactionLoop.lawDispatcher]
		return [functor for dispatcher in dispatchers for functor in dispatcher.functors]

	def _first(self, name):
		return next((engine for engine in self if _isA(engine, name)), None)

	def __str__(self):
		return str(effects(self))


def _isA(thing, name):
	"""Whether a class of this name is among those of the thing."""
	return any(kind.__name__ == name for kind in type(thing).__mro__)


# Arguments


def _number(value, name, holds, allowed):
	if isinstance(value, bool) or not isinstance(value, numbers.Real) or not abs(value) <= sys.float_info.max or not holds(value):
		raise ValueError(f"{name} is {value!r}; allowed is {allowed}")
	return float(value)


def _choice(value, name, allowed):
	if not any(value is choice for choice in allowed):
		raise ValueError(f"{name} is {value!r}; allowed is {', '.join(map(str, allowed[:-1]))} or {allowed[-1]}")


def _gravity(value):
	"""Three finite numbers."""
	from yade import Vector3
	wanted = "three finite numbers [m/s2], or None"
	if value is None or (isinstance(value, numbers.Real) and not isinstance(value, bool) and value == 0):
		return Vector3(0, 0, 0)
	try:
		found = [float(number) for number in value] if not isinstance(value, (str, dict)) else []
	except (TypeError, ValueError, OverflowError):
		found = []
	if len(found) != 3 or not all(map(math.isfinite, found)):
		raise ValueError(f"gravity is {value!r}; allowed are {wanted}")
	return Vector3(*found)


def _byKind(functors):
	"""The functors that were given, for each of `functorKinds` those of that kind."""
	if not isinstance(functors, (list, tuple)):
		raise ValueError(f"functors is {functors!r}; allowed is a list of functors")
	sorted_ = {kind: [functor for functor in functors if _isA(functor, kind)] for kind in functorKinds}
	for functor in functors:
		if not any(_isA(functor, kind) for kind in functorKinds):
			raise ValueError(f"functors has {functor!r}; allowed are functors of bounds (Bo1), geometry (Ig2), physics (Ip2) and law (Law2)")
	for kind, found in sorted_.items():
		types, times = next(iter(Counter(map(_types, found)).most_common(1)), ((), 0))
		if times > 1:
			raise ValueError(f"functors has {times} of the kind {kind} for {' and '.join(types)}; allowed is one")
	return sorted_


def _types(functor):
	"""What a functor is for, whatever the order: the names of its types."""
	return tuple(sorted(functor.bases))


# Parts of the loop


def _merged(ours, given):
	"""Functors of one kind: ours but for those in whose place others were given."""
	taken = set(map(_types, given))
	return [functor for functor in ours if _types(functor) not in taken] + given


def _colliders(scene, given, contact, verletDist):
	from yade import Bo1_Box_Aabb, Bo1_Brick_Aabb, Bo1_Wall_Aabb, InsertionSortCollider
	if verletDist is not None:
		verletDist = _number(verletDist, "verletDist", lambda value: value >= 0, "a number >= 0 m")
	bounds = given["BoundFunctor"]
	if not contact:
		if bounds:
			raise ValueError(f"functors has {_className(bounds[0])}, but contact is False; allowed are functors of bounds only with contact=True")
		return []
	ours = scene.forShapes(Brick=Bo1_Brick_Aabb, Wall=Bo1_Wall_Aabb, Box=Bo1_Box_Aabb)
	return [InsertionSortCollider(_merged(ours, bounds), verletDist=scene.shortestEdge() / stridesInEdge if verletDist is None else verletDist)]


def _interactionLoop(scene, given, choices):
	from yade import Ig2_Box_Brick_BrickGeom, Ig2_Brick_Brick_BrickGeom, Ig2_Wall_Brick_BrickGeom, InteractionLoop
	from yade import Ip2_BrickMat_BrickMat_BrickPhys, Ip2_FrictMat_BrickMat_BrickPhys, Law2_BrickGeom_BrickPhys_Mortar
	for name, value in choices.items():
		_choice(value, name, (None, True, False))
	geometry = scene.forShapes(Brick=Ig2_Brick_Brick_BrickGeom, Wall=Ig2_Wall_Brick_BrickGeom, Box=Ig2_Box_Brick_BrickGeom)
	physics = [Ip2_BrickMat_BrickMat_BrickPhys()] + ([Ip2_FrictMat_BrickMat_BrickPhys()] if scene.hasPlainSupport else [])
	laws = _merged([Law2_BrickGeom_BrickPhys_Mortar()], given["LawFunctor"])
	loop = InteractionLoop(_merged(geometry, given["IGeomFunctor"]), _merged(physics, given["IPhysFunctor"]), laws)
	law = Loop([loop]).law
	for name, value in choices.items():
		if value is None:
			continue
		if law is None:
			raise ValueError(f"{name} is {value}, but functors has another law for bricks; allowed is None")
		setattr(law, name, value)
	return loop


def _onDemandEngines(wanted):
	if wanted is None or wanted is False:
		return []
	if _isA(wanted, "DeformationOnDemand"):
		return [wanted]
	if wanted is not True and not isinstance(wanted, dict):
		raise ValueError(f"onDemand is {wanted!r}; allowed is True, False, a dict of attributes of DeformationOnDemand, or the engine itself")
	from yade import DeformationOnDemand
	attributes = {} if wanted is True else wanted
	try:
		return [DeformationOnDemand(**attributes)]
	except (AttributeError, TypeError, ValueError) as problem:
		raise ValueError(f"onDemand is {wanted!r}; allowed are attributes of DeformationOnDemand with values that it takes: {problem}") from None


def _groundMotions(motion):
	from yade import O
	from .build import groundMotion
	from .motion import Motion
	if motion is None:
		return []
	if _isA(motion, "GroundMotion"):
		return [motion]
	if not isinstance(motion, Motion):
		raise ValueError(f"motion is {motion!r}; allowed is a Motion, a GroundMotion or None")
	return [groundMotion(motion, startTime=O.time)]


# The scene


class _Clay(NamedTuple):
	"""What effects depend on in a BrickMat; mortarAngle is None without mortar."""

	frictionAngle: float
	hn: float
	hs: float
	dampingRatio: float
	mortarAngle: float

	@classmethod
	def of(cls, m):
		return cls(m.frictionAngle, m.hn, m.hs, m.dampingRatio, m.mortar.frictionAngle if m.mortar else None)


class _Scene:
	"""What the loop and its effects depend on in O.bodies, as it is now."""

	def __init__(self):
		from yade import Box, Brick, BrickMat, O, Wall
		self.levels = Counter()  # bricks at each level of deformation
		self.changing = 0  # bricks on the way to it
		self.shapes = set()  # classes
		self.clays = set()  # of bricks
		self.hasPlainSupport = False  # of another material than BrickMat
		self.laid = False  # mortar at any brick, ever
		self.spared = 0  # bricks that are not searched against those laid edge to edge
		for body in O.bodies:
			shape, material = body.shape, body.material
			if shape is None or body.isClump:
				continue
			self.shapes.add(type(shape))
			if isinstance(shape, Brick):
				self.levels[shape.deformation] += 1
				self.changing += shape.share < 1
				self.laid = self.laid or shape.joints > 0
				self.spared += shape.whole and len(shape.beside) > 0
				if isinstance(material, BrickMat):
					self.clays.add(_Clay.of(material))
			elif isinstance(shape, (Wall, Box)):
				self.hasPlainSupport = self.hasPlainSupport or not isinstance(material, BrickMat)

	@property
	def bricks(self):
		return sum(self.levels.values())

	@property
	def mortared(self):
		return any(clay.mortarAngle is not None for clay in self.clays)

	def forShapes(self, **functors):
		"""A functor for each shape of the given names that the scene has."""
		return [functor() for name, functor in functors.items() if any(name in _namesOf(shape) for shape in self.shapes)]

	def shortestEdge(self):
		"""Of all bricks [m]."""
		from yade import Brick, O
		from .build import shortestEdge
		return min(shortestEdge(body.shape.corners) for body in O.bodies if isinstance(body.shape, Brick))

	def pairs(self):
		"""BrickPhys of all joints and contacts."""
		from yade import BrickPhys, O
		return [phys for interaction in O.interactions.all(onlyReal=True) if isinstance(phys := interaction.phys, BrickPhys)]


def _namesOf(kind):
	return [base.__name__ for base in kind.__mro__]


def _className(thing):
	return type(thing).__name__


# Words


class Effect(NamedTuple):
	"""An effect of a loop.

	:param name: what it is
	:param on: whether it is computed
	:param why: how, and why or why not
	"""

	name: str
	on: bool
	why: str


class Effects(tuple):
	"""Records of `Effect`, which `print` shows one a line; effects()['friction'] is the one of that name."""

	def __getitem__(self, place):
		if not isinstance(place, str):
			return super().__getitem__(place)
		for effect in self:
			if effect.name == place:
				return effect
		raise KeyError(f"{place!r}; effects are {', '.join(effect.name for effect in self)}")

	def __str__(self):
		width = max((len(effect.name) for effect in self), default=0)
		return "\n".join(f"{effect.name:{width}}  {'on ' if effect.on else 'off'}  {effect.why}" for effect in self)


def effects(engines=None):
	"""Which effects a loop has in the present scene, and why: found from engines and bodies as they are now.

	:param engines: list of engines; None: O.engines. Those that are dead count as not there
	:returns: Effects: records of name, on and why, which `print` shows one a line
	:raises ValueError: for anything else than engines

	>>> print(yade_brick.effects()['gravity'].why)
	(0, 0, -9.81) m/s2
	"""
	from yade import O
	given = O.engines if engines is None else engines
	if not isinstance(given, (list, tuple)) or not all(_isA(engine, "Engine") for engine in given):
		raise ValueError(f"engines is {engines!r}; allowed is a list of engines, or None for O.engines")
	loop, scene = Loop(engine for engine in given if not engine.dead), _Scene()
	return Effects(Effect(name, *found(loop, scene)) for name, found in _effects.items())


_noLaw = "no Law2_BrickGeom_BrickPhys_Mortar in the loop"
_noDynamics = "no BrickDynamics in the loop: bricks feel neither joints nor contacts"


def _deformation(loop, scene):
	if loop.dynamics is None:
		return False, _noDynamics
	if not scene.bricks:
		return False, "no bricks in the scene"
	if set(scene.levels) == {"rigid"} and not scene.changing:
		return False, f"{_counted(scene.bricks, 'brick')}, all rigid"
	why = " and ".join(f"{count} {level}" for level, count in scene.levels.most_common()) + (" brick" if scene.bricks == 1 else " bricks")
	return True, why + (f", {scene.changing} of which change to that level at present" if scene.changing else "")


def _deformationOnDemand(loop, scene):
	engine = loop.onDemand
	if engine is None:
		return False, "not asked for: bricks keep their level of deformation"
	stress = "" if math.isnan(engine.stress) else f" or {engine.stress:g} Pa in the brick"
	return True, (
	        f"{engine.level} from {engine.utilisation:g} of a joint's strength{stress}, looked at every {_counted(engine.interval, 'step')}; "
	        f"{engine.promoted} promoted, {engine.demoted} demoted so far"
	)


def _mortar(loop, scene):
	if loop.law is None:
		return False, _noLaw
	if holding := sum(phys.jointed for phys in scene.pairs()):
		return True, f"{_counted(holding, 'joint')}, holding in full or in part"
	if scene.laid:
		return False, "all joints have failed"
	if loop._first("MortarJoints"):
		return True, "MortarJoints lays it in the first step"
	if scene.mortared:
		return False, "not laid yet, though materials have it: call MortarJoints()()"
	return False, "dry: no material has it"


def _failure(loop, scene):
	law = loop.law
	if law is None:
		return False, _noLaw
	if not law.failure:
		return False, "left out: failure of the law is False, segments that hold never fail"
	if not scene.laid and not scene.mortared:
		return False, "no mortar that could fail"
	failed = law.tensionFailures + law.shearFailures + law.compressionFailures
	return True, f"segment by segment, by the strengths of the mortar; {_counted(failed, 'segment')} failed so far"


def _contact(loop, scene):
	if loop.collider is None:
		return False, "joints alone: no collider, so bodies that are not joined pass through each other"
	if loop.law is None:
		return False, _noLaw
	missing = [name for name in ("Bo1_Brick_Aabb", "Ig2_Brick_Brick_BrickGeom") if not any(_isA(functor, name) for functor in loop.functors)]
	if missing:
		return False, f"no {' and no '.join(missing)} in the loop"
	untouched = _untouched(loop, scene)
	why = f"with whatever comes near; the collider strides by {1e3 * loop.collider.verletDist:g} mm"
	return True, why + (f"; none for {', '.join(untouched)}: no functors" if untouched else "")


def _contactInCore(loop, scene):
	searched, why = _contact(loop, scene)
	if not searched:
		return False, why
	if scene.spared:
		return False, f"not searched between bricks laid edge to edge while their joints hold: now for {scene.spared} of {_counted(scene.bricks, 'brick')}"
	return True, "searched everywhere: no brick has all its joints"


def _untouched(loop, scene):
	"""Shapes of the scene that no functor of geometry is for."""
	known = {name for functor in loop.functors if _isA(functor, "IGeomFunctor") for name in functor.bases}
	return sorted(shape.__name__ for shape in scene.shapes if not known & set(_namesOf(shape)))


def _friction(loop, scene):
	if loop.law is None:
		return False, _noLaw
	if not loop.law.friction:
		return False, "left out: friction of the law is False"
	angles = [angle for clay in scene.clays for angle in (clay.frictionAngle, clay.mortarAngle) if angle is not None]
	angles += {math.atan(phys.tangensOfFrictionAngle) for phys in scene.pairs()}
	if not any(angle > 0 for angle in angles):
		return False, "no material and no mortar has an angle of friction"
	return True, f"in contacts and failed segments; angle {_range(map(math.degrees, angles))} degrees"


def _dashpots(loop, scene):
	if loop.law is None:
		return False, _noLaw
	if not loop.law.dashpots:
		return False, "left out: dashpots of the law is False"
	if not any(clay.hn or clay.hs for clay in scene.clays):
		return False, "hn and hs of all materials are 0"
	return True, f"in contacts and failed segments; hn {_range(clay.hn for clay in scene.clays)}, hs {_range(clay.hs for clay in scene.clays)}"


def _damping(loop, scene):
	rigid, modes = loop.newton.damping if loop.newton else 0, loop.dynamics.damping if loop.dynamics else 0
	ratios = [clay.dampingRatio for clay in scene.clays]
	said = [f"local, {rigid:g} of rigid motion and {modes:g} of deformation"] if rigid or modes else []
	if any(ratios):
		said.append(f"{_range(ratios)} of critical damping of the deformation")
	return bool(said), "; ".join(said) if said else "0 for rigid motion and deformation"


def _gravityWords(loop, scene):
	if loop.newton is None:
		return False, "no NewtonIntegrator in the loop"
	gravity = tuple(loop.newton.gravity)
	return any(gravity), f"({', '.join(f'{value:g}' for value in gravity)}) m/s2"


def _groundMotion(loop, scene):
	found = [_motionWords(engine) for engine in loop if _isA(engine, "GroundMotion")]
	return bool(found), "; ".join(found) if found else "none given"


def _motionWords(ground):
	samples = ground.acceleration
	peak, duration = max((sample.norm() for sample in samples), default=0), max(len(samples) - 1, 0) * ground.dt
	how = f"moves {_counted(len(ground.ids), 'body', 'bodies')}" if ground.ids else "pushes all bodies that are free to move"
	return f"{how}; {duration:g} s from O.time = {ground.startTime:g} s, up to {peak:.3g} m/s2"


def _ledger(loop, scene):
	from yade import O
	return O.trackEnergy, "O.energy tells where energy went" if O.trackEnergy else "O.trackEnergy is False"


def _guard(loop, scene):
	dynamics = loop.dynamics
	if dynamics is None:
		return False, _noDynamics
	if not dynamics.guard:
		return False, "guard of BrickDynamics is False"
	return True, "a run that makes energy from nothing stops" + (f"; the scene is then saved as {dynamics.stopFile!r}" if dynamics.stopFile else "")


def _timeStep(loop, scene):
	from yade import O
	stepper = loop.stepper
	if stepper is None or not stepper.active:
		return False, f"fixed: O.dt = {O.dt:g} s"
	if not _isA(stepper, "BrickTimeStepper"):
		return False, f"by {_className(stepper)}, which does not know bricks"
	bound = f" of {stepper.limit:.3g} s" if math.isfinite(stepper.limit) else ""
	return True, f"BrickTimeStepper takes {stepper.safety:g} of a proven bound{bound}"


def _besides(loop, scene):
	usual = ("ForceResetter", "Collider", "InteractionLoop", "TimeStepper", "DeformationOnDemand", "BrickDynamics", "GroundMotion", "NewtonIntegrator")
	others = [engine for engine in loop if not any(_isA(engine, name) for name in usual)]
	names = [_className(engine) + (f" '{engine.label}'" if engine.label else "") for engine in others]
	return bool(names), ", ".join(names) if names else "no other engines"


_effects = {
        "deformation": _deformation,
        "deformation on demand": _deformationOnDemand,
        "mortar": _mortar,
        "mortar failure": _failure,
        "contact": _contact,
        "contact in the core": _contactInCore,
        "friction": _friction,
        "dashpots": _dashpots,
        "damping": _damping,
        "gravity": _gravityWords,
        "ground motion": _groundMotion,
        "energy ledger": _ledger,
        "guard": _guard,
        "stable time step": _timeStep,
        "besides": _besides,
}


def _counted(count, one, several=None):
	return f"{count} {one if count == 1 else several or one + 's'}"


def _range(values):
	"""Smallest and largest, with three digits."""
	values = [f"{value:.3g}" for value in sorted(values)]
	return values[0] if values[0] == values[-1] else f"{values[0]} to {values[-1]}"
