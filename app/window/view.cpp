// `gridshell view [PRESET|RUN]`: the desktop window; or the same interface without a display,
// played from a recording.
#include "app/window/view.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>
#include <tuple>

#include "app/cli/console.h"
#include "app/cli/pictures.h"
#include "app/cli/preset_library.h"
#include "app/cli/produce.h"
#include "app/window/imgui_painter.h"
#include "app/window/interface.h"
#include "app/window/manual.h"
#include "app/window/viewer_state.h"
#include "app/window/workspace.h"
#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/core/scratch_folder.h"
#include "engine/core/try.h"
#include "render/gl/image.h"
#include "render/movie/encode.h"
#include "render/movie/subprocess.h"

namespace gridshell::window {
namespace {

using namespace app;

namespace fs = std::filesystem;

bool is_off_screen(const ViewOptions& options) {
  return !options.play.empty() || !options.shot.empty() || !options.picture.empty() ||
         options.bench > 0;
}

/// The preset of a name, file or run; of several cases the first.
Result<preset::Preset> first_preset_of(const std::string& name) {
  TRY(presets, load_preset_or_run(name));
  return presets->cases.empty() ? presets->base : presets->cases.front().preset;
}

/// Runs this program in another process, which can be stopped.
Result<void> run_this_program(std::vector<std::string> arguments, const Watch& watch,
                              const ProgressListener& listener) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return fail(Fault::io, "cannot find this program's file: " + error.message());
  arguments.insert(arguments.begin(), program.string());
  return render::run_subprocess(arguments, watch, listener);
}

Result<void> make_movie(const fs::path& preset, const fs::path& folder,
                        const ProgressListener& listener, const Watch& watch) {
  return run_this_program({"movie", preset.string(), "-o", folder.string()}, watch, listener);
}

/// Forms and exports the shell with `run` and `export` of this program, in a temporary folder. For
/// an .xdmf, which reads its numbers from the run, that folder is FILE_run and remains.
Result<void> export_shell(const preset::Preset& preset, const fs::path& file,
                          const ProgressListener& listener, const Watch& watch) {
  TRY(scratch, ScratchFolder::make());
  const fs::path& aside = scratch->path();
  const auto run = [&](const std::vector<std::string>& arguments) {
    return run_this_program(arguments, watch, listener);
  };
  const bool kept = file.extension() == ".xdmf";
  const std::string shell = (aside / "shell.toml").string(),
                    ran = kept ? (file.parent_path() / file.stem()).string() + "_run"
                               : (aside / "run").string();
  return write_preset_with_tables(preset, shell)
      .and_then([&] {
        return run({"run", shell, "-o", ran});
      })
      .and_then([&] {
        return run({"export", ran, "--to", file.string()});
      });
}

/// The joints of a scan.csv, without missing ones, and lines between neighbours.
Result<OtherShell> load_scan(const fs::path& file) {
  TRY(text, read_file(file));
  record::Layout scan;
  record::Frame frame;
  std::vector<Eigen::Vector3d> positions;
  std::map<std::pair<int, int>, int> nodes;
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line);) {
    record::Joint joint;
    double x = 0, y = 0, z = 0;
    if (std::sscanf(line.c_str(), "%d,%d,%lf,%lf,%lf", &joint.i, &joint.j, &x, &y, &z) != 5)
      continue;
    joint.node = int(positions.size());
    nodes[{joint.i, joint.j}] = joint.node;
    scan.joints.push_back(joint);
    positions.emplace_back(x, y, z);
  }
  if (positions.empty()) return invalid("'{}' has no joints", file.string());
  for (const auto& [at, node] : nodes)
    for (const auto& neighbour : {std::pair(at.first + 1, at.second), {at.first, at.second + 1}})
      if (const auto other = nodes.find(neighbour); other != nodes.end())
        scan.rods.push_back({node, other->second});
  frame.nodes.resize(3, Eigen::Index(positions.size()));
  for (std::size_t k = 0; k < positions.size(); ++k)
    frame.nodes.col(Eigen::Index(k)) = positions[k];
  return OtherShell{file.parent_path().filename().string(), view_of(std::move(scan), frame, frame)};
}

Result<OtherShell> load_run(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "scan.csv", error)) return load_scan(folder / "scan.csv");
  TRY(runs, read_runs(folder, {}, false));
  const record::Trajectory& run = runs->front().trajectory;
  return OtherShell{folder.filename().string(),
                    view_of(run.layout, run.frames.back(), run.frames.front())};
}

