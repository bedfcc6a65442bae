// `gridshell scan`: a cloud of points of a 3D scanner against the joints of runs.
#pragma once

#include <string>
#include <vector>

#include "app/options.h"

namespace gridshell::app {

struct ScanOptions {
  Options common;  ///< output, quiet, context, --set; `input` is the file of points
  std::vector<std::string> runs;
  bool unsealed = false;
};

/// Writes a folder: scan.json, scan.csv (a line a joint), measured.csv (the joints found, for
/// [figure] scan) and scan.png (red joints over the black shell). The exit code; a scan that shows
/// none of the states is `different`.
int produce_scan(const ScanOptions& options);

}  // namespace gridshell::app
