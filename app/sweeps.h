// The work behind `sweep`: many runs of one preset, kept a line a point, gathered, drawn.
#pragma once

#include <string>

#include "app/options.h"

namespace gridshell::app {

struct SweepOptions {
  Options common;
  int jobs = 0;       ///< points computed at a time; 0: as many as there are cores
  std::string shard;  ///< "i/N": every N-th point from the i-th on, in DIR/shard_i_of_N; empty: all
  bool merge = false;  ///< gather the shards in DIR instead of computing
};

/// Computes what is not in the folder's log yet and, once all is there, writes sweep.csv,
/// preset.toml and the pictures. The exit code.
int sweep(const SweepOptions& options);

}  // namespace gridshell::app
