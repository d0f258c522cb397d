# graben_find_python(): find_package(Python) with an interpreter that has headers and numpy of its own.
# GRABEN_PYTHON names it; else it is Debian's, then the python3 that the path finds: other installations that come first there seldom have numpy.
function(_graben_python_usable python result)
  execute_process(
    COMMAND "${python}" -c
      "import numpy, os, sysconfig; assert os.path.exists(os.path.join(sysconfig.get_path('include'), 'Python.h'))"
    RESULT_VARIABLE _code OUTPUT_QUIET ERROR_QUIET)
  if(_code EQUAL 0)
    set(${result} TRUE PARENT_SCOPE)
  else()
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()

macro(graben_find_python)
  if(NOT GRABEN_PYTHON)
    find_program(_graben_path_python python3)
    foreach(_candidate /usr/bin/python3 "${_graben_path_python}")
      _graben_python_usable("${_candidate}" _usable)
      if(_usable)
        set(GRABEN_PYTHON "${_candidate}" CACHE FILEPATH "The Python that graben's package is built for")
        break()
      endif()
    endforeach()
  endif()
  if(NOT GRABEN_PYTHON)
    message(FATAL_ERROR "No python3 with its headers and numpy was found: install python3-dev and python3-numpy, name one with -DGRABEN_PYTHON=..., "
      "or leave the Python package out with -DGRABEN_BUILD_PYTHON=OFF")
  endif()
  set(Python_EXECUTABLE "${GRABEN_PYTHON}")
  set(PYBIND11_FINDPYTHON ON)
  find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
endmacro()
