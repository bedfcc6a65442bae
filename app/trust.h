// The work behind `chart trust`: random scenes judged, their table, pictures and worst presets.
#pragma once

#include "app/charts.h"

namespace gridshell::app {

/// Judges scenes and writes trust.csv, trust.png, errors.png, summary.json and, in worst/, the
/// presets of those that were silently wrong. The exit code: 3 where there is one.
int chart_trust(const ChartOptions& options);

}  // namespace gridshell::app
