#include "errors.h"

#include "graben/core/errors.h"
#include "graben/core/interruption.h"
#include "support/options.h"

#include <algorithm>
#include <regex>
#include <string>

namespace graben::python {

namespace py = pybind11;

namespace {

/// The words of a command line as a Python programmer knows them: option --voxel-size is the argument voxel_size.
std::string asArguments(const std::string& message) {
  static const std::regex kOption("(option )?--([a-z][a-z-]*)");
  std::string text;
  auto from = message.cbegin();
  for (std::sregex_iterator match(message.begin(), message.end(), kOption), end; match != end; ++match) {
    text.append(from, (*match)[0].first);
    std::string name = (*match)[2].str();
    std::replace(name.begin(), name.end(), '-', '_');
    text += name;
    from = (*match)[0].second;
  }
  return text.append(from, message.cend());
}

void raise(const char* name, const std::string& message, const py::object& file = py::none(), const py::object& row = py::none()) {
  const py::object type = py::module_::import("graben.errors").attr(name);
  const py::object error = type(message, py::arg("file") = file, py::arg("row") = row);
  PyErr_SetObject(type.ptr(), error.ptr());
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer)
      std::rethrow_exception(pointer);
  } catch (const UsageError& error) {
    PyErr_SetString(PyExc_ValueError, asArguments(error.what()).c_str());
  } catch (const ParseError& error) {
    raise("FileError", error.what(), py::str(error.file()), error.line() > 0 ? py::object(py::int_(error.line())) : py::object(py::none()));
  } catch (const IoError& error) {
    raise("FileError", error.what(), py::str(error.file()));
  } catch (const InvalidInputError& error) {
    raise("InvalidInputError", asArguments(error.what()));
  } catch (const ResourceError& error) {
    raise("ResourceError", asArguments(error.what()));
  } catch (const Error& error) {
    raise("Error", error.what());
  } catch (const Interrupted&) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  }
}

} // namespace

void translateErrors() { py::register_exception_translator(&translate); }

} // namespace graben::python
