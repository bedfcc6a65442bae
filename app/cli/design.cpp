#include "app/cli/commands.h"

#include <fmt/format.h>

#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/figures.h"
#include "app/cli/preset_library.h"
#include "app/cli/produce.h"
#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/canvas/plot.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

/// Whether the path from the flat state ends in the designed shell, too.
struct FlatStartCheck {
  bool reached = false;
  std::string why;  ///< why it was not reached
};

Json json_of(const DesignedState& state, double scale) {
  Json json{{"edges_per_segment", state.edges_per_segment},
            {"max", state.max_mm / scale},
            {"mean", state.mean_mm / scale}};
  for (const TermName& term : energy_terms)
    json[fmt::format("energy_{}_mJ", term.name)] = state.energies[term.term];
  json.update({{"eigenvalue_N_per_mm2", state.eigenvalue},
               {"largest_leg_force_N", state.largest_leg_force_N},
               {"largest_leg_compression_N", state.largest_leg_compression_N},
               {"residual_N", state.residual_N}});
  return json;
}

/// The text of design.json; `target`: "surface" or "net", of [inverse] target.
std::string design_json(const DesignResult& found, std::string_view target,
                        const FlatStartCheck& from_flat) {
  const double scale = found.length_scale_mm;
  const DesignedState &before = found.before.back(), &after = found.after.back();
  Json json{{"length_scale_mm", scale},
            {"distances_from", target},
            {"max_before", before.max_mm / scale},
            {"mean_before", before.mean_mm / scale},
            {"max_after", after.max_mm / scale},
            {"mean_after", after.mean_mm / scale},
            {"eigenvalue_before", before.eigenvalue},
            {"eigenvalue_after", after.eigenvalue},
            {"largest_move_mm", found.largest_move_mm},
            {"largest_turn_deg", found.largest_turn_deg},
            {"largest_thickening", found.largest_thickening},
            {"thinnest_mm", found.thinnest_mm},
            {"thickest_mm", found.thickest_mm},
            {"iterations", int(found.steps.size()) - 1},
            {"cpu_s", found.cpu_s},
            {"stable", true},  // design() returns no other shell
            {"symmetries", found.symmetries},
            {"variables", found.q.size()},
            {"free_variables", found.free_variables}};
  for (const auto& [name, states] :
       {std::pair("before", &found.before), std::pair("after", &found.after)}) {
    json[name] = Json::array();
    for (const DesignedState& state : *states) json[name].push_back(json_of(state, scale));
  }
  if (found.rounded) json["rounded"] = json_of(*found.rounded, scale);
  json["fabricated"] = Json::array();
  for (const FabricationErrors& one : found.fabricated) {
    Json& sample = json["fabricated"].emplace_back(Json::object());
    sample = {{"sigma_mm", one.sigma_mm}, {"samples", one.samples}, {"lost", one.lost}};
    if (one.lost < one.samples)
      sample.update({{"max", one.max_mm / scale},
                     {"worst", one.worst_mm / scale},
                     {"mean", one.mean_mm / scale}});
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

/// The text of ends.csv: a line for each end of a rod, as `[ends] table` reads it.
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

/// The text of rods.csv: a line for each rod, as `[rod] table` reads it.
std::string rods_csv(const preset::Points& table) {
  record::CsvWriter csv;
  csv.line("family", "rod", "diameter_mm");
  for (const auto& row : table) csv.line(row[0] == 0 ? "u" : "v", int(row[1]), row[2]);
  return std::move(csv).text();
}

/// The text of design.csv: a line for each variable, before and after the design. Legs and
/// diameters are lengths (mm); pins and directions are coordinates along the axis of the variable.
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
                             : one.direction.dot(Eigen::Vector3d(row[3], row[4], row[5]));
    csv.line(std::string(word_of(one.kind)), row[0] == 0 ? "u" : "v", int(row[1]),
             row[2] == 0 ? "begin" : "end", one.component, after - q, after);
  }
  return std::move(csv).text();
}

