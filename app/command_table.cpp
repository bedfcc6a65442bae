#include "app/command_table.h"

#include <CLI/CLI.hpp>

#include "app/commands/commands.h"

namespace gridshell::app {
namespace {

/// "TEXT:{auto,osmesa}" names the words of a choice.
std::vector<std::string> words_in(const std::string& type) {
  const auto begin = type.find('{'), end = type.find('}');
  if (begin == type.npos || end == type.npos || end < begin) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

CommandOption entry_of(const CLI::Option& option) {
  CommandOption entry;
  entry.argument = option.get_positional();
  entry.name = entry.argument ? option.get_name(true) : option.get_name();
  if (!entry.argument && !option.get_lnames().empty()) entry.name = "--" + option.get_lnames()[0];
  if (!option.get_snames().empty()) entry.short_name = "-" + option.get_snames()[0];
  entry.meaning = option.get_description();
  entry.words = words_in(option.get_type_name());
  entry.flag = option.get_items_expected_max() == 0;
  entry.required = option.get_required();
  entry.many = option.get_items_expected_max() > 1;
  return entry;
}

}  // namespace

std::vector<CommandEntry> command_table() {
  CLI::App program;
  Action action;
  add_commands(program, action);
  std::vector<CommandEntry> table;
  for (const CLI::App* command : program.get_subcommands({})) {
    CommandEntry entry{command->get_name(), command->get_description(), command->get_footer(), {}};
    for (const CLI::Option* option : command->get_options())
      entry.options.push_back(entry_of(*option));
    table.push_back(std::move(entry));
  }
  return table;
}

}  // namespace gridshell::app
