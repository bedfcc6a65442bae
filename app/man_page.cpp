#include "app/man_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/command_table.h"
#include "app/preset_library.h"
#include "engine/core/version.h"
#include "engine/preset/field_table.h"
#include "engine/preset/writer.h"

namespace gridshell::app {
namespace {

/// Text that roff prints as it stands.
std::string plain(const std::string& text) {
  std::string safe;
  bool begins = true;
  for (const char c : text) {
    // a line that begins with one of these would be a request
    if (begins && (c == '.' || c == '\'')) safe += "\\&";
    begins = c == '\n';
    if (c == '\\')
      safe += "\\e";
    else if (c == '-')
      safe += "\\-";
    else
      safe += c;
  }
  return safe;
}

/// A tagged paragraph.
std::string entry(const std::string& tag, const std::string& text) {
  return fmt::format(".TP\n{}\n{}\n", tag, plain(text));
}

std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

std::string tag_of(const CommandOption& option) {
  if (option.argument) return italic(option.name);
  std::string tag = bold(option.name);
  if (!option.short_name.empty()) tag = bold(option.short_name) + ", " + tag;
  if (option.flag) return tag;
  if (option.words.empty()) return tag + " " + italic("VALUE");
  return tag + " " + plain(fmt::format("{}", fmt::join(option.words, "|")));
}

std::string section_of(const CommandEntry& command) {
  std::string head = "gridshell " + command.name;
  for (const CommandOption& option : command.options)
    if (option.argument) head += " " + option.name + (option.many ? "..." : "");
  std::string text = fmt::format(".SS \"{}\"\n{}\n", plain(head), plain(command.meaning + "."));
  for (const CommandOption& option : command.options) text += entry(tag_of(option), option.meaning);
  if (!command.footer.empty()) text += ".PP\n.nf\n" + plain(command.footer) + "\n.fi\n";
  return text;
}

Result<std::string> presets_section() {
  std::string text = ".SH PRESETS\n";
  for (const EmbeddedPreset& embedded : embedded_presets()) {
    const auto presets = load_preset(embedded.name, {});
    if (!presets) return tl::unexpected(presets.error());
    const std::string& source = presets->base.source;
    text += entry(bold(embedded.name),
                  presets->base.title + (source.empty() ? "" : " (" + source + ")"));
  }
  return text;
}

std::string keys_section() {
  std::string text = ".SH KEYS OF A PRESET\n";
  const auto keys = preset::key_texts();
  for (const preset::Table& table : preset::tables()) {
    const std::string name = table.name.empty() ? "at the top of the file"
                             : table.list       ? "[[" + table.name + "]]"
                                                : "[" + table.name + "]";
    text += fmt::format(".SS \"{}\"\n{}\n", plain(name), plain(table.meaning));
    for (const preset::KeyText& key : keys)
      if (key.table == table.name)
        text += entry(
            bold(key.key) + plain(key.unit.empty() ? "" : " (" + key.unit + ")"),
            fmt::format("{}. Default: {}. Allowed: {}.", key.meaning, key.value, key.allowed));
  }
  return text;
}

}  // namespace

Result<std::string> man_page() {
  const auto presets = presets_section();
  if (!presets) return presets;
  std::string text = fmt::format(
      ".TH GRIDSHELL 1 \"\" \"gridshell {}\" \"User Commands\"\n.SH NAME\ngridshell \\- elastic "
      "gridshells: formed, measured and shown\n.SH SYNOPSIS\n{} {} [{}]\n.SH COMMANDS\n",
      version(), bold("gridshell"), italic("COMMAND"), italic("OPTIONS"));
  for (const CommandEntry& command : command_table()) text += section_of(command);
  text += *presets + keys_section();
  text += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : {std::pair("0", "done"),
                                      {"1", "the run failed: no equilibrium, unstable, disk full"},
                                      {"2", "bad input or usage"},
                                      {"3", "compared and different; a scan that shows no state"},
                                      {"130", "interrupted"}})
    text += entry(bold(code), meaning);
  return text;
}

}  // namespace gridshell::app
