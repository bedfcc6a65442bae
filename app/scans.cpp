#include "app/scans.h"

#include <fmt/format.h>

#include <limits>

#include "app/console.h"
#include "app/delivery.h"
#include "app/finished_run.h"
#include "app/loading.h"
#include "app/pictures.h"
#include "app/scan_files.h"
#include "app/state_pictures.h"
#include "engine/core/atomic_file.h"
#include "engine/preset/cloud_file.h"
#include "render/figure/net_figure.h"
#include "render/image/png.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

constexpr long most_clusters_a_joint = 20;

/// A state of a run: one of a search, or the last of a path.
struct Candidate {
  const FinishedRun* run = nullptr;
  std::size_t frame = 0;
  std::string name;
};

std::vector<Candidate> candidates_of(const std::vector<FinishedRun>& runs, const fs::path& folder) {
  std::vector<Candidate> all;
  for (const FinishedRun& run : runs) {
    const std::string name = folder_of(folder, run.name).string();
    const std::size_t frames = run.trajectory.frames.size();
    if (frames == 0) continue;
    if (run.states.rows.empty())
      all.push_back({&run, frames - 1, name});
    else
      for (std::size_t k = 0; k < std::min(frames, run.states.rows.size()); ++k)
        all.push_back({&run, k, fmt::format("{}, state {}", name, run.states.rows[k].state)});
  }
  return all;
}

/// Everything that is read before anything is written.
struct Scanned {
  Eigen::Matrix3Xd cloud;
  std::vector<std::vector<FinishedRun>> runs;
  std::vector<Candidate> candidates;
  JointCylinder cylinder;
};

Result<Scanned> read_all(const ScanOptions& options) {
  const auto overrides =
      overrides_of_run(options.common, {"joints.diameter_mm", "joints.height_mm"});
  if (!overrides) return tl::unexpected(overrides.error());
  Scanned scanned;
  const auto bytes = as_input(read_whole(options.common.input, preset::largest_cloud_file));
  if (!bytes) return tl::unexpected(bytes.error());
  auto cloud = preset::read_cloud(*bytes, options.common.input);
  if (!cloud) return tl::unexpected(cloud.error());
  scanned.cloud = std::move(*cloud);
  for (const std::string& folder : options.runs) {
    auto runs = read_runs(folder, *overrides, options.unsealed);
    if (!runs) return tl::unexpected(runs.error());
    scanned.runs.push_back(std::move(*runs));
  }
  for (std::size_t k = 0; k < options.runs.size(); ++k)
    for (Candidate& one : candidates_of(scanned.runs[k], options.runs[k]))
      scanned.candidates.push_back(std::move(one));
  if (scanned.candidates.empty())
    return fail(Fault::bad_input,
                fmt::format("'{}' holds no state to compare with", options.runs.front()));
  const preset::Joints& joints = scanned.candidates.front().run->preset.joints;
  scanned.cylinder = {joints.diameter_mm, joints.height_mm};
  return scanned;
}

/// Errors: bad_input when the cloud holds no joints or far too many, or cannot be laid on any
/// state.
Result<ComparedScan> compared(const Scanned& scanned, const std::string& file, Watch& watch) {
  auto clusters = cluster_tops(scanned.cloud, scanned.cylinder.diameter_mm);
  if (!clusters)
    return fail(Fault::bad_input, fmt::format("{}: {}", file, clusters.error().message));
  long most = 0;
  for (const Candidate& one : scanned.candidates)
    most = std::max(most, long(one.run->trajectory.layout.joints.size()));
  if (clusters->tops.cols() > most_clusters_a_joint * most)
    return fail(Fault::bad_input,
                fmt::format("{}: {} clusters of points as wide as joints of {:g} mm ([joints] "
                            "diameter_mm), the shell has {} joints",
                            file, clusters->tops.cols(), scanned.cylinder.diameter_mm, most));
  ComparedScan scan{file, std::move(*clusters), scanned.cylinder, {}, 0};
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& one : scanned.candidates) {
    if (watch.cancelled()) return stopped();
    const record::Trajectory& run = one.run->trajectory;
    const record::Frame& frame = run.frames[one.frame];
    if (const auto& fault = run.frames.fault()) return tl::unexpected(*fault);
    ComparedState state{one.name, lay_on(scan.clusters, form_of(run.layout, frame), scan.cylinder),
                        false};
    // states of shells of other sizes count by their joints
    if (state.scan) {
      state.shown = shows_state(*state.scan, scan.cylinder);
      const double cost = state.scan->cost / double(run.layout.joints.size());
      if (cost < least) least = cost, scan.best = scan.states.size();
    }
    scan.states.push_back(std::move(state));
    watch.report(double(scan.states.size()) / double(scanned.candidates.size()));
  }
  if (std::isfinite(least)) return scan;
  return fail(Fault::bad_input,
              fmt::format("{}: {} clusters of points as wide as joints of {:g} mm ([joints] "
                          "diameter_mm), {} specks and {} wider ones; they lie like the "
                          "joints of no shell given",
                          file, scan.clusters.tops.cols(), scan.cylinder.diameter_mm,
                          scan.clusters.specks, scan.clusters.others));
}

