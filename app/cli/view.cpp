// `gridshell view`: its options. The window is a program of its own, so that users who only make
// movies need not wait for it to be compiled.
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "app/cli/commands.h"
#include "engine/core/enum_words.h"

namespace gridshell::app {

Result<int> start_window_program(const CommandLine& program) {
  std::error_code error;
  const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", error),
                              there = here.parent_path() / "gridshell_window";
  if (!error && ::access(there.c_str(), X_OK) == 0) {
    ::execv(there.c_str(), program.given());
    return fail(Fault::io, "'{}' cannot be started: {}", there.string(), std::strerror(errno));
  }
  return fail(
      Fault::io,
      "the window is a program of its own, '{}', which is not built: 'app/run.sh view' in the "
      "folder of the sources builds and starts it, 'cmake --build build' builds everything",
      there.string());
}

void add_view(CommandLine& program, Result<int> (*view)(ViewOptions)) {
  auto [command, options] =
      program.add<ViewOptions>("view", "the desktop window, or its input played without one",
                               [view, &program](const ViewOptions& given) {
                                 return view ? view(given) : start_window_program(program);
                               });
  command.option("preset", options.input, "a preset's file or name, or a run's folder");
  command.option("-o,--output", options.output,
                 "folder that pictures and presets are saved to, by default out");
  command.option(
      "--workspace", options.workspace,
      "file in which camera, colours and panels are saved for the next start, by "
      "default ~/.local/state/gridshell/workspace.json; off-screen and with --record none");
  command.option("--record", options.record,
                 "file in which the input is saved as text, one line per event");
  command.option("--play", options.play,
                 "plays recorded input off-screen, and waits for the equilibrium after each event");
  command.option("--shot", options.shot, "with it, the last frame as a PNG");
  command.option("--picture", options.picture,
                 "draws the shell alone, off-screen, as 'Save picture' does");
  command.option("--size", options.size,
                 "width and height of saved pictures: WxH; by default twice the view's");
  command.option("--quality", options.quality, "of saved pictures: draft, movie or figure")
      .one_of(all_words<render::Quality>());
  command.flag("--bare", options.bare, "no legend in saved pictures");
  command
      .option("--bench", options.bench,
              "drags the radius forward and back for so many seconds, off-screen, and prints a "
              "line of JSON")
      .in_range(0.1, 600.0);
  command.option("--context", options.context, "off-screen OpenGL: auto, osmesa or egl")
      .one_of({"auto", "osmesa", "egl"});
}

}  // namespace gridshell::app
