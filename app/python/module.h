// The parts of the Python module: exceptions, arguments, arrays, classes.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/python/shell.h"
#include "engine/gridshell.h"

namespace gridshell::python {
namespace py = pybind11;

/// Adds the classes to the module: Error and, below it, BadInput, NoEquilibrium, IOFailure.
void add_errors(py::module_& module);

/// Raises the exception that belongs to an error, with the error's message.
[[noreturn]] void raise(const Error& error);

/// The value of a result; raises the exception of its error.
template <class T>
T value_of(Result<T> result) {
  if (!result) raise(result.error());
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

// Long work that Ctrl-C stops.

/// Calls work(watch) on a new thread without the GIL, while the caller waits and lets Python handle
/// its signals every 20 ms. An exception of a handler (KeyboardInterrupt) cancels the watch and is
/// raised again once the work has ended. Python handles signals only in its main thread.
template <class Work>
auto interruptible(const Work& work) {
  Watch watch;
  std::optional<py::error_already_set> raised;
  auto running = std::async(std::launch::async, [&] { return work(watch); });
  for (bool ended = false; !ended;) {
    {
      const py::gil_scoped_release others;
      ended = running.wait_for(std::chrono::milliseconds(20)) == std::future_status::ready;
    }
    if (PyErr_CheckSignals() == 0) continue;
    if (!raised) raised.emplace();
    PyErr_Clear();
    watch.cancel();
  }
  auto result = running.get();
  if (raised) throw py::error_already_set(*raised);
  return result;
}

// Values of keys from Python. They are converted to TOML, which the reader of presets then checks.

/// The name of a type in Python, as a template argument.
template <std::size_t size>
struct TypeName {
  char text[size];
  constexpr TypeName(const char (&from)[size]) { std::copy_n(from, size, text); }
};

/// An argument of any type, whose name in signatures is `name`; the code that uses it checks it.
template <TypeName name>
struct Judged {
  py::object value = py::none();
};

/// {"footprint.rods": 14} or {"footprint": {"rods": 14}} as changes to a preset. Raises TypeError.
std::vector<preset::Override> overrides_of(const py::dict& changes);

/// A step with the keys of [[step]], without those that are None, checked together with the preset.
/// Raises BadInput, TypeError.
preset::Step step_of(const preset::Preset& preset, const char* kind, const py::dict& keys);

// Numpy arrays as read-only views of numbers, which are not copied.

/// An array over memory of `owner`, which exists at least as long as the array.
template <class Number>
py::array_t<Number> view(const Number* data, const std::vector<py::ssize_t>& shape,
                         const std::vector<py::ssize_t>& strides, const py::object& owner) {
  py::array_t<Number> array(shape, strides, data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// A view of n numbers.
inline py::array_t<double> view(const Eigen::VectorXd& numbers, const py::object& owner) {
  return view(numbers.data(), {numbers.size()}, {sizeof(double)}, owner);
}

/// A view of n points, n x 3: one row per point.
inline py::array_t<double> view(const Eigen::Matrix3Xd& points, const py::object& owner) {
  return view(points.data(), {points.cols(), 3}, {3 * sizeof(double), sizeof(double)}, owner);
}

inline py::array_t<int> view(const std::vector<int>& numbers, const py::object& owner) {
  return view(numbers.data(), {py::ssize_t(numbers.size())}, {sizeof(int)}, owner);
}

/// Adds the classes Session and Checkpoint to the module.
void add_session(py::module_& module);

/// Adds the class Run and the function load to the module.
void add_run(py::module_& module);

/// The case with this name; without a name the preset itself, if it has no cases. Raises BadInput,
/// with the names of the cases.
preset::Preset chosen(const preset::Presets& presets, const std::optional<std::string>& name);

/// A number of a state: a property of State, and a column of Run.
struct Number {
  const char* name;
  double record::Frame::*member;
  const char* doc;
};

inline constexpr std::array numbers{
    Number{"progress", &record::Frame::progress,
           "Progress. In a session: of the boundary, 0 the original, 1 the actuated one. In a run: "
           "of the experiment, 0 at its start, 1 at its end."},
    Number{"boundary_radius_mm", &record::Frame::boundary_radius_mm,
           "Radius of a circular boundary, mm; else nan."},
    Number{"depth_mm", &record::Frame::depth_mm,
           "Displacement of the last prescribed joint along its direction, mm; nan: none is "
           "prescribed."},
    Number{"force_N", &record::Frame::force_N,
           "Force with which the shell resists that displacement, N; nan: no joint is prescribed."},
    Number{"push_error_N", &record::Frame::push_error_N, "Error of force_N, N; nan: unknown."},
    Number{"stiffness_N_per_mm", &record::Frame::stiffness_N_per_mm,
           "Increase of force_N with depth_mm, N/mm; nan: no joint is prescribed."},
    Number{"stiffness_error_N_per_mm", &record::Frame::stiffness_error_N_per_mm,
           "Error of stiffness_N_per_mm, N/mm; nan: unknown."},
    Number{"largest_force_N", &record::Frame::largest_force_N,
           "Largest of reactions_N, N; nan: unknown."},
    Number{"force_error_N", &record::Frame::force_error_N,
           "Largest error of reactions_N and force_N, N; nan: unknown, as on one mesh."},
    Number{"energies_error_mJ", &record::Frame::energy_error_mJ,
           "Largest error of the energies and of their sum, mJ; nan: unknown."},
    Number{"largest_bending_strain", &record::Frame::largest_bending_strain,
           "Largest bending strain of a fibre, from the change of curvature; nan: unknown."},
    Number{"largest_stress_MPa", &record::Frame::largest_stress_MPa,
           "Largest stress of a fibre, by axial force and bending, MPa; nan: unknown."},
    Number{"utilisation", &record::Frame::utilisation,
           "Largest stress of a fibre over the strength of its rod; nan: unknown."},
    Number{"height_mm", &record::Frame::height_mm,
           "Height of the highest joint above the original boundary's plane, mm."},
    Number{"total_K", &record::Frame::total_K, "Sum of cell_K over all complete cells, rad."},
    Number{"residual_N", &record::Frame::residual_N,
           "Largest force that is left on a free node, N."},
    Number{"error_estimate_mm", &record::Frame::error_estimate_mm,
           "Error estimate of all positions, mm; nan: unknown."},
    Number{"time_s", &record::Frame::time_s,
           "Time since the start of a snap that is integrated in time, s; else nan."},
};

/// Adds the classes State, Layout, Certificate, Report and Event to the module.
void add_values(py::module_& module);

/// Draws a state into a PNG, as the program draws a frame of a movie; `size`: (width, height) in
/// pixels, by default that of its preset. Raises IOFailure, BadInput.
void draw(const State& state, const std::filesystem::path& path,
          const std::optional<std::pair<int, int>>& size, const std::string& context);

/// The docstring of the methods `picture`.
inline constexpr const char* picture_doc =
    "Draws the shell into a PNG, as the program draws a frame of a movie, with [movie] and [style] "
    "of the preset.\n\nsize: (width, height) in pixels, else the preset's. context: where OpenGL "
    "comes from, \"auto\", \"osmesa\", \"egl\" or \"window\".";

}  // namespace gridshell::python

template <gridshell::python::TypeName type_name>
struct pybind11::detail::type_caster<gridshell::python::Judged<type_name>> {
  PYBIND11_TYPE_CASTER(gridshell::python::Judged<type_name>, const_name(type_name.text));
  bool load(handle source, bool) {
    value.value = reinterpret_borrow<object>(source);
    return true;
  }
  static handle cast(const gridshell::python::Judged<type_name>& judged, return_value_policy,
                     handle) {
    return judged.value.inc_ref();
  }
};
