# SPDX-License-Identifier: GPL-2.0-or-later
"""How thin may the contact part be? Two walls under their own weight, with contact parts from 10 mm down to 0.01 mm.

    build/yade -n -x examples/06_thin_contact_part.py [--out DIR]

The paper advises a contact part "as thin as possible". In a staggered bond each brick lies on two, and its one hexahedron has to follow both through glued
half overlaps: as the contact part gets thinner, nothing is left that could give way, and the joints show tension that the wall does not have. Straight
joints, where whole faces meet, do not lock. Elasticity, and the same walls with each brick cut into smaller ones, have compression of 3.4 kPa at least
on every bed joint, whatever r. So have bricks of 2 x 2 x 2 elements ('refined'), whose faces can follow a half overlap each.

Leaves in DIR: result.json, table.md, bed-tension.png. Statics only: a few seconds.
"""

import argparse
import math
import os
import sys
from typing import NamedTuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import yade_brick
from yade_brick import build, report

side, gravity = 0.2, 9.8  # [m], [m/s2]
thicknesses = (0.01, 0.005, 0.001, 0.0001, 0.00001)  # r [m]
tensileStrength = 4.6e3  # of the paper's mortar [Pa]
leastCompression = -3.4e3  # on any bed joint segment of 25 mm, independent finite elements, 4^3 a cube [Pa]
bonds = {"straight": build.straightJointWall, "English": build.englishBondWall}


class Variant(NamedTuple):
	"""How bricks are made.

	:param element: full or incompatible
	:param segments: along an edge
	:param cells: elements along an edge of the inner part
	"""

	element: str
	segments: int
	cells: int = 1

	@property
	def text(self):
		return self.element if self.cells == 1 else f"{self.element}, {self.cells} x {self.cells} x {self.cells}"

	def options(self):
		"""For yade_brick.brick."""
		level = dict(deformation="trilinear") if self.cells == 1 else dict(deformation="refined", cells=self.cells)
		return dict(element=self.element, segments=self.segments, inner="full", **level)


variants = (Variant("full", 4), Variant("full", 2), Variant("incompatible", 4), Variant("full", 4, cells=2))


def mortar(strength):
	"""The paper's; the strength of an unbreakable one only keeps it whole while stresses are read."""
	phi = math.radians(32)
	if strength == "paper":
		return yade_brick.Mortar(tensileStrength=tensileStrength, cohesion=2.9e3, frictionAngle=phi, compressiveStrength=4.9e5)
	return yade_brick.Mortar(tensileStrength=1e12, cohesion=1e12, frictionAngle=phi, compressiveStrength=1e12)


def buildWall(bond, thickness, variant, strength):
	"""The wall in equilibrium under its weight; the StaticEquilibrium that found it."""
	O.reset()
	adobe = yade_brick.BrickMat(young=9.8e6, poisson=0.25, density=1800, frictionAngle=math.radians(32), mortar=mortar(strength))
	O.materials.append(adobe)
	O.bodies.append(wall(0, axis=2, sense=1, material=adobe))
	masonry = bonds[bond](6, 6, (side, side, side), material=adobe, contactThickness=thickness, **variant.options())
	O.bodies.append(masonry.bodies)
	yade_brick.MortarJoints()()
	rest = StaticEquilibrium(gravity=(0, 0, -gravity))
	rest()
	return rest


def largestBedStress():
	"""Largest normal stress of a segment of a bed joint [Pa], tension positive; negative: all are pressed."""
	O.engines = [yade_brick.engines(contact=False).interactionLoop]
	O.dt = 1e-9
	O.step()  # tells joints their geometry; nothing moves
	beds = [i for i in O.interactions if i.phys.jointed and abs(i.geom.normal[2]) > 0.5]
	return max(max(i.phys.normalStress(i.geom)) for i in beds)


def study():
	"""One dict for each wall: its dials, largest bed stress [Pa], segments beyond the paper's strength."""
	found = []
	for bond in bonds:
		for variant in variants:
			for thickness in thicknesses:
				overloaded = buildWall(bond, thickness, variant, "paper").overloaded
				buildWall(bond, thickness, variant, "unbreakable")
				found.append(dict(bond=bond, **variant._asdict(), thickness=thickness, overloaded=overloaded, bedStress=largestBedStress()))
	return found


