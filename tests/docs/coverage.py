# SPDX-License-Identifier: GPL-2.0-or-later
# What runs the shell commands that the documentation shows. A new command needs a row here, or the test of this folder fails; so does a row that no page
# shows any more.
"""Table from commands to the tests that run them."""

#: (command as a regular expression, matched from its beginning; names of tests in ctest, with * for any; what they leave out).
#: The first row that matches counts.
covered = [
        # scripts: .ci/run is scripts/test.sh, which is scripts/prepare.sh and all of ctest but the slow cases
        (r"scripts/prepare\.sh", ["*"], "called by scripts/test.sh, which is what .ci/run runs"),
        (r"scripts/test\.sh", ["*"], "what .ci/run runs"),
        (r"scripts/demo\.sh", ["example.wall"], "the script is prepare.sh and this example"),
        (r"scripts/docs\.sh|build/yade .*doc/sphinx/build\.py", ["docs.html"], "installing Sphinx"),
        (r"scripts/verify\.sh", ["verification.*", "verification.report"], "the slow cases"),
        (r"scripts/stability\.sh", ["stability.*"], "the slow cases; its table"),
        (r"scripts/fuzz\.sh", ["fuzz"], "more examples than the same few"),
        (r"scripts/sanitize\.sh", ["kernel", "yade.*"], "the sanitizers: takes an hour"),
        (r"scripts/benchmark\.sh", ["python", "kernel"], "the measurement: takes ten minutes and a quiet machine; test_benchmarks.py tests its rows and table"),
        (r"scripts/payAsYouGo\.sh", ["python", "budget.*"], "all its scenes; budget counts three of them, test_payAsYouGo.py tests its table"),
        # examples: those that tests/CMakeLists.txt runs (add_example) need no row; these are for what it does not run
        (r".*examples/04_", ["example.rigidVersusDeform", "python"], "whole motions: half an hour; test_findings.py tests what it says of results"),
        (r".*examples/05_", ["example.accuracyVersusTime", "python"], "all settings: hours; test_accuracy.py tests tables, page and reading"),
        (r".*examples/07_", ["example.deformationOnDemand", "python"], "whole motions; test_onDemand.py tests what it says of results"),
        (r"build/yade .*doc/figures/", ["docs.figure.*"], ""),
        (r".*examples/15_", ["example.window", "yade.testWindow"], "a real screen"),
        (r"build/yade-batch |build/yade .*scripts/study\.py", ["yade.testStudy"], "another table of four rows"),
        # benchmarks
        (r"build/yade .*benchmarks/scenes/bricks\.py", ["budget.*"], "this scene; budget's are built by the same modules"),
        # elsewhere
        (r"build/yade --check", ["host.check"], ""),
        (r"build/yade (-n )?(-x )?(-j\d )?(mywall|script)\.py", ["docs.commands", "yade.testThreads"], "the window: run with -n"),
        (r"build/yade$", ["yade.*"], ""),
        (r"cmake --install build", ["yade.testInstall"], ""),
        (r"cmake (-S . -B build )?-D YADE_SOURCE_DIR", ["abi.*"], "a source tree of YADE, which Debian does not have"),
        (r"cmake --build build", ["*"], "what scripts/prepare.sh ends with"),
        (r"ctest", ["*"], "what scripts/test.sh ends with"),
]
