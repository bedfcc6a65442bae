// `gridshell scan`: compares a cloud of points from a 3D scanner with the joints of runs.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/figures.h"
#include "app/cli/preset_library.h"
#include "app/cli/produce.h"
#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/movie/run_figures.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

using study::Clusters;
using study::JointCylinder;
using study::Pose;
using study::RegisteredScan;

/// One state that a scan is compared with.
struct ComparedState {
  std::string name;                    ///< run, case and state: "out/fig2_states, state 3"
  std::optional<RegisteredScan> scan;  ///< the scan moved onto this state; none if that failed
  bool shown = false;                  ///< scan_matches(): the scan shows this state
};

/// A scan and all states that it is compared with.
struct ComparedScan {
  std::string points;  ///< the file
  Clusters clusters;
  JointCylinder cylinder;
  std::vector<ComparedState> states;
  std::size_t best = 0;     ///< index of the state that fits best
  double tolerance_mm = 0;  ///< the requested one, else match_tolerance_mm()
  /// If the scan shows none of the states: a height of the joints' cylinders, mm, with which it
  /// would show one, and the name of that state.
  std::optional<std::pair<double, std::string>> with_height = {};

  const ComparedState& of_best() const { return states[best]; }
};

Json json_of(const RegisteredScan& scan) {
  return {{"joints_found", scan.found},
          {"joints_missing", scan.missing()},
          {"outliers", scan.outliers.cols()},
          {"joints_within_two_radii", scan.within_bar},
          {"rms_mm", scan.rms_mm},
          {"mean_mm", scan.mean_mm},
          {"max_mm", scan.max_mm},
          {"mirrored", scan.mirrored}};
}

Json json_of(const Pose& pose) {
  Json json = Json::object();
  json["turn"] = Json::array();
  for (int row = 0; row < 3; ++row)
    json["turn"].push_back({pose.turn(row, 0), pose.turn(row, 1), pose.turn(row, 2)});
  json["shift_mm"] = {pose.shift.x(), pose.shift.y(), pose.shift.z()};
  return json;
}

/// The text of scan.json: `state`, that the scan shows, or null; its joints compared with those of
/// the nearest state; the pose from the scan's frame to that of the run; all compared states.
std::string scan_json(const ComparedScan& scan) {
  const ComparedState& best = scan.of_best();
  Json json{{"points", scan.points},
            {"state", best.shown ? Json(best.name) : Json()},
            {"nearest_state", best.name}};
  json.update(json_of(*best.scan));
  json.update(
      {{"specks", scan.clusters.specks},
       {"clusters_too_wide", scan.clusters.others},
       {"noise_mm", scan.clusters.noise_mm},
       {"tolerance_mm", scan.tolerance_mm},
       {"joint_diameter_mm", scan.cylinder.diameter_mm},
       {"joint_height_mm", scan.cylinder.height_mm},
       {"joint_height_that_fits_mm", scan.with_height ? Json(scan.with_height->first) : Json()},
       {"scan_to_run", json_of(best.scan->pose)},
       {"states", Json::array()}});
  for (const ComparedState& state : scan.states) {
    Json& one = json["states"].emplace_back(Json{{"name", state.name}, {"shown", state.shown}});
    if (state.scan) one.update(json_of(*state.scan));
  }
  return text_of(json);
}

/// The text of scan.csv: a line for each joint with its measured position in the frame of the run,
/// empty if it is missing.
std::string scan_csv(const ComparedScan& scan, const record::Layout& layout) {
  record::CsvWriter csv;
  csv.line("i", "j", "x_mm", "y_mm", "z_mm", "distance_mm", "distance_radii");
  const RegisteredScan& laid = *scan.of_best().scan;
  for (Eigen::Index k = 0; k < laid.joints.cols(); ++k) {
    const record::Joint& joint = layout.joints[std::size_t(k)];
    csv.line(joint.i, joint.j, laid.joints(0, k), laid.joints(1, k), laid.joints(2, k),
             laid.distance_mm[k], laid.distance_mm[k] / (scan.cylinder.diameter_mm / 2));
  }
  return std::move(csv).text();
}

/// The text of measured.csv: the joints that were found, as [figure] scan reads them.
std::string measured_csv(const RegisteredScan& scan) {
  record::CsvWriter csv;
  csv.line("x_mm", "y_mm", "z_mm");
  const Eigen::Matrix3Xd measured = scan.measured();
  for (const auto& joint : measured.colwise()) csv.line(joint.x(), joint.y(), joint.z());
  return std::move(csv).text();
}