/// Replaces the empty `table` of a section, in the text of a preset, by the name of a file.
void put_name(std::string& text, const std::string& section, const std::string& file) {
  const std::string none = "\ntable = []";
  const auto at = text.find(none, text.find("\n[" + section + "]"));
  text.replace(at, none.size(), "\ntable = " + line_of(Json(file)));
}

/// The text of a preset whose tables are in separate files.
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

/// Writes design.json, design.csv, ends.csv, ends_rounded.csv, rods.csv if diameters were varied,
/// and preset.toml, which reads ends.csv and rods.csv.
Result<void> write_design(const fs::path& folder, const preset::Preset& designed,
                          const DesignResult& found, const FlatStartCheck& from_flat) {
  const auto write = [&](const char* name, const std::string& text) {
    return write_file(folder / name, text);
  };
  TRY_DO(write("design.json", design_json(found, word_of(designed.inverse.target), from_flat)));
  TRY_DO(write("design.csv", design_csv(found, found.table)));
  TRY_DO(write("ends.csv", ends_csv(found.table)));
  TRY_DO(write("ends_rounded.csv", ends_csv(found.rounded_table)));
  if (!designed.rod_table.empty()) TRY_DO(write("rods.csv", rods_csv(designed.rod_table)));
  return write("preset.toml", preset_text(designed, "ends.csv", "rods.csv"));
}

/// Result of a design, as a few lines for the terminal.
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
        "  {:<8} {:>2} edges: largest distance {:.3f} %, mean {:.3f} % of {:.4g} mm; bend energy "
        "{:.3f} mJ, "
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

/// Distances of the joints from the target over the iterations, per cent of the length scale;
/// crosses are refused steps.
render::Plot convergence_plot(const DesignResult& found, const std::string& title) {
  render::Series largest = render::line_series("largest", render::series_colour(0)),
                 mean = render::line_series("mean", render::series_colour(1)),
                 refused = render::mark_series("step refused", {0.3f, 0.3f, 0.3f, 1},
                                               render::Marker::cross);
  largest.marker = mean.marker = render::Marker::circle;
  render::Plot plot;
  const double percent = 100 / found.length_scale_mm;
  double norm = 2;
  for (std::size_t k = 0; k < found.steps.size(); ++k) {
    const DesignStep& step = found.steps[k];
    largest.add(step.iteration, percent * step.max_mm);
    mean.add(step.iteration, percent * step.mean_mm);
    if (k > 0 && !step.taken) refused.add(step.iteration, percent * step.max_mm);
    if (step.norm == norm) continue;
    plot.references.push_back({false, step.iteration - 0.5, fmt::format("*p* = {:g}", step.norm)});
    norm = step.norm;
  }
  plot.title = title;
  plot.x.label = "iteration";
  plot.y.label = "distance of joints (% of *ρ*)";
  plot.y.logarithmic = true;
  plot.series = {largest, mean};
  plot.add(std::move(refused));
  return plot;
}

/// Writes the pictures of draw_net_pictures(), with the target instead of the net (for each node
/// the nearest point of the target), and `<stem>_convergence`.
Result<void> draw_design(Run before, Run after, const DesignResult& found, const fs::path& stem,
                         Watch& watch) {
  for (Run* run : {&before, &after}) {
    record::Trajectory& shell = run->trajectory;
    TRY(nearest, nearest_to(run->preset, shell.layout.flat_nodes, shell.frames.back().nodes));
    shell.layout.net_nodes = std::move(*nearest);
  }
  const auto style = style_of(before.preset, Pictures::stills);
  TRY_DO(draw_net_pictures({&before, &after}, stem, watch));
  return render::write_plot(fs::path(stem) += "_convergence",
                            convergence_plot(found, render::plain(style.title)), style.print);
}

// joints of two runs that end in the same state differ by less than this many tolerances
constexpr double same_state = 4;

/// The preset of the shell to be designed: of the formed shell, without what is done to it later.
/// Errors: bad_input for a preset of several cases.
Result<preset::Preset> one_of(const Options& options) {
  TRY(presets, load(options));
  presets->base.indentation = {};
  presets->base.step.clear();
  if (presets->cases.empty()) return presets->base;
  return invalid("{}: a preset of several cases; design takes one shell", presets->base.name);
}

