# graben_add_module(<name> SOURCES <files> [DEPENDS <graben modules>] [PUBLIC <targets>] [PRIVATE <targets>])
# One library graben_<name> (alias graben::<name>) from modules/<name>, headers in include/.
function(graben_add_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PUBLIC;PRIVATE" ${ARGN})
  graben_sources(_sources graben_${name} modules/${name} ${ARG_SOURCES})
  add_library(graben_${name} ${_sources})
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
  # Before 1.0 a minor version may break its users.
  set_target_properties(graben_${name} PROPERTIES
    EXPORT_NAME ${name} DEFINE_SYMBOL "" LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  set_property(GLOBAL APPEND PROPERTY GRABEN_MODULES ${name})
  graben_install_headers()
endfunction()

# graben_add_header_module(<name> DEPENDS <graben modules> [PUBLIC <targets>]): the same without sources.
function(graben_add_header_module name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;PUBLIC" ${ARGN})
  add_library(graben_${name} INTERFACE)
  add_library(graben::${name} ALIAS graben_${name})
  target_include_directories(graben_${name} INTERFACE
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM ARG_DEPENDS PREPEND graben::)
  target_link_libraries(graben_${name} INTERFACE ${ARG_DEPENDS} ${ARG_PUBLIC})
  set_target_properties(graben_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY GRABEN_MODULES ${name})
  graben_install_headers()
endfunction()

macro(graben_install_headers)
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
endmacro()

# What a target is made from: its sources or, in a second build of the same sources that differs in how they are linked alone (the test of shared
# libraries), the objects of the first one, GRABEN_OBJECTS_OF.
function(graben_sources out target folder)
  if(GRABEN_OBJECTS_OF)
    list(TRANSFORM ARGN REPLACE "(.+)" "${GRABEN_OBJECTS_OF}/${folder}/CMakeFiles/${target}.dir/\\1.o" OUTPUT_VARIABLE _objects)
    set_source_files_properties(${_objects} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
    set(${out} ${_objects} PARENT_SCOPE)
  else()
    set(${out} ${ARGN} PARENT_SCOPE)
  endif()
endfunction()
