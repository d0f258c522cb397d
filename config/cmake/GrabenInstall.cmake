# Installs libraries, headers, commands and documents, and what find_package(graben), pkg-config and CPack need; included after every target is there.
# Components: runtime (commands, shared libraries), development (the rest that a compiler or linker reads), documentation.
include(CMakePackageConfigHelpers)

set(_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/graben")
get_property(_modules GLOBAL PROPERTY GRABEN_MODULES)
list(TRANSFORM _modules PREPEND graben_ OUTPUT_VARIABLE _targets)
install(TARGETS ${_targets} EXPORT grabenTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
install(EXPORT grabenTargets NAMESPACE graben:: DESTINATION ${_package_dir} COMPONENT development)

# From the folder of the .pc files up to the prefix, so that the installed set can be moved.
file(RELATIVE_PATH GRABEN_PREFIX_FROM_PKGCONFIG "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
# What each module links, as the package's files say it: other modules, and libraries of other packages.
set(GRABEN_PACKAGE_PARTS "")
foreach(_module ${_modules})
  get_target_property(_links graben_${_module} INTERFACE_LINK_LIBRARIES)
  get_target_property(_type graben_${_module} TYPE)
  set(_depends "")
  set(_pcl "")
  set(_vtk "")
  set(_others "")
  foreach(_link ${_links})
    if(_link MATCHES "graben::([a-z]+)")
      list(APPEND _depends ${CMAKE_MATCH_1})
    elseif(_link MATCHES "VTK::([A-Za-z0-9]+)")
      list(APPEND _vtk ${CMAKE_MATCH_1})
    elseif(_link MATCHES "pcl_([a-z_]+)")
      list(APPEND _pcl ${CMAKE_MATCH_1})
    elseif(_link MATCHES "X11::X11")
      list(APPEND _others X11)
    elseif(_link MATCHES "PkgConfig::CAIRO")
      list(APPEND _others CAIRO)
    endif()
  endforeach()
  foreach(_list depends pcl vtk others)
    list(REMOVE_DUPLICATES _${_list})
    list(JOIN _${_list} " " _text)
    string(APPEND GRABEN_PACKAGE_PARTS "set(_graben_${_module}_${_list} ${_text})\n")
  endforeach()
  include(GrabenPkgConfig)
endforeach()
list(JOIN _modules " " GRABEN_PACKAGE_MODULES)

configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/GrabenConfig.cmake.in" "${CMAKE_BINARY_DIR}/grabenConfig.cmake"
  INSTALL_DESTINATION ${_package_dir})
# Before 1.0 a minor version may break its users.
write_basic_package_version_file("${CMAKE_BINARY_DIR}/grabenConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/grabenConfig.cmake" "${CMAKE_BINARY_DIR}/grabenConfigVersion.cmake"
  DESTINATION ${_package_dir} COMPONENT development)

install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/graben COMPONENT documentation)
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documentation)
install(DIRECTORY config/documentation config/parameters DESTINATION ${CMAKE_INSTALL_DOCDIR}/config COMPONENT documentation)

include(GrabenPackages)
