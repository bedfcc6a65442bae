// Makers of the field table's entries from pointers to members.
#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include "engine/preset/consistency.h"
#include "engine/preset/field_table.h"

namespace gridshell::preset {

/// A member as it is; of a list of tables the item last read.
template <class T>
T& last_of(T& member) {
  return member;
}
inline Block& last_of(std::vector<Block>& blocks) { return blocks.back(); }
inline Join& last_of(std::vector<Join>& joins) { return joins.back(); }
inline Step& last_of(std::vector<Step>& steps) { return steps.back(); }

/// The member at the end of a path: member_of<&Preset::rod, &Rod::diameter_mm>.
template <auto first, auto... rest>
auto& follow(auto& from) {
  auto& member = last_of(from.*first);
  if constexpr (sizeof...(rest) == 0)
    return member;
  else
    return follow<rest...>(member);
}
template <auto... path>
auto& member_of(Preset& preset) {
  return follow<path...>(preset);
}

template <auto... path>
Real real(Range range) {
  return {member_of<path...>, range};
}
template <auto... path>
Integer integer(Range range) {
  return {member_of<path...>, range};
}
template <auto... path>
Flag flag() {
  return {member_of<path...>};
}
template <auto... path>
Text text() {
  return {member_of<path...>};
}
template <auto... path>
ColourText colour() {
  return {member_of<path...>};
}
template <auto... path>
Word word() {
  using Enum = std::remove_reference_t<decltype(member_of<path...>(std::declval<Preset&>()))>;
  return {[](const Preset& preset) {
            return static_cast<int>(member_of<path...>(const_cast<Preset&>(preset)));
          },
          [](Preset& preset, int index) { member_of<path...>(preset) = static_cast<Enum>(index); },
          all_words<Enum>()};
}
template <auto... path>
IntegerPair pair(Range range) {
  return {member_of<path...>, range};
}
template <auto... path>
IntegerList integers(Range range) {
  return {member_of<path...>, range};
}
template <auto... path>
RealList list(Range range) {
  return {member_of<path...>, range};
}
template <auto... path>
OptionalInteger optional(Range range) {
  return {member_of<path...>, range};
}
template <auto... path>
TextList texts() {
  return {member_of<path...>};
}
template <auto... path>
AxisList axes() {
  return {member_of<path...>};
}
template <auto... path>
PointList points(std::vector<std::string> coordinates,
                 std::vector<std::vector<std::string>> words = {}) {
  return {member_of<path...>, std::move(coordinates), std::move(words)};
}
template <auto... path>
SurfaceText surface() {
  return {member_of<path...>};
}
template <auto... path>
NetworkText network() {
  return {member_of<path...>};
}
template <auto... path>
WordList word_list() {
  using List = std::remove_reference_t<decltype(member_of<path...>(std::declval<Preset&>()))>;
  using Enum = typename List::value_type;
  return {[](const Preset& preset) {
            std::vector<int> indices;
            for (const Enum one : member_of<path...>(const_cast<Preset&>(preset)))
              indices.push_back(static_cast<int>(one));
            return indices;
          },
          [](Preset& preset, const std::vector<int>& indices) {
            List& list = member_of<path...>(preset);
            list.clear();
            for (const int index : indices) list.push_back(static_cast<Enum>(index));
          },
          all_words<Enum>()};
}

// The keys that give shapes: boundaries, nets and building blocks.

/// Of [footprint] and [actuation]: boundaries that a user gives.
std::vector<Field> boundary_fields();

/// Of [net], [blocks], [[block]] and [[join]].
std::vector<Field> net_fields();

// The keys of the field table that say what rods, joints, ends and loads are.

std::vector<Field> rod_fields();      ///< [rod], [rod_v]
std::vector<Field> joint_fields();    ///< [joints], [ends]
std::vector<Field> load_fields();     ///< [loads], [dynamics]
std::vector<Field> inverse_fields();  ///< [inverse]

// The keys of the field table that say what a hand does to a shell, step by step.

std::vector<Field> step_fields();  ///< [[step]]

/// What of a preset's steps does not go together.
std::vector<Conflict> step_conflicts(const Preset& preset);

/// The deeds that a key of [[step]] is for; empty: all.
std::vector<StepKind> step_kinds_of_key(const std::string& key);

// The keys of the field table that say how the states of a shell are looked for.

std::vector<Field> jitter_fields();  ///< [jitter]

// Keys of how pictures look and are printed: [style], [page], and what [movie] and [figure] have
// beside size, camera and quality.

std::vector<Field> style_fields();

}  // namespace gridshell::preset
