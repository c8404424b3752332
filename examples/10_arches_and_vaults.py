# SPDX-License-Identifier: GPL-2.0-or-later
"""Arches and a barrel vault of voussoirs on piers: built, checked, joined, and brought to rest under their weight.

    build/yade -n -x examples/10_arches_and_vaults.py [--dry] [--only NAME] [--out DIR] [--help]

             ___keystone___              semicircular   span 3 m, rise 1.5 m
          _/    |     |    \_            segmental      span 3 m, rise 0.8 m, on wider piers: it thrusts more
        _/ \   _|_____|_   / \_          pointed        span 3 m, rise 2.4 m, a joint at the crown
       /    \_/         \_/    \         barrel vault   3 m long, bricks of 0.6 m in running bond, the last one cut
      |_____|             |_____|  z
      | pier|             | pier|  |     Every structure stands on the ground (a Wall) by the same lime mortar as it is built
      |_____|             |_____|  +-> x with. StaticEquilibrium finds the state of rest at once, with all joints holding.

To be seen: what `checkMasonry` and the lists of joints say; that joints at the crown and under the feet balance the weight; and in the pictures the
largest compression in each brick, which grows from the crown to the springings and is less where the piers are wider.

With --dry, joints bear no tension and have friction alone: StaticEquilibrium is then only where the run begins. Joints open where there was tension
(marked in the pictures), and the structure comes to rest anew, in the loop, with damping (some minutes with the vault; the arches take seconds each).

Leaves in DIR: a picture of each structure, gallery.png, a list of joints of each as CSV, result.json.
"""

import argparse
import math
import os
import sys

import numpy as np

import yade_brick
from yade_brick import Piers, arch, barrelVault, pointedLine, report, segmentalLine, semicircularLine
from yade_brick.snapshot import patches

gravity = 9.81  # [m/s2]
depth = 0.5  # of the arches [m]


def limestone(dry):
	"""Soft limestone in lime mortar; dry: friction alone holds the joints."""
	strengths = dict(tensileStrength=0, cohesion=0) if dry else dict(tensileStrength=1e5, cohesion=1.5e5)
	mortar = yade_brick.Mortar(frictionAngle=math.radians(35), compressiveStrength=3e6, **strengths)
	return yade_brick.BrickMat(young=3e9, poisson=0.2, density=2000, frictionAngle=math.radians(35), mortar=mortar)


#: Name of each structure, how it is built of bricks with given options, and how many joints it has.
structures = {
        "semicircular": (lambda **options: arch(semicircularLine(3), 0.3, depth, 21, abutments=Piers(1.5, 5, 0.7), **options), 32),
        "segmental": (lambda **options: arch(segmentalLine(3, rise=0.8), 0.3, depth, 17, abutments=Piers(1.5, 5, 1.1), **options), 28),
        "pointed": (lambda **options: arch(pointedLine(3, rise=2.4), 0.3, depth, 20, abutments=Piers(1.5, 5, 0.6), **options), 31),
        "barrel vault": (lambda **options: barrelVault(semicircularLine(3), 0.3, 2.8, 21, 0.6, abutments=Piers(1.2, 4, 0.8), **options), None),
}
pierHeights = {"semicircular": 1.5, "segmental": 1.5, "pointed": 1.5, "barrel vault": 1.2}


def build(name, dry):
	"""The structure on the ground, checked and with mortar; its Arch, its joints, and what the check said."""
	O.reset()
	stone = limestone(dry)
	O.materials.append(stone)
	make, _ = structures[name]
	masonry = make(origin=(0, 0, pierHeights[name]), material=stone, element="incompatible")
	O.bodies.append(masonry.bodies)
	O.bodies.append(wall(0, axis=2, sense=1, material=stone))
	O.engines = yade_brick.engines(gravity=(0, 0, -gravity), damping=0.7 if dry else 0)
	check = yade_brick.checkMasonry()
	return masonry, yade_brick.layMortar(along=(0, 1, 0) if name == "barrel vault" else None), check


def rest(dry):
	"""Brings it to rest; how many segments of mortar were beyond their strength, and marks of those that have failed."""
	settled = yade_brick.StaticEquilibrium()
	settled()
	O.step()  # joints' forces are known from now on
	record = yade_brick.JointRecord()
	if dry:
		for _ in range(100):
			O.run(500, True)
			if yade_brick.isAtRest(energyRatio=1e-6, imbalance=1e-3):
				break
	record.update()
	return settled.overloaded, record.marks()


def forceOn(ids, others):
	"""Force [N] and moment about the origin [N m] by joints and contacts of bodies `others` on bodies `ids`."""
	force, moment = np.zeros(3), np.zeros(3)
	for i in O.interactions:
		if {i.id1 in ids, i.id2 in ids} != {True, False} or not (i.id1 in others or i.id2 in others):
			continue
		sign = 1 if i.id2 in ids else -1
		if i.phys.jointed:
			parts = segmentForces(i)
		else:
			parts = [(i.geom.contactPoint, i.phys.normalForce + i.phys.shearForce)]
		for point, part in parts:
			force += sign * np.array(part)
			moment += sign * np.cross(point, part)
	return force, moment


def segmentForces(i):
	"""(point, force on id2) of each segment of a joint."""
	lowFirst = isinstance(O.bodies[i.id1].shape, Wall) or (i.id1 < i.id2 and not isinstance(O.bodies[i.id2].shape, Wall))
	stresses = zip(i.phys.segmentPoints(i.geom), i.phys.segmentArea, i.phys.normalStress(i.geom), i.phys.shearStress(i.geom))
	return [(point, -area * (normal * i.geom.normal + (shear if lowFirst else -shear))) for point, area, normal, shear in stresses]


