// The work behind `chart`: studies of methods, their tables and pictures.
#pragma once

#include <string>

#include "app/options.h"

namespace gridshell::app {

/// What to chart and how much to spend on it.
struct ChartOptions {
  Options common;
  std::string kind;     ///< "accuracy" or "stability"
  double limit_s = 30;  ///< of one run of a method
  int edges = 32;       ///< a segment of the finest mesh that methods are given
};

/// Studies a preset, or each of its cases, and writes tables and pictures. The exit code.
int chart(const ChartOptions& options);

}  // namespace gridshell::app
