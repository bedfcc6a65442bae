// What sessions and runs hand out: states, layouts, certificates and reports.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "app/python/shell.h"

namespace gridshell::python {
namespace py = pybind11;

/// Adds the classes State, Layout, Certificate, Report and Event to the module.
void add_values(py::module_& module);

/// {"bend": ..., "stretch": ...}, mJ.
py::dict dict_of(const Energies& energies);

/// Draws a state into a PNG as the program draws a frame of a movie, in the size (width, height)
/// or its preset's. Raises IOFailure, BadInput.
void draw(const State& state, const std::filesystem::path& path,
          const std::optional<std::pair<int, int>>& size, const std::string& context);

/// What `picture` takes and does, for the methods of that name.
inline constexpr const char* picture_doc =
    "Draws the shell into a PNG, as the program draws a frame of a movie: colours, camera and look "
    "are those of [movie] and [style] of the preset.\n\n"
    "size: (width, height) in pixels, else the preset's. context: how OpenGL is had, \"auto\", "
    "\"osmesa\", \"egl\" or \"window\".";

}  // namespace gridshell::python
