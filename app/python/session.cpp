// gridshell.Session: a shell that a Python program moves step by step.
#include "app/python/module.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "app/cli/preset_library.h"
#include "engine/gridshell.h"

namespace gridshell::python {
using namespace py::literals;

preset::Preset chosen(const preset::Presets& presets, const std::optional<std::string>& name) {
  std::string names;
  for (const preset::Case& one : presets.cases) {
    if (name == one.name) return one.preset;
    names.append(names.empty() ? "" : ", ").append(one.name);
  }
  if (!name && presets.cases.empty()) return presets.base;
  if (names.empty()) names = "none";
  raise({Fault::bad_input, "case: expected one of the preset's cases: " + names});
}

namespace {

/// A shell and its current state; it is used by one thread at a time.
class Session {
 public:
  Session(const std::filesystem::path& preset, const py::dict& changes,
          const std::optional<std::string>& name) {
    const auto read = value_of(app::load_preset(preset.string(), overrides_of(changes)));
    const preset::Preset one = chosen(read, name);
    shell_.emplace(value_of(interruptible([&](const Watch&) { return Shell::open(one); })));
    look();
  }

  /// Calls work(shell, watch), which Ctrl-C stops, and updates the state, also after an error.
  template <class Work>
  auto at_work(const Work& work) {
    const InUse in_use(*this);
    auto done = [&] {
      try {
        return interruptible([&](const Watch& watch) { return work(*shell_, watch); });
      } catch (const py::error_already_set&) {
        look();
        throw;
      }
    }();
    look();
    return value_of(std::move(done));
  }

  /// Calls work(shell), which takes no time.
  template <class Work>
  auto with_shell(const Work& work) {
    const InUse in_use(*this);
    return work(*shell_);
  }

  Done step(const char* kind, const py::dict& keys) {
    const auto step = with_shell([&](Shell& shell) { return step_of(shell.preset(), kind, keys); });
    return at_work([&](Shell& shell, const Watch& watch) {
      return step.kind == preset::StepKind::move ? shell.move(step, watch)
                                                 : shell.take(step, watch);
    });
  }

  void restore(const Saved& saved) {
    with_shell([&](Shell& shell) { value_of(shell.restore(saved)); });
    look();
  }

  const std::shared_ptr<State>& state() const { return state_; }

 private:
  /// The use of the session by one thread: another thread that calls in between gets an exception.
  /// Made and destroyed under the GIL.
  class InUse {
   public:
    explicit InUse(Session& of) : of_(of) {
      if (of_.busy_)
        throw std::runtime_error("the session is at work already: one thread at a time");
      of_.busy_ = true;
    }
    ~InUse() { of_.busy_ = false; }
    InUse(const InUse&) = delete;
    InUse& operator=(const InUse&) = delete;

   private:
    Session& of_;
  };

  void look() { state_ = std::make_shared<State>(value_of(shell_->look())); }

