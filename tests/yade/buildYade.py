# SPDX-License-Identifier: GPL-2.0-or-later
# Runs build/yade as a program of its own, from a test that runs inside YADE itself.
import os, subprocess

import yade_brick

build = os.path.dirname(os.path.dirname(os.path.realpath(yade_brick._core.__file__)))


def run(*arguments, cwd=None, timeout=300, **environment):
	"""The finished process, without what this YADE has put into the environment."""
	inherited = {k: v for k, v in os.environ.items() if k not in ('YADE_PREFIX', 'PYTHONPATH', 'OMP_NUM_THREADS')}
	command = [os.path.join(build, 'yade'), *arguments]
	return subprocess.run(command, cwd=cwd, env=dict(inherited, **environment), capture_output=True, text=True, timeout=timeout)
