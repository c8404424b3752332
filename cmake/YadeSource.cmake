# SPDX-License-Identifier: GPL-2.0-or-later
#
# yade_headers from a YADE source tree (-D YADE_SOURCE_DIR=<tree>). The options of the installed program have to be stated again,
# since they shape its classes. Packages on Debian 12: qtbase5-dev freeglut3-dev libglu1-mesa-dev libopenmpi-dev and
# libboost-{log,filesystem,thread,iostreams,date-time}-dev.
if(NOT EXISTS ${YADE_SOURCE_DIR}/core/Scene.hpp)
	message(FATAL_ERROR "YADE_SOURCE_DIR=${YADE_SOURCE_DIR} is not a YADE source tree: it has no core/Scene.hpp")
endif()
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(Qt5 REQUIRED COMPONENTS Gui)
find_package(Boost REQUIRED COMPONENTS log thread filesystem)

target_include_directories(yade_headers SYSTEM INTERFACE ${YADE_SOURCE_DIR})
target_compile_definitions(
	yade_headers
	INTERFACE
		YADE_BRICK_REAL_HEADERS # ours: no HostCheck.cpp
		YADE_BRICK_YADE_VERSION="${Yade_VERSION}"
		YADE_REAL_BIT=64
		YADE_REAL_DEC=15
		YADE_DISABLE_REAL_MULTI_HP
		YADE_OPENMP
		YADE_OPENGL
		YADE_QT5
		YADE_MPI
		YADE_FEM
		YADE_LS_DEM
		YADE_BOOST_LOG
		BOOST_LOG_DYN_LINK
		MAX_LOG_LEVEL=5
		QT_NO_KEYWORDS)
target_link_libraries(yade_headers INTERFACE Qt5::Gui MPI::MPI_CXX Boost::log Boost::thread Boost::filesystem)
