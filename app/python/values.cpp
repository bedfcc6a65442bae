#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <utility>

#include "app/cli/pictures.h"
#include "app/python/module.h"
#include "app/python/pickled.h"
#include "render/gl/image.h"
#include "render/movie/stage.h"

#include "engine/core/try.h"

namespace gridshell::python {
namespace {

using record::Layout;

const Layout& arrays_of(const Layout& layout) { return layout; }
const record::Frame& arrays_of(const State& state) { return state.frame; }

/// Adds a property with an array that is a view of the object.
template <class Class, class Member>
void add_view(py::class_<Class, std::shared_ptr<Class>>& type, const char* name, Member member,
              const char* doc) {
  type.def_property_readonly(
      name,
      [member](const py::object& self) {
        return view(arrays_of(self.cast<Class&>()).*member, self);
      },
      doc);
}

void add_certificate(py::module_& module) {
  py::class_<Certificate, std::shared_ptr<Certificate>> type(module, "Certificate",
                                                             "What is known of a state.");
  add_pickling<Certificate>(type);
  type.def_readonly("residual_N", &Certificate::residual_N,
                    "Largest force that is left on a free node, N.")
      .def_readonly(
          "negative_pivots", &Certificate::negative_pivots,
          "Number of negative pivots of the Hessian under the constraints; 0: stable, -1: unknown.")
      .def_readonly("error_estimate_mm", &Certificate::error_estimate_mm,
                    "Error estimate of all positions, mm; nan: unknown, as on one mesh.")
      .def_readonly("largest_strain", &Certificate::largest_strain,
                    "Axial strain of largest size of any edge; negative: compressed, nan: unknown.")
      .def_property_readonly("stable", &Certificate::stable, "Whether it has no negative pivot.")
      .def("__repr__", [](const Certificate& of) {
        return fmt::format(
            "Certificate(residual_N={:.2g}, {}, error_estimate_mm={:.2g})", of.residual_N,
            of.stable() ? "stable" : fmt::format("negative_pivots={}", of.negative_pivots),
            of.error_estimate_mm);
      });
}

void add_report(py::module_& module) {
  py::class_<Event, std::shared_ptr<Event>> event(
      module, "Event", "Something that happened to the shell on its path.");
  add_pickling<Event>(event);
  event
      .def_property_readonly(
          "kind", [](const Event& of) { return std::string(word_of(of.kind)); },
          "\"stability_lost\" (bifurcation), \"turned_back\" (limit point), \"locked\" (strain "
          "limit), \"overbent\" ([limits] max_bending_strain or max_utilisation) or \"contact\" "
          "(rods or joints start to touch).")
      .def_readonly("t", &Event::t,
                    "Path parameter: the square root of the progress in an actuation, else 0 at "
                    "the start of the step and 1 at its end.")
      .def_readonly("to", &Event::to,
                    "Path parameter of the state to which it snapped; None: it did not snap.")
      .def("__repr__", [](const Event& of) {
        return fmt::format("Event({}, t={:.4f}{})", word_of(of.kind), of.t,
                           of.to ? fmt::format(", to={:.4f}", *of.to) : "");
      });
  py::class_<Done, std::shared_ptr<Done>> report(module, "Report",
                                                 "Result of a step: certificate, events, effort.");
  add_pickling<Done>(report);
  report
      .def_property_readonly(
          "certificate", [](const Done& of) { return of.report.certificate; },
          "Certificate of the present state.")
      .def_property_readonly(
          "events", [](const Done& of) { return of.report.events; },
          "Events of the step, in order.")
      .def_property_readonly(
          "newton_iterations", [](const Done& of) { return of.report.effort.newton_iterations; },
          "Number of Newton iterations.")
      .def_property_readonly(
          "seconds", [](const Done& of) { return of.report.seconds; }, "Time of the step, s.")
      .def_readonly(
          "limit_reason", &Done::reported,
          "For the first actuation: what a run would report as limit_reason; empty: nothing.")
      .def_readonly("told", &Done::reported, "Earlier name of limit_reason.")
      .def("__repr__", [](const Done& of) {
        return fmt::format("Report({}, {} events, {:.2f} s)",
                           py::str(py::repr(py::cast(of.report.certificate))).cast<std::string>(),
                           of.report.events.size(), of.report.seconds);
      });
}

void add_layout(py::module_& module) {
  py::class_<Layout, std::shared_ptr<Layout>> type(module, "Layout",
                                                   "Rods, joints and cells; no step changes it.");
  type.def("__repr__", [](const Layout& of) {
    return fmt::format("Layout({} rods, {} joints, {} cells)", of.rods.size(), of.joints.size(),
                       of.cells.size());
  });
  type.def_readonly("spacing_mm", &Layout::spacing_mm,
                    "Distance between neighbouring rods of the flat grid, d, mm.")
      .def_readonly("rod_diameter_mm", &Layout::rod_diameter_mm, "Diameter of the rods, mm.")
      .def_readonly(
          "length_scale_mm", &Layout::length_scale_mm,
          "Length that relative errors refer to: R_o of a circle, the radius of a net, mm.")
      .def_readonly("families", &Layout::families, "Family of each rod, \"u\" or \"v\".")
      .def_property_readonly(
          "rods",
          [](const py::object& self) {
            std::vector<py::array_t<int>> rods;
            for (const auto& rod : self.cast<Layout&>().rods) rods.push_back(view(rod, self));
            return rods;
          },
          "Node numbers of each rod, from edge point to edge point.")
      .def_property_readonly(
          "joints",
          [](const py::object& self) {
            const auto& of = self.cast<Layout&>().joints;
            return view(&of.data()->i, {py::ssize_t(of.size()), 2}, {sizeof(of[0]), sizeof(int)},
                        self);
          },
          "Indices (i, j) of each joint, joints x 2. Joint k is node k.")
      .def_property_readonly(
          "cells",
          [](const py::object& self) {
            const auto& of = self.cast<Layout&>().cells;
            return view(of.empty() ? nullptr : of.data()->joints.data(),
                        {py::ssize_t(of.size()), 4}, {sizeof(of[0]), sizeof(int)}, self);
          },
          "The four joints of each complete cell in order, cells x 4.");
  add_view(type, "edge_points", &Layout::edge_points, "Nodes on the boundary.");
  add_view(type, "supports", &Layout::supports,
           "Nodes that may be constrained: those of reactions_N.");
  add_view(type, "original_boundary", &Layout::original_boundary,
           "Closed polyline of the original boundary, points x 3, mm.");
  add_view(type, "actuated_boundary", &Layout::actuated_boundary,
           "Closed polyline of the actuated boundary, points x 3, mm; point k corresponds to point "
           "k of the original.");
  add_view(type, "net_nodes", &Layout::net_nodes,
           "Positions of the nodes on the net that the footprint was designed on, nodes x 3, mm; 0 "
           "x 3: none.");
}

void add_state(py::module_& module) {
  py::class_<State, std::shared_ptr<State>> type(
      module, "State",
      "One state. It never changes: a session that continues has another one. Its arrays are views "
      "without a copy, read-only, and keep it alive.");
  add_pickling<State>(type);
  type.def("__repr__", [](const State& of) {
    return fmt::format("State({} joints, height_mm={:.4g}, energy_mJ={:.4g}, {})",
                       of.layout->joints.size(), of.frame.height_mm, of.frame.energies.total(),
                       of.certificate.stable() ? "stable" : "not stable");
  });
  add_view(type, "nodes", &record::Frame::nodes,
           "Positions, nodes x 3, mm; joints come first, z is up.");
  add_view(type, "cell_K", &record::Frame::cell_K,
           "Integrated Gauss curvature of each complete cell, 2 pi less its four angles, rad.");
  add_view(type, "axial_force_N", &record::Frame::axial_force_N,
           "Axial force of each edge, rod after rod, N; negative: compression. On the finest mesh, "
           "not extrapolated.");
  add_view(type, "curvature_per_mm", &record::Frame::curvature_per_mm,
           "Curvature at each point of each rod, rod after rod, 1/mm. On the finest mesh.");
  add_view(type, "bending_mJ_per_m", &record::Frame::bending_mJ_per_m,
           "Bending energy over length at the same points, mJ/m.");
  add_view(type, "stress_MPa", &record::Frame::stress_MPa,
           "Largest stress of a fibre at the same points, MPa.");
  add_view(type, "reactions_N", &record::Frame::reactions_N,
           "Force on each of layout.supports, supports x 3, N.");
  add_view(type, "loads_N", &record::Frame::loads_N,
           "Loads, distributed to layout.supports, supports x 3, N; 0 x 3: none.");
  add_view(type, "brace_force_N", &record::Frame::brace_force_N,
           "Axial force of braces along both diagonals of each cell, N; nan: no brace; empty: none "
           "at all.");
  for (const Number& number : numbers)
    type.def_property_readonly(
        number.name, [=](const State& of) { return of.frame.*number.member; }, number.doc);
  type.def_property_readonly(
          "layout",
          [](const State& of) { return std::const_pointer_cast<record::Layout>(of.layout); },
          "Rods, joints and cells of the shell.")
      .def_readonly("certificate", &State::certificate, "Residual, stability and error.")
      .def_property_readonly(
          "energies",
          [](const State& of) {
            py::dict terms;
            for (const TermName& term : energy_terms)
              terms[term.name] = of.frame.energies[term.term];
            return Judged<"dict[str, float]">{terms};
          },
          "Energy of each term, mJ, by name: bend, stretch, twist, joint, shear, load, support, "
          "contact.")
      .def_property_readonly(
          "energy_mJ", [](const State& of) { return of.frame.energies.total(); },
          "Sum of all energies, mJ; an equilibrium minimises it.")
      .def_property_readonly(
          "event", [](const State& of) { return of.frame.event; },
          "Event of a frame of a run: a snap, a limit, a recovery; empty: nothing.")
      .def_property_readonly(
          "held",
          [](const State& of) {
            std::vector<std::pair<int, int>> indices;
            for (const auto& [i, j] : of.constrained) indices.emplace_back(i, j);
            return indices;
          },
          "Indices (i, j) of the prescribed joints of a session.")
      .def_property_readonly(
          "directions",
          [](const State& of) {
            std::vector<std::tuple<double, double, double>> directions;
            for (const auto& [x, y, z] : of.directions) directions.emplace_back(x, y, z);
            return directions;
          },
          "Unit vector (x, y, z) along which each prescribed joint of a session was first pushed; "
          "nan: it is prescribed in all directions.")
      .def("picture", &draw, py::arg("path"), py::kw_only(), py::arg("size") = py::none(),
           py::arg("context") = "auto", picture_doc);
}

Result<void> draw_on(const State& state, const render::MovieStyle& style,
                     const std::filesystem::path& path, const std::string& context) {
  if (render::of_change(style.colour_by))
    return invalid(
        "[movie] colour_by: got \"{}\", a change since the first frame of a run, expected a "
        "quantity of one state",
        word_of(style.colour_by));
  // an OpenGL context is used by the thread that made it, so each call makes its own
  TRY(artist, app::PictureMaker::create(context, state.preset->style.font));
  record::Layout layout = *state.layout;
  std::ranges::copy(state.pushed, std::back_inserter(layout.loaded_joints));
  const record::Trajectory run{std::move(layout), {state.frame}};
  TRY_DO(render::check_showable(run, style));
  const render::Stage stage(run, style);
  TRY(picture, stage.draw(artist->renderer(), {run.frames.front(), 0}));
  return render::write_png(*picture, path);
}

}  // namespace

void add_values(py::module_& module) {
  add_certificate(module);
  add_report(module);
  add_layout(module);
  add_state(module);
}

void draw(const State& state, const std::filesystem::path& path,
          const std::optional<std::pair<int, int>>& size, const std::string& context) {
  // a forked process does not have the threads of OpenGL, and would wait for them for ever
  static std::atomic<pid_t> drawn_by = 0;
  pid_t none = 0;
  if (!drawn_by.compare_exchange_strong(none, getpid()) && none != getpid())
    raise({Fault::io,
           "this process was forked from one that had drawn a picture, and OpenGL does not bear "
           "that: draw none before the fork, or start processes by "
           "multiprocessing.get_context(\"spawn\")"});
  render::MovieStyle style = app::style_of(*state.preset, app::Pictures::movie);
  if (size) style.size = {size->first, size->second};
  value_of(interruptible([&](const Watch&) { return draw_on(state, style, path, context); }));
}

}  // namespace gridshell::python
