# SPDX-License-Identifier: GPL-2.0-or-later
# Where a bill puts the time of engines and functors, and what it says of the time step, on scenes that are made up: no YADE needed.
"""Tests of yade_brick.bill."""

import json
import time
import types
import unittest

import numpy as np

import standalone

bill = standalone.load("bill")
signs = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])


class Engine:
	label, execTime, execCount = "", 0, 0

	def __init__(self, **attributes):
		vars(self).update(attributes)


def kind(name, base=Engine):
	return type(name, (base,), {})


Collider = kind("Collider")
InsertionSortCollider = kind("InsertionSortCollider", Collider)
InteractionLoop, BrickDynamics, BrickTimeStepper = kind("InteractionLoop"), kind("BrickDynamics"), kind("BrickTimeStepper")
ForceResetter, NewtonIntegrator, GroundMotion = kind("ForceResetter"), kind("NewtonIntegrator"), kind("GroundMotion")
Mortar, OtherLaw, Geometry = kind("Law2_BrickGeom_BrickPhys_Mortar"), kind("Law2_ScGeom_FrictPhys_CundallStrack"), kind("Ig2_Brick_Brick_BrickGeom")
Brick, Wall, BrickPhys = kind("Brick"), kind("Wall"), kind("BrickPhys")


class Interactions(list):

	def withBody(self, id):
		return [interaction for interaction in self if id in (interaction.id1, interaction.id2)]


def brickBody(id, deformation, centre):
	shape = Brick(deformation=deformation, worldCorners=lambda state: np.array(centre) + 0.5 * signs)
	return types.SimpleNamespace(id=id, shape=shape, state=None)


def interaction(id1, id2, point, jointed=True, states=(0, 0), area=1.0):
	phys = BrickPhys(jointed=jointed, segmentState=list(states))
	return types.SimpleNamespace(id1=id1, id2=id2, isReal=True, phys=phys, geom=types.SimpleNamespace(contactPoint=point, area=area))


class FakeScene:
	"""A wall below, a deformable brick on it, a rigid one above, and engines whose clocks `work` moves on."""

	def __init__(self, threads=1):
		self.timingEnabled, self.numThreads, self.time, self.iter, self.dt = False, threads, 1.0, 10, 0.5
		self.law, self.geometry = Mortar(jointSeconds=7.0, contactSeconds=1.0), Geometry(seconds=3.0)
		self.collider, self.newton = InsertionSortCollider(execTime=5e9), NewtonIntegrator()
		self.loop = InteractionLoop(execTime=2e9, geomDispatcher=types.SimpleNamespace(functors=[self.geometry, Engine()]))
		self.loop.lawDispatcher = types.SimpleNamespace(functors=[OtherLaw(), self.law])
		self.stepper, self.dynamics = BrickTimeStepper(limit=0.6, limitingBrick=1, limitingFace=4), BrickDynamics()
		self.engines = [ForceResetter(), self.collider, self.loop, self.stepper, self.dynamics, self.newton]
		self.bodies = [types.SimpleNamespace(id=0, shape=Wall(), state=None), brickBody(1, "trilinear", (0, 0, 0.5)), brickBody(2, "rigid", (0, 0, 1.5)), None]
		self.interactions = Interactions([interaction(0, 1, (0.1, 0, 0)), interaction(1, 2, (0, 0.2, 1), states=(0, 1))])
		self.interactions.append(interaction(1, 2, (0.49, 0, 0), jointed=False, states=(), area=1e-4))

	def work(self, steps=4):
		"""A tenth of a second in which engines take 10 ms each and the loop 40 ms."""
		for engine in self.engines:
			engine.execTime += 40e6 if engine is self.loop else 10e6
		self.geometry.seconds += 0.004
		self.law.jointSeconds += 0.020
		self.law.contactSeconds += 0.008
		self.iter, self.time = self.iter + steps, self.time + 0.5 * steps
		time.sleep(0.1)


