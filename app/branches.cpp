#include "app/branches.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/atomic_file.h"
#include "engine/study/branches_study.h"
#include "render/figure/branches_chart.h"

namespace gridshell::app {
namespace {

using record::BranchEvent;
using record::BranchPoint;

std::string place_of(const BranchPoint& point, double original_radius_mm) {
  if (!std::isfinite(point.boundary_radius_mm))
    return fmt::format("progress {:.4f}", point.progress);
  return fmt::format("R_a = {:.4f} R_o", point.boundary_radius_mm / original_radius_mm);
}

/// "branch 1: 88 points, 80 of them stable; bifurcation at ...", a line a branch.
void tell(const study::BranchDiagram& diagram, Findings& findings) {
  const auto& points = diagram.points;
  const int last = points.empty() ? -1 : points.back().branch;
  for (int branch = 0; branch <= last; ++branch) {
    int count = 0, stable = 0;
    std::string events;
    for (const BranchPoint& point : points) {
      if (point.branch != branch) continue;
      ++count;
      stable += point.stable();
      if (point.event != BranchEvent::none)
        events += fmt::format("; {} at {}", word_of(point.event),
                              place_of(point, diagram.original_radius_mm));
    }
    findings.text += fmt::format("{}: {} points, {} of them stable{}\n",
                                 branch == 0 ? "the path" : fmt::format("branch {}", branch), count,
                                 stable, events);
  }
}

}  // namespace

Result<Findings> draw_branches(const preset::Preset& preset, const std::filesystem::path& folder,
                               Watch& watch) {
  const auto found = study::branches_study(preset, {}, watch);
  if (!found) return tl::unexpected(found.error());
  auto written =
      write_atomically(folder / "branches.csv", record::branches_csv(found->points)).and_then([&] {
        return render::write_branches(folder / "branches", found->points, preset.title);
      });
  if (!written) return tl::unexpected(written.error());
  Findings findings;
  findings.summary["edges_per_segment"] = found->edges_per_segment;
  findings.summary["branches"] = found->points.empty() ? 0 : found->points.back().branch + 1;
  findings.summary["symmetry_order"] = found->symmetry_order;
  findings.summary["all_followed"] = found->all_followed;
  findings.text = fmt::format(
      "on {} edges a segment; the amplitude is of what breaks {} of the "
      "symmetries of the square\n",
      found->edges_per_segment, found->symmetry_order);
  tell(*found, findings);
  if (!found->all_followed) findings.text += "there are more branches than were followed\n";
  return findings;
}

}  // namespace gridshell::app
