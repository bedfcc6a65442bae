// `gridshell report RUN`: one PDF with what an engineer needs to know about a formed shell.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/paper_page.h"
#include "app/cli/preset_library.h"
#include "app/cli/produce.h"
#include "app/cli/staged_folder.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/canvas/panels.h"
#include "render/canvas/text.h"
#include "render/movie/fabrication_sheets.h"
#include "render/movie/run_figures.h"
#include "render/movie/state_charts.h"
#include "render/movie/stills.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

using render::AlignX;
using render::Sheets;
using render::TableRow;

struct ReportOptions {
  std::string input;
  fs::path to;
  int modes = 6, imperfections = 0;
  bool no_checksum = false;
};

/// A number with four digits; from 1000 to 1e9 with all digits before the decimal point.
std::string number(double value) {
  if (!std::isfinite(value)) return "not known";
  return std::abs(value) >= 1000 && std::abs(value) < 1e9 ? fmt::format("{:.0f}", value)
                                                          : fmt::format("{:.4g}", value);
}

std::string with_unit(double value, const char* unit) {
  return std::isfinite(value) ? number(value) + " " + unit : "not known";
}

/// An error and its unit, "0.01 mm": one digit, as the second one is not known.
std::string error_with_unit(double value, const char* unit) {
  if (!std::isfinite(value)) return "not known";
  const std::string digit = fmt::format("{:.1g}", value);
  return (value < 1 ? digit : fmt::format("{:.0f}", std::stod(digit))) + " " + unit;
}

/// A force with as many decimals as its error permits.
std::string force_text(double force, double error) {
  constexpr double round_off = 1e-9;
  if (!std::isfinite(error) || error <= 0) return number(std::abs(force) < round_off ? 0 : force);
  const int decimals = std::clamp(int(std::ceil(-std::log10(error))), 0, 9);
  const std::string text = fmt::format("{:.{}f}", force, decimals);
  return std::stod(text) == 0 ? "0" : text;
}

/// A picture of the last state of a run, coloured by a quantity, half as wide as the sheet.
Result<render::Image> picture_of(const Run& run, preset::ColourBy colours,
                                 render::Renderer& renderer) {
  preset::Preset preset = run.preset;
  preset.movie.colour_by = colours;
  preset.movie.bins = false;
  preset.style.range.clear();
  constexpr double width_mm = 88, height_mm = 66, dpi = 300;
  render::MovieStyle style =
      at_size(render::still_style(style_of(preset, Pictures::stills)), width_mm, height_mm, dpi);
  style.print = {width_mm, dpi};
  style.title.clear();
  record::Trajectory last{run.trajectory.layout, {}};
  last.frames = {record::Frame(run.trajectory.frames.back())};
  TRY_DO(render::check_showable(last, style));
  const record::Frame first(run.trajectory.frames.front());
  const render::Stage stage(last.layout, render::summarise_run(last, &first), style);
  const record::Frame& frame = last.frames.front();
  TRY(picture, stage.draw_views(renderer, {frame, 0}));
  render::draw_over(*picture, [&](render::Canvas& canvas) {
    render::draw_still_labels(canvas, stage, {frame, 0}, render::frame_state_caption(frame));
  });
  return std::move(*picture);
}

/// The material of the rods: the bending stiffness if it is given, else the name, "timber c24", or
/// without a name Young's modulus, "E = 83 GPa".
std::string material_text(const preset::Rod& rod) {
  if (rod.EI_Nmm2 > 0) return fmt::format("EI = {:g} N mm²", rod.EI_Nmm2);
  if (rod.material == preset::Material::none) return fmt::format("E = {:g} GPa", rod.young_GPa);
  return render::spaced(std::string(word_of(rod.material)));
}

/// The materials of all rods.
std::string materials_text(const preset::Preset& preset) {
  std::string text = material_text(preset.rod);
  if (const std::string v = material_text(preset.rod_v); preset.rod_v.differs && v != text)
    text = "u: " + text + ", v: " + v;
  return preset.footprint.file.own.empty() ? text : text + "; some rods have values of their own";
}