def statics(masonry):
	"""Weight, thrust at the crown and under the left feet [N], and what is left of forces and moments on the left half, as shares."""
	ground, = [body.id for body in O.bodies if isinstance(body.shape, Wall)]
	half = (len(masonry.courses) + 1) // 2  # with the keystone
	left = [body for course in masonry.abutments[0] for body in course] + [body for course in masonry.courses[:half] for body in course]
	leftIds, rest = {body.id for body in left}, {body.id for body in masonry.bodies} - {body.id for body in left}
	crown, crownMoment = forceOn(leftIds, rest)
	feet, feetMoment = forceOn(leftIds, {ground})
	own = sum(body.state.mass * gravity for body in left)
	ownMoment = sum(np.cross(body.state.pos, (0, 0, -gravity * body.state.mass)) for body in left)
	weight = sum(body.state.mass * gravity for body in masonry.bodies)
	imbalance = np.linalg.norm(crown + feet - (0, 0, own)) / own
	turning = np.linalg.norm(crownMoment + feetMoment + ownMoment) / (own * 3)
	both, _ = forceOn({body.id for body in masonry.bodies}, {ground})
	footAt = -feetMoment[1] / feet[2]  # x where the ground's force acts
	return dict(weight=weight, groundForce=both[2], thrust=-crown[0], feetThrust=feet[0], imbalance=imbalance, turning=turning, footAt=footAt)


def compression(bricks):
	"""Largest compressive principal stress of each brick [kPa], by id."""
	found = {}
	for body in bricks:
		xx, yy, zz, xy, yz, zx = body.shape.stress()
		found[body.id] = -1e-3 * float(np.linalg.eigvalsh([(xx, xy, zx), (xy, yy, yz), (zx, yz, zz)])[0])
	return found


def judge(name, masonry, joints, check, overloaded, found, dry):
	"""Rows of one structure."""
	within = 1e-6 if not dry else 5e-3  # StaticEquilibrium goes to round-off; the loop is stopped at an imbalance of 1e-3
	rows = [
	        report.judgedRow(f"{name}: findings of the check", len(check.loose) + len(check.overlaps) + len(check.gaps) + len(check.tinyJoints), limit=0),
	        report.judgedRow(f"{name}: ground bears the weight [N]", found["groundForce"], expected=found["weight"], tolerance=within),
	        report.judgedRow(f"{name}: thrust at the feet and crown [N]", found["feetThrust"], expected=found["thrust"], tolerance=within),
	        report.judgedRow(f"{name}: forces left on a half, of its weight", found["imbalance"], limit=within),
	        report.judgedRow(f"{name}: moments left on a half, of weight x span", found["turning"], limit=within),
	]
	if structures[name][1] is not None:
		rows.append(report.judgedRow(f"{name}: joints", len(joints), expected=structures[name][1], tolerance=0))
	if not dry:
		rows.append(report.judgedRow(f"{name}: segments beyond their strength", overloaded, limit=0))
	return rows


def draw(path, name, stresses, marks):
	yade_brick.wallPicture(
	        path, patches(O.bodies, stresses), marks, view="3d", title=f"{name}, self weight", colorLabel="largest compression [kPa]",
	        colorRange=(0, max(stresses.values()))
	)


def drawAll(path, frames, largest):
	yade_brick.pictureSeries(
	        path, frames, view="3d", title="Arches and a vault on piers: self weight", columns=2,
	        rowLabels=("semicircular and segmental", "pointed, and a barrel vault"), colorLabel="largest compression [kPa]", colorRange=(0, largest)
	)


def options():
	parser = argparse.ArgumentParser(prog="10_arches_and_vaults.py", description=__doc__.splitlines()[0])
	parser.add_argument("--dry", action="store_true", help="joints without tensile strength and cohesion")
	parser.add_argument("--only", metavar="NAME", choices=list(structures), help="one of " + ", ".join(structures))
	parser.add_argument("--out", metavar="DIR", default="result-10", help="folder for the results (default: result-10)")
	return parser.parse_args()


def main():
	chosen = options()
	os.makedirs(chosen.out, exist_ok=True)
	rows, facts, frames = [], {}, []
	for name in [chosen.only] if chosen.only else structures:
		masonry, joints, check = build(name, chosen.dry)
		print(f"\n{name}\n{check}\n{joints}")
		overloaded, marks = rest(chosen.dry)
		found = statics(masonry)
		file = name.replace(" ", "-")
		joints.now().writeCsv(os.path.join(chosen.out, f"{file}-joints.csv"))
		stresses = compression(masonry.bodies)
		draw(os.path.join(chosen.out, f"{file}.png"), name, stresses, marks)
		frames.append((None, patches(O.bodies, stresses), marks))
		facts[name] = dict(found, overloaded=overloaded, largestCompression=1e3 * max(stresses.values()), failed=sum(joint.failed for joint in joints.now()))
		rows += judge(name, masonry, joints, check, overloaded, found, chosen.dry)
		print(f"thrust {found['thrust'] / 1e3:.2f} kN, {100 * found['thrust'] / found['weight']:.1f} % of the weight")
		print(f"{overloaded} segments beyond their strength, {facts[name]['failed']} failed")
	if len(frames) > 1:
		drawAll(os.path.join(chosen.out, "gallery.png"), frames, 1e-3 * max(fact["largestCompression"] for fact in facts.values()))
	report.writeResult(chosen.out, rows, structures=facts, dry=chosen.dry)
	print("\n" + report.table(rows, title=f"Results in {chosen.out}"))
	sys.exit(report.exitStatus(rows))


main()
