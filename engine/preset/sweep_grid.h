// The runs of a sweep: every case, every combination of values, every seed.
#pragma once

#include <string>
#include <vector>

#include "engine/preset/preset_builder.h"
#include "engine/preset/preset_file.h"

namespace gridshell::preset {

/// One run of a sweep.
struct SweepPoint {
  std::string case_name;            ///< empty where the preset has no cases
  std::vector<std::string> values;  ///< as TOML, one per axis
  int seed = 0;                     ///< imperfection.seed, if the sweep has several; else 0
  Preset preset;                    ///< the preset of this run
};

/// All runs of a sweep in order: cases change slowest, then the axes from first to last, seeds
/// fastest.
class SweepGrid {
 public:
  explicit SweepGrid(const Presets& presets);

  std::size_t size() const { return size_; }
  /// The run of index `point`. A search for states runs with jitter.seed + point, unless that key
  /// is swept.
  SweepPoint at(std::size_t point) const;
  const Sweep& sweep() const { return cases_.front().preset.sweep; }
  bool has_cases() const { return !cases_.front().name.empty(); }

 private:
  std::vector<Case> cases_;
  std::size_t size_ = 0;
};

/// Adds errors of a sweep: values that contradict other keys, swept keys that have no effect in any
/// run, and swept keys that a case or the command line sets, too.
void check_sweep(const std::vector<PresetBuilder>& runs, LocatedErrors& errors);

}  // namespace gridshell::preset
