// `gridshell view [PRESET|RUN]`: the desktop window; or the same interface without a display,
// played from a recording.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <thread>
#include <tuple>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/design_files.h"
#include "app/cli/options.h"
#include "app/cli/preset_library.h"
#include "app/window/imgui_painter.h"
#include "app/window/interface.h"
#include "app/window/viewer_state.h"
#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/core/try.h"
#include "render/gl/image.h"
#include "render/movie/subprocess.h"

namespace gridshell::app {
namespace {

namespace fs = std::filesystem;

struct ViewOptions {
  std::string input, record, play, shot, picture, size, quality = "movie", context = "auto";
  fs::path output = "out", workspace;
  bool bare = false;
  double bench = 0;

  bool off_screen() const {
    return !play.empty() || !shot.empty() || !picture.empty() || bench > 0;
  }
};

Result<std::unique_ptr<render::Context>> make_context(const std::string& name) {
  const auto kind = find_word<render::ContextKind>(name);
  if (!kind) return fail(Fault::bad_input, "--context " + name + ": no such context");
  return render::Context::create(*kind);
}

/// Of several cases the first.
Result<preset::Preset> first_preset_of(const std::string& name) {
  TRY(presets, load_preset_or_run(name));
  return presets->cases.empty() ? presets->base : presets->cases.front().preset;
}

/// The program itself makes it, in a process of its own that can be stopped.
Result<void> make_movie(const fs::path& preset, const fs::path& folder,
                        const window::ProgressListener& heard, const Watch& watch) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return fail(Fault::io, "cannot find this program's file: " + error.message());
  return render::run_subprocess({program.string(), "movie", preset.string(), "-o", folder.string()},
                                watch, heard);
}

/// In a context of its own, which does not hold up the window's.
Result<void> draw_picture(const window::PictureRequest& order, const fs::path& file,
                          const std::string& context) {
  TRY(made, make_context(context));
  TRY(renderer, render::Renderer::create(**made));
  return ui::picture_of(order, **renderer).and_then([&](const render::Image& image) {
    return render::write_png(image, file);
  });
}

window::Library library_of(const ViewOptions& options) {
  window::Library library;
  for (const EmbeddedPreset& embedded : embedded_presets())
    if (const auto presets = load_preset(embedded.name, {}))
      library.cards.push_back({embedded.name, presets->base.title, embedded_card(embedded.name)});
  library.load = first_preset_of;
  library.make_movie = make_movie;
  library.draw_picture = [context = options.context](const window::PictureRequest& order,
                                                     const fs::path& file) {
    return draw_picture(order, file, context);
  };
  library.write_preset = write_preset_with_tables;
  library.save_to = options.output;
  return library;
}

/// The interface off-screen, with a viewer of its own.
struct OffscreenInterface {
  std::unique_ptr<render::Context> context;
  std::unique_ptr<render::Renderer> renderer;
  std::unique_ptr<ui::Interface> interface;
};

/// The software rasteriser leaves a processor to the engine.
void share_processors() {
  const unsigned cores = std::max(2u, std::thread::hardware_concurrency());
  setenv("LP_NUM_THREADS", std::to_string(cores - 1).c_str(), 0);
}

Result<OffscreenInterface> open_aside(const ViewOptions& options, window::ViewerState& viewer) {
  TRY(context, make_context(options.context));
  TRY(renderer, render::Renderer::create(**context));
  TRY(interface, ui::Interface::create(**context, **renderer, viewer));
  return OffscreenInterface{std::move(*context), std::move(*renderer), std::move(*interface)};
}

int print_bench(const ui::BenchFigures& figures) {
  Json line = Json::object();
  const auto rounded = [](double value) { return std::round(10 * value) / 10; };
  line["interface_fps"] = rounded(figures.interface_fps);
  line["equilibria_per_s"] = rounded(figures.equilibria_per_s);
  line["worst_frame_ms"] = rounded(figures.worst_frame_ms);
  line["frame_cpu_ms"] = rounded(figures.frame_cpu_ms);
  line["cancel_ms"] = rounded(figures.cancel_ms);
  fmt::print("{}\n", line_of(line));
  return ExitCode::done;
}

/// What the engine came to, as a line of JSON: the same for the same recording on every machine.
void print_state(const window::ViewerState& viewer) {
  const window::ShellView& sight = *viewer.sight;
  Json line = Json::object();
  line["preset"] = sight.preset.name;
  line["progress"] = sight.progress;
  line["boundary_radius_mm"] = sight.frame.boundary_radius_mm;
  line["height_mm"] = sight.frame.height_mm;
  line["energy_bend_mJ"] = sight.frame.energies[Term::bend];
  line["total_K"] = sight.frame.total_K;
  line["residual_N"] = sight.certificate.residual_N;
  line["negative_pivots"] = sight.certificate.negative_pivots;
  line["error_estimate_mm"] = sight.certificate.error_estimate_mm;
  line["held"] = sight.held.size();
  line["force_N"] = sight.held.empty() ? 0 : sight.held.back().force_N.norm();
  line["depth_mm"] = sight.held.empty() ? 0 : sight.held.back().moved_mm.norm();
  line["gravity"] = viewer.gravity();
  line["undo_steps"] = sight.undo_steps;
  line["redo_steps"] = sight.redo_steps;
  if (sight.design) {
    const window::DesignProgress& course = *sight.design;
    line["design"] = {
        {"steps", int(course.points.size()) - 1},        {"iterations", course.iterations},
        {"max_before_mm", course.points.front().max_mm}, {"max_mm", course.points.back().max_mm},
        {"mean_mm", course.points.back().mean_mm},       {"kept", course.kept}};
  }
  line["message"] = viewer.message;
  fmt::print("{}\n", line_of(line));
}

/// The shell alone, as the view has it; of a preset that nobody turned all of it.
Result<void> draw_alone(const ViewOptions& options, window::ViewerState& viewer) {
  if (!viewer.sight->any()) return fail(Fault::no_equilibrium, viewer.message);
  if (options.play.empty() && viewer.picture.width > 0) {
    viewer.view = {double(viewer.picture.width), double(viewer.picture.height)};
    viewer.fit_view();
  }
  return draw_picture(viewer.picture_order(), options.picture, options.context);
}

int play_aside(const ViewOptions& options, window::ViewerState& viewer) {
  std::vector<window::InputEvent> events;
  // a picture of a preset is of its end, pushed as far as it pushes
  if (!options.picture.empty() && options.play.empty())
    events.push_back({.kind = window::InputKind::act, .text = "to_end"});
  if (!options.play.empty()) {
    const auto text = as_input(read_file(options.play));
    if (!text) return report(text.error());
    auto read = window::read_events(*text, options.play);
    if (!read) return report(read.error());
    events = std::move(*read);
  }
  auto aside = open_aside(options, viewer);
  if (!aside) return report(aside.error());
  if (options.bench > 0) {
    const auto figures = ui::bench(*aside->interface, viewer, options.bench);
    return figures ? print_bench(*figures) : report(figures.error());
  }
  if (auto played = ui::play(*aside->interface, viewer, events); !played)
    return report(played.error());
  if (!options.shot.empty())
    if (auto kept = render::write_png(aside->interface->read(), options.shot); !kept)
      return report(kept.error());
  if (!options.picture.empty())
    if (auto drawn = draw_alone(options, viewer); !drawn) return report(drawn.error());
  print_state(viewer);
  return ExitCode::done;
}

/// How the picture is wanted.
Result<void> size_picture(const ViewOptions& options, window::PictureFormat& picture) {
  picture.quality = *find_word<render::Quality>(options.quality);
  picture.legend = !options.bare;
  if (options.size.empty()) return {};
  TRY(size, size_of(options.size));
  std::tie(picture.width, picture.height) = *size;
  return window::check_picture(picture.width, picture.height);
}

/// The workspace of the last visit; one that cannot be read is none.
void restore(const ViewOptions& options, window::ViewerState& viewer) {
  if (options.workspace.empty()) return;
  if (const auto text = read_file(options.workspace, largest_text))
    if (auto taken = window::take_workspace(viewer, *text); !taken)
      fmt::print(stderr, "{}: {}\n", options.workspace.string(), taken.error().message);
}

/// Kept for the next visit.
void keep(const ViewOptions& options, const window::ViewerState& viewer) {
  if (options.workspace.empty() || !viewer.sight->any()) return;
  const fs::path folder = options.workspace.parent_path();
  const auto kept = (folder.empty() ? Result<void>{} : make_folder(folder)).and_then([&] {
    return write_file(options.workspace, window::workspace_text(viewer));
  });
  if (!kept) fmt::print(stderr, "the workspace is not kept: {}\n", kept.error().message);
}

int show(const ViewOptions& options, window::ViewerState& viewer) {
  std::ofstream record;
  if (!options.record.empty()) {
    record.open(options.record);
    if (!record) return report({Fault::io, "cannot write '" + options.record + "'"});
    if (!options.input.empty()) record << "open " << options.input << "\n";
  }
  const InterruptGuard guarded;
  const auto done = ui::run_desktop(
      viewer,
      [&](const window::InputEvent& event) {
        if (record.is_open()) record << write_event(event) << "\n" << std::flush;
      },
      interrupted_by_signal);
  if (!done) return report(done.error());
  return interrupted_by_signal() ? ExitCode::interrupted : ExitCode::done;
}

int view(ViewOptions options) {
  if (options.bench > 0 && options.input.empty())
    return report(
        {Fault::bad_input, "view --bench S takes a preset: gridshell view PRESET --bench S"});
  if (options.off_screen() && options.play.empty() && options.input.empty())
    return report(
        {Fault::bad_input, "view --shot PNG and --picture PNG take a preset or --play FILE"});
  const bool off_screen = options.off_screen();
  // what is played is the same everywhere
  if (options.workspace.empty() && !off_screen && options.record.empty())
    options.workspace = window::workspace_file();
  share_processors();
  window::ViewerState viewer(library_of(options));
  viewer.timed = !off_screen;
  if (auto sized = size_picture(options, viewer.picture); !sized) return report(sized.error());
  restore(options, viewer);
  if (!options.input.empty()) {
    const auto preset = first_preset_of(options.input);
    if (!preset) return report(preset.error());
    viewer.open(options.input);
  }
  const int code = off_screen ? play_aside(options, viewer) : show(options, viewer);
  keep(options, viewer);
  return code;
}

}  // namespace