/// Writes the manual into the folder of temporary files and opens it in a browser.
Result<void> show_manual(const Watch& watch) {
  TRY(page, manual_html());
  const fs::path file =
      fs::temp_directory_path() / fmt::format("gridshell-manual-{}.html", ::getuid());
  TRY_DO(write_file(file, *page));
  const fs::path browser = render::find_program("xdg-open");
  if (browser.empty() || !render::run_subprocess({browser.string(), file.string()}, watch))
    return fail(Fault::io, "no browser can be opened: the manual is {}", file.string());
  return {};
}

Library library_of(const ViewOptions& options) {
  Library library;
  for (const EmbeddedPreset& embedded : embedded_presets())
    if (const auto presets = load_preset(embedded.name, {}))
      library.cards.push_back({embedded.name, presets->base.title, embedded_card(embedded.name)});
  library.load = first_preset_of;
  library.make_movie = make_movie;
  library.export_shell = export_shell;
  library.export_formats = usual_exports();
  library.load_run = load_run;
  library.show_manual = show_manual;
  // in a separate context, so that the window need not wait
  library.draw_picture = [context = options.context](const PictureRequest& order,
                                                     const fs::path& file) -> Result<void> {
    TRY(maker, PictureMaker::create(context));
    TRY(image, picture_of(order, maker->renderer()));
    return render::write_png(*image, file, order.format.dpi);
  };
  library.draw_still = [context =
                            options.context](const PictureRequest& shown) -> Result<render::Image> {
    TRY(maker, PictureMaker::create(context));
    return view_picture(shown, Resolution::still, maker->renderer());
  };
  library.write_preset = write_preset_with_tables;
  library.save_to = options.output;
  return library;
}

/// Leaves one core to the engine and one to the window, and the others to the threads of the
/// software rasteriser; if there are only two, it has no threads.
void share_processors() {
  const unsigned cores = std::max(2u, std::thread::hardware_concurrency());
  setenv("LP_NUM_THREADS", std::to_string(cores - 2).c_str(), 0);
}

void print_bench(const BenchFigures& figures) {
  const auto rounded = [](double value) { return std::round(10 * value) / 10; };
  fmt::print("{}\n", line_of({{"interface_fps", rounded(figures.interface_fps)},
                              {"equilibria_per_s", rounded(figures.equilibria_per_s)},
                              {"worst_frame_ms", rounded(figures.worst_frame_ms)},
                              {"frame_cpu_ms", rounded(figures.frame_cpu_ms)},
                              {"cancel_ms", rounded(figures.cancel_ms)}}));
}

/// Prints the final state as a line of JSON, the same for the same recording on every machine.
void print_state(const ViewerState& viewer) {
  const ShellView& sight = *viewer.shell;
  const auto* last = sight.constrained.empty() ? nullptr : &sight.constrained.back();
  Json line{{"preset", sight.preset.name},
            {"progress", sight.progress},
            {"boundary_radius_mm", sight.frame.boundary_radius_mm},
            {"height_mm", sight.frame.height_mm},
            {"energy_bend_mJ", sight.frame.energies[Term::bend]},
            {"total_K", sight.frame.total_K},
            {"residual_N", sight.certificate.residual_N},
            {"negative_pivots", sight.certificate.negative_pivots},
            {"error_estimate_mm", sight.certificate.error_estimate_mm},
            {"held", sight.constrained.size()},
            {"force_N", last ? last->force_N.norm() : 0},
            {"depth_mm", last ? last->moved_mm.norm() : 0},
            {"gravity", viewer.gravity()},
            {"undo_steps", sight.undo_steps},
            {"redo_steps", sight.redo_steps}};
  if (sight.design) {
    const DesignProgress& design = *sight.design;
    line["design"] = {
        {"steps", int(design.points.size()) - 1},        {"iterations", design.iterations},
        {"max_before_mm", design.points.front().max_mm}, {"max_mm", design.points.back().max_mm},
        {"mean_mm", design.points.back().mean_mm},       {"kept", design.kept}};
  }
  line["message"] = viewer.message;
  fmt::print("{}\n", line_of(line));
}

