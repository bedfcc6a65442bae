// `gridshell export`: a run's shape for other programs, its footprint for the workshop.
#pragma once

#include <filesystem>
#include <string>

#include "app/options.h"

namespace gridshell::app {

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