def wallsOf(found, bond, variant):
	return [row for row in found if row["bond"] == bond and all(row[dial] == value for dial, value in variant._asdict().items())]


def judge(found):
	"""The straight wall holds whatever r; the English bond holds from 1 mm up, and locks below, but not with bricks of several elements."""
	rows = []
	for bond in bonds:
		walls = wallsOf(found, bond, Variant("full", 4))
		thin = [row for row in walls if row["thickness"] < 0.9e-3]
		thick = [row for row in walls if row["thickness"] > 0.9e-3]
		rows.append(report.judgedRow(f"{bond}, r >= 1 mm: segments beyond their strength", sum(row["overloaded"] for row in thick), limit=0))
		if bond == "straight":
			rows.append(report.judgedRow("straight, r < 1 mm: segments beyond their strength", sum(row["overloaded"] for row in thin), limit=0))
		else:
			# independent computation: +7.7 kPa and 24 segments over ft at 0.1 mm, printed with two digits
			locked, = [row for row in thin if row["thickness"] == 0.0001]
			rows.append(report.judgedRow("English, r = 0.1 mm: largest bed stress [Pa]", locked["bedStress"], expected=7.7e3, tolerance=0.01))
		refined = wallsOf(found, bond, Variant("full", 4, cells=2))
		rows.append(report.judgedRow(f"{bond}, refined, any r: segments beyond their strength", sum(row["overloaded"] for row in refined), limit=0))
	return rows


def table(found):
	lines = ["| bond | element | segments | " + " | ".join(f"r = {1e3 * r:g} mm" for r in thicknesses) + " |", "|---|---|---|" + "---|" * len(thicknesses)]
	for bond in bonds:
		for variant in variants:
			walls = wallsOf(found, bond, variant)
			cells = [f"{row['bedStress'] / 1e3:+.2f}" + (f" ({row['overloaded']})" if row["overloaded"] else "") for row in walls]
			lines.append(f"| {bond} | {variant.text} | {variant.segments} x {variant.segments} | " + " | ".join(cells) + " |")
	return "\n".join(lines) + "\n"


def draw(found, path):
	figure, axes = plt.subplots(figsize=(7, 4.2), layout="constrained")
	for bond, marker in zip(bonds, "os"):
		for variant, line in zip(variants, ("-", "--", ":", "-.")):
			walls = wallsOf(found, bond, variant)
			axes.plot(
			        [1e3 * row["thickness"] for row in walls], [row["bedStress"] / 1e3 for row in walls], line, marker=marker, fillstyle="none",
			        label=f"{bond}, {variant.text}, {variant.segments} x {variant.segments} segments"
			)
	axes.axhline(leastCompression / 1e3, color="k", lw=0.8, label="finite elements, 4 x 4 x 4 a brick, any r")
	axes.axhline(tensileStrength / 1e3, color="r", lw=0.8, label="tensile strength of the paper's mortar")
	axes.set(xscale="log", xlabel="thickness r of the contact part [mm]", ylabel="largest normal stress on a bed joint [kPa]")
	axes.set_title("Self weight of a wall of 6 x 6 bricks")
	axes.legend(fontsize="small")
	figure.savefig(path, dpi=110)


def main():
	parser = argparse.ArgumentParser(prog="06_thin_contact_part.py", description=__doc__.splitlines()[0])
	parser.add_argument("--out", metavar="DIR", default="result-06", help="folder for the results (default: result-06)")
	out = parser.parse_args().out
	found = study()
	rows = judge(found)
	report.writeResult(out, rows, walls=found)
	with open(os.path.join(out, "table.md"), "w") as file:
		file.write(table(found))
	draw(found, os.path.join(out, "bed-tension.png"))
	print("Largest normal stress on a bed joint [kPa], tension positive; in brackets: segments beyond the strength of the paper's mortar\n")
	print(table(found))
	print(report.table(rows, title=f"Results in {out}"))
	sys.exit(report.exitStatus(rows))


main()
