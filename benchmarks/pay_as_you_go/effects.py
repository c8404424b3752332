# SPDX-License-Identifier: GPL-2.0-or-later
# The scenes of the table of effects, and its rows: for each effect a scene with it, the same without, and one where it was on and is off again.
"""Effects and the scenes that show their cost. Pure Python, nothing is run here."""

from dataclasses import asdict, dataclass, replace


@dataclass(frozen=True)
class Scene:
	"""What scene.py builds. By default it is the minimal one: rigid bricks in joints that are elastic, with the engines without which nothing moves.

	:param bricks: columns, and courses, of the wall
	:param steps: that are counted
	:param deformation: level of all bricks
	:param joints: 'intact'; 'cracked': half the segments of every joint have failed; 'dry': none, the bricks press and slide on each other, and stay where they are
	:param contact: collider and search, always there when dry
	:param searchCore: with contact, neighbours that meet at an edge are searched although all their joints hold: without Brick.beside
	:param failure, friction, dashpots: attributes of the law
	:param ledger: O.trackEnergy
	:param guard: BrickDynamics.guard
	:param motion: GroundMotion
	:param stepper: BrickTimeStepper instead of a fixed step
	:param onDemand: DeformationOnDemand, whose criterion is never met
	:param ended: one of these, by name, that is on for the first steps and switched off before those that count
	"""

	bricks: int = 12
	steps: int = 20
	deformation: str = "rigid"
	joints: str = "intact"
	contact: bool = False
	searchCore: bool = False
	failure: bool = False
	friction: bool = False
	dashpots: bool = False
	ledger: bool = False
	guard: bool = False
	motion: bool = False
	stepper: bool = False
	onDemand: bool = False
	ended: str = ""

	@property
	def given(self):
		"""What is not as in the minimal scene."""
		return {name: value for name, value in asdict(self).items() if value != getattr(minimal, name)}

	@property
	def name(self):
		"""A word for files and tables, for example 'joints=cracked,failure'."""
		return ",".join(name if value is True else f"{name}={value}" for name, value in self.given.items()) or "minimal"


minimal = Scene()
full = Scene(
        deformation="trilinear", joints="cracked", contact=True, failure=True, friction=True, dashpots=True, ledger=True, guard=True, motion=True, stepper=True
)
# some things are looked at once in up to a thousand steps
aWindow = Scene(bricks=6, steps=1000)


@dataclass(frozen=True)
class Effect:
	"""A row of the table.

	:param what: in words
	:param on: scene with it
	:param without: the same scene that never had it
	:param off: scene where it was on and is off again, or where it has nothing to do; None where there is no such thing
	:param leftOut: the full scene without it; None for what the full scene does not have
	"""

	what: str
	on: Scene
	without: Scene
	off: Scene = None
	leftOut: Scene = None

	@property
	def scenes(self):
		return [scene for scene in (self.on, self.without, self.off, self.leftOut, full if self.leftOut else None) if scene]


def switched(what, base, name, level=True, leftOut=None):
	"""Effect of one option, which can be switched off again."""
	on = replace(base, **{name: level})
	return Effect(what, on, base, replace(on, ended=name), leftOut)


cracked = Scene(joints="cracked")
# a search takes a hundred times what a joint that holds does
short = Scene(bricks=6, steps=5, contact=True)
dry = replace(short, joints="dry")
effects = (
        switched("deformation: uniform", minimal, "deformation", "uniform", replace(full, deformation="uniform")),
        switched("deformation: trilinear", minimal, "deformation", "trilinear", replace(full, deformation="rigid")),
        Effect("deformation: refined, 2 cells", Scene(deformation="refined"), minimal),
        switched("failure, checked in joints that hold", minimal, "failure"),
        switched("failure, checked in joints that have cracked", cracked, "failure", leftOut=replace(full, failure=False)),
        Effect("joints half of whose segments have failed", cracked, minimal),
        Effect("contact search around an intact wall", Scene(contact=True), minimal, leftOut=replace(full, contact=False)),
        Effect("recontact searched for in the intact core (no lists of neighbours)", replace(short, searchCore=True), short),
        Effect("contact instead of joints: dry wall", dry, short),
        switched("friction in cracked joints", cracked, "friction", leftOut=replace(full, friction=False)),
        switched("friction in contacts", dry, "friction"),
        switched("dashpots in cracked joints", cracked, "dashpots", leftOut=replace(full, dashpots=False)),
        switched("dashpots in contacts", dry, "dashpots"),
        Effect("friction and dashpots where all joints hold", Scene(friction=True, dashpots=True), minimal),
        switched("energy ledger", minimal, "ledger", leftOut=replace(full, ledger=False)),
        switched("guard", aWindow, "guard", leftOut=replace(full, guard=False)),
        switched("ground motion", minimal, "motion", leftOut=replace(full, motion=False)),
        switched("time stepper", aWindow, "stepper", leftOut=replace(full, stepper=False)),
        switched("deformation on demand, all bricks rigid", aWindow, "onDemand"),
)


def scenesOf(rows):
	"""All scenes of some rows, and minimal and full, each once."""
	return list(dict.fromkeys([minimal, full] + [scene for effect in rows for scene in effect.scenes]))