  std::optional<Shell> shell_;
  std::shared_ptr<State> state_;
  bool busy_ = false;
};

void add_steps(py::class_<Session>& type) {
  using Array = Judged<"ArrayLike">;
  using OptionalArray = Judged<"Optional[ArrayLike]">;
  using OptionalNumber = Judged<"Optional[float]">;
  const auto none = py::none();
  type.def(
          "actuate",
          [](Session& self, double progress, const OptionalNumber& radius,
             const OptionalArray& edges) {
            return self.step("move", py::dict("progress"_a = progress, "radius_mm"_a = radius,
                                              "edge_points"_a = edges));
          },
          "progress"_a = 1.0, py::kw_only(), "radius_mm"_a = none, "edge_points"_a = none,
          "Moves the boundary: progress 0 is the original, 1 the actuated one, above 1 further. "
          "The first call forms the shell as a run of the preset does, on the meshes of its "
          "tolerance.\n\nradius_mm: radius of a circular boundary instead of progress, mm. "
          "edge_points: rows (k, x, y, z), the displacement of edge point k, counted from 0, "
          "relative to the motion, mm.")
      .def(
          "push",
          [](Session& self, const Array& joint, const OptionalNumber& depth,
             const OptionalArray& to, const OptionalArray& along, const std::string& lateral) {
            return self.step("push",
                             py::dict("joint"_a = joint, "depth_mm"_a = depth, "to_mm"_a = to,
                                      "along"_a = along, "lateral"_a = lateral));
          },
          "joint"_a, "depth_mm"_a = none, py::kw_only(), "to_mm"_a = none, "along"_a = none,
          "lateral"_a = "free",
          "Moves the joint (i, j), which remains prescribed: by depth_mm against the shell's "
          "normal, inward (negative: outward), or to the position to_mm, mm.\n\nalong: direction "
          "in which it is prescribed, else that of the push. depth_mm uses the shell's present "
          "normal at each push; to_mm with along=session.directions[k] continues along the first. "
          "lateral: \"free\" or \"held\", whether it may move across the push.")
      .def(
          "hold",
          [](Session& self, const Array& joint, const OptionalArray& along) {
            return self.step("hold", py::dict("joint"_a = joint, "along"_a = along));
          },
          "joint"_a, py::kw_only(), "along"_a = none,
          "Fixes the joint (i, j) where it is, along a direction or in all.")
      .def(
          "release",
          [](Session& self, const OptionalArray& joint) {
            return self.step("release", py::dict("joint"_a = joint));
          },
          "joint"_a = none, "Releases the joint (i, j), or all prescribed joints.")
      .def(
          "load",
          [](Session& self, double factor) {
            return self.step("load", py::dict("factor"_a = factor));
          },
          "factor"_a, "Applies [loads] times `factor` from now on.")
      .def(
          "rest",
          [](Session& self, const std::string& side) {
            return self.step("rest", py::dict("side"_a = side));
          },
          "side"_a = "lower",
          "Descends to a stable state. side: from an unstable state to the \"lower\" energy, or "
          "\"along\" or \"against\" its lowest mode.")
      .def(
          "jitter",
          [](Session& self, int seed, double force) {
            return self.step("jitter", py::dict("seed"_a = seed, "force_N"_a = force));
          },
          "seed"_a = 1, "force_N"_a = 0.4,
          "Applies random forces to all joints and removes them; force_N: the largest along each "
          "axis, N.")
      .def(
          "refine",
          [](Session& self, double tolerance_mm) {
            return self.at_work([&](Shell& shell, const Watch& watch) {
              return shell.refine(tolerance_mm, watch);
            });
          },
          "tolerance_mm"_a = std::numeric_limits<double>::quiet_NaN(),
          "Takes finer meshes until the error estimate is below tolerance_mm (default: the "
          "preset's tolerance).");
}

void add_looks(const py::module_& module, py::class_<Session>& type) {
  type.def_property_readonly("state", &Session::state,
                             "The present State. It does not change when the session continues.")
      .def_property_readonly(
          "preset",
          [](Session& self) {
            return self.with_shell([](Shell& shell) { return preset::to_toml(shell.preset()); });
          },
          "The preset as TOML, with changes and defaults.")
      .def_property_readonly(
          "edges_per_segment",
          [](Session& self) {
            return self.with_shell([](Shell& shell) { return shell.meshes(); });
          },
          "Edges per segment of the meshes, coarse to fine.")
      .def(
          "save",
          [](Session& self) { return self.with_shell([](Shell& shell) { return shell.save(); }); },
          "A state to return to with restore().")
      .def("restore", &Session::restore, "kept"_a, "Returns to a state that this session saved.")
      .def("__repr__",
           [](const Session& self) {
             const State& now = *self.state();
             return "Session(" + now.preset->name + ", progress " +
                    std::string(py::str(py::float_(now.frame.progress))) + ")";
           })
      .def(
          "picture",
          [](const Session& self, const std::filesystem::path& path,
             const std::optional<std::pair<int, int>>& size, const std::string& context) {
            const auto state = self.state();
            draw(*state, path, size, context);
          },
          "path"_a, py::kw_only(), "size"_a = py::none(), "context"_a = "auto", picture_doc);
  // properties of the state as properties of the session, too
  const py::object state = module.attr("State");
  for (const char* name :
       {"nodes", "layout", "certificate", "energies", "energy_mJ", "force_N", "depth_mm",
        "height_mm", "progress", "boundary_radius_mm", "cell_K", "total_K", "held", "directions"})
    type.def_property_readonly(
        name,
        [name](const Session& self) -> py::object { return py::cast(self.state()).attr(name); },
        py::str(state.attr(name).attr("__doc__")).cast<std::string>().c_str());
}

}  // namespace

void add_session(py::module_& module) {
  py::class_<Saved>(module, "Checkpoint", "A state to which Session.restore() returns.");
  py::class_<Session> type(
      module, "Session",
      "A shell that you command: flat at first, then actuated, pushed, loaded, released. Every "
      "step ends in a certified state, or raises and remains in the last one. Ctrl-C stops a "
      "step.\n\npreset: name of a preset that comes with the program, or path of a TOML file. "
      "changes: keys that replace those of the preset, {\"footprint.rods\": 14}. case: which of "
      "its cases.");
  type.def(
      py::init<const std::filesystem::path&, const py::dict&, const std::optional<std::string>&>(),
      "preset"_a, "changes"_a = py::dict(), py::kw_only(), "case"_a = py::none());
  add_steps(type);
  add_looks(module, type);
}

}  // namespace gridshell::python
