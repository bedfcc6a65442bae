// The language in which the field table is written: a list of keys of one struct.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/preset/field_table.h"

namespace gridshell::preset {

/// The name of a member: "diameter_mm" of &Rod::diameter_mm.
template <auto member>
std::string member_name() {
  const std::string_view text = __PRETTY_FUNCTION__;
  const auto begin = text.rfind("::", text.find_first_of(";]", text.find("member = "))) + 2;
  return std::string(text.substr(begin, text.find_first_of(";])", begin) - begin));
}

template <class T>
Member member_at(T& member) {
  if constexpr (std::is_enum_v<T>)
    return OneWord{&member, [](const void* at) { return int(*static_cast<const T*>(at)); },
                   [](void* at, const int& place) { *static_cast<T*>(at) = T(place); }};
  else
    return &member;
}
template <class T>
requires std::is_enum_v<T> Member member_at(std::vector<T>& list) {
  return SomeWords{&list,
                   [](const void* at) {
                     std::vector<int> places;
                     for (const T one : *static_cast<const std::vector<T>*>(at))
                       places.push_back(int(one));
                     return places;
                   },
                   [](void* at, const std::vector<int>& places) {
                     auto& list = *static_cast<std::vector<T>*>(at);
                     list.clear();
                     for (const int place : places) list.push_back(T(place));
                   }};
}

template <class T>
std::vector<std::string> words_of_type(const T*) {
  if constexpr (std::is_enum_v<T>) return all_words<T>();
  return {};
}
template <class T>
std::vector<std::string> words_of_type(const std::vector<T>*) {
  return words_of_type(static_cast<const T*>(nullptr));
}

/// The keys of a struct. What is said after a key speaks of that key; what is said before the
/// first, of all. Conditions take the preset, the struct, or both.
template <class Struct>
class FieldList {
 public:
  /// `of` leads to the struct, in a list of tables to that of an item (below 0: the last).
  template <class Of>
  FieldList(std::vector<Field>& all, std::string table, Of of) : all_(all), table_(table) {
    of_ = [of](Preset& preset, int item) -> Struct& {
      if constexpr (std::is_invocable_v<Of, Preset&, int>)
        return of(preset, item);
      else
        return std::invoke(of, preset);
    };
  }

  /// A key with the name of its member and the unit that its name ends in.
  template <auto member>
  FieldList& add(Range range, std::string meaning) {
    using Value = std::remove_reference_t<decltype(std::declval<Struct&>().*member)>;
    const auto key = member_name<member>();
    if (first_key_.empty()) first_key_ = key;
    all_.push_back(
        {.table = table_,
         .key = key,
         .unit = unit_of(key),
         .meaning = std::move(meaning),
         .in = [of = of_](Preset& preset, int item) { return member_at(of(preset, item).*member); },
         .range = range,
         .words = words_of_type(static_cast<const Value*>(nullptr)),
         .rules = common_});
    return *this;
  }
  template <auto member>
  FieldList& add(std::string meaning) {
    return add<member>({}, std::move(meaning));
  }

  FieldList& named(std::string key) {
    if (first_key_ == all_.back().key) first_key_ = key;
    all_.back().key = std::move(key);
    return *this;
  }
  FieldList& unit(std::string unit) { return all_.back().unit = std::move(unit), *this; }
  /// Of a list of numbers: what it holds, or else it is empty.
  FieldList& shape(std::string shape) { return all_.back().shape = std::move(shape), *this; }
  FieldList& colour() { return all_.back().colour = true, *this; }
  FieldList& points(std::vector<std::string> coordinates,
                    std::vector<std::vector<std::string>> words = {}) {
    all_.back().coordinates = std::move(coordinates);
    all_.back().coordinate_words = std::move(words);
    return *this;
  }

