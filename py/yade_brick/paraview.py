# SPDX-License-Identifier: GPL-2.0-or-later
# Writes a running scene for ParaView: .vtu files of bricks, mortar segments and contacts, and .pvd files that give each its simulated time. The files are
# meshio's (binary, compressed). Reading only: nothing here changes the simulation.
"""Results for ParaView: `VtkRecorder`."""

import os
import xml.etree.ElementTree as xml

import numpy as np

from .build import cornerSigns
from .segments import SegmentRecord
from .snapshot import numbers

#: Number of a level of deformation in the files.
levels = {"rigid": 0, "uniform": 1, "trilinear": 2, "refined": 3}


class VtkRecorder:
	"""Writes a frame for ParaView at each call: now, as ``PyRunner(command='recorder()', virtPeriod=.02)``, or as callback of `runWithProgress`.

	``name-bricks.pvd``, ``name-joints.pvd`` and ``name-contacts.pvd`` are to be opened; the frames, ``.vtu`` files, lie in the folder ``name-frames``. Each
	.pvd is complete after every frame. All frames of a series have the same arrays, also where nothing is there. SI units, world axes, all per cell but the
	first two:

	- bricks: hexahedra with their deformed corners, of a refined brick the faces of the elements on its surface. ``displacement`` of the nodes since the
	  brick was laid (State.refPos, refOri), ``velocity``; ``stress`` (mean of the brick, tension positive, XX YY ZZ XY YZ XZ), ``principalStress`` (three,
	  largest first), ``elasticEnergy``, ``kineticEnergy`` (rigid motion and deformation), ``id``, ``level`` (0 rigid, 1 uniform, 2 trilinear, 3 refined),
	  ``share`` (see Brick.share), ``fixed``, ``limiting`` (1: sets the time step), ``stableStep`` (NaN where fixed).
	- joints: a quadrilateral for each segment of mortar, also of joints that have failed altogether, see SegmentRecord. ``displacement`` of its
	  corners likewise; ``state`` (0 intact, failed in 1 tension, 2 shear, 3 compression, 4 unseen), ``joined`` (0: nothing of its joint holds), ``normal``,
	  ``opening``, ``slip``, ``normalStress``, ``shearStress``, ``utilisation``, ``area``, ``id1``, ``id2``, ``segment``.
	- contacts: a point for each ordinary contact, with ``force`` on the body id2, ``normalForce``, ``shearForce``, ``normal``, ``area``, ``penetration``,
	  ``id1``, ``id2``.

	Stress of rigid bricks is zero, and unknown (NaN) before the first step. Places are deformed ones: to exaggerate by a factor f, warp by displacement
	with f - 1. Bricks are where the last step has brought them, joints and contacts where they were in it.

	:param name: of the files, with a folder if wanted, which is made: 'out/wall'
	:param joints: whether to write them
	:param contacts: whether to write them
	:param stableStep: whether to find each brick's own stable step, which can take milliseconds for a refined brick; needs a BrickTimeStepper in O.engines
	:param brickData: further numbers of bricks: dict from name to a function of the Body
	:param resume: True to go on with the series of an earlier run: its frames up to the present time stay
	:raises ValueError: naming the argument, its value and what is allowed
	:raises ImportError: without meshio (Debian: python3-meshio)
	"""

	def __init__(self, name, joints=True, contacts=True, stableStep=True, brickData=None, resume=False):
		_meshio()
		self.brickData = _checkedData(brickData)
		for argument, value in (("joints", joints), ("contacts", contacts), ("stableStep", stableStep), ("resume", resume)):
			if not isinstance(value, bool):
				raise ValueError(f"{argument} is {value!r}; allowed is True or False")
		if not isinstance(name, (str, os.PathLike)) or not os.path.basename(name := os.fspath(name)):
			raise ValueError(f"name is {name!r}; allowed is a name of files, with a folder if wanted, such as 'out/wall'")
		self.stableStep, self.name = stableStep, name
		kinds = ["bricks"] + ["joints"] * joints + ["contacts"] * contacts
		self._series = {kind: _Series(name, kind, resume) for kind in kinds}
		self._recordPath, self._recorded = f"{name}-frames/segments.npz", None
		self.segments = SegmentRecord.load(self._recordPath) if resume and joints and os.path.exists(self._recordPath) else SegmentRecord()

	def __call__(self):
		"""Writes a frame of the scene as it is; one of the same time, or later, is replaced. Returns the paths of its files.

		:raises ValueError: when there is no brick in the scene
		:raises RuntimeError: with joints, before the first step
		"""
		from yade import O
		made = {"bricks": lambda: brickMesh(O.bodies, self.stableStep, self.brickData), "joints": self._jointMesh, "contacts": contactMesh}
		meshes = {kind: made[kind]() for kind in self._series}  # all before the first is written
		paths = [self._series[kind].write(O.time, mesh) for kind, mesh in meshes.items()]
		if "joints" in self._series:
			self._keepRecord()
		return paths

	def _keepRecord(self):
		"""Keeps what a run that goes on needs of joints that are gone; where the others are, it sees itself."""
		known = len(self.segments), int(self.segments.joined.sum())
		if known != self._recorded:
			with _replacing(self._recordPath) as path:
				self.segments.save(path)
			self._recorded = known

	def look(self):
		"""Looks at the joints and writes nothing: called often enough between frames, no segment fails in a way that was not seen."""
		self.segments.update()

	def _jointMesh(self):
		self.segments.update()
		return jointMesh(self.segments)


