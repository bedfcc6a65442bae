#include "render/canvas/short_svg.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

namespace gridshell::render {
namespace {

/// A number rounded to a hundredth, without trailing zeros.
std::string short_number(const std::string& text) {
  std::string number = fmt::format("{:.2f}", std::strtod(text.c_str(), nullptr));
  number.erase(number.find_last_not_of('0') + 1);
  if (number.back() == '.') number.pop_back();
  return number == "-0" ? "0" : number;
}

/// A path's data with shorter numbers. Commands that SVG implies are left out: one that repeats the
/// command before it, L after M, and the last M after Z, which draws nothing.
std::string short_data(const std::string& data) {
  std::string text, pending;
  char command = 0;
  std::istringstream words(data);
  for (std::string word; words >> word;) {
    const bool letter = std::isalpha(static_cast<unsigned char>(word.front()));
    if (letter && word == "M") {
      pending = "M";
      command = 'M';
    } else if (letter) {
      const bool implied = word.front() == command || (word == "L" && command == 'M');
      if (!implied) text += word;
      command = word.front();
    } else if (!pending.empty() && pending.size() == 1) {
      pending += short_number(word) + " ";
    } else if (!pending.empty()) {
      text += pending + short_number(word);
      pending.clear();
    } else {
      if (!std::isalpha(static_cast<unsigned char>(text.back()))) text += ' ';
      text += short_number(word);
    }
  }
  // "Z M 1 2" at the end
  if (const auto close = text.rfind('Z'); close != text.npos)
    if (text.find_first_of("LCH", close) == text.npos &&
        text.find(' ', text.find(' ', close) + 1) == text.npos)
      text.erase(close + 1);
  return text;
}

std::string short_colour(const std::string& value) {
  if (!value.starts_with("rgb(")) return value;
  std::string hex = "#";
  const char* at = value.c_str() + 4;
  for (int k = 0; k < 3; ++k) {
    char* end = nullptr;
    hex += fmt::format("{:02x}", int(std::lround(2.55 * std::strtod(at, &end))));
    at = end;
    while (*at == '%' || *at == ',') ++at;
  }
  return hex;
}

std::string short_style(const std::string& style) {
  std::string text;
  std::istringstream properties(style);
  for (std::string one; std::getline(properties, one, ';');) {
    const auto name = one.find_first_not_of(' ');
    const auto colon = one.find(':');
    if (name == one.npos || colon == one.npos) continue;
    const std::string key = one.substr(name, colon - name), value = one.substr(colon + 1);
    const bool usual = (key.ends_with("-opacity") && value == "1") || key == "stroke-miterlimit" ||
                       (key == "stroke-linecap" && value == "butt") ||
                       (key == "fill-rule" && value == "nonzero");
    if (!usual) text += key + ":" + short_colour(value) + ";";
  }
  if (!text.empty()) text.pop_back();
  return text;
}

/// The text between `before` and the next quote; empty if the line does not contain `before`.
std::string quoted(const std::string& line, const std::string& before) {
  const auto from = line.find(before);
  if (from == line.npos) return "";
  const auto begin = from + before.size();
  return line.substr(begin, line.find('"', begin) - begin);
}

struct Path {
  std::string style, data, transform;

  std::string text() const {
    return "<path style=\"" + style + "\" d=\"" + data + "\"" +
           (transform.empty() ? "" : " transform=\"" + transform + "\"") + "/>\n";
  }
  /// Whether both paths can be one: both are only strokes or only fills of one opaque style, which
  /// look the same if they overlap in one path.
  bool takes(const Path& next) const {
    const bool one_ink =
        style.find("fill:none") != style.npos || style.find("stroke:none") != style.npos;
    return one_ink && style == next.style && transform == next.transform &&
           style.find("-opacity") == style.npos;
  }
};

}  // namespace

std::string short_svg(std::string_view svg) {
  std::string text;
  Path last;
  const auto flush = [&] {
    if (!last.data.empty()) text += last.text();
    last = {};
  };
  std::istringstream lines{std::string(svg)};
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("<path style=\"") || !line.ends_with("/>")) {
      flush();
      text += line + "\n";
      continue;
    }
    Path path{short_style(quoted(line, "style=\"")), short_data(quoted(line, " d=\"")),
              quoted(line, "transform=\"")};
    if (last.takes(path)) {
      last.data += path.data;
    } else {
      flush();
      last = std::move(path);
    }
  }
  flush();
  return text;
}

}  // namespace gridshell::render
