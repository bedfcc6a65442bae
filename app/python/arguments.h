// What Python passes as a value of a preset, as TOML: the preset's reader then judges it.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "engine/preset/reader.h"

namespace gridshell::python {
namespace py = pybind11;

/// A number, string, path, bool, sequence of these or numpy array as TOML. Raises TypeError for
/// anything else.
std::string toml_of(const py::handle& value);

/// {"footprint.rods": 14} as changes to a preset. Raises TypeError.
std::vector<preset::Override> overrides_of(const py::dict& changes);

/// A step of a hand with the keys of [[step]], those that are None left out, judged together with
/// the preset. Raises BadInput, TypeError.
preset::Step step_of(const preset::Preset& preset, const char* deed, const py::dict& keys);

}  // namespace gridshell::python
