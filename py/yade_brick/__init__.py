# SPDX-License-Identifier: GPL-2.0-or-later
"""Deformable bricks for YADE: ``import yade_brick`` in any YADE script.

Loads the library if YADE has not done so while starting. Its classes (Brick, BrickMat, ...) become attributes of this module,
of ``yade.wrapper`` and of ``yade``, and names in scripts, as YADE's own classes are.

:raises ImportError: outside YADE, or if the library was built for another YADE or with other compiler flags; then nothing is
    registered and the message says what to do.
"""
import sys as _sys


def _load():
	"""Open the library and return {name: class} of its classes."""
	if 'yade' not in _sys.modules:
		raise ImportError(
		        'yade_brick needs a running YADE: use it in a script that is run by `yade` (or by build/yade), or write `import yade` before it.'
		)
	import yade
	from yade import config, system, wrapper
	from . import _build
	if config.version != _build.yadeVersion:
		raise ImportError(
		        'yade_brick was built for YADE %s, this is YADE %s. Nothing was loaded. Build yade-brick again on this machine, or install '
		        'YADE %s (Debian 12: apt-get install yade).' % (_build.yadeVersion, config.version, _build.yadeVersion)
		)
	from . import _core
	classes = {name: getattr(wrapper, name) for name in _core.classes}
	import __main__
	for namespace in (yade, __main__):
		vars(namespace).update(classes)
	system._allSerializables.update(classes)
	_showInController(classes)
	return classes


def _showInController(classes):
	"""Adds the drawing classes to the display tab of a controller that was open before."""
	qt = _sys.modules.get('yade.qt')
	if qt is None: return
	vars(qt).update(classes)
	for name in sorted(classes):
		if name.startswith('Gl1_') and qt.controller and qt.controller.displayCombo.findText(name) < 0: qt.controller.displayCombo.addItem(name)


_classes = _load()
globals().update(_classes)

from . import (
        animation, arches, assembly, baseline, bill, blocks, bonds, build, capacity, checkpoint, designSpectrum, faces, files, fragility, histories, houses,
        ida, intensity, joints, loop, masonryCheck, mesh, motion, motionFiles, motionPicture, openings, paraview, picture, piers, progress, pulses,
        quasiStatic, report, rest, segments, snapshot, solids, spectrum, spectrumCompatible, study, synthetic, walls, window
)
from .animation import Film
from .arches import Arch, Piers, arch, barrelVault, ellipticalLine, pointedLine, segmentalLine, semicircularLine
from .assembly import assembled
from .bill import Bill
from .build import Masonry, brick, englishBondWall, groundMotion, straightJointWall
from .capacity import capacityCurve, capacityPlot
from .checkpoint import runWithCheckpoints
from .designSpectrum import elasticSpectrum
from .fragility import fitFragility, fragilityPlot
from .histories import Histories, wallHistories
from .houses import Floor, house
from .ida import HuntAndFill, idaPlot, incrementalDynamicAnalysis
from .joints import JointList, layMortar, listJoints
from .loop import Loop, effects, engines
from .masonryCheck import MasonryCheck, checkMasonry
from .mesh import MeshBricks, readBricks, writeBricks
from .motion import Motion, combineComponents
from .motionFiles import readAt2, readAt2Components, readColumns, writeColumns
from .motionPicture import motionPlot
from .openings import Opening
from .paraview import VtkRecorder
from .picture import historyPlot, pictureSeries, wallPicture
from .piers import column, pier
from .progress import runWithProgress
from .pulses import syntheticHalfSine, syntheticHarmonic, syntheticPulse, syntheticRicker, syntheticSweep
from .quasiStatic import loadAt, pushover, tiltAt, tiltingTable
from .rest import isAtRest, restState
from .segments import SegmentRecord
from .snapshot import JointRecord, patches
from .spectrum import responseSpectrum
from .spectrumCompatible import syntheticFromSpectrum
from .study import runStudy, writeTable
from .synthetic import syntheticNearFault
from .walls import bondedWall, wallsAlong

# Modules stay out of `from yade_brick import *`: names such as `motion` and `report` are often a script's own.
__all__ = sorted(name for name, value in globals().items() if not name.startswith('_') and type(value) is not type(_sys))
