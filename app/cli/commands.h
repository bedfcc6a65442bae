// The commands of the program, a file each: add_x declares the arguments of `gridshell x` and what
// it does.
#pragma once

#include <vector>

#include "app/cli/command_line.h"

namespace gridshell::window {
struct ExportFormat;
}

namespace gridshell::app {

void add_render(CommandLine& program);
void add_view(CommandLine& program);
void add_chart(CommandLine& program);
void add_sweep(CommandLine& program);
void add_export(CommandLine& program);
void add_load(CommandLine& program);
void add_modes(CommandLine& program);
void add_report(CommandLine& program);
void add_scan(CommandLine& program);
void add_compare(CommandLine& program);

/// What `export` writes by a file's ending alone.
std::vector<window::ExportFormat> usual_exports();

/// All of them, in the order of the help.
void add_commands(CommandLine& program);

/// All commands as data.
std::vector<CommandEntry> command_table();

}  // namespace gridshell::app
