# SPDX-License-Identifier: GPL-2.0-or-later
#
# The installed YADE (double precision).
#
#   Yade_FOUND, Yade_PROBLEM   whether it is there, and what is wrong if not
#   Yade_EXECUTABLE            /usr/bin/yade
#   Yade_PREFIX                /usr
#   Yade_LIBRARY_SUBDIR        lib/x86_64-linux-gnu/yade-double
#   Yade_LIBRARY_DIR           the two together: libyade.so, plugins, Python modules
#   Yade_LIBRARIES             the libraries whose symbols we use
#   Yade_VERSION, Yade_FEATURES
find_program(Yade_EXECUTABLE NAMES yade-double yade)
if(NOT Yade_EXECUTABLE)
	set(Yade_PROBLEM "the program `yade` is not installed")
else()
	file(REAL_PATH ${Yade_EXECUTABLE} program) # /bin may be a link to /usr/bin
	cmake_path(GET program PARENT_PATH bin)
	cmake_path(GET bin PARENT_PATH Yade_PREFIX)
	set(Yade_LIBRARY_SUBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE}/yade-double)
	set(Yade_LIBRARY_DIR ${Yade_PREFIX}/${Yade_LIBRARY_SUBDIR})
	set(config ${Yade_LIBRARY_DIR}/py/yade/config.py)
	foreach(name libyade libpkg_common libpkg_dem)
		list(APPEND Yade_LIBRARIES ${Yade_LIBRARY_DIR}/${name}.so)
		if(NOT EXISTS ${Yade_LIBRARY_DIR}/${name}.so)
			set(Yade_PROBLEM "${Yade_LIBRARY_DIR}/${name}.so is missing")
		endif()
	endforeach()
	if(EXISTS ${config})
		file(STRINGS ${config} line REGEX "^version=")
		string(REGEX REPLACE "^version='([^']*)'.*" "\\1" Yade_VERSION "${line}")
		file(STRINGS ${config} line REGEX "^features=")
		string(REGEX REPLACE "^features='([^']*)'.*" "\\1" line "${line}")
		string(STRIP "${line}" line)
		string(REPLACE " " ";" Yade_FEATURES "${line}")
	else()
		set(Yade_PROBLEM "${config} is missing")
	endif()
endif()
if(Yade_PROBLEM)
	set(Yade_FOUND FALSE)
else()
	set(Yade_FOUND TRUE)
endif()