/// Red joints over the black shell [Baek 2018, Figs. 2A, 3C, 5E].
Result<void> draw(const ComparedScan& scan, const Candidate& one, Artist& artist,
                  const fs::path& folder, Watch& watch) {
  const auto style = style_of(one.run->preset, Pictures::stills);
  const LaidScan& laid = *scan.of_best().scan;
  const record::Trajectory shown = states_alone(one.run->trajectory, {one.frame});
  const std::string caption =
      fmt::format("{}{} of {} joints, {:.2f} mm rms, {:.2f} mm at most",
                  scan.of_best().shown ? "" : "not this state: ", laid.found, laid.joints.cols(),
                  laid.rms_mm, laid.max_mm);
  const double dpi = style.print.width_mm > 0 ? style.print.dpi : 0;
  return render::draw_over_nets({{&shown, caption, laid.measured()}}, style, artist.renderer(),
                                watch)
      .and_then(render::draw_panels)
      .and_then([&](const render::Image& image) {
        return render::write_png(image, folder / "scan.png", dpi);
      });
}

Result<void> write(const ComparedScan& scan, const record::Layout& layout, const fs::path& folder) {
  return make_folder(folder)
      .and_then([&] { return write_atomically(folder / "scan.csv", scan_csv(scan, layout)); })
      .and_then([&] {
        return write_atomically(folder / "measured.csv", measured_csv(*scan.of_best().scan));
      })
      .and_then([&] { return write_atomically(folder / "scan.json", scan_json(scan)); });
}

}  // namespace

int produce_scan(const ScanOptions& options) {
  const auto scanned = read_all(options);
  if (!scanned) return report(scanned.error());
  const fs::path points = options.common.input;
  const auto folder = options.common.output.empty()
                          ? fs::path("out") / (points.stem().string() + "_scan")
                          : options.common.output;
  const preset::Preset& first = scanned->candidates.front().run->preset;
  const std::vector<Phase> phases{drawing("comparing", 0.1 * double(scanned->candidates.size())),
                                  drawing("drawing", expected_seconds(Pictures::stills, first))};
  std::optional<ComparedScan> scan;
  const int code =
      deliver(folder, phases, options.common.quiet,
              [&](const fs::path& partial, Progress& progress) -> Result<void> {
                auto found = compared(*scanned, points.string(), progress.next_phase());
                if (!found) return tl::unexpected(found.error());
                scan = std::move(*found);
                const Candidate& best = scanned->candidates[scan->best];
                return write(*scan, best.run->trajectory.layout, partial).and_then([&] {
                  auto artist = Artist::create(options.common.context, options.common.threads,
                                               best.run->preset.style.font);
                  if (!artist) return Result<void>(tl::unexpected(artist.error()));
                  return draw(*scan, best, *artist, partial, progress.next_phase());
                });
              });
  if (code != ExitCode::done) return code;
  if (!options.common.quiet) fmt::print("{}: {}", folder.string(), scan_text(*scan));
  return scan->of_best().shown ? ExitCode::done : ExitCode::different;
}

}  // namespace gridshell::app