/// The result as lines for the terminal.
std::string scan_text(const ComparedScan& scan) {
  const ComparedState& best = scan.of_best();
  const RegisteredScan& laid = *best.scan;
  std::string text = best.shown ? "shows " + best.name : "does not show " + best.name;
  if (!best.shown && scan.states.size() > 1)
    text = fmt::format("shows none of {} states; nearest: {}", scan.states.size(), best.name);
  text += fmt::format(
      "\n  {} of {} joints found, {} outliers, {} specks{}; distances {:.3f} mm rms, {:.3f} mm at "
      "most; {} within two radii ({:g} mm)\n",
      laid.found, laid.joints.cols(), laid.outliers.cols(), scan.clusters.specks,
      laid.mirrored ? ", mirrored" : "", laid.rms_mm, laid.max_mm, laid.within_bar,
      scan.cylinder.diameter_mm);
  if (std::isfinite(scan.clusters.noise_mm))
    text += fmt::format("  noise of the points {:.3f} mm rms, tolerance of the joints {:.3f} mm\n",
                        scan.clusters.noise_mm, scan.tolerance_mm);
  if (!best.shown && study::scan_matches(laid, scan.cylinder.diameter_mm / 2))
    text += fmt::format(
        "  its joints are near those of {}, but their distance of {:.3g} mm rms exceeds the "
        "tolerance of {:.3g} mm: the shell is pushed, loaded or built otherwise; with --tolerance "
        "{:.3g} it shows that state\n",
        best.name, laid.rms_mm, scan.tolerance_mm, 1.01 * laid.rms_mm);
  if (scan.with_height) {
    const auto& [fits_mm, name] = *scan.with_height;
    const double assumed_mm = scan.cylinder.height_mm;
    text += fmt::format(
        "  all tops are {:.2f} mm further {} along the normals than [joints] height_mm = {:g} "
        "assumes: with {} it shows {}\n",
        std::abs(fits_mm - assumed_mm), fits_mm > assumed_mm ? "out" : "in", assumed_mm,
        fits_mm > 0 ? fmt::format("--set joints.height_mm={:.3g}", fits_mm) : "--centres", name);
  }
  return text;
}

struct ScanOptions {
  Options common;  ///< output, quiet, context, --set; `input` is the file of points
  std::vector<std::string> runs;
  std::string unit = "mm";
  bool no_checksum = false;
  bool centres = false;     ///< the points are joints, not tops of cylinders
  double tolerance_mm = 0;  ///< 0: match_tolerance_mm() of the noise
};

constexpr long most_clusters_a_joint = 20;

/// A state of a run that the scan may show: each of a search, or the last of a path.
struct Candidate {
  const Run* run = nullptr;
  std::size_t frame = 0;
  std::string name;
};

std::vector<Candidate> candidates_of(const std::vector<Run>& runs, const fs::path& folder) {
  std::vector<Candidate> all;
  for (const Run& run : runs) {
    const std::string name = folder_of(folder, run.name).string();
    const std::size_t frames = run.trajectory.frames.size();
    if (frames == 0) continue;
    if (run.states.rows.empty())
      all.push_back({&run, frames - 1, name});
    else
      for (std::size_t k = 0; k < std::min(frames, run.states.rows.size()); ++k)
        all.push_back({&run, k, name + ", state " + run.states.rows[k].name()});
  }
  return all;
}

/// Everything that the command reads.
struct Scanned {
  Eigen::Matrix3Xd cloud;
  std::size_t empty_rows = 0;  ///< rows of its file without a point
  std::vector<std::vector<Run>> runs;
  std::vector<Candidate> candidates;
  JointCylinder cylinder;
  double tolerance_mm = 0;  ///< as in ScanOptions
};

Result<Scanned> read_all(const ScanOptions& options) {
  TRY(overrides, overrides_of_run(options.common, {"joints.diameter_mm", "joints.height_mm"}));
  Scanned scanned;
  scanned.tolerance_mm = options.tolerance_mm;
  TRY(bytes, as_input(read_file(options.common.input, preset::largest_cloud_file)));
  const auto unit = find_word<preset::FileUnit>(options.unit).value_or(preset::FileUnit::mm);
  TRY(cloud, preset::read_cloud(*bytes, options.common.input, preset::millimetres(unit)));
  scanned.cloud = std::move(cloud->points);
  scanned.empty_rows = cloud->empty_rows;
  for (const std::string& folder : options.runs) {
    TRY(runs, read_runs(folder, *overrides, options.no_checksum));
    scanned.runs.push_back(std::move(*runs));
  }
  for (std::size_t k = 0; k < options.runs.size(); ++k)
    for (Candidate& one : candidates_of(scanned.runs[k], options.runs[k]))
      scanned.candidates.push_back(std::move(one));
  if (scanned.candidates.empty())
    return invalid("'{}' contains no state to compare with", options.runs.front());
  const Run& run = *scanned.candidates.front().run;
  const record::Layout& layout = run.trajectory.layout;
  const preset::Joints& joints = run.preset.joints;
  scanned.cylinder = {joints.diameter_mm.value_or(layout.joint_diameter_mm),
                      options.centres ? 0 : joints.height_mm.value_or(layout.joint_height_mm)};
  return scanned;
}

