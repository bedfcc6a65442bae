// FieldList: declares the keys of a preset's table from the members of its struct, with ranges,
// meanings and rules. The files that declare keys (rod_fields.cpp and others) use it.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <initializer_list>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/preset/field_table.h"

namespace gridshell::preset {

/// The name of a member, from its pointer: "diameter_mm" for &Rod::diameter_mm.
template <auto member>
std::string member_name() {
  const std::string_view text = __PRETTY_FUNCTION__;
  const auto begin = text.rfind("::", text.find_first_of(";]", text.find("member = "))) + 2;
  return std::string(text.substr(begin, text.find_first_of(";])", begin) - begin));
}

/// The member as the variant that the field table uses.
template <class T>
Member member_at(T& member) {
  if constexpr (std::is_enum_v<T>)
    return OneWord{&member, [](const void* at) { return int(*static_cast<const T*>(at)); },
                   [](void* at, const int& location) { *static_cast<T*>(at) = T(location); }};
  else
    return &member;
}
template <class T>
requires std::is_enum_v<T> Member member_at(std::vector<T>& list) {
  return SomeWords{&list,
                   [](const void* at) {
                     std::vector<int> indices;
                     for (const T one : *static_cast<const std::vector<T>*>(at))
                       indices.push_back(int(one));
                     return indices;
                   },
                   [](void* at, const std::vector<int>& indices) {
                     auto& list = *static_cast<std::vector<T>*>(at);
                     list.clear();
                     for (const int location : indices) list.push_back(T(location));
                   }};
}

/// Names of an enum's values; empty for other types.
template <class T>
std::vector<std::string> words_of_type(const T*) {
  if constexpr (std::is_enum_v<T>) return all_words<T>();
  return {};
}
template <class T>
std::vector<std::string> words_of_type(const std::vector<T>*) {
  return words_of_type(static_cast<const T*>(nullptr));
}

/// The part of FieldList that does not depend on the struct, so that it is compiled once.
class AnyFieldList {
 protected:
  using StructOf = std::function<void*(Preset& preset, int item)>;
  using Fault = std::function<std::string(const Preset& preset, const void* one)>;
  using Condition = std::function<bool(const Preset& preset, const void* one)>;
  using WordOf = std::function<std::string_view(const Preset& preset, const void* one)>;
  using Keys = std::initializer_list<std::string_view>;

  AnyFieldList(std::vector<Field>& all, std::string table, StructOf of);

  void add(std::string key, std::string_view meaning, Range range, std::vector<std::string> words,
           Member (*member)(void* one));
  void rename(std::string key);
  void add_rule(RuleKind kind, Keys others, Fault fault);
  void add_rule(RuleKind kind, Keys others, std::string_view what, Condition condition);
  /// The key is unused unless the value of the key `decider` is one of `users`.
  void use_only(std::string_view decider, WordOf word, std::vector<std::string> users);

  std::vector<Field>& all_;
  std::string table_, first_key_;
  std::function<bool(const Preset&)> where_;

 private:
  void add_rule(Rule rule);

  StructOf of_;
  std::vector<Rule> common_;
};

/// Declares the keys of one struct, in order. A rule after a key applies to that key, a rule before
/// the first key to all keys of the list. The function of a rule takes (const Preset&), (const
/// Struct&), or both.
template <class Struct>
class FieldList : AnyFieldList {
 public:
  /// `of` returns the struct of a preset: of(preset), or for a list of tables of(preset, item),
  /// where an item below 0 is the last one.
  template <class Of>
  FieldList(std::vector<Field>& all, std::string table, Of of)
      : AnyFieldList(all, std::move(table), [of](Preset& preset, int item) -> void* {
          if constexpr (std::is_invocable_v<Of, Preset&, int>)
            return &of(preset, item);
          else
            return &std::invoke(of, preset);
        }) {}

  /// Adds a key named as its member; its unit is the ending of that name.
  template <auto member>
  FieldList& add(Range range, std::string_view meaning) {
    using Value = std::remove_reference_t<decltype(std::declval<Struct&>().*member)>;
    AnyFieldList::add(member_name<member>(), meaning, range,
                      words_of_type(static_cast<const Value*>(nullptr)),
                      [](void* one) { return member_at(static_cast<Struct*>(one)->*member); });
    return *this;
  }
  template <auto member>
  FieldList& add(std::string_view meaning) {
    return add<member>({}, meaning);
  }

