# SPDX-License-Identifier: GPL-2.0-or-later
#
# build/yade, build/yade-batch: the installed YADE with our library, Python package and checks at hand, without root and without touching it.
#
#   build/prefix/   what YADE_PREFIX names: links to the installed libraries and checks, and to ours. YADE opens all of these
#                   libraries while it starts, so our classes are there in every script, in --test, in --check and in the GUI.
#   build/py/       PYTHONPATH: `import yade_brick` works in scripts; yade_brick/_core.so is a link to the same library.
#
# The links are renewed by every build, so that a new Python file or check needs no new configuration.
set(Brick_PYTHONPATH ${CMAKE_BINARY_DIR}/py)
set(Brick_OVERLAY ${CMAKE_BINARY_DIR}/prefix)
set(Brick_BUILT_FOR ${Yade_VERSION})

add_custom_target(
	overlay ALL
	COMMAND
		${CMAKE_COMMAND} -D SOURCE=${CMAKE_SOURCE_DIR} -D BINARY=${CMAKE_BINARY_DIR} -D LIBRARY=$<TARGET_FILE:pkg_brick> -D
		HOST=${Yade_LIBRARY_DIR} -D SUBDIR=${Yade_LIBRARY_SUBDIR} -P ${CMAKE_SOURCE_DIR}/cmake/LinkOverlay.cmake
	COMMENT "Linking the overlay prefix"
	VERBATIM)
add_dependencies(overlay pkg_brick)

configure_file(cmake/_build.py.in ${CMAKE_BINARY_DIR}/py/yade_brick/_build.py @ONLY)
foreach(program yade yade-batch)
	configure_file(cmake/${program}.in ${CMAKE_BINARY_DIR}/${program} @ONLY FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
																							  WORLD_READ WORLD_EXECUTE)
endforeach()