/// Draws the shell without the interface, with the camera of the view; without a recording the
/// camera is fitted to the requested size.
Result<void> draw_alone(const ViewOptions& options, ViewerState& viewer) {
  if (!viewer.shell->any()) return fail(Fault::no_equilibrium, viewer.message);
  if (options.play.empty() && viewer.picture.width > 0) {
    viewer.view = {double(viewer.picture.width), double(viewer.picture.height)};
    viewer.fit_view();
  }
  return viewer.library.draw_picture(viewer.picture_request(), options.picture);
}

Result<int> play_offscreen(const ViewOptions& options, ViewerState& viewer) {
  std::vector<InputEvent> events;
  // the picture of a preset shows the end of its path or push
  if (!options.picture.empty() && options.play.empty())
    events.push_back({.kind = InputKind::act, .text = "to_end"});
  if (!options.play.empty()) {
    TRY(text, as_input(read_file(options.play)));
    TRY(read, read_events(*text, options.play));
    events = std::move(*read);
  }
  TRY(maker, PictureMaker::create(options.context));
  TRY(interface, Interface::create(maker->context(), maker->renderer(), viewer));
  if (options.bench > 0) {
    TRY(figures, bench(**interface, viewer, options.bench));
    print_bench(*figures);
    return printed();
  }
  TRY_DO(play(**interface, viewer, events));
  if (!options.shot.empty()) TRY_DO(render::write_png((*interface)->read(), options.shot));
  if (!options.picture.empty()) TRY_DO(draw_alone(options, viewer));
  print_state(viewer);
  return ExitCode::done;
}

/// Sets the requested size of the picture.
Result<void> size_picture(const ViewOptions& options, PictureFormat& picture) {
  picture.quality = *find_word<render::Quality>(options.quality);
  picture.legend = !options.bare;
  if (options.size.empty()) return {};
  TRY(size, size_of(options.size));
  std::tie(picture.width, picture.height) = *size;
  return check_picture(picture.width, picture.height);
}

/// Restores the workspace; errors in it are only reported.
void restore(const ViewOptions& options, ViewerState& viewer) {
  if (options.workspace.empty()) return;
  if (const auto text = read_file(options.workspace, largest_text))
    if (auto taken = take_workspace(viewer, *text); !taken)
      fmt::print(stderr, "{}: {}\n", options.workspace.string(), taken.error().message);
}

void save_workspace(const ViewOptions& options, const ViewerState& viewer) {
  if (options.workspace.empty() || !viewer.shell->any()) return;
  const auto saved = write_with_folder(options.workspace, workspace_text(viewer));
  if (!saved) fmt::print(stderr, "the workspace is not saved: {}\n", saved.error().message);
}

Result<int> show(const ViewOptions& options, ViewerState& viewer) {
  std::ofstream record;
  if (!options.record.empty()) {
    record.open(options.record);
    if (!record) return fail(Fault::io, "cannot write '" + options.record + "'");
    if (!options.input.empty()) record << "open " << options.input << "\n";
  }
  const InterruptGuard guarded;
  TRY_DO(run_desktop(
      viewer,
      [&](const InputEvent& event) {
        if (record.is_open()) record << write_event(event) << "\n" << std::flush;
      },
      interrupted_by_signal));
  return interrupted_by_signal() ? ExitCode::interrupted : ExitCode::done;
}

}  // namespace

Result<int> view(ViewOptions options) {
  if (options.bench > 0 && options.input.empty())
    return invalid("view --bench S takes a preset: gridshell view PRESET --bench S");
  const bool off_screen = is_off_screen(options);
  if (off_screen && options.play.empty() && options.input.empty())
    return invalid("view --shot PNG and --picture PNG take a preset or --play FILE");
  if (off_screen && !options.record.empty())
    return invalid(
        "view --record FILE records the input of the window, which --play, --shot, --picture and "
        "--bench do not open");
  // no workspace off-screen or for a recording, so that it plays the same on every machine
  if (options.workspace.empty() && !off_screen && options.record.empty())
    options.workspace = workspace_file();
  share_processors();
  ViewerState viewer(library_of(options));
  viewer.timed = !off_screen;
  // without another thread, so that frames are the same on every machine
  if (off_screen && options.bench == 0) viewer.library.draw_still = nullptr;
  TRY_DO(size_picture(options, viewer.picture));
  restore(options, viewer);
  if (!options.input.empty()) {
    TRY_DO(first_preset_of(options.input));
    viewer.open(options.input);
  }
  auto code = off_screen ? play_offscreen(options, viewer) : show(options, viewer);
  save_workspace(options, viewer);
  return code;
}

}  // namespace gridshell::window
