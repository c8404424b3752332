# SPDX-License-Identifier: GPL-2.0-or-later
#
# The library goes to YADE's plugin folder, where YADE finds it at every start. The Python package goes to YADE's folder of Python
# modules, which is in the path of every YADE script. With another --prefix, set PYTHONPATH=<prefix>/lib/<arch>/yade-double/py, and
# the library is opened by `import yade_brick`.
install(TARGETS pkg_brick LIBRARY DESTINATION ${Yade_LIBRARY_SUBDIR})
install(
	DIRECTORY py/yade_brick
	DESTINATION ${Yade_LIBRARY_SUBDIR}/py
	FILES_MATCHING
	PATTERN "*.py"
	PATTERN "__pycache__" EXCLUDE)
install(FILES ${CMAKE_BINARY_DIR}/py/yade_brick/_build.py DESTINATION ${Yade_LIBRARY_SUBDIR}/py/yade_brick)
install(
	CODE "file(CREATE_LINK ../../$<TARGET_FILE_NAME:pkg_brick> \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${Yade_LIBRARY_SUBDIR}/py/yade_brick/_core.so\" SYMBOLIC)"
)
