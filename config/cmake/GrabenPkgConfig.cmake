# graben_<module>.pc, from what GrabenInstall.cmake found out about the module.
list(TRANSFORM _depends PREPEND graben_ OUTPUT_VARIABLE _requires)
list(TRANSFORM _pcl PREPEND pcl_ OUTPUT_VARIABLE _pcl_packages)
list(APPEND _requires ${_pcl_packages})
set(_libs "")
set(_cflags "")
if(NOT _type STREQUAL "INTERFACE_LIBRARY")
  set(_libs "-L\${libdir} -lgraben_${_module}")
endif()
if(_module STREQUAL "core")
  list(APPEND _requires eigen3)
  set(_cflags " ${OpenMP_CXX_FLAGS}")
  string(APPEND _libs " ${OpenMP_CXX_FLAGS}")
endif()
if(_type STREQUAL "STATIC_LIBRARY") # what it links itself, its users have to link
  foreach(_part ${_vtk})
    string(APPEND _libs " $<TARGET_FILE:VTK::${_part}>")
  endforeach()
  if("X11" IN_LIST _others)
    list(APPEND _requires x11)
  endif()
  if("CAIRO" IN_LIST _others)
    list(APPEND _requires cairo)
  endif()
endif()
list(JOIN _requires " " _requires)
file(GENERATE OUTPUT "${CMAKE_BINARY_DIR}/pkgconfig/graben_${_module}.pc" CONTENT
"prefix=\${pcfiledir}/${GRABEN_PREFIX_FROM_PKGCONFIG}
libdir=\${prefix}/${CMAKE_INSTALL_LIBDIR}
includedir=\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}

Name: graben_${_module}
Description: graben, faulted geological horizons from picks and faults: module ${_module}
Version: ${PROJECT_VERSION}
Requires: ${_requires}
Libs: ${_libs}
Cflags: -I\${includedir}${_cflags}
")
install(FILES "${CMAKE_BINARY_DIR}/pkgconfig/graben_${_module}.pc" DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