  FieldList& named(std::string key) { return rename(std::move(key)), *this; }
  FieldList& unit(std::string_view unit) { return all_.back().unit = unit, *this; }
  FieldList& label(std::string_view label) { return all_.back().label = label, *this; }
  /// Names the entries of a list of numbers, such as "[i, j]": the list is empty or has that many.
  FieldList& shape(std::string_view shape) { return all_.back().shape = shape, *this; }
  FieldList& colour() { return all_.back().colour = true, *this; }
  FieldList& points(const std::vector<std::string>& coordinates,
                    const std::vector<std::vector<std::string>>& words = {}) {
    all_.back().coordinates = coordinates;
    all_.back().coordinate_words = words;
    return *this;
  }

  /// Restricts all following rules to presets for which the condition is true.
  FieldList& where(const std::function<bool(const Preset&)>& applies) {
    return where_ = applies, *this;
  }
  /// Adds a rule whose function returns the error, or an empty text if there is none.
  template <class Say>
  FieldList& rule(RuleKind kind, Keys others, Say fault) {
    add_rule(kind, others, [fault](const Preset& preset, const void* one) {
      return std::string(ask(fault, preset, one));
    });
    return *this;
  }
  template <class Predicate>
  FieldList& rule(RuleKind kind, Keys others, std::string_view what, Predicate applies) {
    add_rule(kind, others, what, [applies](const Preset& preset, const void* one) {
      return ask(applies, preset, one);
    });
    return *this;
  }
  template <class... Arguments>
  FieldList& unused(Keys others, Arguments... arguments) {
    return rule(RuleKind::unused, others, std::move(arguments)...);
  }
  template <class... Arguments>
  FieldList& refused(Keys others, Arguments... arguments) {
    return rule(RuleKind::refused, others, std::move(arguments)...);
  }
  template <class Predicate>
  FieldList& needs_twist(std::string_view why, Predicate applies) {
    return rule(RuleKind::needs_twist, {}, why, applies);
  }
  template <class Predicate>
  FieldList& needs_equilibrium(std::string_view why, Predicate applies) {
    return rule(RuleKind::needs_equilibrium, {}, why, applies);
  }

  /// Makes the last key unused unless `kind`, the first key of the list, has one of these values.
  template <class Kind>
  FieldList& used_by(Kind Struct::*kind, std::vector<std::type_identity_t<Kind>> users) {
    use_only(
        first_key_,
        [kind](const Preset&, const void* one) {
          return word_of(static_cast<const Struct*>(one)->*kind);
        },
        words_for(users));
    return *this;
  }
  FieldList& used_by_footprint(std::vector<FootprintKind> users) {
    use_only(
        "[footprint] kind",
        [](const Preset& preset, const void*) { return word_of(preset.footprint.kind); },
        words_for(users));
    return *this;
  }

 private:
  template <class Function>
  static auto ask(const Function& function, const Preset& preset, const void* at) {
    const auto& one = *static_cast<const Struct*>(at);
    if constexpr (std::is_invocable_v<Function, const Preset&, const Struct&>)
      return std::invoke(function, preset, one);
    else if constexpr (std::is_invocable_v<Function, const Struct&>)
      return std::invoke(function, one);
    else
      return std::invoke(function, preset);
  }

  template <class Kind>
  static std::vector<std::string> words_for(const std::vector<Kind>& kinds) {
    std::vector<std::string> words;
    for (const Kind kind : kinds) words.emplace_back(word_of(kind));
    return words;
  }
};

/// Refuses a struct for which `asks` is true if the rods have no mass: "gravity needs a mass".
template <class Struct>
void needs_mass(FieldList<Struct>& list, const char* what, bool (*asks)(const Struct&)) {
  for (const char* table : {"rod", "rod_v"})
    list.refused({fmt::format("[{}] density_kg_m3", table)},
                 fmt::format("{} needs a mass, expected [{}] density_kg_m3 above 0", what, table),
                 [=, v = std::string(table) == "rod_v"](const Preset& preset, const Struct& of) {
                   const bool lacks = v ? preset.rod_v.differs && !preset.rod_v.has_mass()
                                        : !preset.rod.has_mass();
                   return asks(of) && lacks;
                 });
}

// Each function adds the keys of some tables.
void add_rod_fields(std::vector<Field>& all);    ///< [rod], [rod_v], [joints], [ends]
void add_shape_fields(std::vector<Field>& all);  ///< [footprint], [actuation]
void add_net_fields(std::vector<Field>& all);    ///< [net], [blocks], [[block]], [[join]]
/// [imperfection] to [sweep], [[step]], [loads].
void add_experiment_fields(std::vector<Field>& all);
void add_hand_fields(std::vector<Field>& all);     ///< [[step]], [loads]
void add_picture_fields(std::vector<Field>& all);  ///< [movie], [style], [figure], [page]

}  // namespace gridshell::preset
