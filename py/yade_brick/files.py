# SPDX-License-Identifier: GPL-2.0-or-later
# Files that outlive a crash: what is there is whole, belongs to one process at a time, and can be told from what it was. Studies and long runs
# are built on these.
"""Checksums, locks and writing that survive a process that is killed."""

import contextlib
import fcntl
import hashlib
import json
import os
import tempfile


def checksum(path):
	"""SHA-256 of a file's content, as text."""
	digest = hashlib.sha256()
	with open(path, "rb") as file:
		for block in iter(lambda: file.read(1 << 20), b""):
			digest.update(block)
	return digest.hexdigest()


def readJson(path):
	"""What a JSON file holds; None where there is no such file or no JSON in it."""
	try:
		with open(path, encoding="utf-8") as file:
			return json.load(file)
	except (OSError, ValueError):
		return None


@contextlib.contextmanager
def replacing(path):
	"""A text file to write; it takes the place of `path` at once when the block ends, and not at all when the block fails."""
	folder, name = os.path.split(os.path.abspath(path))
	os.makedirs(folder, exist_ok=True)
	handle, unfinished = tempfile.mkstemp(prefix=f".{name}-", dir=folder)
	try:
		with os.fdopen(handle, "w", encoding="utf-8", newline="") as file:
			yield file
			file.flush()
			os.fsync(file.fileno())
		os.chmod(unfinished, 0o644)
		os.replace(unfinished, path)
	except BaseException:
		os.unlink(unfinished)
		raise


def writeToDisk(path):
	"""Waits until a file or folder is on the disk and not only in memory, where a power failure would lose it."""
	handle = os.open(path, os.O_RDONLY)
	try:
		os.fsync(handle)
	finally:
		os.close(handle)


def lock(path):
	"""An open file that this process and those which inherit it hold alone until all of them have closed it or ended; None while others do.

	The kernel keeps such locks: none is left behind by a process that was killed.
	"""
	os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
	file = open(path, "a")
	try:
		fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
	except BlockingIOError:
		file.close()
		return None
	return file