/// The extent of the rods' ends along x and y; of all rods, where none ends on a boundary.
std::string plan_dimensions(const record::Layout& layout, const record::Frame& last) {
  const auto& ends = layout.edge_points;
  const Eigen::Matrix3Xd points = ends.empty() ? last.nodes : last.nodes(Eigen::all, ends).eval();
  const Eigen::Vector3d span = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  return number(span.x()) + " × " + with_unit(span.y(), "mm");
}

void add_geometry(Sheets& sheets, const Run& run, const record::Frame& last,
                  const exports::FabricationPlan& plan) {
  const record::Summary& summary = run.summary;
  sheets.values(
      {{"rods", fmt::format("{}, {:.4g} m in all", summary.rods, 1e-3 * plan.total_length_mm())},
       {"section and material", plan.section_text() + "; " + materials_text(run.preset)},
       {"joints", fmt::format("{}, {} mm apart", summary.joints, number(plan.spacing_mm))},
       {"plan dimensions", plan_dimensions(run.trajectory.layout, last)},
       {"rise", with_unit(summary.height_mm, "mm")},
       {"model", fmt::format("{}, {} edges per segment", summary.model, summary.edges_per_segment)},
       {"error of positions", error_with_unit(summary.error_estimate_mm, "mm")},
       {"state", !summary.solved  ? "the net itself, no equilibrium"
                 : summary.stable ? "in stable equilibrium"
                                  : "not stable"},
       {"residual force", error_with_unit(summary.residual_N, "N")}});
  if (!summary.limit_reason.empty()) sheets.text("On its path: " + summary.limit_reason + ".");
  if (!summary.doubt.empty()) sheets.text("Not confirmed: " + summary.doubt + ".");
  for (const std::string& step : summary.steps) sheets.text(step);
}

void add_stresses(Sheets& sheets, const record::Summary& summary) {
  sheets.heading("Stresses");
  sheets.values(
      {{"largest fibre stress", with_unit(summary.largest_stress_MPa, "MPa")},
       {"utilisation", std::isfinite(summary.utilisation)
                           ? fmt::format("{:.2f}", summary.utilisation)
                           : "not known"},
       {"largest bending strain", fmt::format("{:.2f} %", 100 * summary.largest_bending_strain)}});
  if (!summary.stress_at.empty())
    sheets.text((std::isfinite(summary.utilisation) ? "The utilisation is largest in "
                                                    : "The stress is largest in ") +
                summary.stress_at + ".");
  if (const std::string text = summary.breaking(); !text.empty()) sheets.text(text + ".");
  if (!std::isfinite(summary.utilisation))
    sheets.text("The rods' strength is not known: [rod] strength_MPa or yield_strain says it.");
}

/// The name of a support: that of a rod's end, as in the plate and pins.csv, "u-3 begin", or of a
/// joint, "joint [0, 4]".
std::string support_name(const record::Layout& layout, const exports::FabricationPlan& plan,
                         int node) {
  // first the joints, since a rod may end on a fixed joint, which is no pin
  for (const record::Joint& joint : layout.joints)
    if (joint.node == node) return fmt::format("joint [{}, {}]", joint.i, joint.j);
  const auto end =
      std::size_t(std::ranges::find(layout.edge_points, node) - layout.edge_points.begin());
  if (end < 2 * plan.rods.size() && end < layout.edge_points.size())
    return exports::pin_name(plan.rods[end / 2].name, end % 2 == 1);
  return "";
}

