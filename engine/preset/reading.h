// Lays TOML over presets, and gathers what is wrong on the way.
#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <string>

#include "engine/preset/assign.h"
#include "engine/preset/draft.h"
#include "engine/preset/field.h"
#include "engine/preset/place.h"
#include "engine/preset/reader.h"

namespace gridshell::preset {

class Reading {
 public:
  /// `source` names the text in faults.
  Reading(std::string source, Beside beside)
      : source_(std::move(source)), beside_(std::move(beside)) {}

  /// The keys of a file, or of one of its cases, over a draft; `apart` is read by someone else.
  void lay(const toml::table& root, const std::string& apart, Draft& draft);
  /// One value of the command line over a draft.
  void lay_override(const Override& change, Draft& draft);

  const std::string& source() const { return source_; }
  Place place_of(const toml::source_region& region) const;
  PlacedFaults& faults() { return faults_; }

 private:
  void lay_items(const toml::key& key, const toml::node& value, bool in_file, Draft& draft);
  void lay_table(const toml::key& key, const toml::node& value, Draft& draft);
  void assign_key(const std::string& table, const toml::key& key, const toml::node& value,
                  Draft& draft, int item = -1);

  void lay_axes(const AxisList& list, const toml::table& over, Draft& draft);

  std::string source_;
  Beside beside_;              // the file
  std::string override_;       // while an override is laid: its option
  Layer layer_ = Layer::file;  // of what is laid of the file
  PlacedFaults faults_;
};

}  // namespace gridshell::preset
