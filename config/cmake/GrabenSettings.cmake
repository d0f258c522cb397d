# Compiler settings shared by every target.
include(GNUInstallDirs)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# An installed set of shared libraries finds itself wherever it is put.
file(RELATIVE_PATH _bin_to_lib "/prefix/${CMAKE_INSTALL_BINDIR}" "/prefix/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_INSTALL_RPATH "$ORIGIN" "$ORIGIN/${_bin_to_lib}")
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH TRUE)

find_program(GRABEN_CCACHE ccache)
if(GRABEN_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${GRABEN_CCACHE}")
endif()

# No -march and no -ffast-math: Debian's PCL is plain x86-64, and NaN means "no data".
# -ffp-contract=off keeps results the same on machines with fused multiply-add.
add_library(graben_warnings INTERFACE)
target_compile_options(graben_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  $<$<BOOL:${GRABEN_WERROR}>:-Werror>)

# Debian's libraries are not instrumented. The standard library's assertions are checked too, and Eigen's where the build type leaves them.
set(GRABEN_SANITIZE "" CACHE STRING "Sanitizers to build with: address,undefined or thread (see tests/run --sanitize); empty: none")
if(GRABEN_SANITIZE)
  add_compile_options(-fsanitize=${GRABEN_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -D_GLIBCXX_ASSERTIONS)
  add_link_options(-fsanitize=${GRABEN_SANITIZE})
endif()
