#include "app/design_files.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/core/atomic_file.h"
#include "engine/preset/writer.h"
#include "engine/record/csv.h"
#include "engine/record/json.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

using record::Json;

Json json_of(const DesignedState& state, double scale) {
  Json json = Json::object();
  json["edges_per_segment"] = state.edges_per_segment;
  json["max"] = state.max_mm / scale;
  json["mean"] = state.mean_mm / scale;
  json["energy_bend_mJ"] = state.energies[Term::bend];
  json["energy_stretch_mJ"] = state.energies[Term::stretch];
  json["eigenvalue_N_per_mm2"] = state.eigenvalue;
  json["largest_leg_force_N"] = state.largest_leg_force_N;
  json["largest_leg_compression_N"] = state.largest_leg_compression_N;
  json["residual_N"] = state.residual_N;
  return json;
}

std::string design_json(const Designed& found, const FromFlat& from_flat) {
  const double scale = found.length_scale_mm;
  Json json = Json::object();
  json["length_scale_mm"] = scale;
  json["max_before"] = found.before.back().max_mm / scale;
  json["mean_before"] = found.before.back().mean_mm / scale;
  json["max_after"] = found.after.back().max_mm / scale;
  json["mean_after"] = found.after.back().mean_mm / scale;
  json["eigenvalue_before"] = found.before.back().eigenvalue;
  json["eigenvalue_after"] = found.after.back().eigenvalue;
  json["largest_move_mm"] = found.largest_move_mm;
  json["largest_turn_deg"] = found.largest_turn_deg;
  json["iterations"] = int(found.steps.size()) - 1;
  json["cpu_s"] = found.cpu_s;
  json["stable"] = true;  // nothing else is ever delivered
  json["symmetries"] = found.symmetries;
  json["variables"] = found.q.size();
  json["free_variables"] = found.free_variables;
  for (const auto& [name, states] :
       {std::pair("before", &found.before), std::pair("after", &found.after)}) {
    json[name] = Json::array();
    for (const DesignedState& state : *states) json[name].push_back(json_of(state, scale));
  }
  if (found.rounded) json["rounded"] = json_of(*found.rounded, scale);
  json["fabricated"] = Json::array();
  for (const Fabricated& one : found.fabricated)
    json["fabricated"].push_back({{"sigma_mm", one.sigma_mm},
                                  {"samples", one.samples},
                                  {"lost", one.lost},
                                  {"max", one.max_mm / scale},
                                  {"worst", one.worst_mm / scale},
                                  {"mean", one.mean_mm / scale}});
  json["from_flat"] = {{"reached", from_flat.reached}, {"why_not", from_flat.why}};
  json["steps"] = Json::array();
  for (const DesignStep& step : found.steps)
    json["steps"].push_back({{"iteration", step.iteration},
                             {"norm", step.norm},
                             {"objective", step.objective},
                             {"max", step.max_mm / scale},
                             {"mean", step.mean_mm / scale},
                             {"eigenvalue", step.eigenvalue},
                             {"largest_move_mm", step.largest_move_mm},
                             {"taken", step.taken},
                             {"refused", step.refused}});
  return record::text_of(json);
}

/// A line an end, as `[ends] table` reads it.
std::string ends_csv(const preset::Points& table) {
  record::Csv csv;
  csv.line("family", "rod", "end", "x_mm", "y_mm", "z_mm", "leg_mm", "tx", "ty", "tz");
  for (const auto& row : table) {
    csv.cell(row[0] == 0 ? "u" : "v");
    csv.cell(int(row[1]));
    csv.cell(row[2] == 0 ? "begin" : "end");
    for (std::size_t k = 3; k < row.size(); ++k) csv.cell(row[k]);
    csv.end_line();
  }
  return std::move(csv).text();
}

/// A line a variable; legs before and after are lengths, pins and directions coordinates along the
/// variable's own axis.
std::string design_csv(const Designed& found, const preset::Points& table) {
  record::Csv csv;
  csv.line("kind", "family", "rod", "end", "component", "before", "after");
  for (std::size_t k = 0; k < found.variables.size(); ++k) {
    const DesignVariable& one = found.variables[k];
    const auto& row = table[std::size_t(found.row_of_end[std::size_t(one.end)])];
    const double q = found.q[Eigen::Index(k)];
    const double after = one.kind == preset::Vary::legs ? row[6]
                         : one.kind == preset::Vary::directions
                             ? q
                             : one.way.dot(Eigen::Vector3d(row[3], row[4], row[5]));
    csv.line(std::string(word_of(one.kind)), row[0] == 0 ? "u" : "v", int(row[1]),
             row[2] == 0 ? "begin" : "end", one.component, after - q, after);
  }
  return std::move(csv).text();
}

/// The preset with its table in the file beside it.
std::string preset_text(preset::Preset designed) {
  designed.ends.table.clear();
  std::string text = preset::to_toml(designed);
  const std::string none = "\ntable = []";
  text.replace(text.find(none), none.size(), "\ntable = \"ends.csv\"");
  return text;
}

}  // namespace

Result<void> write_design(const fs::path& folder, const preset::Preset& designed,
                          const Designed& found, const FromFlat& from_flat) {
  const auto write = [&](const char* name, const std::string& text) {
    return write_atomically(folder / name, text);
  };
  return write("design.json", design_json(found, from_flat))
      .and_then([&] { return write("design.csv", design_csv(found, found.table)); })
      .and_then([&] { return write("ends.csv", ends_csv(found.table)); })
      .and_then([&] { return write("ends_rounded.csv", ends_csv(found.rounded_table)); })
      .and_then([&] { return write("preset.toml", preset_text(designed)); });
}

std::string design_text(const Designed& found, const FromFlat& from_flat) {
  const double percent = 100 / found.length_scale_mm;
  std::string text = fmt::format(
      "{} variables, {} of them free under {} symmetries; {} iterations, {:.1f} s of CPU; moved by "
      "{:.2f} mm and {:.2f} degrees at most\n",
      found.q.size(), found.free_variables, found.symmetries, found.steps.size() - 1, found.cpu_s,
      found.largest_move_mm, found.largest_turn_deg);
  const auto line = [&](const char* name, const DesignedState& state) {
    text += fmt::format(
        "  {:<8} {:>2} edges: largest {:.3f} %, mean {:.3f} % of {:.4g} mm; bend energy {:.3f} mJ, "
        "smallest eigenvalue {:.3g} N/mm^2, leg force at most {:.3f} N\n",
        name, state.edges_per_segment, percent * state.max_mm, percent * state.mean_mm,
        found.length_scale_mm, state.energies[Term::bend], state.eigenvalue,
        state.largest_leg_force_N);
  };
  for (const DesignedState& state : found.before) line("before", state);
  for (const DesignedState& state : found.after) line("after", state);
  if (found.rounded) line("rounded", *found.rounded);
  for (const Fabricated& one : found.fabricated)
    text += fmt::format(
        "  built with errors of {:g} mm: largest {:.2f} % (worst {:.2f} %), mean {:.2f} %{}\n",
        one.sigma_mm, percent * one.max_mm, percent * one.worst_mm, percent * one.mean_mm,
        one.lost > 0 ? fmt::format("; {} of {} lost", one.lost, one.samples) : "");
  text += from_flat.reached ? "  reached from the flat too\n"
                            : "  not reached from the flat: " + from_flat.why + "\n";
  return text;
}

}  // namespace gridshell::app
