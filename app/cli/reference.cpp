// Lists for other programs: commands, presets, tables and keys as JSON, and the completion for
// bash.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/cli/commands.h"
#include "app/cli/preset_library.h"
#include "engine/core/json.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"

namespace gridshell::app {
namespace {

template <class List, class Object>
Json array_of(const List& list, const Object& object) {
  Json all = Json::array();
  for (const auto& one : list) all.push_back(object(one));
  return all;
}

Json json_of(const CommandOption& option) {
  Json json{{"name", option.name}};
  if (!option.short_name.empty()) json["short"] = option.short_name;
  json["meaning"] = option.meaning;
  if (!option.words.empty()) json["words"] = option.words;
  json.update({{"argument", option.argument},
               {"flag", option.flag},
               {"required", option.required},
               {"many", option.many}});
  return json;
}

Json json_of(const CommandEntry& command) {
  return {{"name", command.name},
          {"meaning", command.meaning},
          {"options", array_of(command.options, [](const auto& one) { return json_of(one); })}};
}

/// The line of a `case` in bash with the options of a command, and with the names of presets if it
/// takes one: "    movie) options='--set ...' names=$presets ;;".
std::string case_of(const CommandEntry& command) {
  std::string options, names;
  for (const CommandOption& option : command.options)
    if (!option.argument)
      options += (options.empty() ? "" : " ") + option.name;
    else if (option.name == "PRESET" || option.meaning.find("preset") != std::string::npos)
      names = " names=$presets";
  return fmt::format("    {}) options='{}'{} ;;\n", command.name, options, names);
}

/// The lines of a `case` in bash for the options of a command that have a few values:
/// "    'render --context') words='auto ...' ;;".
std::string words_of(const CommandEntry& command) {
  std::string text;
  for (const CommandOption& option : command.options)
    if (!option.argument && !option.words.empty())
      text += fmt::format("    '{} {}') words='{}' ;;\n", command.name, option.name,
                          fmt::join(option.words, " "));
  return text;
}

}  // namespace

Result<std::string> listing_json() {
  Json json{{"version", version()}};
  json["commands"] = array_of(command_table(), [](const auto& one) { return json_of(one); });
  json["presets"] = Json::array();
  for (const EmbeddedPreset& embedded : embedded_presets()) {
    TRY(presets, load_preset(embedded.name, {}));
    const preset::Preset& base = presets->base;
    json["presets"].push_back({{"name", embedded.name},
                               {"title", base.title},
                               {"description", base.description},
                               {"source", base.source}});
  }
  json["tables"] = array_of(preset::tables(), [](const preset::Table& table) -> Json {
    return {{"name", table.name}, {"meaning", table.meaning}, {"list", table.list}};
  });
  json["keys"] = array_of(preset::key_texts(), [](const preset::KeyText& key) -> Json {
    return {{"table", key.table},   {"key", key.key},         {"unit", key.unit},
            {"default", key.value}, {"allowed", key.allowed}, {"meaning", key.meaning}};
  });
  return text_of(json);
}

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