/// Adds the table of reactions, one support per line, the largest first.
void add_reactions(Sheets& sheets, const record::Layout& layout, const record::Frame& frame,
                   const exports::FabricationPlan& plan) {
  sheets.heading("Reactions");
  if (frame.reactions_N.cols() == 0) return sheets.text("They are not known for this state.");
  std::vector<Eigen::Index> order;
  for (Eigen::Index k = 0; k < frame.reactions_N.cols(); ++k)
    if (!frame.reactions_N.col(k).isZero(0)) order.push_back(k);
  std::ranges::stable_sort(order, std::greater<>(),
                           [&](Eigen::Index k) { return frame.reactions_N.col(k).norm(); });
  std::vector<TableRow> rows;
  const auto add = [&](const std::string& pin, const std::string& position,
                       const Eigen::Vector3d& force) {
    rows.push_back({{pin, position}});
    for (const double one : {force.x(), force.y(), force.z(), force.norm()})
      rows.back().cells.push_back(force_text(one, frame.force_error_N));
  };
  add("sum of loads", "", frame.loads_N.rowwise().sum());
  add("sum", "", frame.reactions_N.rowwise().sum());
  // heights are above the lowest support
  double ground = INFINITY;
  for (const Eigen::Index k : order)
    ground = std::min(ground, frame.nodes(2, layout.supports[std::size_t(k)]));
  for (const Eigen::Index k : order) {
    const Eigen::Vector3d at =
        frame.nodes.col(layout.supports[std::size_t(k)]) - Eigen::Vector3d(0, 0, ground);
    add(support_name(layout, plan, layout.supports[std::size_t(k)]),
        fmt::format("{:.1f}, {:.1f}, {:.1f}", at.x() + 0.0, at.y() + 0.0, at.z() + 0.0),
        frame.reactions_N.col(k));
  }
  sheets.text(
      "Forces of the supports on the shell, the largest first, z above the lowest support; " +
      (std::isfinite(frame.force_error_N)
           ? "each is known to ± " + error_with_unit(frame.force_error_N, "N") + "."
           : std::string("their error is not known, as they were computed on one mesh.")));
  std::vector<render::TableColumn> columns{
      {"pin", 48, AlignX::left}, {"position (mm)", 75, AlignX::left},
      {"*x* (N)", 32},           {"*y* (N)", 32},
      {"*z* (N)", 32},           {"size (N)", 40}};
  // many supports: two in each line, without the magnitudes of the forces
  constexpr std::size_t most_lines = 24;
  if (rows.size() > most_lines) {
    std::vector<TableRow> pairs;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      rows[k].cells.pop_back();
      if (k % 2 == 0)
        pairs.push_back(std::move(rows[k]));
      else
        std::ranges::move(rows[k].cells, std::back_inserter(pairs.back().cells));
    }
    rows = std::move(pairs);
    columns.pop_back();
    const auto half = columns;
    columns.insert(columns.end(), half.begin(), half.end());
  }
  sheets.table(columns, rows);
}

Result<void> add_loads(Sheets& sheets, study::FormedShell& shell, const ReportOptions& options,
                       Watch& watch) {
  sheets.heading("Load factors");
  if (shell.path.simulation.scene().load_cases.empty()) {
    sheets.text("No load case: [[loads.case]] defines one.");
    return {};
  }
  TRY(found, study::load_study(shell, options.imperfections, watch));
  const auto factor = [](double value, double error) {
    return std::isfinite(value) ? record::with_error(value, error, "") : "–";
  };
  std::vector<TableRow> rows;
  for (const record::LoadRow& row : found->cases) {
    const std::string imperfect = record::knock_down_text(row);
    const Eigen::Vector3d sum(row.load_x_N, row.load_y_N, row.load_z_N);
    // components that are round-off are written as 0
    const auto part = [&](double one) {
      return number(std::abs(one) < 1e-9 * sum.norm() ? 0 : one);
    };
    rows.push_back(
        {{row.load_case, part(sum.x()), part(sum.y()), part(sum.z()),
          factor(row.critical_factor, row.error), factor(row.linear_factor, row.linear_error),
          factor(row.strength_factor, row.strength_error),
          record::loss_text(row) + (imperfect.empty() ? "" : "; " + imperfect)},
         row.critical_factor < 1 || row.strength_factor < 1});
  }
  sheets.text(
      "Each case is applied to the state above and its factor increased, by arc length, until "
      "stability is lost; linear: the factor of the linearised problem. Red: the shell does not "
      "carry this case, as stability is lost or the strength reached at a factor below 1.");
  sheets.table({{"case", 62, AlignX::left},
                {"sum *x* (N)", 44},
                {"sum *y* (N)", 44},
                {"sum *z* (N)", 44},
                {"factor", 70},
                {"linear", 40},
                {"strength at", 72},
                {"failure mode", 0, AlignX::left}},
               rows);
  sheets.plot(render::load_plot(found->points, found->cases, ""));
  return {};
}

