// The commands of the program, a file each: add_x declares the arguments of `gridshell x`; when the
// command line names it, `action` becomes what is to be done and returns the exit code.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace gridshell::app {

using Action = std::function<int()>;

void add_movie(CLI::App& program, Action& action);
void add_figure(CLI::App& program, Action& action);
void add_run(CLI::App& program, Action& action);
void add_render(CLI::App& program, Action& action);
void add_view(CLI::App& program, Action& action);
void add_chart(CLI::App& program, Action& action);
void add_sweep(CLI::App& program, Action& action);
void add_design(CLI::App& program, Action& action);
void add_export(CLI::App& program, Action& action);
void add_scan(CLI::App& program, Action& action);
void add_check(CLI::App& program, Action& action);
void add_compare(CLI::App& program, Action& action);
void add_list(CLI::App& program, Action& action);

/// All of them, in the order of the help.
void add_commands(CLI::App& program, Action& action);

}  // namespace gridshell::app
