// The field table: every key a preset may hold, once. The reader, `--set`, `--print-config`,
// `check` and the README's reference are made from it; defaults are those of a default-built
// Preset.
#pragma once

#include <vector>

#include "engine/preset/field.h"

namespace gridshell::preset {

/// A table of the file, in the order of the reference.
struct Table {
  std::string name;  ///< empty for the keys at the top
  std::string meaning;
  bool list = false;  ///< stands once an item: [[block]]
};

const std::vector<Table>& tables();

/// All keys, table by table in the order of tables().
const std::vector<Field>& field_table();

/// The key `key` of `table`, or null.
const Field* find_field(const std::string& table, const std::string& key);

}  // namespace gridshell::preset
