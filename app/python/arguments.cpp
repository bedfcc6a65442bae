#include "app/python/arguments.h"

#include <utility>

#include "app/python/errors.h"
#include "engine/preset/writer.h"

namespace gridshell::python {

std::string toml_of(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::int_>(value)) return py::str(value);
  if (PyFloat_Check(value.ptr())) return py::str(py::float_(value.cast<double>()));
  if (py::isinstance<py::str>(value))
    return py::str(py::module_::import("json").attr("dumps")(value));
  // of numpy, a number or a list of them
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

std::vector<preset::Override> overrides_of(const py::dict& changes) {
  std::vector<preset::Override> overrides;
  for (const auto& [key, value] : changes) {
    if (!py::isinstance<py::str>(key))
      throw py::type_error("keys are strings such as \"footprint.rods\"");
    overrides.push_back({"changes", key.cast<std::string>(), toml_of(value)});
  }
  return overrides;
}

preset::Step step_of(const preset::Preset& preset, const char* deed, const py::dict& keys) {
  std::string text = std::string("step = [{do = \"").append(deed).append("\"");
  for (const auto& [key, value] : keys)
    if (!value.is_none())
      text.append(", ").append(key.cast<std::string>()).append(" = ").append(toml_of(value));
  // what the preset itself would do to the shell is not done here
  preset::Preset alone = preset;
  alone.step.clear();
  alone.indentation = {};
  alone.jitter = {};
  text.append("}]\n").append(preset::to_toml(alone));
  auto read = value_of(preset::read_preset_text(text, std::string(deed) + "()", preset.name));
  return std::move(read.base.step.at(0));
}

}  // namespace gridshell::python
