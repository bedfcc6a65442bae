#include "app/python/module.h"

#include <pybind11/stl.h>
#include <regex>

#include "app/cli/preset_library.h"
#include "render/gl/context.h"

namespace gridshell::python {
namespace {

/// The exception class of a kind of error: derived from Error and, if `also` is given, from a
/// built-in class.
struct FaultClass {
  Fault fault;
  const char* name;
  PyObject* also;
  const char* doc;
};

const std::vector<FaultClass>& fault_classes() {
  static const std::vector<FaultClass> all{
      {Fault::bad_input, "BadInput", PyExc_ValueError,
       "A wrong preset, key, value, folder or joint; the message names it and what is allowed."},
      {Fault::no_equilibrium, "NoEquilibrium", nullptr,
       "No certified state was found, or the path ended early. The session is in its last "
       "certified state."},
      {Fault::io, "IOFailure", PyExc_OSError,
       "A file could not be written, or no OpenGL context is available."}};
  return all;
}

void add_error(py::module_& module, const char* name, const char* doc, PyObject* base,
               PyObject* also = nullptr) {
  const auto of = [](PyObject* one) { return py::reinterpret_borrow<py::object>(one); };
  const py::tuple bases = also ? py::make_tuple(of(base), of(also)) : py::make_tuple(of(base));
  const std::string full = std::string("gridshell.").append(name);
  PyObject* made = PyErr_NewExceptionWithDoc(full.c_str(), doc, bases.ptr(), nullptr);
  if (!made) throw py::error_already_set();
  module.attr(name) = py::reinterpret_steal<py::object>(made);
}

/// A number, string, path, bool, sequence of these or numpy array as TOML. Raises TypeError for
/// anything else.
std::string toml_of(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::int_>(value)) return py::str(value);
  if (PyFloat_Check(value.ptr())) return py::str(py::float_(value.cast<double>()));
  if (py::isinstance<py::str>(value))
    return py::str(py::module_::import("json").attr("dumps")(value));
  // numbers and arrays of numpy
  if (py::hasattr(value, "tolist")) return toml_of(value.attr("tolist")());
  if (py::hasattr(value, "__fspath__")) return toml_of(value.attr("__fspath__")());
  if (!py::isinstance<py::sequence>(value) || py::isinstance<py::bytes>(value))
    throw py::type_error("a preset takes numbers, strings, bools and lists of them, not " +
                         std::string(py::str(py::type::handle_of(value).attr("__name__"))));
  std::string text = "[";
  for (const py::handle item : py::reinterpret_borrow<py::sequence>(value))
    text.append(text.size() > 1 ? ", " : "").append(toml_of(item));
  return text + "]";
}

}  // namespace

void add_errors(py::module_& module) {
  add_error(module, "Error",
            "Base class of all errors of gridshell; the message is that of the program.",
            PyExc_Exception);
  const py::object error = module.attr("Error");
  for (const FaultClass& one : fault_classes())
    add_error(module, one.name, one.doc, error.ptr(), one.also);
}

void raise(const Error& error) {
  py::object type = py::reinterpret_borrow<py::object>(PyExc_KeyboardInterrupt);
  for (const FaultClass& one : fault_classes())
    if (one.fault == error.fault) type = py::module_::import("gridshell").attr(one.name);
  PyErr_SetString(type.ptr(), error.message.c_str());
  throw py::error_already_set();
}

std::vector<preset::Override> overrides_of(const py::dict& changes) {
  std::vector<preset::Override> overrides;
  for (const auto& [key, value] : changes) {
    if (!py::isinstance<py::str>(key))
      throw py::type_error("keys are strings such as \"footprint.rods\"");
    const auto name = key.cast<std::string>();
    if (!py::isinstance<py::dict>(value)) {
      overrides.push_back({"changes", name, toml_of(value)});
      continue;
    }
    for (preset::Override& inner : overrides_of(py::reinterpret_borrow<py::dict>(value))) {
      inner.key.insert(0, name + ".");
      overrides.push_back(std::move(inner));
    }
  }
  return overrides;
}

preset::Step step_of(const preset::Preset& preset, const char* kind, const py::dict& keys) {
  std::string text = std::string("step = [{do = \"").append(kind).append("\"");
  for (const auto& [key, value] : keys)
    if (!value.is_none())
      text.append(", ").append(key.cast<std::string>()).append(" = ").append(toml_of(value));
  // without the steps, the push and the search of the preset itself
  preset::Preset alone = preset;
  alone.step.clear();
  alone.indentation = {};
  alone.jitter = {};
  text.append("}]\n").append(preset::to_toml(alone));
  // errors name the method; their lines and columns are those of a text that its user does not see
  const std::string method = kind == std::string("move") ? "actuate()" : std::string(kind) + "()";
  auto read = preset::read_preset_text(text, method, preset.name);
  static const std::regex position("\\(\\):\\d+:\\d+:( \\[\\[step\\]\\] 1)?");
  if (!read) read.error().message = std::regex_replace(read.error().message, position, "():");
  return std::move(value_of(std::move(read)).base.step.at(0));
}

}  // namespace gridshell::python

// The Python module `gridshell`.

PYBIND11_MODULE(gridshell, module) {
  using namespace gridshell;
  render::keep_compiled_shaders();
  module.doc() =
      "Elastic gridshells: form them, push them, measure them, draw them.\n\n    import gridshell "
      "as gs\n    s = gs.Session(\"s1_actuation\", {\"footprint.rods\": 8, "
      "\"footprint.radius_mm\": 84,\n                                    \"actuation.radius_mm\": "
      "63})\n    s.actuate()                      # forms the shell\n    s.push((0, 0), "
      "depth_mm=2)       # pushes the joint (i, j) inward\n    print(s.height_mm, s.force_N, "
      "s.certificate)\n    run = gs.load(\"out/run\")         # reads what `gridshell run` "
      "wrote\n\nSession commands a shell, State is one state of it with arrays, Run is a finished "
      "run. Units: millimetres, newtons, millijoules, radians; z is up. K is the integrated Gauss "
      "curvature of a cell, 2 pi less its four angles.";
  module.attr("__version__") = version();
  python::add_errors(module);
  python::add_values(module);
  python::add_session(module);
  python::add_run(module);
  module.def(
      "presets",
      [] {
        std::vector<std::string> names;
        for (const auto& one : app::embedded_presets()) names.push_back(one.name);
        return names;
      },
      "Names of the presets that come with the program.");
}
