#include "app/window/input_event.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <type_traits>

namespace gridshell::window {
namespace {

template <class Enum>
std::string one_of() {
  std::string all;
  for (const std::string& word : all_words<Enum>()) all += (all.empty() ? "" : ", ") + word;
  return all;
}

/// Calls visit(member) for each member that a line of the event's kind has, in order.
template <class Event, class Visit>
void each_member(Event& event, const Visit& visit) {
  switch (event.kind) {
    case InputKind::size:
      return visit(event.x), visit(event.y), visit(event.density);
    case InputKind::mouse:
      return visit(event.text), visit(event.x), visit(event.y);
    case InputKind::press:
    case InputKind::release:
      return visit(event.button);
    case InputKind::wheel:
      return visit(event.y);
    case InputKind::wait:
      return visit(event.x);
    case InputKind::down:
    case InputKind::up:
      return visit(event.key);
    case InputKind::type:
    case InputKind::act:
    case InputKind::open:
      return visit(event.text);
  }
}

/// Reads the members of an event from a line, one by one; `right` becomes false at an error.
struct Reader {
  std::istringstream words;
  bool right = true;

  template <class Enum>
  void operator()(Enum& value) {
    std::string word;
    words >> word;
    const auto found = find_word<Enum>(word);
    if (found) value = *found;
    right = right && found;
  }
  void operator()(double& value) { right = right && words >> value && std::isfinite(value); }
  std::string rest() {
    std::string rest;
    std::getline(words >> std::ws, rest);
    return rest;
  }
};

bool in_range(const InputEvent& event) {
  const auto within = [](double value, double low, double high) {
    return value >= low && value <= high;
  };
  if (event.kind == InputKind::size)
    return within(event.x, 320, 8192) && within(event.y, 240, 8192) &&
           within(event.density, 0.5, 4);
  return event.kind != InputKind::wait || within(event.x, 0, 60);
}

/// The expected form of a line, in the order of InputKind.
constexpr const char* forms[] = {
    "size WIDTH HEIGHT DENSITY, as 'size 1280 720 1'",
    "mouse X Y, or mouse @NAME X Y",
    "press or release left, right or middle",
    "press or release left, right or middle",
    "wheel STEPS",
    "down or up and the name of a key as 'F1', 'A', 'Ctrl'",
    "down or up and the name of a key as 'F1', 'A', 'Ctrl'",
    "type TEXT",
    "do ACTION",
    "open PRESET",
    "wait SECONDS, at most 60",
};
static_assert(std::size(forms) == words_of<InputKind>().size());

}  // namespace

std::string utf8_of(unsigned code) {
  if (code < 0x80) return {char(code)};
  // as many bytes as it needs: the first has that number of leading ones
  const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  constexpr unsigned first[] = {0, 0xc0, 0xe0, 0xf0};
  std::string letter(1, char(first[more] | code >> (6 * more)));
  for (int k = more - 1; k >= 0; --k) letter += char(0x80 | (code >> (6 * k) & 0x3f));
  return letter;
}

Result<InputEvent> read_event(const std::string& line) {
  Reader reader{std::istringstream(line)};
  InputEvent event;
  reader(event.kind);
  if (!reader.right)
    return invalid("'{}': a line begins with one of {}", line, one_of<InputKind>());
  each_member(event, [&](auto& member) {
    if constexpr (!std::is_same_v<decltype(member), std::string&>) {
      reader(member);
    } else if (event.kind != InputKind::mouse) {
      reader.right = !(member = reader.rest()).empty();
      // a space is written as "Space", since spaces at the end of a line are removed
      if (event.kind == InputKind::type && member == "Space") member = " ";
    } else if ((reader.words >> std::ws).peek() == '@') {
      reader.words.get();
      reader.words >> member;
    }
  });
  if (!reader.right || !in_range(event) || !reader.rest().empty())
    return invalid("'{}': expected {}", line, forms[std::size_t(event.kind)]);
  return event;
}

std::string write_event(const InputEvent& event) {
  std::string line{word_of(event.kind)};
  each_member(event, [&](const auto& member) {
    using Member = std::decay_t<decltype(member)>;
    if constexpr (std::is_same_v<Member, double>)
      line += fmt::format(" {:g}", member);
    else if constexpr (std::is_enum_v<Member>)
      line.append(" ").append(word_of(member));
    else if (event.kind == InputKind::type && member == " ")
      line += " Space";
    else if (!member.empty())
      line.append(event.kind == InputKind::mouse ? " @" : " ").append(member);
  });
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
    line.erase(0, begin);
    // removes a comment; the text of `type` and `open` may contain " #"
    if (!line.starts_with("type") && !line.starts_with("open"))
      line.erase(std::min(line.find(" #"), line.size()));
    line.erase(line.find_last_not_of(" \t\r") + 1);
    auto event = read_event(line);
    if (!event) return invalid("{}:{}: {}", source, number, event.error().message);
    events.push_back(std::move(*event));
  }
  return events;
}

}  // namespace gridshell::window
