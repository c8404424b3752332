# SPDX-License-Identifier: GPL-2.0-or-later
#
# Two interface targets:
#   yade_flags    flags without which objects differ from YADE's in memory, or symbols are not shared. For all our C++ code.
#   yade_headers  YADE's classes: our declarations, or the headers of a source tree. For pkg/brick only.
#
# Never: -fvisibility=hidden, -Wl,-Bsymbolic, -fno-gnu-unique, -static-libstdc++ (YADE and we must share weak symbols and unique
# statics, or casts and archives fail across the border), -D_GLIBCXX_DEBUG (other containers), -ffast-math (NaN means `not given`).
add_library(yade_flags INTERFACE)
target_compile_features(yade_flags INTERFACE cxx_std_17)
target_compile_definitions(
	yade_flags
	INTERFACE
		EIGEN_DONT_ALIGN # layout: quaternions at 8 bytes; otherwise State and all after it moves, silently
		EIGEN_DONT_VECTORIZE # as YADE: the same code for the same inline function on both sides
		EIGEN_DISABLE_UNALIGNED_ARRAY_ASSERT # as YADE
)
target_compile_options(yade_flags INTERFACE -fPIC -fopenmp -Wall -Wextra)
if(BRICK_WARNINGS_AS_ERRORS)
	target_compile_options(yade_flags INTERFACE -Werror)
endif()
target_link_options(yade_flags INTERFACE -fopenmp)
if(BRICK_SANITIZE)
	include(Sanitize)
endif()
target_include_directories(yade_flags SYSTEM INTERFACE ${EIGEN3_INCLUDE_DIRS})

add_library(yade_headers INTERFACE)
target_link_libraries(yade_headers INTERFACE yade_flags Boost::${python_component} Boost::serialization Python3::Module)
target_compile_definitions(
	yade_headers
	INTERFACE
		BOOST_ALL_DYN_LINK # Boost from the shared libraries that YADE uses
		BOOST_BIND_GLOBAL_PLACEHOLDERS # only to silence notes of Boost
		BOOST_ALLOW_DEPRECATED_HEADERS # likewise
)
# Not needed to load, since YADE's symbols are there by then; but so a missing symbol shows at link time. libyade.so does not list
# Boost itself, hence --allow-shlib-undefined.
target_link_libraries(yade_headers INTERFACE ${Yade_LIBRARIES} ${Python3_LIBRARIES})
target_link_options(yade_headers INTERFACE -Wl,--no-undefined -Wl,--allow-shlib-undefined)

if(YADE_SOURCE_DIR)
	include(YadeSource)
else()
	target_include_directories(yade_headers INTERFACE ${CMAKE_SOURCE_DIR}/yade-abi/${Yade_VERSION})
	target_compile_definitions(yade_headers INTERFACE YADE_BRICK_YADE_VERSION="${Yade_VERSION}")
endif()
