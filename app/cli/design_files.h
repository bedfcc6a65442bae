// The files that say what a design came to.
#pragma once

#include <filesystem>

#include "engine/core/result.h"
#include "engine/gridshell.h"

namespace gridshell::app {

/// Whether the designed shell is also reached from the flat: how far its joints are from there
/// then.
struct FlatStartCheck {
  bool reached = false;
  double off_mm = 0;
  std::string why;  ///< it was not
};

/// design.json, design.csv, ends.csv, ends_rounded.csv, rods.csv where diameters were varied, and
/// preset.toml, which reads them.
/// Errors: io.
Result<void> write_design(const std::filesystem::path& folder, const preset::Preset& designed,
                          const DesignResult& found, const FlatStartCheck& from_flat);

/// A preset whose `[ends] table` and `[rod] table`, where it has them, stand in STEM_ends.csv and
/// STEM_rods.csv beside it. Errors: io.
Result<void> write_preset_with_tables(const preset::Preset& preset,
                                      const std::filesystem::path& file);

/// What a design came to, as a few lines for the terminal.
std::string design_text(const DesignResult& found, const FlatStartCheck& from_flat);

}  // namespace gridshell::app
