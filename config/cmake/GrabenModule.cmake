# graben_add_module(<name> SOURCES <files> [DEPENDS <graben modules>] [PUBLIC <targets>] [PRIVATE <targets>])
# One library graben_<name> (alias graben::<name>) from modules/<name>, headers in include/.
function(graben_add_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PUBLIC;PRIVATE" ${ARGN})
  add_library(graben_${name} ${ARG_SOURCES})
  add_library(graben::${name} ALIAS graben_${name})
  target_compile_features(graben_${name} PUBLIC cxx_std_17)
  target_compile_options(graben_${name} PRIVATE -ffp-contract=off)
  target_include_directories(graben_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM ARG_DEPENDS PREPEND graben::)
  target_link_libraries(graben_${name}
    PUBLIC ${ARG_DEPENDS} ${ARG_PUBLIC}
    PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:graben_warnings>)
  set_target_properties(graben_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY GRABEN_MODULES graben_${name})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()

