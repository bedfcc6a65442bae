// The work behind `movie`, `figure` and `run`: every run of a preset simulated, written and drawn.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/cli/pictures.h"
#include "engine/gridshell.h"

namespace gridshell::app {

/// Simulates a preset and draws it. The exit code; everything that is to be said has been said.
int produce(const Options& options, Pictures pictures);

/// How a run fell short of an equilibrium at the end of its path, stable unless that is allowed;
/// empty when it did not.
std::string failure_of(const record::Summary& summary, bool allow_unstable);

/// The text of the summary.json on top of several cases: the preset's name, and every case's
/// summary after its `name`, which is its folder.
std::string summary_of_cases(const std::string& preset, const std::vector<std::string>& names,
                             const std::vector<record::Summary>& summaries);

// `gridshell export`: a run's shape for other programs, its footprint for the workshop.

struct ExportOptions {
  std::string input;  ///< RUN; for what is not a shape PRESET too
  std::filesystem::path to;
  std::string what;       ///< empty: what the extension of `to` is for
  std::string frame;      ///< its index; empty: the last
  std::string case_name;  ///< of a run of several cases
  double seconds = 6;     ///< of an animation
  bool unsealed = false;
};

/// Writes the file, whole or not at all, and says so. The exit code.
int export_file(const ExportOptions& options);

/// "shape: .csv .dxf ...\n" a line for each thing that can be exported.
std::string exported_formats();

}  // namespace gridshell::app
