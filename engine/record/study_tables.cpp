#include "engine/record/study_tables.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace gridshell::record {

bool silently_wrong(RunOutcome outcome) {
  return outcome == RunOutcome::planar_saddle || outcome == RunOutcome::other_state ||
         outcome == RunOutcome::silent_wrong;
}

double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k) {
    if (!(x[k] > 0) || !(y[k] > 0)) continue;
    const double a = std::log(x[k]), b = std::log(y[k]);
    n += 1, sx += a, sy += b, sxx += a * a, sxy += a * b;
  }
  const double spread = n * sxx - sx * sx;
  return n >= 4 && spread > 0 ? (n * sxy - sx * sy) / spread : unknown;
}

std::vector<std::size_t> pareto_front(const std::vector<AccuracyRow>& rows) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (rows[k].outcome == RunOutcome::right && rows[k].cpu_s > 0 && rows[k].error > 0)
      order.push_back(k);
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return std::pair(rows[a].cpu_s, rows[a].error) < std::pair(rows[b].cpu_s, rows[b].error);
  });
  std::vector<std::size_t> front;
  for (std::size_t k : order)
    if (front.empty() || rows[k].error < 0.95 * rows[front.back()].error) front.push_back(k);
  return front;
}

std::string loss_text(const LoadRow& row) {
  if (std::isfinite(row.critical_factor))
    return row.event == BranchEvent::turn ? "limit point" : "bifurcation";
  return row.event == BranchEvent::locking
             ? "the rods reach the strain limit before stability is lost"
             : "stability is not lost on the path followed";
}

std::string knock_down_text(const LoadRow& row) {
  if (row.imperfections == 0) return "";
  std::string text = fmt::format(
      "median of {} imperfect shells: {:.3g} of that factor (5 to 95 %: {:.3g} to {:.3g})",
      row.imperfections, row.knock_down_50, row.knock_down_5, row.knock_down_95);
  if (row.knock_down_95 > 1)
    text += "; a shell that stays stable counts with the factor at the end of its path";
  if (row.imperfections_failed > 0)
    text += fmt::format(", of which {} have no equilibrium", row.imperfections_failed);
  return text;
}

}  // namespace gridshell::record
