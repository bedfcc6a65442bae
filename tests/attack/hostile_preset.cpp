#include "tests/attack/hostile_preset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "engine/core/file_io.h"
#include "engine/preset/field_table.h"
#include "engine/preset/preset.h"

namespace fs = std::filesystem;
using gridshell::preset::Field;

namespace {

using Lines = std::vector<std::string>;

const std::vector<std::string>& shipped() {
  static const auto texts = [] {
    std::vector<std::string> names, all;
    for (const auto& entry : fs::directory_iterator(fs::path(GRIDSHELL_SOURCE_DIR) / "presets"))
      if (entry.path().extension() == ".toml") names.push_back(entry.path());
    std::sort(names.begin(), names.end());
    for (const auto& name : names) all.push_back(gridshell::read_file(name).value());
    return all;
  }();
  return texts;
}

std::string repeated(const std::string& word, std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) text += word;
  return text;
}

// a value that is extreme, of a wrong type, malformed or very long
std::string hostile_value(Draw& draw) {
  static const auto values = listed(
      R"(0 | -0.0 | 1 | -1 | 2 | 3 | 7.5 | 1e-320 | 5e-324 | 1e-300 | 1e-160 | 1e-12 | 1e-5 | )"
      R"(0.499999 | 0.5 | 90 | 179.999 | 1e4 | 1e6 | 1e9 | 1e160 | 1e300 | 1e308 | -1e308 | )"
      R"(nan | -nan | inf | -inf | 2147483647 | 2147483648 | -2147483649 | 9223372036854775807 | )"
      R"(9223372036854775808 | 99999999999999999999999 | 0x7fffffff | 0b1010 | 1_000_000 | )"
      R"(true | false | 2024-01-01 | 12:30:00 | "" | "x" | "nan" | "fifo" | "/dev/zero" | )"
      R"("/dev/stdin" | "/etc/passwd" | "../../x" | "." | "\u0000" | "\u202e" | )"
      "\"\xf0\x9f\x90\x8d\" | "
      "'\xff\xfe' | "
      R"([] | {} | [[]] | [nan] | [1] | [1, 2] | [-1, 1e300] | [1, "x"] | [1, [2]] | )"
      R"([16384, 16384] | [1, 1] | [[0, 0]] | [[0, 0], [1, 0], [0, 1]] | )"
      R"([[0, 0], [0, 0], [0, 0], [0, 0]] | [[0, 0], [60, 60], [60, 0], [0, 60]] | )"
      R"([[1e300, 0], [-1e300, 1], [0, 1e300]] | )"
      R"([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1e9, 1, 1]] | [[nan, inf], [1, 2], [3, 4]] | )"
      R"({a = 1} | [{name = "a"}] | "twist" | "net" | "bend" | "curve" | "blocks" | "circle" | )"
      R"("clamped" | "spring" | "on_axis" | "cylinder" | "spool" | "beltrami" | "profile" | )"
      R"("translation" | "spline" | "polygon" | "highest" | "flat" | "held")");
  if (draw.one_in(30)) return fmt::format("\"{}\"", repeated("long ", 200000));
  if (draw.one_in(30)) return fmt::format("{}1{}", repeated("[", 3000), repeated("]", 3000));
  if (draw.one_in(30)) return fmt::format("[{}[0.0, 0.0]]", repeated("[1.0, 2.0], ", 50000));
  return draw.of(values);
}

// a value of the key's own type, anywhere in its range or at the edge of it
std::string fitting_value(const Field& field, Draw& draw) {
  gridshell::preset::Preset any = gridshell::preset::default_items();
  if (field.as_word(any)) return fmt::format("\"{}\"", draw.of(field.words));
  if (field.as<bool>(any)) return draw.one_in(2) ? "true" : "false";
  static const std::vector<double> sizes{1e-9, 1e-4, 0.01, 0.1, 0.5, 0.9, 1, 1.5, 3, 10, 40, 200};
  const double size = draw.of(sizes);
  if (field.as<int>(any)) return fmt::format("{}", int(size));
  return fmt::format("{:g}", size);
}

std::size_t some_line(const Lines& lines, Draw& draw) { return draw.below(lines.size()); }

void change_value(Lines& lines, Draw& draw) {
  for (int tries = 0; tries < 20; ++tries) {
    std::string& line = lines[some_line(lines, draw)];
    const auto equals = line.find('=');
    if (equals == line.npos || line.starts_with('#')) continue;
    line = fmt::format("{} {}", line.substr(0, equals + 1), hostile_value(draw));
    return;
  }
}