void add_view(CLI::App& program, Action& action) {
  const auto options = std::make_shared<ViewOptions>();
  auto* command =
      program.add_subcommand("view", "the desktop window, or its input played without one");
  command->add_option("preset", options->input, "a preset's file or name, or a run's folder");
  command->add_option("-o,--output", options->output,
                      "folder that pictures and presets are saved to, by default out");
  command->add_option(
      "--workspace", options->workspace,
      "file that keeps camera, colours and panels from one visit to the next, by "
      "default ~/.local/state/gridshell/workspace.json; off-screen and with --record none");
  command->add_option("--record", options->record, "keeps the input as text, a line an event");
  command->add_option("--play", options->play,
                      "plays recorded input off-screen, each event's equilibrium awaited");
  command->add_option("--shot", options->shot, "with it, the last frame as a PNG");
  command->add_option("--picture", options->picture,
                      "draws the shell alone, off-screen, as 'Save picture' does");
  command->add_option("--size", options->size,
                      "width and height of kept pictures: WxH; by default twice the view's");
  command->add_option("--quality", options->quality, "of kept pictures: draft, movie or figure")
      ->check(CLI::IsMember(all_words<render::Quality>()));
  command->add_flag("--bare", options->bare, "no legend in kept pictures");
  command
      ->add_option("--bench", options->bench,
                   "drags the radius to and fro for so many seconds, off-screen, and prints a "
                   "line of JSON")
      ->check(CLI::Range(0.1, 600.0));
  command->add_option("--context", options->context, "off-screen OpenGL: auto, osmesa or egl")
      ->check(CLI::IsMember({"auto", "osmesa", "egl"}));
  command->callback([&action, options] { action = [options] { return view(*options); }; });
}

}  // namespace gridshell::app
