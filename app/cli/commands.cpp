#include "app/cli/commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <system_error>

#include "app/cli/console.h"
#include "app/cli/pictures.h"
#include "app/cli/preset_library.h"
#include "app/cli/produce.h"
#include "app/cli/staged_folder.h"
#include "engine/core/try.h"
#include "render/gl/context.h"

namespace gridshell::app {

std::vector<CommandEntry> command_table() {
  CommandLine program;
  add_commands(program);
  return program.table();
}

namespace {

// `gridshell list`: the presets that come with the program, and the reference of all keys, options
// and commands.

Result<std::string> preset_lines() {
  std::size_t longest = 0;
  for (const auto& embedded : embedded_presets()) longest = std::max(longest, embedded.name.size());
  std::string text;
  for (const auto& embedded : embedded_presets()) {
    TRY(title, title_of(embedded));
    text += fmt::format("{:<{}}  {}\n", embedded.name, longest, *title);
  }
  return text;
}

struct ListOptions {
  std::string keys, completion;
  bool json = false, man = false;
};

Result<int> list(const ListOptions& options, const CommandLine& program,
                 Result<std::string> (*man_page)()) {
  if (options.man && !man_page) return start_window_program(program);
  TRY(text, !options.keys.empty()         ? preset::reference_markdown()
            : !options.completion.empty() ? bash_completion()
            : options.json                ? listing_json()
            : options.man                 ? man_page()
                                          : preset_lines());
  fmt::print("{}", *text);
  return printed();
}

void add_list(CommandLine& program, Result<std::string> (*man_page)()) {
  auto [command, options] = program.add<ListOptions>(
      "list", "the presets that come with the program",
      [man_page, &program](const ListOptions& given) { return list(given, program, man_page); });
  command.option("--keys", options.keys, "instead, the reference of all keys of a preset")
      .one_of({"markdown"});
  command.flag("--json", options.json,
               "instead, all commands, options, presets and keys for other programs");
  command.option("--completion", options.completion, "instead, a script for a shell")
      .one_of({"bash"});
  command.flag("--man", options.man, "instead, the manual page");
}

/// Adds a command whose arguments are a preset and the options that change it, write and draw.
std::pair<CommandArguments, Options&> add_preset_command(
    CommandLine& program, const char* name, const char* meaning, Result<int> (*act)(const Options&),
    const char* output = "folder to write, by default out/<preset>") {
  auto [command, options] = program.add<Options>(name, meaning, act);
  add_preset_options(command, options);
  add_work_options(command, options, output);
  add_picture_options(command, options);
  return {command, options};
}

template <Pictures pictures>
Result<int> produce_with(const Options& options) {
  return options.turntable ? turntable(options) : produce(options, pictures);
}

}  // namespace

void add_commands(CommandLine& program, const WindowProgram& window) {
  auto [movie, to_draw] =
      add_preset_command(program, "movie", "run the experiment and render it: frames and a movie",
                         produce_with<Pictures::movie>);
  movie.flag("--turntable", to_draw.turntable,
             "instead, of the folder of a finished run: its last state seen once around, in "
             "RUN_turntable");
  add_preset_command(program, "figure", "the stills of a preset", produce_with<Pictures::stills>,
                     "folder to write, by default out/<preset>_figure");
  auto [run, to_run] = add_preset_command(program, "run", "the experiment alone, no pictures",
                                          produce_with<Pictures::none>);
  run.flag("--resume", to_run.resume,
           "continue a run of this preset to the same folder; starts if there is none, ends at "
           "once if it is finished");
  add_render(program);
  add_view(program, window.view);
  add_chart(program);
  add_sweep(program);
  add_preset_command(
      program, "design",
      "moves pins, legs, prescribed directions or diameters until the shell meets its surface",
      produce_design, "folder to write, by default out/<preset>_design");
  add_export(program);
  add_load(program);
  add_modes(program);
  add_report(program);
  add_scan(program);
  // takes the options of `movie`, whose command line can so be checked by changing one word
  add_preset_command(program, "check", "validate a preset and say what would run", check);
  add_compare(program);
  add_list(program, window.man_page);
}

int run_program(int argc, char** argv, const WindowProgram& window) {
  install_signal_handlers();
  install_terminate_handler();
  open_standard_streams();
  render::keep_compiled_shaders();
  int code = ExitCode::failed;
  int not_printed = 0;
  try {
    CommandLine program;
    add_commands(program, window);
    code = program.run(argc, argv);
  } catch (const std::system_error& error) {
    // a failed write to stdout is reported below
    if (std::ferror(stdout))
      not_printed = error.code().value();
    else
      code = report_exception(error);
  } catch (const std::exception& error) {
    code = report_exception(error);
  }
  // a command whose output is lost has failed
  if (!flush_stdout(not_printed) && code == ExitCode::done) code = ExitCode::failed;
  return code;
}

}  // namespace gridshell::app
