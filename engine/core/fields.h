// A list of the members of a record with their names, by which tables, JSON and files are written
// and read: fields(record, visit) calls visit(name, member) for each, in order.
//
//   struct Row {
//     int from = 0, to = 0;
//     GRIDSHELL_FIELDS(from, to)
//   };
#pragma once

#include <algorithm>
#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>

namespace gridshell {

/// `Record` or `const Record`.
template <class Type, class Record>
concept RecordOf = std::same_as<std::remove_const_t<Type>, Record>;

/// Calls visit(name, member) for every member; `names`: "row.from, row.to", of which the last parts
/// are passed.
template <class Visit, class... Members>
void visit_named(const Visit& visit, std::string_view names, Members&... members) {
  const auto next = [&] {
    std::string name(names.substr(0, names.find(',')));
    names.remove_prefix(std::min(names.size(), name.size() + 1));
    return name.substr(name.find_last_of(". ") + 1);
  };
  (visit(next().c_str(), members), ...);
}

/// Calls visit(name, member) for members, each by its own name: GRIDSHELL_VISIT(visit, row.from).
#define GRIDSHELL_VISIT(visit, ...) visit_named(visit, #__VA_ARGS__, __VA_ARGS__)

/// Lists the members of a record, inside it, if their names in files are their own.
#define GRIDSHELL_FIELDS(...)             \
  template <class Visit>                  \
  void fields(const Visit& visit) {       \
    GRIDSHELL_VISIT(visit, __VA_ARGS__);  \
  }                                       \
  template <class Visit>                  \
  void fields(const Visit& visit) const { \
    GRIDSHELL_VISIT(visit, __VA_ARGS__);  \
  }

namespace record {
/// fields(record, visit) of a record with GRIDSHELL_FIELDS; others have a function of their own.
template <class Record, class Visit>
requires requires(Record& record, const Visit& visit) { record.fields(visit); }
void fields(Record& record, const Visit& visit) { record.fields(visit); }
}  // namespace record

}  // namespace gridshell
