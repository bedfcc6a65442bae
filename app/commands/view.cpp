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

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/interrupt.h"
#include "app/preset_library.h"
#include "app/ui/desktop.h"
#include "app/ui/playback.h"
#include "app/window/workspace.h"
#include "engine/core/atomic_file.h"
#include "engine/record/json.h"
#include "render/image/png.h"

namespace gridshell::app {
namespace {

namespace fs = std::filesystem;

struct ViewOptions {
  std::string input, record, play, shot, context = "auto";
  fs::path output = "out", workspace;
  double bench = 0;
};

/// Of several cases the first.
Result<preset::Preset> first_preset_of(const std::string& name) {
  auto presets = load_preset_or_run(name);
  if (!presets) return tl::unexpected<Error>(presets.error());
  return presets->cases.empty() ? presets->base : presets->cases.front().preset;
}

window::Library library_of(const ViewOptions& options) {
  window::Library library;
  for (const EmbeddedPreset& embedded : embedded_presets())
    if (const auto presets = load_preset(embedded.name, {}))
      library.cards.push_back({embedded.name, presets->base.title});
  library.load = first_preset_of;
  library.save_to = options.output;
  return library;
}

/// The interface off-screen, with a desk of its own.
struct Aside {
  std::unique_ptr<render::Context> context;
  std::unique_ptr<render::Renderer> renderer;
  std::unique_ptr<ui::Interface> interface;
};

/// The software rasteriser leaves a processor to the engine.
void share_processors() {
  const unsigned cores = std::max(2u, std::thread::hardware_concurrency());
  setenv("LP_NUM_THREADS", std::to_string(cores - 1).c_str(), 0);
}

Result<Aside> open_aside(const ViewOptions& options, window::Desk& desk) {
  const auto kind = find_word<render::ContextKind>(options.context);
  if (!kind) return fail(Fault::bad_input, "--context " + options.context + ": no such context");
  auto context = render::Context::create(*kind);
  if (!context) return tl::unexpected<Error>(context.error());
  auto renderer = render::Renderer::create(**context);
  if (!renderer) return tl::unexpected<Error>(renderer.error());
  auto interface = ui::Interface::create(**context, **renderer, desk);
  if (!interface) return tl::unexpected<Error>(interface.error());
  return Aside{std::move(*context), std::move(*renderer), std::move(*interface)};
}

int print_bench(const ui::BenchFigures& figures) {
  record::Json line = record::Json::object();
  const auto rounded = [](double value) { return std::round(10 * value) / 10; };
  line["interface_fps"] = rounded(figures.interface_fps);
  line["equilibria_per_s"] = rounded(figures.equilibria_per_s);
  line["worst_frame_ms"] = rounded(figures.worst_frame_ms);
  line["frame_cpu_ms"] = rounded(figures.frame_cpu_ms);
  line["cancel_ms"] = rounded(figures.cancel_ms);
  fmt::print("{}\n", record::line_of(line));
  return ExitCode::done;
}

/// What the engine came to, as a line of JSON: the same for the same recording on every machine.
void print_state(const window::Desk& desk) {
  const window::Sight& sight = *desk.sight;
  record::Json line = record::Json::object();
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
  line["gravity"] = desk.gravity();
  line["undo_steps"] = sight.undo_steps;
  line["redo_steps"] = sight.redo_steps;
  line["message"] = desk.message;
  fmt::print("{}\n", record::line_of(line));
}

int play_aside(const ViewOptions& options, window::Desk& desk) {
  std::vector<window::InputEvent> events;
  if (!options.play.empty()) {
    const auto text = as_input(read_whole(options.play));
    if (!text) return report(text.error());
    auto read = window::read_events(*text, options.play);
    if (!read) return report(read.error());
    events = std::move(*read);
  }
  auto aside = open_aside(options, desk);
  if (!aside) return report(aside.error());
  if (options.bench > 0) {
    const auto figures = ui::bench(*aside->interface, desk, options.bench);
    return figures ? print_bench(*figures) : report(figures.error());
  }
  if (auto played = ui::play(*aside->interface, desk, events); !played)
    return report(played.error());
  if (!options.shot.empty())
    if (auto kept = render::write_png(aside->interface->read(), options.shot); !kept)
      return report(kept.error());
  print_state(desk);
  return ExitCode::done;
}

/// The workspace of the last visit; one that cannot be read is none.
void restore(const ViewOptions& options, window::Desk& desk) {
  if (options.workspace.empty()) return;
  if (const auto text = read_whole(options.workspace, largest_text))
    if (auto taken = window::take_workspace(desk, *text); !taken)
      fmt::print(stderr, "{}: {}\n", options.workspace.string(), taken.error().message);
}

/// Kept for the next visit.
void keep(const ViewOptions& options, const window::Desk& desk) {
  if (options.workspace.empty() || !desk.sight->any()) return;
  const fs::path folder = options.workspace.parent_path();
  const auto kept = (folder.empty() ? Result<void>{} : make_folder(folder)).and_then([&] {
    return write_atomically(options.workspace, window::workspace_text(desk));
  });
  if (!kept) fmt::print(stderr, "the workspace is not kept: {}\n", kept.error().message);
}

int show(const ViewOptions& options, window::Desk& desk) {
  std::ofstream record;
  if (!options.record.empty()) {
    record.open(options.record);
    if (!record) return report({Fault::io, "cannot write '" + options.record + "'"});
    if (!options.input.empty()) record << "open " << options.input << "\n";
  }
  const Guarded guarded;
  const auto done = ui::run_desktop(
      desk,
      [&](const window::InputEvent& event) {
        if (record.is_open()) record << write_event(event) << "\n" << std::flush;
      },
      interrupt_came);
  if (!done) return report(done.error());
  return interrupt_came() ? ExitCode::interrupted : ExitCode::done;
}

int view(ViewOptions options) {
  if (options.bench > 0 && options.input.empty())
    return report(
        {Fault::bad_input, "view --bench S takes a preset: gridshell view PRESET --bench S"});
  if (!options.shot.empty() && options.play.empty() && options.input.empty())
    return report({Fault::bad_input, "view --shot PNG takes a preset or --play FILE"});
  const bool off_screen = !options.play.empty() || !options.shot.empty() || options.bench > 0;
  // what is played is the same everywhere
  if (options.workspace.empty() && !off_screen) options.workspace = window::workspace_file();
  share_processors();
  window::Desk desk(library_of(options));
  restore(options, desk);
  if (!options.input.empty()) {
    const auto preset = first_preset_of(options.input);
    if (!preset) return report(preset.error());
    desk.open(options.input);
  }
  const int code = off_screen ? play_aside(options, desk) : show(options, desk);
  keep(options, desk);
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
  command->add_option("--workspace", options->workspace,
                      "file that keeps camera, colours and panels from one visit to the next, by "
                      "default ~/.local/state/gridshell/workspace.json; off-screen none");
  command->add_option("--record", options->record, "keeps the input as text, a line an event");
  command->add_option("--play", options->play,
                      "plays recorded input off-screen, each event's equilibrium awaited");
  command->add_option("--shot", options->shot, "with it, the last frame as a PNG");
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
