# SPDX-License-Identifier: GPL-2.0-or-later
#
# Makes the links of the overlay (see Overlay.cmake). Script mode: SOURCE, BINARY, LIBRARY, HOST, SUBDIR are given by -D.
set(prefix ${BINARY}/prefix/${SUBDIR})
set(package ${BINARY}/py/yade_brick)

# links `name` in `folder` to each of the files; links to files that are gone are removed first
function(link_into folder)
	file(MAKE_DIRECTORY ${folder})
	file(GLOB present ${folder}/*)
	foreach(link IN LISTS present)
		if(IS_SYMLINK ${link} AND NOT EXISTS ${link})
			file(REMOVE ${link})
		endif()
	endforeach()
	foreach(file IN LISTS ARGN)
		cmake_path(GET file FILENAME name)
		file(CREATE_LINK ${file} ${folder}/${name} SYMBOLIC)
	endforeach()
endfunction()

file(GLOB libraries ${HOST}/lib*.so)
link_into(${prefix} ${libraries} ${LIBRARY})

# YADE looks for this file to know that the prefix is one; the package itself always comes from the installed place
link_into(${prefix}/py/yade ${HOST}/py/yade/__init__.py)

file(GLOB checks ${HOST}/py/yade/tests/checks/* ${SOURCE}/tests/yade/check*.py)
list(FILTER checks EXCLUDE REGEX "__pycache__")
link_into(${prefix}/py/yade/tests/checks ${checks})

file(GLOB modules ${SOURCE}/py/yade_brick/*.py)
link_into(${package} ${modules})
file(CREATE_LINK ${LIBRARY} ${package}/_core.so SYMBOLIC)
