// The numbers of a state: one table for a state's properties and a run's columns.
#pragma once

#include <pybind11/pybind11.h>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "app/python/shell.h"
#include "engine/gridshell.h"

namespace gridshell::python {

struct Number {
  const char* name;
  double record::Frame::*member;
  const char* doc;
};

inline constexpr std::array numbers{
    Number{"progress", &record::Frame::progress,
           "Of a session: of the boundary, 0 the original and 1 the actuated one. Of a run: of the "
           "experiment, 0 its begin and 1 its end."},
    Number{"boundary_radius_mm", &record::Frame::boundary_radius_mm,
           "Of a circular boundary, mm; else nan."},
    Number{"depth_mm", &record::Frame::depth_mm,
           "How far the joint held last was moved the way it is held, mm; nan: none is held."},
    Number{"force_N", &record::Frame::force_N,
           "With what force the shell resists that move, N; nan: no joint is held."},
    Number{"height_mm", &record::Frame::height_mm,
           "Of the highest joint above the original boundary's plane, mm."},
    Number{"total_K", &record::Frame::total_K, "Sum of cell_K, rad."},
    Number{"residual_N", &record::Frame::residual_N, "Largest force that nothing holds, N."},
    Number{"error_estimate_mm", &record::Frame::error_estimate_mm,
           "Of the joints' positions, mm; nan: not known."},
    Number{"time_s", &record::Frame::time_s,
           "Since the begin of a snap that was followed in time, s; else nan."},
};

// What sessions and runs hand out: states, layouts, certificates and reports.

/// Adds the classes State, Layout, Certificate, Report and Event to the module.
void add_values(py::module_& module);

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
