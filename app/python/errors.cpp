#include "app/python/errors.h"

namespace gridshell::python {
namespace {

/// A class of the module, below others.
void add(py::module_& module, const char* name, const py::tuple& bases, const char* doc) {
  const std::string full = std::string("gridshell.").append(name);
  PyObject* made = PyErr_NewExceptionWithDoc(full.c_str(), doc, bases.ptr(), nullptr);
  if (!made) throw py::error_already_set();
  module.attr(name) = py::reinterpret_steal<py::object>(made);
}

const char* name_of(Fault fault) {
  switch (fault) {
    case Fault::bad_input:
      return "BadInput";
    case Fault::no_equilibrium:
      return "NoEquilibrium";
    case Fault::io:
      return "IOFailure";
    case Fault::cancelled:
      break;
  }
  return nullptr;
}

}  // namespace

void add_errors(py::module_& module) {
  const auto of = [](PyObject* base) { return py::reinterpret_borrow<py::object>(base); };
  add(module, "Error", py::make_tuple(of(PyExc_Exception)),
      "What went wrong, in the words of the program. Every other error of gridshell is one.");
  const py::object error = module.attr("Error");
  add(module, "BadInput", py::make_tuple(error, of(PyExc_ValueError)),
      "A preset, a key, a value, a folder or a joint that is not right: names it, and what would "
      "be.");
  add(module, "NoEquilibrium", py::make_tuple(error),
      "No certified state was found, or the path ended before its end. The session stands in its "
      "last certified state.");
  add(module, "IOFailure", py::make_tuple(error, of(PyExc_OSError)),
      "A file could not be written, or no OpenGL context be had.");
}

void raise(const Error& error) {
  if (const char* name = name_of(error.fault)) {
    const py::object type = py::module_::import("gridshell").attr(name);
    PyErr_SetString(type.ptr(), error.message.c_str());
  } else {
    PyErr_SetString(PyExc_KeyboardInterrupt, error.message.c_str());
  }
  throw py::error_already_set();
}

}  // namespace gridshell::python
