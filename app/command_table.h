// The commands of the program as data, read off what they declare: for whatever lists them.
#pragma once

#include <string>
#include <vector>

namespace gridshell::app {

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
