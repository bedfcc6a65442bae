#include "engine/record/study_tables.h"

#include <algorithm>
#include <cmath>

#include "engine/formats/csv.h"

namespace gridshell::record {

bool silently_wrong(RunOutcome outcome) {
  return outcome == RunOutcome::planar_saddle || outcome == RunOutcome::other_state ||
         outcome == RunOutcome::silent_wrong;
}

std::string accuracy_csv(const std::vector<AccuracyRow>& rows) {
  CsvWriter csv;
  csv.line("method", "edges_per_segment", "dof", "error", "cpu_s", "cpu_min_s", "cpu_max_s",
           "outcome");
  for (const AccuracyRow& row : rows)
    csv.line(row.method, row.edges_per_segment, row.dof, row.error, row.cpu_s, row.cpu_min_s,
             row.cpu_max_s, word_of(row.outcome));
  return std::move(csv).text();
}

std::string scaling_csv(const std::vector<ScalingRow>& rows) {
  CsvWriter csv;
  csv.line("method", "rods", "edges_per_segment", "dof", "cpu_s", "cpu_min_s", "cpu_max_s",
           "outcome");
  for (const ScalingRow& row : rows)
    csv.line(row.method, row.rods, row.edges_per_segment, row.dof, row.cpu_s, row.cpu_min_s,
             row.cpu_max_s, word_of(row.outcome));
  return std::move(csv).text();
}

std::string stability_csv(const std::vector<StabilityRow>& rows) {
  CsvWriter csv;
  csv.line("map", "method", "x_name", "x", "y_name", "y", "outcome");
  for (const StabilityRow& row : rows)
    csv.line(row.map, row.method, row.x_name, row.x, row.y_name, row.y, word_of(row.outcome));
  return std::move(csv).text();
}

double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k) {
    if (!(x[k] > 0) || !(y[k] > 0)) continue;
    const double a = std::log(x[k]), b = std::log(y[k]);
    n += 1, sx += a, sy += b, sxx += a * a, sxy += a * b;
  }
  const double spread = n * sxx - sx * sx;
  return n > 1 && spread > 0 ? (n * sxy - sx * sy) / spread : unknown;
}

std::vector<std::size_t> pareto_front(const std::vector<AccuracyRow>& rows) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (rows[k].outcome == RunOutcome::right && rows[k].cpu_s > 0 && rows[k].error > 0)
      order.push_back(k);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(rows[a].cpu_s, rows[a].error) < std::pair(rows[b].cpu_s, rows[b].error);
  });
  std::vector<std::size_t> front;
  for (std::size_t k : order)
    if (front.empty() || rows[k].error < 0.95 * rows[front.back()].error) front.push_back(k);
  return front;
}

bool silently_wrong(TrustClass found) {
  return found == TrustClass::estimate_small || found == TrustClass::other_branch ||
         found == TrustClass::inner_unphysical || found == TrustClass::frame_dependent;
}

std::string trust_csv(const std::vector<TrustRow>& rows) {
  CsvWriter csv;
  csv.line("scene", "kind", "class", "error", "estimate", "exit_default", "exit_fine",
           "snap_default", "snap_fine", "doubt");
  for (const TrustRow& row : rows)
    csv.line(row.scene, row.kind, std::string(word_of(row.found)), row.error, row.estimate,
             row.exit_default, row.exit_fine, int(row.snap_default), int(row.snap_fine),
             int(row.doubt));
  return std::move(csv).text();
}

std::string branches_csv(const std::vector<BranchPoint>& points) {
  CsvWriter csv;
  csv.line("branch", "progress", "boundary_radius_mm", "height_mm", "amplitude", "energy_mJ",
           "negative_pivots", "event");
  for (const BranchPoint& p : points)
    csv.line(p.branch, p.progress, p.boundary_radius_mm, p.height_mm, p.amplitude, p.energy_mJ,
             p.negative_pivots, std::string(word_of(p.event)));
  return std::move(csv).text();
}

}  // namespace gridshell::record
