#include "app/window/input_event.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

namespace gridshell::window {
namespace {

template <class Enum>
std::string one_of() {
  std::string all;
  for (const std::string& word : all_words<Enum>()) all += (all.empty() ? "" : ", ") + word;
  return all;
}

template <class Enum>
bool read_word(std::istringstream& words, Enum& value) {
  std::string word;
  words >> word;
  const auto found = find_word<Enum>(word);
  if (found) value = *found;
  return found.has_value();
}

bool read_number(std::istringstream& words, double& value) {
  return bool(words >> value) && std::isfinite(value);
}

std::string rest_of(std::istringstream& words) {
  std::string rest;
  std::getline(words >> std::ws, rest);
  return rest;
}

/// Whether the rest of a line is what its kind asks for.
bool read_rest(std::istringstream& words, InputEvent& event) {
  switch (event.kind) {
    case InputKind::size:
      return read_number(words, event.x) && read_number(words, event.y) &&
             read_number(words, event.density) && event.x >= 320 && event.y >= 240 &&
             event.x <= 8192 && event.y <= 8192 && event.density >= 0.5 && event.density <= 4;
    case InputKind::mouse:
      if ((words >> std::ws).peek() == '@') words.get(), words >> event.text;
      return read_number(words, event.x) && read_number(words, event.y);
    case InputKind::press:
    case InputKind::release:
      return read_word(words, event.button);
    case InputKind::wheel:
      return read_number(words, event.y);
    case InputKind::wait:
      return read_number(words, event.x) && event.x >= 0 && event.x <= 60;
    case InputKind::down:
    case InputKind::up:
      return read_word(words, event.key);
    case InputKind::type:
    case InputKind::act:
    case InputKind::open:
      event.text = rest_of(words);
      return !event.text.empty();
  }
  return false;
}

const char* form_of(InputKind kind) {
  switch (kind) {
    case InputKind::size:
      return "size WIDTH HEIGHT DENSITY, as 'size 1280 720 1'";
    case InputKind::mouse:
      return "mouse X Y, or mouse @NAME X Y";
    case InputKind::press:
    case InputKind::release:
      return "press or release left, right or middle";
    case InputKind::wheel:
      return "wheel STEPS";
    case InputKind::down:
    case InputKind::up:
      return "down or up and the name of a key as 'F1', 'A', 'Ctrl'";
    case InputKind::type:
      return "type TEXT";
    case InputKind::act:
      return "do ACTION";
    case InputKind::open:
      return "open PRESET";
    case InputKind::wait:
      return "wait SECONDS, at most 60";
  }
  return "";
}

}  // namespace

Result<InputEvent> read_event(const std::string& line) {
  std::istringstream words(line);
  InputEvent event;
  if (!read_word(words, event.kind))
    return fail(Fault::bad_input,
                fmt::format("'{}': a line begins with one of {}", line, one_of<InputKind>()));
  if (!read_rest(words, event) || !rest_of(words).empty())
    return fail(Fault::bad_input, fmt::format("'{}': expected {}", line, form_of(event.kind)));
  return event;
}

std::string write_event(const InputEvent& event) {
  std::string line{word_of(event.kind)};
  switch (event.kind) {
    case InputKind::size:
      return line + fmt::format(" {:g} {:g} {:g}", event.x, event.y, event.density);
    case InputKind::mouse:
      if (!event.text.empty()) line += " @" + event.text;
      return line + fmt::format(" {:.6g} {:.6g}", event.x, event.y);
    case InputKind::press:
    case InputKind::release:
      return line.append(" ").append(word_of(event.button));
    case InputKind::wheel:
      return line + fmt::format(" {:g}", event.y);
    case InputKind::wait:
      return line + fmt::format(" {:g}", event.x);
    case InputKind::down:
    case InputKind::up:
      return line.append(" ").append(word_of(event.key));
    case InputKind::type:
    case InputKind::act:
    case InputKind::open:
      return line.append(" ").append(event.text);
  }
  return line;
}

Result<std::vector<InputEvent>> read_events(const std::string& text, const std::string& source) {
  std::vector<InputEvent> events;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    line.erase(line.find_last_not_of(" \t\r") + 1);
    auto event = read_event(line);
    if (!event)
      return fail(Fault::bad_input,
                  fmt::format("{}:{}: {}", source, number, event.error().message));
    events.push_back(std::move(*event));
  }
  return events;
}

}  // namespace gridshell::window