def _checkedData(data):
	if data is None:
		return {}
	if not isinstance(data, dict) or not all(isinstance(name, str) and name and callable(value) for name, value in data.items()):
		raise ValueError(f"brickData is {data!r}; allowed is a dict from names to functions of a Body")
	return dict(data)


def _meshio():
	try:
		import meshio
	except ImportError:
		raise ImportError("VtkRecorder needs meshio (Debian: apt-get install python3-meshio)") from None
	return meshio


# Meshes


def brickMesh(bodies, stableStep=True, brickData=None):
	"""The bricks among the bodies as meshio.Mesh, with the arrays that `VtkRecorder` tells.

	:raises ValueError: when there is none
	"""
	from yade import Brick
	bricks = [body for body in bodies if body is not None and isinstance(body.shape, Brick)]
	if not bricks:
		raise ValueError("there is no brick to write; add the bodies first")
	motion = _Motion(bricks)
	points, pointData, cells, counts = _brickNodes(bricks, motion)
	ofBricks = {**_motionData(bricks, motion), **_limits(bricks, stableStep)}
	ofBricks.update((name, np.array([value(body) for body in bricks], dtype=float)) for name, value in (brickData or {}).items())
	cellData = {name: [np.repeat(values, counts[kind], axis=0) for kind in cells] for name, values in ofBricks.items()}
	return _meshio().Mesh(points, list(cells.items()), point_data=pointData, cell_data=cellData)


class _Motion:
	"""Where the bricks are and how they move, as arrays; axes as matrices that turn a brick's axes into the world's."""

	def __init__(self, bricks):
		from scipy.spatial.transform import Rotation
		states = [body.state for body in bricks]

		def vectors(read):
			return np.array([numbers(read(state)) for state in states])

		def matrices(read):
			return Rotation.from_quat([(*numbers(read(state)), read(state)[3]) for state in states]).as_matrix()

		self.place, self.axes = vectors(lambda state: state.pos), matrices(lambda state: state.ori)
		self.laidPlace, self.laidAxes = vectors(lambda state: state.refPos), matrices(lambda state: state.refOri)
		self.velocity, self.spin, self.inertia = (vectors(read) for read in (lambda s: s.vel, lambda s: s.angVel, lambda s: s.inertia))
		self.mass = np.array([state.mass for state in states])


def _brickNodes(bricks, motion):
	"""Points, what belongs to them, and cells by kind with how many of them each brick has."""
	nodes, moved, velocity, first = [], [], [], 0
	cells, each = {"hexahedron": [], "quad": []}, {"hexahedron": [], "quad": []}
	for body in bricks:
		shape = body.shape
		corners, deformed = _array(shape.corners), _array(shape.displacement)
		elements = 1 if len(deformed) <= 8 else round(((len(deformed) - 2) / 6)**0.5)
		rest = corners if elements == 1 else surfaceNodes(corners, elements)
		nodes.append(rest)
		moved.append(rest + deformed if len(deformed) else rest)
		# a refined brick that has not been in a step yet is drawn by its corners
		velocity.append(_array(shape.worldVelocities(body.state))[:len(rest)])
		found = {"hexahedron": np.arange(8).reshape(1, 8), "quad": np.empty((0, 4), dtype=int)}
		if elements > 1:
			found = {"hexahedron": np.empty((0, 8), dtype=int), "quad": surfaceQuads(elements)}
		for kind, some in found.items():
			cells[kind].append(first + some)
			each[kind].append(len(some))
		first += len(rest)
	brickOf = np.repeat(np.arange(len(bricks)), [len(rest) for rest in nodes])
	points = motion.place[brickOf] + np.einsum("nij,nj->ni", motion.axes[brickOf], np.concatenate(moved))
	laid = motion.laidPlace[brickOf] + np.einsum("nij,nj->ni", motion.laidAxes[brickOf], np.concatenate(nodes))
	cells = {kind: np.concatenate(some) for kind, some in cells.items() if any(each[kind])}
	return points, {"displacement": points - laid, "velocity": np.concatenate(velocity)}, cells, each


