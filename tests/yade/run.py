# SPDX-License-Identifier: GPL-2.0-or-later
# Runs unittest modules inside YADE:  build/yade -n -x tests/yade/run.py tests/yade/testBrickMat.py [unittest options]
# The exit status is 0 if all tests passed; a module without tests is an error.
import os, sys, unittest

path, options = os.path.abspath(sys.argv[1]), sys.argv[2:]
sys.path.insert(0, os.path.dirname(path))
program = unittest.main(module=os.path.splitext(os.path.basename(path))[0], argv=[path] + options, exit=False, verbosity=1)
if program.result.testsRun == 0: print('no tests in ' + path)
sys.exit(0 if program.result.wasSuccessful() and program.result.testsRun > 0 else 1)