/// Adds the picture of the first modes' shapes, over the state in grey.
Result<void> add_shapes(Sheets& sheets, const study::Vibrations& found, render::MovieStyle style,
                        Watch& watch) {
  constexpr std::size_t most = 6, columns = 3;
  style.title.clear();
  style = at_size(render::uncoloured(std::move(style)), 58, 34, 300);
  style.print = {180, 200};
  record::Trajectory states;
  states.layout = found.state.layout;
  states.layout.original_boundary = states.layout.actuated_boundary;
  states.frames.push_back(found.state.frames.back());
  for (std::size_t k = 0; k < std::min(most, found.modes.size()); ++k)
    if (found.modes[k].frequency_Hz >= 0)
      states.frames.push_back(moved_by(found.state, found.shapes[k], 1, int(k + 1)));
  if (states.frames.size() < 2) return {};
  const render::Stage stage(states, style);
  render::PanelFigure figure = render::empty_figure(style, int(columns));
  for (std::size_t k = 1; k < states.frames.size(); ++k) {
    const record::Frame frame = states.frames[k];
    const auto& mode = found.modes[std::size_t(frame.index) - 1];
    TRY_DO(render::add_panel(
        figure, stage, stage.drawing(frame),
        {false, fmt::format("mode {}: {:.3g} Hz", mode.mode, mode.frequency_Hz)}, nullptr, watch));
  }
  TRY(picture, render::draw_panels(figure));
  sheets.text("Shapes over the state in grey; their largest displacement is drawn as " +
              render::length_text(drawn_move_mm(found.state.layout)) + ".");
  sheets.pictures({std::move(*picture)});
  return {};
}

Result<void> add_vibrations(Sheets& sheets, study::FormedShell& shell, const ReportOptions& options,
                            const render::MovieStyle& style, Watch& watch) {
  sheets.heading("Natural frequencies and modes");
  const auto found = study::vibrations_of(shell, options.modes, watch);
  if (!found && found.error().fault == Fault::bad_input) {
    sheets.text("Not found: " + found.error().message + ".");
    return {};
  }
  if (!found) return tl::unexpected(found.error());
  std::vector<TableRow> rows;
  for (const record::ModeRow& mode : found->modes)
    rows.push_back(
        {{fmt::format("{}", mode.mode),
          mode.frequency_Hz >= 0 ? record::with_error(mode.frequency_Hz, mode.error_Hz, "")
                                 : "none: the state is not stable",
          ""},
         mode.frequency_Hz < 0});
  sheets.table({{"mode", 40}, {"frequency (Hz)", 120}, {"", 0}}, rows);
  return add_shapes(sheets, *found, style, watch);
}

