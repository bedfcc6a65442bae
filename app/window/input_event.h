// Input of the user as plain data, from a window or from the lines of a recording.
#pragma once

#include <string>
#include <vector>

#include "engine/core/enum_words.h"
#include "engine/core/result.h"

namespace gridshell::window {

// clang-format off
enum class Key { a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
                 n0, n1, n2, n3, n4, n5, n6, n7, n8, n9,
                 f1, f4, f5, f9, f10, f11, space, enter, escape, tab, backspace, del, left, right, up, down,
                 home, end, page_up, page_down, comma, period, minus, plus, ctrl, shift, alt };
constexpr auto words(Key) {
  return names_except<Key>(
      {{Key::a, "A"}, {Key::b, "B"}, {Key::c, "C"}, {Key::d, "D"}, {Key::e, "E"}, {Key::f, "F"},
       {Key::g, "G"}, {Key::h, "H"}, {Key::i, "I"}, {Key::j, "J"}, {Key::k, "K"}, {Key::l, "L"},
       {Key::m, "M"}, {Key::n, "N"}, {Key::o, "O"}, {Key::p, "P"}, {Key::q, "Q"}, {Key::r, "R"},
       {Key::s, "S"}, {Key::t, "T"}, {Key::u, "U"}, {Key::v, "V"}, {Key::w, "W"}, {Key::x, "X"},
       {Key::y, "Y"}, {Key::z, "Z"},
       {Key::n0, "0"}, {Key::n1, "1"}, {Key::n2, "2"}, {Key::n3, "3"}, {Key::n4, "4"},
       {Key::n5, "5"}, {Key::n6, "6"}, {Key::n7, "7"}, {Key::n8, "8"}, {Key::n9, "9"},
       {Key::f1, "F1"}, {Key::f4, "F4"}, {Key::f5, "F5"}, {Key::f9, "F9"}, {Key::f10, "F10"},
       {Key::f11, "F11"},
       {Key::space, "Space"}, {Key::enter, "Enter"}, {Key::escape, "Esc"}, {Key::tab, "Tab"},
       {Key::backspace, "Backspace"}, {Key::del, "Del"}, {Key::left, "Left"},
       {Key::right, "Right"}, {Key::up, "Up"}, {Key::down, "Down"}, {Key::home, "Home"},
       {Key::end, "End"}, {Key::page_up, "PageUp"}, {Key::page_down, "PageDown"},
       {Key::comma, "Comma"}, {Key::period, "Period"}, {Key::minus, "Minus"}, {Key::plus, "Plus"},
       {Key::ctrl, "Ctrl"}, {Key::shift, "Shift"}, {Key::alt, "Alt"}});
}
// clang-format on
inline constexpr int key_count = int(words_of<Key>().size());

enum class Button { left, right, middle };

enum class InputKind { size, mouse, press, release, wheel, down, up, type, act, open, wait };
constexpr auto words(InputKind) { return names_except<InputKind>({{InputKind::act, "do"}}); }

/// One event, a line of a recording:
///   size WIDTH HEIGHT DENSITY     the window, pixels, and pixels per point of text
///   mouse X Y                     to this position, pixels from the top left of the window
///   mouse @NAME X Y               to a position in a control, as fractions of its size,
///                                 "mouse @R_a 0.5 0.5"; or to X, Y pixels from "@joint:I,J" or
///                                 "@edge:K"
///   press|release left|right|middle
///   wheel STEPS                   above 0: away from the user
///   down|up KEY                   a key, named as in the help sheet (F1)
///   type TEXT                     "Space" types one space
///   do ACTION                     by its name in the table of actions
///   open PRESET
///   wait SECONDS
struct InputEvent {
  InputKind kind = InputKind::wait;
  double x = 0, y = 0, density = 1;
  Button button = Button::left;
  Key key = Key::a;
  std::string text = {};  ///< what is typed; or the name of an action, a preset or a control
};

/// A letter in UTF-8; `code` is its Unicode number.
std::string utf8_of(unsigned code);

/// Reads a line without its end. Errors: bad_input with what was expected.
Result<InputEvent> read_event(const std::string& line);
/// The line of an event, without its end.
std::string write_event(const InputEvent& event);

/// Reads all lines of a recording except empty ones and comments (#). Errors: bad_input with the
/// number of the line.
Result<std::vector<InputEvent>> read_events(const std::string& text, const std::string& source);

}  // namespace gridshell::window