/// The height of the joints' cylinders, mm, with which the scan shows a state, and the name of that
/// state; the one that fits best if there are several. Nothing if no height does.
std::optional<std::pair<double, std::string>> height_that_fits(const Scanned& scanned,
                                                               const ComparedScan& scan) {
  std::optional<std::pair<double, std::string>> fits;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < scan.states.size(); ++k) {
    const record::Trajectory& run = scanned.candidates[k].run->trajectory;
    const auto form = study::form_of(run.layout, run.frames[scanned.candidates[k].frame]);
    JointCylinder cylinder = scan.cylinder;
    std::optional<RegisteredScan> laid = scan.states[k].scan;
    // twice, since with the first height other tops may belong to the joints
    for (int turn = 0; turn < 2 && laid; ++turn) {
      // no top is below its joint, though a fit of few joints may give that
      cylinder.height_mm = std::max(0.0, cylinder.height_mm + study::excess_height(*laid, form));
      laid = study::register_points(scan.clusters, form, cylinder);
    }
    const bool shown = laid && study::scan_matches(*laid, scan.tolerance_mm);
    const double cost = laid ? laid->cost / double(run.layout.joints.size()) : least;
    if (!shown || !(cost < least)) continue;
    least = cost;
    // rounded to a micrometre; 0 if the joints themselves were measured
    fits = {std::round(1e3 * cylinder.height_mm) / 1e3, scan.states[k].name};
  }
  return fits;
}

double extent_of(const Eigen::Matrix3Xd& points) {
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff();
}

/// Errors: bad_input if the cloud is far smaller than every shell, as one in metres is.
Result<void> check_size(const Scanned& scanned, const std::string& file) {
  constexpr double far_smaller = 50;
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& one : scanned.candidates) {
    const record::Trajectory& run = one.run->trajectory;
    const record::Frame& frame = run.frames[one.frame];
    if (!run.frames.fault()) least = std::min(least, extent_of(frame.nodes));
  }
  const double extent = extent_of(scanned.cloud);
  if (!(far_smaller * extent < least)) return {};
  return invalid(
      "{}: its points reach over {:.3g} mm, the shell over {:.3g} mm: is it in metres? "
      "--unit m reads it so",
      file, extent, least);
}

/// Compares the cloud with all candidates. Errors: bad_input if it has no joints or far too many,
/// or cannot be registered with any state.
Result<ComparedScan> compared(const Scanned& scanned, const std::string& file, Watch& watch) {
  if (auto sized = check_size(scanned, file); !sized) return tl::unexpected(sized.error());
  auto clusters = study::cluster_joint_tops(scanned.cloud, scanned.cylinder.diameter_mm);
  if (!clusters) return invalid("{}: {}", file, clusters.error().message);
  long most = 0;
  for (const Candidate& one : scanned.candidates)
    most = std::max(most, long(one.run->trajectory.layout.joints.size()));
  if (clusters->tops.cols() > most_clusters_a_joint * most)
    return invalid(
        "{}: {} clusters of points as wide as joints of {:g} mm ([joints] diameter_mm), "
        "the shell has {} joints",
        file, clusters->tops.cols(), scanned.cylinder.diameter_mm, most);
  ComparedScan scan{file, std::move(*clusters), scanned.cylinder, {}};
  scan.tolerance_mm = scanned.tolerance_mm > 0
                          ? scanned.tolerance_mm
                          : study::match_tolerance_mm(scan.clusters, scan.cylinder);
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& one : scanned.candidates) {
    if (watch.cancelled()) return stopped();
    const record::Trajectory& run = one.run->trajectory;
    const record::Frame& frame = run.frames[one.frame];
    if (const auto& fault = run.frames.fault()) return tl::unexpected(*fault);
    ComparedState state{
        one.name,
        study::register_points(scan.clusters, study::form_of(run.layout, frame), scan.cylinder),
        false};
    // per joint, so that shells of different sizes can be compared
    if (state.scan) {
      state.shown = scan_matches(*state.scan, scan.tolerance_mm);
      const double cost = state.scan->cost / double(run.layout.joints.size());
      if (cost < least) least = cost, scan.best = scan.states.size();
    }
    scan.states.push_back(std::move(state));
    watch.report(double(scan.states.size()) / double(scanned.candidates.size()));
  }
  if (std::isfinite(least)) {
    if (std::ranges::none_of(scan.states, &ComparedState::shown))
      scan.with_height = height_that_fits(scanned, scan);
    return scan;
  }
  return invalid(
      "{}: {} clusters of points as wide as joints of {:g} mm ([joints] diameter_mm), {} "
      "specks and {} wider ones; no given shell has its joints there",
      file, scan.clusters.tops.cols(), scan.cylinder.diameter_mm, scan.clusters.specks,
      scan.clusters.others);
}