def _array(vectors):
	return np.array([numbers(vector) for vector in vectors]).reshape(-1, 3)


def _gridPlaces(elements):
	"""Places of a brick's surface nodes in its grid of elements, in the order of Brick.displacement: corners, then the others with x fastest."""
	places = [tuple(elements * (sign + 1) // 2 for sign in signs) for signs in cornerSigns]
	span = range(elements + 1)
	every = [(x, y, z) for z in span for y in span for x in span if {x, y, z} & {0, elements}]
	return places + [place for place in every if place not in places]


def surfaceNodes(corners, elements):
	"""Nodes on the surface of a refined brick at rest, in the order of Brick.displacement."""
	places = np.array(_gridPlaces(elements))[:, None] / elements
	weights = np.where(np.array(cornerSigns) > 0, places, 1 - places).prod(axis=2)
	return weights @ corners


def surfaceQuads(elements):
	"""Faces of the elements on the surface of a refined brick, nodes counter-clockwise from outside."""
	number = {place: node for node, place in enumerate(_gridPlaces(elements))}
	quads = []
	for axis in range(3):
		for end in (0, elements):
			for i in range(elements):
				for j in range(elements):
					around = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
					# the next two axes after `axis` turn to the right about it
					places = [tuple(np.roll((end, *pair), axis).tolist()) for pair in (around if end else around[::-1])]
					quads.append([number[place] for place in places])
	return np.array(quads)


def _motionData(bricks, motion):
	"""What there is to know of each brick, as arrays."""
	shapes = [body.shape for body in bricks]
	local = np.array([[row[i] for i in range(6)] for row in (shape.stress() for shape in shapes)])
	stress = motion.axes @ local[:, [0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(-1, 3, 3) @ motion.axes.transpose(0, 2, 1)
	spin = np.einsum("nji,nj->ni", motion.axes, motion.spin)
	rigidKinetic = 0.5 * (motion.mass * (motion.velocity**2).sum(axis=1) + (motion.inertia * spin**2).sum(axis=1))
	return {
	        "id": np.array([body.id for body in bricks]),
	        "level": np.array([levels[shape.deformation] for shape in shapes]),
	        "share": np.array([shape.share for shape in shapes]),
	        "fixed": np.array([int(not body.dynamic) for body in bricks]),
	        "stress": stress[:, [0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]],  # the order that ParaView names XX YY ZZ XY YZ XZ
	        "principalStress": _principal(stress),
	        "elasticEnergy": np.array([shape.elasticEnergy() for shape in shapes]),
	        "kineticEnergy": rigidKinetic + [shape.kineticEnergy() for shape in shapes],
	}


def _principal(stress):
	"""Principal values, the largest first; NaN where the stress is not known."""
	known = np.isfinite(stress).all(axis=(1, 2))
	principal = np.full((len(stress), 3), np.nan)
	principal[known] = np.linalg.eigvalsh(stress[known])[:, ::-1]
	return principal


def _limits(bricks, stableStep):
	from yade import BrickTimeStepper, O
	stepper = next((engine for engine in O.engines if isinstance(engine, BrickTimeStepper)), None)
	limiting = stepper.limitingBrick if stepper else -1
	found = {"limiting": np.array([int(body.id == limiting) for body in bricks])}
	if stableStep:
		steps = np.array([stepper.stableStep(body.id) if stepper else np.nan for body in bricks])
		found["stableStep"] = np.where(np.isfinite(steps), steps, np.nan)
	return found


def jointMesh(segments):
	"""The segments of a SegmentRecord as meshio.Mesh, with the arrays that `VtkRecorder` tells."""
	count = len(segments)
	quads = np.arange(4 * count).reshape(count, 4)
	cellData = {name: getattr(segments, name) for name in ("normal", "opening", "slip", "normalStress", "shearStress", "utilisation", "area")}
	cellData.update(state=segments.state, joined=segments.joined.astype(int), segment=segments.index, id1=segments.bodies[:, 0], id2=segments.bodies[:, 1])
	return _meshio().Mesh(
	        segments.outline.reshape(-1, 3), [("quad", quads)], point_data={"displacement": segments.displacement.reshape(-1, 3)},
	        cell_data={name: [values] for name, values in cellData.items()}
	)


def contactMesh():
	"""The ordinary contacts of bricks in the scene as points, meshio.Mesh, with the arrays that `VtkRecorder` tells."""
	from yade import BrickPhys, O
	found = [(i, i.geom, phys) for i in O.interactions.all(onlyReal=True) if isinstance(phys := i.phys, BrickPhys) and not phys.jointed]

	def vectors(read):
		return np.array([numbers(read(geom, phys)) for _, geom, phys in found]).reshape(-1, 3)

	normalForce, shearForce = vectors(lambda geom, phys: phys.normalForce), vectors(lambda geom, phys: phys.shearForce)
	cellData = {
	        "force": normalForce + shearForce,
	        "normalForce": normalForce,
	        "shearForce": shearForce,
	        "normal": vectors(lambda geom, phys: geom.normal),
	        "area": np.array([geom.area for _, geom, _ in found], dtype=float),
	        "penetration": np.array([geom.penetration for _, geom, _ in found], dtype=float),
	        "id1": np.array([i.id1 for i, _, _ in found], dtype=int),
	        "id2": np.array([i.id2 for i, _, _ in found], dtype=int),
	}
	cells = [("vertex", np.arange(len(found)).reshape(-1, 1))]
	return _meshio().Mesh(vectors(lambda geom, phys: geom.contactPoint), cells, cell_data={name: [values] for name, values in cellData.items()})


# Files


class _Series:
	"""A .pvd file and the frames that it names."""

	def __init__(self, name, kind, resume):
		self.path, self.folder, self.kind = f"{name}-{kind}.pvd", f"{name}-frames", kind
		self.frames = readPvd(self.path) if resume and os.path.exists(self.path) else []

	def write(self, time, mesh):
		"""Writes a frame, then the .pvd that names it."""
		self.frames = [frame for frame in self.frames if frame[0] < time]
		os.makedirs(self.folder, exist_ok=True)
		path = os.path.join(self.folder, f"{self.kind}-{len(self.frames):06d}.vtu")
		with _replacing(path) as unfinished:
			_meshio().write(unfinished, mesh, file_format="vtu", binary=True, compression="zlib")
		self.frames.append((time, f"{os.path.basename(self.folder)}/{os.path.basename(path)}"))
		root = xml.Element("VTKFile", type="Collection", version="0.1", byte_order="LittleEndian")
		collection = xml.SubElement(root, "Collection")
		for at, file in self.frames:
			xml.SubElement(collection, "DataSet", timestep=repr(at), group="", part="0", file=file)
		xml.indent(root)
		with _replacing(self.path) as unfinished:
			xml.ElementTree(root).write(unfinished, encoding="utf-8", xml_declaration=True)
		return path


def readPvd(path):
	"""The frames that a .pvd file names: list of (time [s], path relative to the file's folder).

	:raises ValueError: for a file that is none
	"""
	try:
		sets = [dataSet.attrib for dataSet in xml.parse(path).getroot().iter("DataSet")]
		return [(float(dataSet["timestep"]), dataSet["file"]) for dataSet in sets]
	except (xml.ParseError, KeyError, ValueError) as problem:
		raise ValueError(f"{path} is no .pvd file with times and files: {problem}") from None


class _replacing:
	"""Gives the name of a file to write, which takes the place of `path` when it is complete: who reads meanwhile finds no half of one."""

	def __init__(self, path):
		self.path = path
		self.unfinished = os.path.join(os.path.dirname(path), f".unfinished-{os.path.basename(path)}")

	def __enter__(self):
		return self.unfinished

	def __exit__(self, kind, *_):
		if kind is None:
			os.replace(self.unfinished, self.path)
		elif os.path.exists(self.unfinished):
			os.remove(self.unfinished)
