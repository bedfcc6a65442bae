// Makers of the field table's entries from pointers to members.
#pragma once

#include <type_traits>
#include <utility>

#include "engine/preset/field.h"

namespace gridshell::preset {

/// A member as it is; of a list of tables the item last read.
template <class T>
T& last_of(T& member) {
  return member;
}
inline Block& last_of(std::vector<Block>& blocks) { return blocks.back(); }
inline Join& last_of(std::vector<Join>& joins) { return joins.back(); }
inline Step& last_of(std::vector<Step>& steps) { return steps.back(); }

/// The member at the end of a path: reach<&Preset::rod, &Rod::diameter_mm>.
template <auto first, auto... rest>
auto& follow(auto& from) {
  auto& member = last_of(from.*first);
  if constexpr (sizeof...(rest) == 0)
    return member;
  else
    return follow<rest...>(member);
}
template <auto... path>
auto& reach(Preset& preset) {
  return follow<path...>(preset);
}

template <auto... path>
Real real(Range range) {
  return {reach<path...>, range};
}
template <auto... path>
Integer integer(Range range) {
  return {reach<path...>, range};
}
template <auto... path>
Flag flag() {
  return {reach<path...>};
}
template <auto... path>
Text text() {
  return {reach<path...>};
}
template <auto... path>
ColourText colour() {
  return {reach<path...>};
}
template <auto... path>
Word word() {
  using Enum = std::remove_reference_t<decltype(reach<path...>(std::declval<Preset&>()))>;
  return {[](const Preset& preset) {
            return static_cast<int>(reach<path...>(const_cast<Preset&>(preset)));
          },
          [](Preset& preset, int index) { reach<path...>(preset) = static_cast<Enum>(index); },
          all_words<Enum>()};
}
template <auto... path>
IntegerPair pair(Range range) {
  return {reach<path...>, range};
}
template <auto... path>
IntegerList integers(Range range) {
  return {reach<path...>, range};
}
template <auto... path>
RealList list(Range range) {
  return {reach<path...>, range};
}
template <auto... path>
OptionalInteger optional(Range range) {
  return {reach<path...>, range};
}
template <auto... path>
TextList texts() {
  return {reach<path...>};
}
template <auto... path>
AxisList axes() {
  return {reach<path...>};
}
template <auto... path>
PointList points(std::vector<std::string> coordinates,
                 std::vector<std::vector<std::string>> words = {}) {
  return {reach<path...>, std::move(coordinates), std::move(words)};
}
template <auto... path>
SurfaceText surface() {
  return {reach<path...>};
}
template <auto... path>
NetworkText network() {
  return {reach<path...>};
}
template <auto... path>
WordList word_list() {
  using List = std::remove_reference_t<decltype(reach<path...>(std::declval<Preset&>()))>;
  using Enum = typename List::value_type;
  return {[](const Preset& preset) {
            std::vector<int> indices;
            for (const Enum one : reach<path...>(const_cast<Preset&>(preset)))
              indices.push_back(static_cast<int>(one));
            return indices;
          },
          [](Preset& preset, const std::vector<int>& indices) {
            List& list = reach<path...>(preset);
            list.clear();
            for (const int index : indices) list.push_back(static_cast<Enum>(index));
          },
          all_words<Enum>()};
}

}  // namespace gridshell::preset
