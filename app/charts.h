// The work behind `chart`: studies of methods, their tables and pictures.
#pragma once

#include <string>

#include "app/options.h"
#include "engine/record/json.h"

namespace gridshell::app {

/// What to chart and how much to spend on it.
struct ChartOptions {
  Options common;
  std::string kind;            ///< "accuracy", "stability", "branches" or "trust"
  double limit_s = 0;          ///< of one run; 0: as the study has it
  int edges = 32;              ///< a segment of the finest mesh that methods are given
  int scenes = 600, seed = 1;  ///< of a study of trust
};

/// Lines for the terminal once everything is written, and the summary of a study.
struct Findings {
  std::string text;
  record::Json summary = record::Json::object();
};

/// Studies a preset, or each of its cases, and writes tables and pictures. The exit code.
int chart(const ChartOptions& options);

}  // namespace gridshell::app
