#include "engine/record/branches.h"

#include "engine/record/csv.h"

namespace gridshell::record {

std::string branches_csv(const std::vector<BranchPoint>& points) {
  Csv csv;
  csv.line("branch", "progress", "boundary_radius_mm", "height_mm", "amplitude", "energy_mJ",
           "negative_pivots", "event");
  for (const BranchPoint& p : points)
    csv.line(p.branch, p.progress, p.boundary_radius_mm, p.height_mm, p.amplitude, p.energy_mJ,
             p.negative_pivots, std::string(word_of(p.event)));
  return std::move(csv).text();
}

}  // namespace gridshell::record
