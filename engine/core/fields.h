// A list of the members of a record with their names, by which tables, JSON and files are written
// and read.
//
//   template <RecordOf<Barrier> Row, class Visit>
//   void fields(Row& row, const Visit& visit) {
//     visit_each(visit, "from", row.from, "to", row.to, "energy_mJ", row.energy_mJ);
//   }
#pragma once

#include <concepts>
#include <type_traits>

namespace gridshell {

/// `Record` or `const Record`.
template <class Type, class Record>
concept RecordOf = std::same_as<std::remove_const_t<Type>, Record>;

/// Calls visit(name, member) for every pair of a name and a member, in order.
template <class Visit, class Name, class Member, class... Others>
void visit_each(const Visit& visit, const Name& name, Member& member, Others&... others) {
  visit(name, member);
  if constexpr (sizeof...(others) > 0) visit_each(visit, others...);
}

}  // namespace gridshell
