#include "app/cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/cli/console.h"
#include "engine/core/system_info.h"
#include "engine/core/text.h"

namespace gridshell::app {
namespace {

/// Empty when `word` is a command; a mistyped one deserves a better answer than "not expected".
std::string no_such_command(const CLI::App& program, const std::string& word) {
  std::vector<std::string> names;
  for (const auto* command : program.get_subcommands({})) names.push_back(command->get_name());
  if (std::ranges::find(names, word) != names.end()) return "";
  return "no command '" + word + "'" + did_you_mean(word, names) +
         " ('gridshell --help' lists them)";
}

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

Argument Argument::required(bool must) { return option_->required(must); }
Argument Argument::in_range(int least, int most) { return option_->check(CLI::Range(least, most)); }
Argument Argument::in_range(double least, double most) {
  return option_->check(CLI::Range(least, most));
}
Argument Argument::one_of(const std::vector<std::string>& words) {
  return option_->check(CLI::IsMember(words));
}
Argument Argument::not_empty(const std::string& message) {
  return option_->check(
      [message](const std::string& text) { return text.empty() ? message : std::string(); });
}
Argument Argument::each(std::function<void(const std::string&)> act) {
  return option_->each(std::move(act));
}
Argument Argument::excludes(Argument other) { return option_->excludes(other.option_); }
Argument Argument::show_default() { return option_->capture_default_str(); }
Argument Argument::one_each_time() {
  return option_->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

Argument CommandArguments::option(const std::string& names, std::string& value,
                                  const std::string& meaning) {
  return command_->add_option(names, value, meaning);
}
Argument CommandArguments::option(const std::string& names, std::filesystem::path& value,
                                  const std::string& meaning) {
  return command_->add_option(names, value, meaning);
}
Argument CommandArguments::option(const std::string& names, std::vector<std::string>& value,
                                  const std::string& meaning) {
  return command_->add_option(names, value, meaning);
}
Argument CommandArguments::option(const std::string& names, int& value,
                                  const std::string& meaning) {
  return command_->add_option(names, value, meaning);
}
Argument CommandArguments::option(const std::string& names, double& value,
                                  const std::string& meaning) {
  return command_->add_option(names, value, meaning);
}
Argument CommandArguments::flag(const std::string& names, bool& value, const std::string& meaning) {
  return command_->add_flag(names, value, meaning);
}
Argument CommandArguments::declared(const std::string& name) { return command_->get_option(name); }
void CommandArguments::footer(const std::string& text) { command_->footer(text); }

CommandLine::CommandLine()
    : program_(std::make_unique<CLI::App>("Elastic gridshells: formed, measured and shown.",
                                          "gridshell")) {
  program_->set_version_flag("--version", version());
  program_->require_subcommand(1);
}

CommandLine::~CommandLine() = default;

CommandArguments CommandLine::add(const std::string& name, const std::string& meaning, Action act) {
  CLI::App* command = program_->add_subcommand(name, meaning);
  command->callback([this, act = std::move(act)] { action_ = act; });
  return command;
}

int CommandLine::run(int argc, char** argv) {
  if (argc > 1 && argv[1][0] != '-')
    if (const auto fault = no_such_command(*program_, argv[1]); !fault.empty())
      return report({Fault::bad_input, fault});
  try {
    program_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // help and version come as errors too, with code 0
    return program_->exit(error) == 0 ? ExitCode::done : ExitCode::bad_input;
  }
  return report(action_());
}

std::vector<CommandEntry> CommandLine::table() const {
  std::vector<CommandEntry> table;
  for (const CLI::App* command : program_->get_subcommands({})) {
    CommandEntry entry{command->get_name(), command->get_description(), command->get_footer(), {}};
    for (const CLI::Option* option : command->get_options())
      entry.options.push_back(entry_of(*option));
    table.push_back(std::move(entry));
  }
  return table;
}

}  // namespace gridshell::app
