// The manual, as roff and as HTML: commands, presets, keys and the window, each from the table that
// the program itself uses.
#include "app/window/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

#include "app/cli/commands.h"
#include "app/cli/preset_library.h"
#include "app/window/actions.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"

namespace gridshell::window {
namespace {

using app::CommandEntry;
using app::CommandOption;
using app::EmbeddedPreset;

/// Text that roff prints without changes.
std::string plain(const std::string& text) {
  std::string safe;
  bool begins = true;
  for (const char c : text) {
    // a line that begins with . or ' would be a command of roff
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
  for (const EmbeddedPreset& embedded : app::embedded_presets()) {
    TRY(title, app::title_of(embedded));
    text += entry(bold(embedded.name), *title);
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

/// Actions, mouse and terms of the window.
std::string window_section() {
  std::string text = ".SH THE WINDOW\n.SS \"Actions\"\n";
  for (const Action& action : actions()) {
    const std::string key = name_of(action.key);
    text += entry(
        bold(action.label) + (key.empty() ? "" : " " + italic(key)),
        fmt::format("{} (menu {}; in a recording: do {})", action.help, action.menu, action.name));
  }
  text += ".SS \"Mouse\"\n";
  for (const MouseAction& action : mouse_actions()) text += entry(bold(action.how), action.help);
  text += ".SS \"Words\"\n";
  for (const auto& [term, meaning] : terms()) text += entry(bold(term), meaning);
  return text;
}

/// A line of roff as man_page() writes it, in HTML.
std::string html_of(const std::string& roff) {
  std::string html;
  const char* open = "";
  for (std::size_t k = 0; k < roff.size(); ++k) {
    const char c = roff[k], next = k + 1 < roff.size() ? roff[k + 1] : ' ';
    if (c == '\\' && next == 'f' && k + 2 < roff.size()) {
      html += *open ? fmt::format("</{}>", open) : "";
      open = roff[k + 2] == 'B' ? "b" : roff[k + 2] == 'I' ? "i" : "";
      html += *open ? fmt::format("<{}>", open) : "";
      k += 2;
    } else if (c == '\\') {
      html += next == 'e' ? "\\" : next == '-' ? "-" : "";
      ++k;
    } else {
      html += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    }
  }
  return html;
}

}  // namespace

Result<std::string> manual_html() {
  TRY(page, man_page());
  std::string html =
      "<!DOCTYPE html><meta charset=utf-8><title>gridshell</title><style>body{max-width:50em;"
      "margin:2em auto;padding:0 1em;font:16px/1.5 sans-serif}dt{margin-top:.6em}h3{margin-top:2em}"
      "</style><h1>gridshell</h1>\n";
  std::istringstream lines(*page);
  bool tag = false, as_is = false;
  for (std::string line; std::getline(lines, line);) {
    const bool begins = line.starts_with(".SH ") || line.starts_with(".SS ");
    std::string words = html_of(begins ? line.substr(4) : line);
    if (begins) std::erase(words, '"');
    if (begins)
      html += line[2] == 'H' ? fmt::format("<h2>{}</h2>\n", words)
                             : fmt::format("<h3>{}</h3>\n", words);
    else if (line == ".nf" || line == ".fi")
      html += (as_is = line == ".nf") ? "<pre>" : "</pre>\n";
    else if (as_is)
      html += words + "\n";
    else if (!line.starts_with('.'))
      html += tag ? fmt::format("<dt>{}</dt>\n", words) : fmt::format("<dd>{}</dd>\n", words);
    tag = line == ".TP";
  }
  return html;
}

Result<std::string> man_page() {
  TRY(presets, presets_section());
  std::string text = fmt::format(
      ".TH GRIDSHELL 1 \"\" \"gridshell {}\" \"User Commands\"\n.SH NAME\ngridshell \\- elastic "
      "gridshells: formed, measured and shown\n.SH SYNOPSIS\n{} {} [{}]\n.SH COMMANDS\n",
      version(), bold("gridshell"), italic("COMMAND"), italic("OPTIONS"));
  for (const CommandEntry& command : app::command_table()) text += section_of(command);
  text += *presets + window_section() + keys_section();
  text += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : {std::pair("0", "done"),
                                      {"1", "the run failed: no equilibrium, unstable, disk full"},
                                      {"2", "bad input or usage"},
                                      {"3", "compared and different; a scan that shows no state"},
                                      {"130", "interrupted"}})
    text += entry(bold(code), meaning);
  return text;
}

}  // namespace gridshell::window
