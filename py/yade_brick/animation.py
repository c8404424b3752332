# SPDX-License-Identifier: GPL-2.0-or-later
# Animations without a display: frames that were recorded in a run, drawn as pictures alike (picture.py) and joined to a GIF, an MP4 or numbered PNGs. The same
# frames give the same bytes.
"""Animations of bricks: `Film` records and saves one, `saveFrames` draws frames that are at hand, `readFrames` takes them from files for ParaView."""

import io
import numbers
import os
import shutil
import subprocess

import numpy as np

from . import picture
from .checks import isFinite

#: A palette is found from at most so many frames of a GIF, evenly spread.
_paletteFrames = 12


class Film:
	"""Keeps how the bricks stand at each call: now, as ``PyRunner(command='film()', virtPeriod=.05)``, or as callback of `runWithProgress`.

	:param colors: None for brick tones, or a function of the Body that returns a colour or a number, such as ``lambda body: body.state.displ()[0]``
	:param marks: whether segments that have failed are marked; joints are followed from the first frame on, which needs a step before it
	:param widest: segments whose sides have moved apart or slid by more [m] are not marked: such a crack shows by itself

	`frames` is a list of (time [s], patches, marks), as pictureSeries takes it too.
	"""

	def __init__(self, colors=None, marks=True, widest=0.02):
		if colors is not None and not callable(colors):
			raise ValueError(f"colors is {colors!r}; allowed is a function of a Body, or None")
		if not (isFinite(widest) and widest >= 0):
			raise ValueError(f"widest is {widest!r}; allowed is a finite number >= 0 m")
		self.colors, self.marks, self.widest, self.frames = colors, marks, widest, []
		self._joints = None

	def __call__(self):
		"""Keeps a frame; one of the same time is replaced."""
		from yade import Brick, O
		from . import snapshot
		bodies = [body for body in O.bodies if body is not None and isinstance(body.shape, Brick)]
		patches = snapshot.patches(bodies, {body.id: self.colors(body) for body in bodies} if self.colors else None)
		if self.frames and self.frames[-1][0] == O.time:
			self.frames.pop()
		self.frames.append((O.time, patches, self._present() if self.marks else None))

	def look(self):
		"""Looks at the joints and keeps no frame: called often enough, no segment fails in a way that was not seen."""
		if self.marks:
			self._present()

	def _present(self):
		from yade import BrickPhys, O
		from .snapshot import JointRecord
		if self._joints is None:
			if not any(isinstance(phys := i.phys, BrickPhys) and phys.jointed for i in O.interactions.all(onlyReal=True)):
				return None
			self._joints = JointRecord()
		self._joints.update()
		return self._joints.marks(self.widest)

	def save(self, path, framesPerSecond=20, **options):
		"""Draws and joins the frames.

		:param path: '.gif', '.mp4' or a folder, see saveFrames
		:param framesPerSecond: > 0
		:param options: the other arguments of saveFrames
		:returns: path
		:raises ValueError, RuntimeError: as saveFrames
		"""
		return saveFrames(path, self.frames, framesPerSecond, **options)


def saveFrames(path, frames, framesPerSecond=20, view="elevation", title=None, ground=0.0, limits=None, colorLabel=None, colorRange=None, width=6.4, dpi=100):
	"""Saves an animation. All pictures have the same limits, range of colours and legend.

	:param path: '.gif'; '.mp4', for which the program ffmpeg has to be installed; or a folder, for frame-000000.png and so on
	:param frames: list of (time [s] or None, bricks, marks or None), as in pictureSeries
	:param framesPerSecond: > 0; frames that were taken every 0.05 s run in real time at 20. GIF counts in hundredths of a second; viewers slow down above 50
	:param limits: (left, right, bottom, top) [m] in the picture's plane; by default around all bricks of all frames
	:param colorRange: (lowest, highest) of the colour scale; by default those of all frames
	:param width: [inches]; the height follows
	:param dpi: pixels per inch
	:param view, title, ground, colorLabel: as in wallPicture
	:returns: path
	:raises ValueError: for no frame, another kind of file, and what wallPicture refuses
	:raises RuntimeError: when ffmpeg is needed and not installed, or fails
	"""
	frames, path = list(frames), os.fspath(path)
	write = _writer(path)
	if not (isFinite(framesPerSecond) and framesPerSecond > 0):
		raise ValueError(f"framesPerSecond is {framesPerSecond!r}; allowed is a finite number > 0")
	limits = picture.sharedLimits(frames, view, ground) if limits is None else limits
	shared = dict(
	        view=view, title=title, ground=ground, limits=limits, colorLabel=colorLabel, colorRange=_sharedRange(frames, colorRange), width=width, dpi=dpi,
	        legend=sorted({int(state) for _, _, marks in frames if marks is not None for state in marks.states} - {0})
	)
	os.makedirs(path if write is _writeFolder else os.path.dirname(os.path.abspath(path)), exist_ok=True)
	write(path, (_drawn(frame, shared) for frame in frames), framesPerSecond)
	return path


