# SPDX-License-Identifier: GPL-2.0-or-later
#
# Everything the build needs. All that is missing is collected first and named at once, with the packages to install.
set(missing "")
set(missing_packages "")

macro(require what package found)
	if(NOT ${found})
		string(APPEND missing "\n  ${what}")
		list(APPEND missing_packages ${package})
	endif()
endmacro()

find_package(Yade QUIET)
require("YADE: ${Yade_PROBLEM}" yade Yade_FOUND)

find_package(Eigen3 3.3 QUIET NO_MODULE)
require("Eigen 3.3 or newer" libeigen3-dev Eigen3_FOUND)

# the Python that YADE runs in, whatever else comes first in PATH
set(Python3_EXECUTABLE ${Yade_PREFIX}/bin/python3)
find_package(Python3 QUIET COMPONENTS Interpreter Development)
require("Python headers" libpython3-dev Python3_Development_FOUND)

set(python_component python${Python3_VERSION_MAJOR}${Python3_VERSION_MINOR})
find_package(Boost QUIET COMPONENTS ${python_component} serialization)
require("Boost.Python for Python ${Python3_VERSION}" libboost-python-dev Boost_${python_component}_FOUND)
require("Boost.Serialization" libboost-serialization-dev Boost_serialization_FOUND)

find_package(OpenMP QUIET COMPONENTS CXX)
require("OpenMP for C++" g++ OpenMP_CXX_FOUND)

set(OpenGL_GL_PREFERENCE LEGACY) # libGL, which YADE itself draws with
find_package(OpenGL QUIET)
require("OpenGL" libgl-dev OPENGL_FOUND)

find_package(GTest QUIET)
require("GoogleTest" libgtest-dev GTest_FOUND)

find_program(XVFB_RUN xvfb-run)
require("xvfb-run, for tests of the 3-D view" "xvfb xauth" XVFB_RUN)

if(missing)
	list(REMOVE_DUPLICATES missing_packages)
	list(JOIN missing_packages " " missing_packages)
	message(FATAL_ERROR " Missing:${missing}\n On Debian 12:\n  apt-get install ${missing_packages}")
endif()

set(supported_version 2023.02a) # the folder in yade-abi/
if(NOT YADE_SOURCE_DIR AND NOT Yade_VERSION STREQUAL supported_version)
	message(
		FATAL_ERROR
			"The installed YADE is ${Yade_VERSION}; yade-abi/ describes ${supported_version} (Debian 12) only.\n"
			"Install that one, or give the source tree of yours:  -D YADE_SOURCE_DIR=<tree>")
endif()
if(NOT "OPENMP" IN_LIST Yade_FEATURES)
	message(FATAL_ERROR "The installed YADE was built without OpenMP; yade-abi/ describes one with it.")
endif()
list(JOIN Yade_FEATURES " " features)
message(STATUS "YADE ${Yade_VERSION} in ${Yade_LIBRARY_DIR}, features: ${features}")
