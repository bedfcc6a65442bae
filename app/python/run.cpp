// gridshell.load: reads the folder of a run as numpy arrays.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <vector>

#include "app/cli/produce.h"
#include "app/python/module.h"
#include "engine/gridshell.h"

namespace gridshell::python {
using namespace py::literals;
namespace {

/// A run. The nodes of its frames are read from the file when they are needed.
class Run {
 public:
  explicit Run(app::Run run)
      : run_(std::move(run)),
        preset_(std::make_shared<const preset::Preset>(run_.preset)),
        layout_(std::make_shared<const record::Layout>(run_.trajectory.layout)) {
    for (std::size_t k = 0; k < size(); ++k) heads_.push_back(record::without_nodes(frame(k)));
  }

  std::size_t size() const { return run_.trajectory.frames.size(); }
  const app::Run& read() const { return run_; }
  const std::vector<record::Frame>& heads() const { return heads_; }
  const std::shared_ptr<const record::Layout>& layout() const { return layout_; }

  const record::Frame& frame(std::size_t k) const {
    const record::FrameList& frames = run_.trajectory.frames;
    const record::Frame& found = frames[k];
    if (frames.fault()) raise(*frames.fault());
    return found;
  }

  std::shared_ptr<State> state(py::ssize_t k) const {
    const auto count = py::ssize_t(size());
    if (k < -count || k >= count)
      throw py::index_error(fmt::format("the run has {} frames, there is no [{}]", count, k));
    const record::Frame& found = frame(std::size_t(k < 0 ? k + count : k));
    const Certificate known{found.residual_N, found.negative_pivots, found.error_estimate_mm,
                            record::unknown};
    return std::make_shared<State>(State{preset_, layout_, found, known});
  }

  /// Positions in all frames, frames x nodes x 3, mm; read once.
  const py::array_t<double>& nodes() {
    if (nodes_) return *nodes_;
    const auto count = frame(0).nodes.cols();
    py::array_t<double> all({py::ssize_t(size()), py::ssize_t(count), py::ssize_t(3)});
    for (std::size_t k = 0; k < size(); ++k)
      std::copy_n(frame(k).nodes.data(), 3 * count, all.mutable_data(py::ssize_t(k), 0, 0));
    all.attr("flags").attr("writeable") = false;
    return nodes_.emplace(std::move(all));
  }

 private:
  app::Run run_;
  std::shared_ptr<const preset::Preset> preset_;
  std::shared_ptr<const record::Layout> layout_;
  std::vector<record::Frame> heads_;
  std::optional<py::array_t<double>> nodes_;
};

/// An array with one number per frame.
template <class Value, class Find>
py::array_t<Value> column(const Run& run, const Find& find) {
  py::array_t<Value> all(py::ssize_t(run.size()));
  for (std::size_t k = 0; k < run.size(); ++k) all.mutable_at(k) = Value(find(run.heads()[k]));
  return all;
}

Run load(const std::filesystem::path& folder, const std::optional<std::string>& name,
         bool unfinished, bool no_checksum, bool unsealed) {
  auto runs = value_of(interruptible(
      [&](const Watch&) { return app::read_runs(folder, {}, no_checksum || unsealed); }));
  std::string names;
  for (app::Run& run : runs) {
    names.append(names.empty() ? "" : ", ").append(run.name);
    if (name ? run.name != *name : runs.size() > 1) continue;
    if (!run.summary.finished && !unfinished)
      raise({Fault::bad_input,
             fmt::format("'{}' is a run that was cut short: {}; unfinished=True takes it",
                         folder.string(), app::progress_text(run))});
    return Run(std::move(run));
  }
  raise({Fault::bad_input, fmt::format("'{}': case: expected one of: {}", folder.string(),
                                       names.empty() ? "none" : names)});
}

void add_columns(py::class_<Run>& type) {
  for (const Number& number : numbers)
    type.def_property_readonly(
        number.name,
        [=](const Run& run) {
          return column<double>(run, [=](const auto& frame) { return frame.*number.member; });
        },
        std::string("One value per frame. ").append(number.doc).c_str());
  type.def_property_readonly(
          "negative_pivots",
          [](const Run& run) {
            return column<int>(run, [](const auto& frame) { return frame.negative_pivots; });
          },
          "Number of negative pivots of each frame; 0: stable, -1: unknown.")
      .def_property_readonly(
          "stable",
          [](const Run& run) {
            return column<bool>(run, [](const auto& frame) { return frame.negative_pivots == 0; });
          },
          "Whether each frame is known to be stable.")
      .def_property_readonly(
          "energies",
          [](const Run& run) {
            py::dict terms;
            for (const TermName& term : energy_terms)
              terms[term.name] =
                  column<double>(run, [&](const auto& frame) { return frame.energies[term.term]; });
            return Judged<"dict[str, numpy.ndarray[numpy.float64]]">{terms};
          },
          "Energy of each term by name, each an array over the frames, mJ.")
      .def_property_readonly(
          "energy_mJ",
          [](const Run& run) {
            return column<double>(run, [](const auto& frame) { return frame.energies.total(); });
          },
          "Sum of all energies of each frame, mJ.")
      .def_property_readonly(
          "events",
          [](const Run& run) {
            std::vector<std::string> events;
            for (const record::Frame& frame : run.heads()) events.push_back(frame.event);
            return events;
          },
          "Event of each frame: a snap, a limit, a recovery; empty: nothing.")
      .def_property_readonly("nodes", &Run::nodes, "Positions, frames x nodes x 3, mm.");
}

}  // namespace

void add_run(py::module_& module) {
  py::class_<Run> type(module, "Run", "A finished run; run[k] is the State of its k-th frame.");
  type.def("__len__", &Run::size)
      .def("__getitem__", &Run::state, "k"_a)
      .def_property_readonly(
          "preset", [](const Run& run) { return preset::to_toml(run.read().preset); },
          "The preset of the run, as TOML.")
      .def_property_readonly(
          "summary",
          [](const Run& run) {
            return Judged<"dict[str, Any]">{
                py::module_::import("json").attr("loads")(record::to_json(run.read().summary))};
          },
          "summary.json as a dict.")
      .def_property_readonly(
          "layout",
          [](const Run& run) { return std::const_pointer_cast<record::Layout>(run.layout()); },
          "Rods, joints and cells of the shell.")
      .def("__repr__", [](const Run& run) {
        return fmt::format("Run({}, {})", run.read().summary.preset,
                           app::progress_text(run.read()));
      });
  add_columns(type);
  module.def(
      "load", &load, "folder"_a, py::kw_only(), "case"_a = py::none(), "unfinished"_a = false,
      "no_checksum"_a = false, "unsealed"_a = false,
      "Reads a run's folder. Raises BadInput with the reason if it is no run, is damaged, or was "
      "cut short and unfinished is not set.\n\ncase: which of its cases. no_checksum (once "
      "`unsealed`): reads a "
      "trajectory.h5 with a missing or wrong checksum, as another program wrote it.");
}

}  // namespace gridshell::python
