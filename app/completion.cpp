#include "app/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/command_table.h"
#include "app/preset_library.h"
#include "engine/preset/writer.h"

namespace gridshell::app {
namespace {

/// "    movie) options='--set ...' ;;"
std::string case_of(const CommandEntry& command) {
  std::vector<std::string> options;
  bool preset = false;
  for (const CommandOption& option : command.options) {
    if (option.argument)
      preset |= option.name == "PRESET" || option.meaning.find("preset") != std::string::npos;
    else
      options.push_back(option.name);
  }
  return fmt::format("    {}) options='{}'{} ;;\n", command.name, fmt::join(options, " "),
                     preset ? " names=$presets" : "");
}

/// "    'render --context') words='auto ...' ;;" of every option that is one of a few words.
std::string words_of(const CommandEntry& command) {
  std::string text;
  for (const CommandOption& option : command.options)
    if (!option.argument && !option.words.empty())
      text += fmt::format("    '{} {}') words='{}' ;;\n", command.name, option.name,
                          fmt::join(option.words, " "));
  return text;
}

}  // namespace

std::string bash_completion() {
  std::vector<std::string> presets, keys;
  for (const EmbeddedPreset& preset : embedded_presets()) presets.push_back(preset.name);
  for (const preset::KeyText& key : preset::key_texts())
    keys.push_back(key.table.empty() ? key.key + "=" : key.table + "." + key.key + "=");
  std::string commands, options, words;
  for (const CommandEntry& command : command_table()) {
    commands += (commands.empty() ? "" : " ") + command.name;
    options += case_of(command);
    words += words_of(command);
  }
  return fmt::format(
      R"(# Completion of gridshell for bash, made by 'gridshell list --completion bash'.
_gridshell() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}
  local command=${{COMP_WORDS[1]}} options= names= words=
  local presets='{0}'
  local keys='{1}'
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W '{2} --help --version' -- "$current"))
    return
  fi
  case $command in
{3}  esac
  case "$command $before" in
{4}  esac
  if [ -n "$words" ]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  elif [ "$before" = --set ]; then
    compopt -o nospace 2> /dev/null
    COMPREPLY=($(compgen -W "$keys" -- "$current"))
  elif [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
  elif [[ $before != --* && $before != -o ]]; then
    COMPREPLY=($(compgen -W "$names" -- "$current"))
  fi
}}
complete -o default -F _gridshell gridshell
)",
      fmt::join(presets, " "), fmt::join(keys, " "), commands, options, words);
}

}  // namespace gridshell::app
