// The names of an enum's enumerators in files: their identifiers, with exceptions.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gridshell {

/// One enumerator and its name in files and on the command line.
template <class Enum>
struct EnumWord {
  Enum value;
  std::string_view word;
};

/// An enumerator as the compiler writes it, "gridshell::Seed::up"; a value that is no enumerator is
/// written as a cast, "(gridshell::Seed)7".
template <auto value>
consteval std::string_view enumerator_text() {
  std::string_view text = __PRETTY_FUNCTION__;
  text.remove_prefix(text.find("value = ") + 8);
  return text.substr(0, text.find_first_of(";]"));
}

/// Whether `value` is an enumerator.
template <auto value>
consteval bool is_enumerator() {
  constexpr auto text = enumerator_text<value>();
  constexpr auto cast = text.rfind(')');
  return cast == text.npos ||
         !(text[cast + 1] == '-' || (text[cast + 1] >= '0' && text[cast + 1] <= '9'));
}

/// All enumerators, counted from 0, with their identifiers as names. These names are used in files
/// and on command lines: another name is another format.
template <class Enum, std::size_t size = 0>
consteval auto enumerator_names() {
  if constexpr (is_enumerator<Enum(size)>()) {
    return enumerator_names<Enum, size + 1>();
  } else {
    return []<std::size_t... k>(std::index_sequence<k...>) {
      const auto name = [](std::string_view text) { return text.substr(text.rfind(':') + 1); };
      return std::array<EnumWord<Enum>, size>{{{Enum(k), name(enumerator_text<Enum(k)>())}...}};
    }
    (std::make_index_sequence<size>());
  }
}

/// All enumerators, some with other names, for a function `words(Enum)` next to the enum, which an
/// enum without exceptions does not need:
///   enum class Choice { automatic, none };
///   constexpr auto words(Choice) { return names_except<Choice>({{Choice::automatic, "auto"}}); }
/// A duplicate name does not compile.
template <class Enum, std::size_t size>
consteval auto names_except(const EnumWord<Enum> (&exceptions)[size]) {
  auto words = enumerator_names<Enum>();
  for (const auto& one : exceptions) words[std::size_t(one.value)].word = one.word;
  for (std::size_t k = 0; k < words.size(); ++k)
    for (std::size_t j = 0; j < k; ++j)
      if (words[j].word == words[k].word) throw "two enumerators have the same word";
  return words;
}

/// Every enumerator with its word, in their order.
template <class Enum>
constexpr auto words_of() {
  if constexpr (requires { words(Enum{}); })
    return words(Enum{});
  else
    return enumerator_names<Enum>();
}

/// The word of an enumerator.
template <class Enum>
constexpr std::string_view word_of(Enum value) {
  constexpr auto table = words_of<Enum>();
  return table[std::size_t(value)].word;
}

/// The enumerator of a name, if any.
template <class Enum>
constexpr std::optional<Enum> find_word(std::string_view word) {
  for (const auto& entry : words_of<Enum>())
    if (entry.word == word) return entry.value;
  return std::nullopt;
}

/// All words, in the order of the enumerators.
template <class Enum>
std::vector<std::string> all_words() {
  std::vector<std::string> all;
  for (const auto& entry : words_of<Enum>()) all.emplace_back(entry.word);
  return all;
}

}  // namespace gridshell
