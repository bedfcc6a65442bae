#include "app/cli/design_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/gridshell.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

Json json_of(const DesignedState& state, double scale) {
  Json json = Json::object();
  json["edges_per_segment"] = state.edges_per_segment;
  json["max"] = state.max_mm / scale;
  json["mean"] = state.mean_mm / scale;
  for (const TermName& term : energy_terms)
    json[fmt::format("energy_{}_mJ", term.name)] = state.energies[term.term];
  json["eigenvalue_N_per_mm2"] = state.eigenvalue;
  json["largest_leg_force_N"] = state.largest_leg_force_N;
  json["largest_leg_compression_N"] = state.largest_leg_compression_N;
  json["residual_N"] = state.residual_N;
  return json;
}

std::string design_json(const DesignResult& found, const FlatStartCheck& from_flat) {
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
  json["largest_thickening"] = found.largest_thickening;
  json["thinnest_mm"] = found.thinnest_mm;
  json["thickest_mm"] = found.thickest_mm;
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
  for (const FabricationErrors& one : found.fabricated) {
    Json& sample = json["fabricated"].emplace_back(Json::object());
    sample["sigma_mm"] = one.sigma_mm;
    sample["samples"] = one.samples;
    sample["lost"] = one.lost;
    if (one.lost == one.samples) continue;
    sample["max"] = one.max_mm / scale;
    sample["worst"] = one.worst_mm / scale;
    sample["mean"] = one.mean_mm / scale;
  }
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
  return text_of(json);
}

/// A line an end, as `[ends] table` reads it.
std::string ends_csv(const preset::Points& table) {
  record::CsvWriter csv;
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

/// A line a rod, as `[rod] table` reads it.
std::string rods_csv(const preset::Points& table) {
  record::CsvWriter csv;
  csv.line("family", "rod", "diameter_mm");
  for (const auto& row : table) csv.line(row[0] == 0 ? "u" : "v", int(row[1]), row[2]);
  return std::move(csv).text();
}

/// A line a variable; legs and diameters before and after are lengths, pins and directions
/// coordinates along the variable's own axis.
std::string design_csv(const DesignResult& found, const preset::Points& table) {
  record::CsvWriter csv;
  csv.line("kind", "family", "rod", "end", "component", "before", "after");
  for (std::size_t k = 0; k < found.variables.size(); ++k) {
    const DesignVariable& one = found.variables[k];
    if (one.kind == preset::Vary::diameters) {
      const std::size_t rod = std::size_t(one.end) / 2;
      const auto& row = found.rod_table[rod];
      csv.line(std::string(word_of(one.kind)), row[0] == 0 ? "u" : "v", int(row[1]), "", 0,
               found.rods_before[rod][2], row[2]);
      continue;
    }
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

/// The text of a preset whose empty `table` in a section is a file's name instead.
void put_name(std::string& text, const std::string& section, const std::string& file) {
  const std::string none = "\ntable = []";
  const auto at = text.find(none, text.find("\n[" + section + "]"));
  std::string name;
  for (const char c : file) {
    if (c == '"' || c == '\\') name += '\\';
    name += c;
  }
  text.replace(at, none.size(), "\ntable = \"" + name + "\"");
}

/// The preset with its tables in the files beside it.
std::string preset_text(preset::Preset designed, const std::string& ends_file,
                        const std::string& rods_file) {
  const bool ends = !designed.ends.table.empty(), rods = !designed.rod_table.empty();
  designed.ends.table.clear();
  designed.rod_table.clear();
  std::string text = preset::to_toml(designed);
  if (ends) put_name(text, "ends", ends_file);
  if (rods) put_name(text, "rod", rods_file);
  return text;
}

}  // namespace

Result<void> write_design(const fs::path& folder, const preset::Preset& designed,
                          const DesignResult& found, const FlatStartCheck& from_flat) {
  const auto write = [&](const char* name, const std::string& text) {
    return write_file(folder / name, text);
  };
  return write("design.json", design_json(found, from_flat))
      .and_then([&] { return write("design.csv", design_csv(found, found.table)); })
      .and_then([&] { return write("ends.csv", ends_csv(found.table)); })
      .and_then([&] { return write("ends_rounded.csv", ends_csv(found.rounded_table)); })
      .and_then([&] {
        return designed.rod_table.empty() ? Result<void>()
                                          : write("rods.csv", rods_csv(designed.rod_table));
      })
      .and_then(
          [&] { return write("preset.toml", preset_text(designed, "ends.csv", "rods.csv")); });
}

Result<void> write_preset_with_tables(const preset::Preset& preset, const fs::path& file) {
  const std::string stem = file.stem().string(), ends = stem + "_ends.csv",
                    rods = stem + "_rods.csv";
  const auto write = [&](const std::string& name, const std::string& text) {
    return write_file(file.parent_path() / name, text);
  };
  // the tables first: the preset is whole once it is there
  return (preset.ends.table.empty() ? Result<void>() : write(ends, ends_csv(preset.ends.table)))
      .and_then([&] {
        return preset.rod_table.empty() ? Result<void>() : write(rods, rods_csv(preset.rod_table));
      })
      .and_then([&] { return write_file(file, preset_text(preset, ends, rods)); });
}

std::string design_text(const DesignResult& found, const FlatStartCheck& from_flat) {
  const double percent = 100 / found.length_scale_mm;
  std::string text = fmt::format(
      "{} variables, {} of them free under {} symmetries; {} iterations, {:.1f} s of CPU; moved by "
      "{:.2f} mm and {:.2f} degrees at most{}\n",
      found.q.size(), found.free_variables, found.symmetries, found.steps.size() - 1, found.cpu_s,
      found.largest_move_mm, found.largest_turn_deg,
      found.largest_thickening > 0
          ? fmt::format(", diameters by {:.1f} %, to {:.3f} ... {:.3f} mm",
                        100 * found.largest_thickening, found.thinnest_mm, found.thickest_mm)
          : "");
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
  for (const FabricationErrors& one : found.fabricated) {
    if (one.lost == one.samples) {
      text += fmt::format("  built with errors of {:g} mm: all of {} samples lost\n", one.sigma_mm,
                          one.samples);
      continue;
    }
    text += fmt::format(
        "  built with errors of {:g} mm: largest {:.2f} % (worst {:.2f} %), mean {:.2f} %{}\n",
        one.sigma_mm, percent * one.max_mm, percent * one.worst_mm, percent * one.mean_mm,
        one.lost > 0 ? fmt::format("; {} of {} lost", one.lost, one.samples) : "");
  }
  text += from_flat.reached ? "  reached from the flat too\n"
                            : "  not reached from the flat: " + from_flat.why + "\n";
  return text;
}

}  // namespace gridshell::app