Result<void> add_run(Sheets& sheets, const Run& run, const ReportOptions& options,
                     render::Renderer& renderer, Progress& progress, std::string& last_cut_list) {
  const preset::Preset& preset = run.preset;
  if (run.trajectory.frames.empty()) return invalid("'{}' has no frame", options.input);
  TRY(plan, simulate::fabrication_plan_of(preset));
  sheets.heading(preset::title_or_name(preset), 15);
  if (!preset.description.empty()) sheets.text(preset.description);
  Watch& drawing = progress.next_phase();
  const record::Frame& last = run.trajectory.frames.back();
  TRY(shape, picture_of(run, preset.movie.colour_by, renderer));
  std::vector<render::Image> pictures{std::move(*shape)};
  if (last.stress_MPa.size() > 0) {
    const bool strength = std::isfinite(run.summary.utilisation);
    TRY(stresses,
        picture_of(run, strength ? preset::ColourBy::utilisation : preset::ColourBy::stress,
                   renderer));
    pictures.push_back(std::move(*stresses));
  }
  drawing.report(1);
  sheets.pictures(pictures);
  sheets.heading("Geometry");
  add_geometry(sheets, run, last, *plan);
  add_stresses(sheets, run.summary);
  add_reactions(sheets, run.trajectory.layout, last, *plan);
  Watch& studies = progress.next_phase();
  if (run.summary.solved) {
    TRY(shell, study::form_shell(preset, studies));
    TRY_DO(add_loads(sheets, *shell, options, studies));
    TRY_DO(add_vibrations(sheets, *shell, options, style_of(preset, Pictures::stills), studies));
  } else {
    sheets.text("Nothing was solved: load factors and frequencies of the net are not known.");
  }
  sheets.heading("Cut list");
  const auto rounded = exports::rounded(std::move(*plan), preset.figure.cut_step_mm);
  if (render::cut_list_text(rounded) == last_cut_list)
    sheets.text("As above.");
  else
    render::add_cut_list(sheets, rounded);
  last_cut_list = render::cut_list_text(rounded);
  // frames are read when they are used: an error of reading is known at the end
  if (const auto& error = run.trajectory.frames.fault()) return tl::unexpected(*error);
  return {};
}

Result<int> make_report(ReportOptions options) {
  if (options.to.empty()) options.to = next_to(options.input, "_report.pdf");
  if (options.to.extension() != ".pdf")
    return invalid("--to {}: expected a name that ends in .pdf", options.to.string());
  TRY_DO(check_output_file(options.to));
  TRY(runs, read_runs(options.input, {}, options.no_checksum));
  for (const Run& run : *runs) {
    const std::string folder = folder_of(options.input, run.name).string();
    if (!run.summary.finished)
      return invalid(
          "'{}' is not finished, and a report is of a finished run: --resume continues it", folder);
    if (run.preset.jitter.requested())
      return invalid("'{}' has several states, expected a run without [jitter]: a report is of one",
                     folder);
  }
  TRY(maker, PictureMaker::create("auto", runs->front().preset.style.font));
  std::vector<Phase> phases;
  for (const Run& run : *runs) {
    // the shell is formed again, and the studies take about four times as long
    const auto plan = plan_of(run.preset);
    const double seconds =
        plan && std::isfinite(plan->expected_seconds) ? plan->expected_seconds : 1;
    phases.insert(phases.end(),
                  {drawing("drawing", 2), {"following loads, finding modes", 5 * seconds}});
  }
  Sheets sheets(preset::title_or_name(runs->front().preset));
  {
    Progress progress(phases, Progress::show_for(false), [] {});
    std::string cut_list;
    for (std::size_t k = 0; k < runs->size(); ++k) {
      if (k > 0) sheets.next_sheet();
      TRY_DO(add_run(sheets, (*runs)[k], options, maker->renderer(), progress, cut_list));
    }
  }
  TRY_DO(write_with_folder(options.to, sheets.pdf()));
  fmt::print("{}\n", options.to.string());
  return ExitCode::done;
}

}  // namespace

void add_report(CommandLine& program) {
  auto [command, options] = program.add<ReportOptions>(
      "report", "geometry, stresses, reactions, loads, frequencies, cut list as a PDF",
      make_report);
  command.option("RUN", options.input, "folder of a run").required();
  command.option("--to", options.to, "the file, by default RUN_report.pdf");
  command.option("--count", options.modes, "how many frequencies").in_range(1, 200);
  command
      .option("--imperfections", options.imperfections,
              "more shells per case, displaced by loads.imperfection")
      .in_range(0, 1000);
  add_no_checksum(command, options.no_checksum);
}

}  // namespace gridshell::app