/// Whether the path from the flat state ends in the same state.
FlatStartCheck from_flat(preset::Preset preset, const record::Trajectory& designed, Watch& watch) {
  preset.actuation.start = preset::Start::flat;
  const auto outcome = simulate::run(preset, true, watch);
  FlatStartCheck found;
  const bool ended = outcome && !outcome->trajectory.frames.empty() &&
                     outcome->trajectory.frames.back().progress >= 1;
  if (!ended) {
    found.why = outcome ? outcome->summary.limit_reason : outcome.error().message;
    return found;
  }
  const auto joints = long(designed.layout.joints.size());
  const Eigen::Matrix3Xd there = outcome->trajectory.frames.back().nodes.leftCols(joints),
                         here = designed.frames.back().nodes.leftCols(joints);
  const double distance_mm = (there - here).colwise().norm().maxCoeff();
  found.reached =
      distance_mm < same_state * preset.accuracy.tolerance * designed.layout.length_scale_mm;
  if (!found.reached) found.why = fmt::format("it ends {:.3g} mm away", distance_mm);
  return found;
}

/// Designs the shell, simulates it before and after the design, writes and draws the result.
/// `summary`: that of the designed shell; `text`: lines for the terminal.
Result<void> work(const preset::Preset& preset, const fs::path& folder, Progress& progress,
                  record::Summary& summary, std::string& text) {
  TRY(found, design(preset, progress.next_phase()));
  preset::Preset designed = preset;
  designed.ends.table = found->table;
  if (found->largest_thickening > 0) designed.rod_table = found->rod_table;
  TRY(before, simulate::run(preset, true, progress.next_phase()));
  record::FolderSink sink(folder, {designed.name, record::Kind::figure, designed.title});
  TRY(run, simulate::run(designed, true, sink, progress.next_phase()));
  summary = *run;
  summary.kind = record::Kind::figure;
  TRY(after, sink.finish(summary));
  Watch& last = progress.next_phase();
  const FlatStartCheck flat = from_flat(designed, *after, last);
  if (last.cancelled()) return stopped();
  text = design_text(*found, flat);
  TRY_DO(write_design(folder, designed, *found, flat));
  TRY_DO(render::use_font(preset.style.font));
  return draw_design(
      {.preset = preset, .trajectory = std::move(before->trajectory), .label = "before"},
      {.preset = designed, .trajectory = std::move(*after), .label = "designed"}, *found,
      folder / fs::path(preset.name).filename(), progress.next_phase());
}

}  // namespace

Result<void> write_preset_with_tables(const preset::Preset& preset, const fs::path& file) {
  const std::string stem = file.stem().string(), ends = stem + "_ends.csv",
                    rods = stem + "_rods.csv";
  const fs::path folder = file.parent_path();
  // the tables first, so that a preset that exists is complete
  if (!preset.ends.table.empty()) TRY_DO(write_file(folder / ends, ends_csv(preset.ends.table)));
  if (!preset.rod_table.empty()) TRY_DO(write_file(folder / rods, rods_csv(preset.rod_table)));
  return write_file(file, preset_text(preset, ends, rods));
}

Result<int> produce_design(const Options& options) {
  TRY(preset, one_of(options));
  if (options.print_config) return print_config({*preset, {}});
  const auto folder = output_of(options, *preset, "_design");
  const std::vector<Phase> phases{{"designing", 5},
                                  {"simulating before", 1},
                                  {"simulating after", 1},
                                  {"from the flat", 2},
                                  {"drawing", 2 * expected_seconds(Pictures::stills, *preset)}};
  record::Summary summary;
  std::string text;
  TRY_DO(deliver({folder, "design"}, phases, options.quiet,
                 [&](const fs::path& partial, Progress& progress) {
                   return work(*preset, partial, progress, summary, text);
                 }));
  if (!options.quiet) fmt::print("{}: {}", folder.string(), text);
  const auto fault = failure_of(summary, preset->allow_unstable);
  if (!fault.empty()) fmt::print(stderr, "{}: {}\n", preset->name, fault);
  return fault.empty() ? ExitCode::done : ExitCode::failed;
}

}  // namespace gridshell::app