def readFrames(name, field=None, component=0, widest=0.02):
	"""Frames of a series that VtkRecorder has written, for saveFrames or pictureSeries: an animation of a run that is over.

	:param name: as given to VtkRecorder
	:param field: None for brick tones, or the cell array of bricks whose numbers colour them, such as 'principalStress'
	:param component: of a field with several numbers, from 0
	:param widest: as in Film; without a series of joints nothing is marked
	:returns: list of (time [s], patches, marks)
	:raises FileNotFoundError: when there is no such series
	:raises ValueError: for a field or component that is not there
	"""
	from .paraview import readPvd
	joints = dict(readPvd(f"{name}-joints.pvd")) if os.path.exists(f"{name}-joints.pvd") else {}
	frames = []
	for time, file in readPvd(f"{name}-bricks.pvd"):
		bricks, segments = (os.path.join(os.path.dirname(name), path) if path else None for path in (file, joints.get(time)))
		frames.append((time, _patchesOf(bricks, field, component), _marksOf(segments, widest) if segments else None))
	return frames


def _patchesOf(path, field, component):
	"""Bricks of a file: their corners are the first of their nodes, whatever they are drawn with."""
	import meshio
	mesh = meshio.read(path)
	data = {name: np.concatenate(blocks) for name, blocks in mesh.cell_data.items()}
	lowest = np.concatenate([block.data.min(axis=1) for block in mesh.cells])
	colors = _componentOf(data, field, component) if field is not None else None
	patches = []
	for brick in dict.fromkeys(data["id"].tolist()):
		cells = np.flatnonzero(data["id"] == brick)
		first, fixed = lowest[cells].min(), bool(data["fixed"][cells[0]])
		patches.append(picture.Patch(mesh.points[first:first + 8], None if colors is None or fixed else float(colors[cells[0]]), fixed))
	return patches


def _componentOf(data, field, component):
	if field not in data:
		raise ValueError(f"field is {field!r}; allowed are {', '.join(map(repr, data))}")
	values = data[field].reshape(len(data[field]), -1)
	if component not in range(values.shape[1]):
		raise ValueError(f"component is {component!r}; allowed for {field!r} are 0 to {values.shape[1] - 1}")
	return values[:, component]


def _marksOf(path, widest):
	import meshio
	with open(path) as file:
		if 'NumberOfCells="0"' in file.read(1000):
			return None  # which meshio writes, but does not read
	mesh = meshio.read(path)
	state, opening, slip = (mesh.cell_data[name][0] for name in ("state", "opening", "slip"))
	near = np.hypot(opening, np.linalg.norm(slip, axis=1)) <= widest
	middles = mesh.points[mesh.cells[0].data].mean(axis=1)
	return picture.Marks(middles[near], state[near])


def _writer(path):
	kind = os.path.splitext(path)[1].lower()
	writers = {".gif": _writeGif, ".mp4": _writeMp4, "": _writeFolder}
	if kind not in writers:
		raise ValueError(f"path is {path!r}; allowed are a file ending in .gif or .mp4, or the name of a folder for PNG files")
	if kind == ".mp4" and shutil.which("ffmpeg") is None:
		raise RuntimeError("ffmpeg, which writes .mp4 files, is not installed (Debian: apt-get install ffmpeg); .gif and a folder of PNG files need nothing")
	return writers[kind]


def _sharedRange(frames, given):
	"""The range of colours over all frames, or None when no brick is coloured by a number."""
	if given is not None:
		return given
	values = [patch[1] for _, bricks, _ in frames for patch in bricks if len(patch) > 1]
	values = [float(value) for value in values if isinstance(value, numbers.Real) and not isinstance(value, bool)]
	return (min(values), max(values)) if values else None


def _drawn(frame, shared):
	"""A frame as PNG, in memory."""
	time, bricks, marks = frame
	file = io.BytesIO()
	picture.wallPicture(file, bricks, marks, time=time, **shared)
	return file.getvalue()


def _image(png):
	from PIL import Image
	return Image.open(io.BytesIO(png)).convert("RGB")


def _writeFolder(path, pngs, framesPerSecond):
	for number, png in enumerate(pngs):
		with open(os.path.join(path, f"frame-{number:06d}.png"), "wb") as file:
			file.write(png)


def _writeGif(path, pngs, framesPerSecond):
	from PIL import Image
	images = [_image(png) for png in pngs]
	# one palette for all, so that colours do not flicker
	chosen = images[::-(-len(images) // _paletteFrames)]
	sample = Image.fromarray(np.concatenate([np.asarray(image) for image in chosen]))
	palette = sample.quantize(256, method=Image.Quantize.MAXCOVERAGE)
	flat = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
	duration = max(10, 10 * round(100 / framesPerSecond))  # [ms]
	flat[0].save(path, save_all=True, append_images=flat[1:], duration=duration, loop=0, optimize=False)


def _writeMp4(path, pngs, framesPerSecond):
	# even sizes, as the codec needs them; one thread and no stamps, so that the same frames give the same file
	command = ["ffmpeg", "-loglevel", "error", "-y", "-f", "image2pipe", "-framerate", f"{framesPerSecond:g}", "-c:v", "png", "-i", "-"]
	command += ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-threads", "1"]
	command += ["-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1", "-movflags", "+faststart", path]
	done = subprocess.run(command, input=b"".join(pngs), stderr=subprocess.PIPE)
	if done.returncode:
		raise RuntimeError(f"ffmpeg has failed on {path}: {done.stderr.decode(errors='replace').strip()}")