  /// The rules from here on are held only by presets of which this is so.
  FieldList& where(std::function<bool(const Preset&)> holds) {
    return where_ = std::move(holds), *this;
  }
  /// `fault` says what is wrong, or is empty.
  template <class Say>
  FieldList& rule(RuleKind kind, std::vector<std::string> others, Say fault) {
    rules().push_back({kind, std::move(others),
                       [of = of_, where = where_, fault](const Preset& preset, int item) {
                         if (where && !where(preset)) return std::string();
                         // nothing is written through this
                         return std::string(
                             ask(fault, preset, of(const_cast<Preset&>(preset), item)));
                       }});
    return *this;
  }
  template <class Condition>
  FieldList& rule(RuleKind kind, std::vector<std::string> others, std::string what,
                  Condition condition) {
    return rule(kind, std::move(others), [=](const Preset& preset, const Struct& one) {
      return ask(condition, preset, one) ? what : "";
    });
  }
  template <class... Arguments>
  FieldList& unused(std::vector<std::string> others, Arguments... arguments) {
    return rule(RuleKind::unused, std::move(others), std::move(arguments)...);
  }
  template <class... Arguments>
  FieldList& refused(std::vector<std::string> others, Arguments... arguments) {
    return rule(RuleKind::refused, std::move(others), std::move(arguments)...);
  }
  template <class Condition>
  FieldList& needs_twist(std::string why, Condition condition) {
    return rule(RuleKind::needs_twist, {}, std::move(why), condition);
  }
  template <class Condition>
  FieldList& needs_equilibrium(std::string why, Condition condition) {
    return rule(RuleKind::needs_equilibrium, {}, std::move(why), condition);
  }

  /// The words of `kind`, the first key of the list, for which the key counts.
  template <class Kind>
  FieldList& used_by(Kind Struct::*kind, std::vector<std::type_identity_t<Kind>> users) {
    return only(
        first_key_, [kind](const Preset&, const Struct& one) { return one.*kind; }, users);
  }
  FieldList& used_by_footprint(std::vector<FootprintKind> users) {
    return only(
        "[footprint] kind",
        [](const Preset& preset, const Struct&) { return preset.footprint.kind; }, users);
  }

 private:
  std::vector<Rule>& rules() { return first_key_.empty() ? common_ : all_.back().rules; }

  template <class Asked>
  static auto ask(const Asked& asked, const Preset& preset, const Struct& one) {
    if constexpr (std::is_invocable_v<Asked, const Preset&, const Struct&>)
      return std::invoke(asked, preset, one);
    else if constexpr (std::is_invocable_v<Asked, const Struct&>)
      return std::invoke(asked, one);
    else
      return std::invoke(asked, preset);
  }

  template <class KindOf, class Kind>
  FieldList& only(const std::string& decider, KindOf kind_of, const std::vector<Kind>& users) {
    std::vector<std::string> names;
    for (const Kind user : users) names.emplace_back(word_of(user));
    const auto fault = [=, of = of_, where = where_, table = table_](const Preset& preset,
                                                                     int item) -> std::string {
      const Kind kind = kind_of(preset, of(const_cast<Preset&>(preset), item));
      if ((where && !where(preset)) || std::ranges::find(users, kind) != users.end()) return "";
      return fmt::format("{} = \"{}\" does not use it, only {}", full_label(table, decider, item),
                         word_of(kind), words_text(names));
    };
    rules().push_back({RuleKind::unused, {decider}, fault});
    return *this;
  }

  std::vector<Field>& all_;
  std::string table_, first_key_;
  std::function<Struct&(Preset&, int)> of_;
  std::function<bool(const Preset&)> where_;
  std::vector<Rule> common_;
};

/// What asks for a mass that a family of rods lacks.
template <class Struct>
void needs_mass(FieldList<Struct>& list, const char* what, bool (*asks)(const Struct&)) {
  for (const char* table : {"rod", "rod_v"})
    list.refused({fmt::format("[{}] density_kg_m3", table)},
                 fmt::format("{} needs a mass, [{}] density_kg_m3 must be above 0", what, table),
                 [=, v = std::string(table) == "rod_v"](const Preset& preset, const Struct& of) {
                   const bool lacks = v ? preset.rod_v.differs && preset.rod_v.density_kg_m3 == 0
                                        : preset.rod.density_kg_m3 == 0;
                   return asks(of) && lacks;
                 });
}

/// The keys of the tables, by what they are about.
void add_rod_fields(std::vector<Field>& all);         ///< [rod], [rod_v], [joints], [ends]
void add_shape_fields(std::vector<Field>& all);       ///< [footprint], [net], [[block]], …
void add_experiment_fields(std::vector<Field>& all);  ///< what is done to a shell, and how
void add_hand_fields(std::vector<Field>& all);        ///< [[step]], [loads]
void add_picture_fields(std::vector<Field>& all);     ///< [movie], [style], [figure], [page]

}  // namespace gridshell::preset
