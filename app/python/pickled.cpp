#include "app/python/pickled.h"

#include <pybind11/stl.h>

#include <string>

#include "engine/core/file_io.h"
#include "engine/core/scratch_folder.h"
#include "engine/gridshell.h"

namespace gridshell::python {
namespace {

void check_size(const py::tuple& from, std::size_t size) {
  if (from.size() != size) throw py::value_error("not a pickle of this version of gridshell");
}

}  // namespace

py::tuple packed(const Certificate& of) {
  return py::make_tuple(of.residual_N, of.negative_pivots, of.error_estimate_mm, of.largest_strain);
}

void unpack(const py::tuple& from, Certificate& to) {
  check_size(from, 4);
  to.residual_N = from[0].cast<double>();
  to.negative_pivots = from[1].cast<int>();
  to.error_estimate_mm = from[2].cast<double>();
  to.largest_strain = from[3].cast<double>();
}

py::tuple packed(const Event& of) { return py::make_tuple(int(of.kind), of.t, of.to); }

void unpack(const py::tuple& from, Event& to) {
  check_size(from, 3);
  to.kind = Event::Kind(from[0].cast<int>());
  to.t = from[1].cast<double>();
  to.to = from[2].cast<std::optional<double>>();
}

py::tuple packed(const Done& of) {
  py::list events;
  for (const Event& event : of.report.events) events.append(packed(event));
  return py::make_tuple(packed(of.report.certificate), events, of.report.effort.newton_iterations,
                        of.report.seconds, of.reported);
}

void unpack(const py::tuple& from, Done& to) {
  check_size(from, 5);
  unpack(from[0].cast<py::tuple>(), to.report.certificate);
  for (const py::handle event : from[1].cast<py::list>())
    unpack(event.cast<py::tuple>(), to.report.events.emplace_back());
  to.report.effort.newton_iterations = from[2].cast<int>();
  to.report.seconds = from[3].cast<double>();
  to.reported = from[4].cast<std::string>();
}

py::tuple packed(const State& of) {
  const ScratchFolder scratch = value_of(ScratchFolder::make());
  const auto file = scratch.path() / "state";
  auto journal = value_of(record::JournalWriter::create(
      file, {of.preset->name, record::Kind::run, of.preset->title}, *of.layout));
  value_of(journal.append(of.frame));
  const std::string bytes = value_of(read_file(file));
  py::list pushed;
  for (const record::LoadedJoint& one : of.pushed)
    pushed.append(py::make_tuple(one.joint, one.direction.x(), one.direction.y(), one.direction.z(),
                                 one.at_times));
  return py::make_tuple(of.preset->name, preset::to_toml(*of.preset), py::bytes(bytes),
                        packed(of.certificate), of.constrained, of.directions, pushed);
}

void unpack(const py::tuple& from, State& to) {
  check_size(from, 7);
  const auto name = from[0].cast<std::string>();
  to.preset = std::make_shared<const preset::Preset>(
      value_of(preset::read_preset_text(from[1].cast<std::string>(), name, name)).base);
  const ScratchFolder scratch = value_of(ScratchFolder::make());
  const auto file = scratch.path() / "state";
  value_of(write_file(file, from[2].cast<std::string>()));
  const record::Journal journal = value_of(record::read_journal(file, false));
  to.layout = std::make_shared<const record::Layout>(journal.trajectory.layout);
  to.frame = journal.trajectory.frames.front();
  unpack(from[3].cast<py::tuple>(), to.certificate);
  to.constrained = from[4].cast<decltype(to.constrained)>();
  to.directions = from[5].cast<decltype(to.directions)>();
  for (const py::handle one : from[6].cast<py::list>()) {
    const auto [joint, x, y, z, at_times] =
        one.cast<std::tuple<int, double, double, double, bool>>();
    to.pushed.push_back({joint, {x, y, z}, at_times});
  }
}

}  // namespace gridshell::python