/// Draws scan.png: measured joints in red over the shell in black [Baek 2018, Figs. 2A, 3C, 5E].
Result<void> draw(const ComparedScan& scan, const Candidate& one, const fs::path& folder,
                  Watch& watch) {
  TRY_DO(render::use_font(one.run->preset.style.font));
  auto style = style_of(one.run->preset, Pictures::stills);
  const RegisteredScan& laid = *scan.of_best().scan;
  const record::Trajectory shown = render::states_alone(one.run->trajectory, {one.frame}, style);
  const std::string caption =
      fmt::format("{}{} of {} joints, {:.2f} mm rms, {:.2f} mm at most",
                  scan.of_best().shown ? "" : "not this state: ", laid.found, laid.joints.cols(),
                  laid.rms_mm, laid.max_mm);
  return save_panels(render::draw_over_nets({{&shown, caption, laid.measured()}}, style, watch),
                     folder / "scan.png", style.print.dpi);
}

/// Writes the folder with scan.json, scan.csv, measured.csv and scan.png. Returns the exit code,
/// which is `different` if the scan shows none of the states.
Result<int> produce_scan(const ScanOptions& options) {
  TRY(scanned, read_all(options));
  const Options& common = options.common;
  const fs::path points = common.input;
  const auto folder =
      common.output.empty() ? fs::path("out") / (points.stem().string() + "_scan") : common.output;
  const preset::Preset& first = scanned->candidates.front().run->preset;
  const std::vector<Phase> phases{drawing("comparing", 0.1 * double(scanned->candidates.size())),
                                  drawing("drawing", expected_seconds(Pictures::stills, first))};
  std::optional<ComparedScan> scan;
  const auto work = [&](const fs::path& partial, Progress& progress) -> Result<void> {
    TRY(found, compared(*scanned, points.string(), progress.next_phase()));
    scan = std::move(*found);
    const Candidate& best = scanned->candidates[scan->best];
    TRY_DO(write_file(partial / "scan.csv", scan_csv(*scan, best.run->trajectory.layout)));
    TRY_DO(write_file(partial / "measured.csv", measured_csv(*scan->of_best().scan)));
    TRY_DO(write_file(partial / "scan.json", scan_json(*scan)));
    return draw(*scan, best, partial, progress.next_phase());
  };
  TRY_DO(deliver({folder, "scan"}, phases, common.quiet, work));
  if (!common.quiet && scanned->empty_rows > 0)
    fmt::print("{}: {} rows have no point (nan)\n", points.string(), scanned->empty_rows);
  if (!common.quiet) fmt::print("{}: {}", folder.string(), scan_text(*scan));
  return scan->of_best().shown ? ExitCode::done : ExitCode::different;
}

}  // namespace

void add_scan(CommandLine& program) {
  auto [command, options] = program.add<ScanOptions>(
      "scan", "which state a 3D scan shows, and how far its joints are off", produce_scan);
  command.option("POINTS", options.common.input, "cloud of points: .ply, .xyz, .pts or .csv")
      .required();
  command.option("RUN", options.runs, "folders of runs; of a search all of its states").required();
  command.option("--unit", options.unit, "unit of the points where the file names none")
      .one_of({"mm", "cm", "m", "in", "ft"});
  add_changes(command, options.common);
  add_work_options(command, options.common, "folder to write, by default out/<points>_scan");
  add_picture_options(command, options.common);
  add_no_checksum(command, options.no_checksum);
  command.flag("--centres", options.centres,
               "the points are the joints themselves, not tops of cylinders");
  command
      .option("--tolerance", options.tolerance_mm,
              "largest distance of the joints, mm rms; by default five times the scan's noise")
      .in_range(0.0, 1000.0);
  command.footer(
      "The exit code is 3 where the scan shows none of the states. Joints are cylinders of\n"
      "[joints] diameter_mm and height_mm, of which the scan sees the tops.");
}

}  // namespace gridshell::app
