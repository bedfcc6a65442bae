// What the module is made of.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

#include "engine/preset/reader.h"

namespace gridshell::python {
namespace py = pybind11;

/// Adds the classes Session and Checkpoint to the module.
void add_session(py::module_& module);

/// Adds the class Run and the function load to the module.
void add_run(py::module_& module);

/// The case of a name, or the preset itself where it has none. Raises BadInput, naming the cases.
preset::Preset chosen(const preset::Presets& presets, const std::optional<std::string>& name);

}  // namespace gridshell::python
