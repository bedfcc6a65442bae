// An enum and its words, side by side in one table that cannot fall out of step.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gridshell {

/// One enumerator and the word that stands for it in files and on the command line.
template <class Enum>
struct EnumWord {
  Enum value;
  std::string_view word;
};

/// Whether `value` is an enumerator: the compiler writes others as a cast number, "(Enum)7".
template <auto value>
consteval bool is_enumerator() {
  constexpr std::string_view text = __PRETTY_FUNCTION__;
  constexpr std::string_view name = text.substr(text.find("value = "));
  constexpr auto cast = name.rfind(')');
  return cast == name.npos ||
         !(name[cast + 1] == '-' || (name[cast + 1] >= '0' && name[cast + 1] <= '9'));
}

/// The table of an enum, for a function `words(Enum)` beside the enum itself:
///   enum class Seed { up, down };
///   constexpr auto words(Seed) {
///     return word_table<Seed>({{Seed::up, "up"}, {Seed::down, "down"}});
///   }
/// Enumerators count from 0. One that is forgotten, named twice or out of order does not compile;
/// nor does a word used twice.
template <class Enum, std::size_t size>
consteval std::array<EnumWord<Enum>, size> word_table(const EnumWord<Enum> (&table)[size]) {
  static_assert(!is_enumerator<Enum(size)>(), "an enumerator has no word");
  std::array<EnumWord<Enum>, size> words{};
  for (std::size_t k = 0; k < size; ++k) {
    if (std::size_t(table[k].value) != k) throw "enumerators stand in their order, each once";
    for (std::size_t j = 0; j < k; ++j)
      if (table[j].word == table[k].word) throw "two enumerators have the same word";
    words[k] = table[k];
  }
  return words;
}

/// The word of an enumerator.
template <class Enum>
constexpr std::string_view word_of(Enum value) {
  constexpr auto table = words(Enum{});
  return table[std::size_t(value)].word;
}

/// The enumerator that a word stands for, if any.
template <class Enum>
constexpr std::optional<Enum> find_word(std::string_view word) {
  for (const auto& entry : words(Enum{}))
    if (entry.word == word) return entry.value;
  return std::nullopt;
}

/// All words, in the order of the enumerators.
template <class Enum>
std::vector<std::string> all_words() {
  std::vector<std::string> all;
  for (const auto& entry : words(Enum{})) all.emplace_back(entry.word);
  return all;
}

/// The enumerator of another enum that has the same words in the same order, as where the renderer
/// keeps its own; that they are the same is checked when it compiles.
template <class To, class From>
constexpr To same_word(From value) {
  constexpr auto to = words(To{});
  constexpr auto from = words(From{});
  static_assert(to.size() == from.size(), "the two enums have different words");
  static_assert(
      [&] {
        for (std::size_t k = 0; k < to.size(); ++k)
          if (to[k].word != from[k].word) return false;
        return true;
      }(),
      "the two enums have different words");
  return To(value);
}

}  // namespace gridshell