class BillTest(unittest.TestCase):

	def facts(self, scene, work=None):
		with bill.Bill(scene) as made:
			(work or scene.work)()
		return made.facts()

	def seconds(self, facts):
		return {name: stage["seconds"] for name, stage in facts["stages"].items()}

	def test_time_goes_to_its_stage(self):
		seconds = self.seconds(self.facts(FakeScene()))
		expected = {"detection": 0.014, "joints": 0.020, "contacts": 0.008, "dynamics": 0.010, "time step": 0.010, "YADE": 0.028}
		for name, value in expected.items():
			self.assertAlmostEqual(seconds[name], value, places=12, msg=name)
		self.assertEqual(set(seconds) - set(expected), {"between steps"})

	def test_stages_add_up_to_the_elapsed_time(self):
		facts = self.facts(FakeScene())
		self.assertGreaterEqual(facts["wallSeconds"], 0.1)
		self.assertAlmostEqual(sum(self.seconds(facts).values()), facts["wallSeconds"], places=12)
		self.assertAlmostEqual(sum(stage["share"] for stage in facts["stages"].values()), 1, places=12)
		self.assertAlmostEqual(facts["secondsPerSimulatedSecond"], facts["wallSeconds"] / 2, places=12)
		self.assertAlmostEqual(facts["microsecondsPerBrickStep"], 1e6 * facts["wallSeconds"] / 4 / 2, places=6)
		self.assertEqual((facts["steps"], facts["bricks"], facts["deformableShare"], facts["simulatedSeconds"]), (4, 2, 0.5, 2))

	def test_sums_over_threads_are_scaled_to_the_loops_elapsed_time(self):
		seconds = self.seconds(self.facts(FakeScene(threads=2)))
		for name, value in {"detection": 0.012, "joints": 0.010, "contacts": 0.004, "YADE": 0.044}.items():
			self.assertAlmostEqual(seconds[name], value, places=12, msg=name)

	def test_functors_never_get_more_than_their_loop_took(self):
		scene = FakeScene()

		def work():
			scene.work()
			scene.law.jointSeconds += 0.032

		seconds = self.seconds(self.facts(scene, work))
		for name, value in {"detection": 0.0125, "joints": 0.0325, "contacts": 0.005, "YADE": 0.020}.items():
			self.assertAlmostEqual(seconds[name], value, places=12, msg=name)

	def test_other_engines_go_by_their_names(self):
		scene = FakeScene()
		scene.engines += [GroundMotion(), GroundMotion(label="shake")]
		added = kind("PyRunner")()

		def work():
			scene.engines = scene.engines + [added]
			scene.work()

		seconds = self.seconds(self.facts(scene, work))
		for name in ("GroundMotion", "shake", "PyRunner"):
			self.assertAlmostEqual(seconds[name], 0.01, places=12)

	def test_timing_is_given_back_as_it_was(self):
		for before in (False, True):
			scene = FakeScene()
			scene.timingEnabled = before
			opened = bill.Bill(scene).start()
			self.assertTrue(scene.timingEnabled)
			scene.work()
			opened.stop()
			self.assertEqual(scene.timingEnabled, before)
			with self.assertRaises(KeyError):
				with opened:
					raise KeyError
			self.assertEqual(scene.timingEnabled, before)

	def test_misuse_is_refused(self):
		scene = FakeScene()
		made = bill.Bill(scene)
		for call, word in ((made.stop, "not open"), (made.facts, "not been stopped"), (lambda: made.start().start(), "open already"), (made.stop, "0 steps")):
			with self.assertRaisesRegex(RuntimeError, word):
				call()
		self.assertFalse(scene.timingEnabled)

	def test_scene_without_the_law_of_bricks_is_refused(self):
		for change in (lambda scene: scene.engines.remove(scene.loop), lambda scene: scene.loop.lawDispatcher.functors.remove(scene.law)):
			scene = FakeScene()
			change(scene)
			with self.assertRaisesRegex(RuntimeError, "InteractionLoop with a Law2_BrickGeom_BrickPhys_Mortar"):
				bill.Bill(scene).start()
			self.assertFalse(scene.timingEnabled)

	def test_joints_and_contacts_are_counted(self):
		facts = self.facts(FakeScene())
		self.assertEqual((facts["joints"], facts["crackedJoints"], facts["contacts"]), (2, 1, 1))
		self.assertGreater(facts["residentMemory"], 2**20)

	def test_limit_names_brick_face_and_partner(self):
		# brick 2 also meets an edge of the face, with a ten thousandth of its area: no partner
		scene = FakeScene()
		expected = {"step": 0.6, "brick": 1, "level": "trilinear", "face": "-z", "partners": ["Wall 0"]}
		self.assertEqual(self.facts(scene)["limit"], expected)
		self.assertEqual(bill.limitText(expected), "trilinear brick 1, face -z to Wall 0")
		scene.stepper.limitingFace = 5
		self.assertEqual(bill.stepLimit(scene)["partners"], ["rigid brick 2"])
		scene.stepper.limitingFace = 0
		self.assertEqual(bill.limitText(bill.stepLimit(scene)), "trilinear brick 1, face -x to its like")
		scene.bodies[1].shape.deformation, scene.bodies[1].shape.cells = "refined", 3
		scene.stepper.limitingFace = -1
		self.assertEqual(bill.limitText(bill.stepLimit(scene)), "refined 3 brick 1")

	def test_step_that_no_stepper_set_has_no_limit(self):
		scene = FakeScene()
		scene.stepper.limit = float("inf")
		self.assertIsNone(self.facts(scene)["limit"])
		scene.engines.remove(scene.stepper)
		self.assertIsNone(self.facts(scene)["limit"])

	def test_facts_are_json_and_the_table_names_all(self):
		with bill.Bill(scene := FakeScene()) as made:
			scene.work()
		json.dumps(made.facts(), allow_nan=False)
		text = made.table()
		expected = ["4 steps of 2 bricks, 50 % deformable", "limited by trilinear brick 1, face -z to Wall 0", "2 joints, 1 of them cracked; 1 contacts"]
		for words in [*made.facts()["stages"], *expected]:
			self.assertIn(words, text)


if __name__ == "__main__":
	unittest.main()
