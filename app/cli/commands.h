// The commands of the program, a file each: add_x declares the arguments of `gridshell x`; when the
// command line names it, `action` becomes what is to be done and returns the exit code.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace CLI {
class App;
}

namespace gridshell::app {

using Action = std::function<Result<int>()>;

/// Adds `gridshell name`: where the command line names it, `action` becomes `act`.
CLI::App& add_command(CLI::App& program, Action& action, const std::string& name,
                      const std::string& meaning, Action act);

void add_render(CLI::App& program, Action& action);
void add_view(CLI::App& program, Action& action);
void add_chart(CLI::App& program, Action& action);
void add_sweep(CLI::App& program, Action& action);
void add_export(CLI::App& program, Action& action);
void add_scan(CLI::App& program, Action& action);
void add_compare(CLI::App& program, Action& action);

/// All of them, in the order of the help.
void add_commands(CLI::App& program, Action& action);

// The commands of the program as data, read off what they declare: for whatever lists them.

/// An argument or an option of a command.
struct CommandOption {
  std::string name;        ///< "--to"; of an argument "PRESET"
  std::string short_name;  ///< "-o", or empty
  std::string meaning;
  std::vector<std::string> words;  ///< that it can be; empty: anything
  bool argument = false;           ///< stands by its place
  bool flag = false;               ///< takes no value
  bool required = false;
  bool many = false;  ///< any number of times
};

struct CommandEntry {
  std::string name, meaning;
  std::string footer;  ///< what its help ends with
  std::vector<CommandOption> options;
};

/// All commands, in the order of the help.
std::vector<CommandEntry> command_table();

}  // namespace gridshell::app