// multiplies the first number of a line by a factor from 0.01 to 10
void scale_value(Lines& lines, Draw& draw) {
  for (int tries = 0; tries < 20; ++tries) {
    std::string& line = lines[some_line(lines, draw)];
    const auto digit = line.find_first_of("0123456789", line.find('='));
    if (line.find('=') == line.npos || digit == line.npos || line.find('"') < digit) continue;
    char* end = nullptr;
    const double before = std::strtod(line.c_str() + digit, &end);
    const auto length = std::size_t(end - line.c_str()) - digit;
    static const std::vector<double> factors{0.01, 0.1, 0.5, 0.8, 0.95, 1.05, 1.3, 2, 4, 10};
    double value = before * draw.of(factors);
    const bool whole = line.substr(digit, length).find('.') == std::string::npos;
    line.replace(digit, length,
                 !(std::abs(value) < 1e9) ? fmt::format("{:g}", value)
                 : whole                  ? fmt::format("{}", int(value))
                                          : fmt::format("{:.6f}", value));
    return;
  }
}

// sets a key in its table, which is added if it is missing
void add_key(Lines& lines, Draw& draw) {
  const Field& field = draw.of(gridshell::preset::field_table());
  const auto value = draw.one_in(2) ? fitting_value(field, draw) : hostile_value(draw);
  const auto header = fmt::format("[{}]", field.table);
  const auto at = std::find(lines.begin(), lines.end(), header);
  const auto entry = fmt::format("{} = {}", field.key, value);
  if (field.table.empty()) {
    lines.insert(lines.begin(), entry);
  } else if (at != lines.end()) {
    // replaces the existing one
    auto end = std::find_if(at + 1, lines.end(), [](const auto& l) { return l.starts_with('['); });
    const auto old =
        std::find_if(at + 1, end, [&](const auto& l) { return l.starts_with(field.key + " "); });
    if (old != end)
      *old = entry;
    else
      lines.insert(at + 1, entry);
  } else {
    lines.emplace_back(header);
    lines.emplace_back(entry);
  }
}

void rearrange(Lines& lines, Draw& draw) {
  const auto a = some_line(lines, draw), b = some_line(lines, draw);
  draw.one_of({[&] { lines.erase(lines.begin() + std::ptrdiff_t(a)); },
               [&] { lines.insert(lines.begin() + std::ptrdiff_t(b), std::string(lines[a])); },
               [&] { std::swap(lines[a], lines[b]); },
               [&] { lines[a] = lines[a].substr(0, draw.below(lines[a].size() + 1)); }});
  if (lines.empty()) lines.emplace_back();
}

void add_tables(Lines& lines, Draw& draw) {
  const std::size_t many = draw.one_in(10) ? 3000 : 3;
  const auto add = [&](std::string text) { lines.push_back(std::move(text)); };
  draw.one_of(
      {[&] {
         for (std::size_t k = 0; k < many; ++k) add(fmt::format("[[case]]\nname = \"c{}\"", k));
       },
       [&] {
         for (std::size_t k = 0; k < many; ++k) add("[[block]]\nname = \"b\"");
       },
       [&] { add("[[case]]\nname = \"../x\"\n[[case]]\nname = \"..\"\n[[case]]\nname = \"\""); },
       [&] { add(fmt::format("[{}a]\nb = 1", repeated("a.", many))); },
       [&] { add("[footprint]\n[footprint]\n[[footprint]]"); },
       [&] {
         add(fmt::format("[[case]]\nname = \"a\"\n{}.x = {}",
                         draw.of(gridshell::preset::field_table()).table, hostile_value(draw)));
       }});
}

// damages the text, so that it may be neither TOML nor UTF-8
void damage(std::string& text, Draw& draw) {
  const auto put_in = [&](const std::string& what) {
    text.insert(draw.below(text.size() + 1), what);
  };
  draw.one_of({[&] {
                 for (std::size_t k = 1 + draw.below(20); k > 0 && !text.empty(); --k)
                   text[draw.below(text.size())] = draw.byte();
               },
               [&] { text.resize(draw.below(text.size() + 1)); },
               [&] { put_in(repeated(draw.one_in(2) ? "{" : "[", 20000)); },
               [&] { text = "\xef\xbb\xbf" + text; },
               [&] { put_in(std::string("\0\r\n\x1b[2J\"\"\"", 10)); }});
}

}  // namespace

std::string hostile_preset(Draw& draw) {
  Lines lines;
  std::istringstream text(draw.of(shipped()));
  for (std::string line; std::getline(text, line);) lines.emplace_back(line);
  for (std::size_t ways = 1 + draw.below(3); ways > 0; --ways) {
    const auto way = draw.below(18);
    const auto change = way < 2    ? change_value
                        : way < 6  ? add_key
                        : way == 6 ? rearrange
                        : way == 7 ? add_tables
                                   : scale_value;
    change(lines, draw);
  }
  std::string whole;
  for (const auto& line : lines) whole += line + "\n";
  if (draw.one_in(20)) damage(whole, draw);
  return whole;
}
