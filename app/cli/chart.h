// The work behind `chart`: studies of methods, their tables and pictures.
#pragma once

#include <string>

#include "app/cli/options.h"
#include "engine/core/json.h"
#include "engine/core/watch.h"

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
struct ChartReport {
  std::string text;
  Json summary = Json::object();
};

/// Studies a preset, or each of its cases, and writes tables and pictures. The exit code.
int chart(const ChartOptions& options);

// The work behind `chart branches`: a bifurcation diagram, its table and picture.

/// Writes branches.csv and branches.png, .svg, .pdf of a preset into `folder`; what to tell on the
/// terminal and in summary.json. Errors: those of the study, naming the reason, and io.
Result<ChartReport> draw_branches(const preset::Preset& preset, const std::filesystem::path& folder,
                                  Watch& watch);

// The work behind `chart trust`: random scenes judged, their table, pictures and worst presets.

/// Judges scenes and writes trust.csv, trust.png, errors.png, summary.json and, in worst/, the
/// presets of those that were silently wrong. The exit code: 3 where there is one.
int chart_trust(const ChartOptions& options);

}  // namespace gridshell::app
