#include "engine/session/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/memory.h"

namespace gridshell {
namespace {

// of all meshes of a run together; measured on shells of 24 to 150 rods and 100 000 to 1 500 000
// unknowns: 400 to 820 bytes on the bend rung, more for the larger ones, and 1200 on the twist
// rung
constexpr double bytes_an_unknown = 1000, bytes_a_twist_unknown = 2000;
// of one mesh of a large net: what it has more in its factor, a joint, for each time that there are
// twice as many joints as this; measured on 48, 96 and 192 rods a direction (41 MB, 240 MB, 1.2 GB)
constexpr double bytes_a_doubling = 6500, joints_of_a_small_net = 1800;

}  // namespace

double unknowns_of(const Footprint& footprint, preset::Rung rung, int edges_per_segment) {
  double segments = 0;
  for (const FootprintRod& rod : footprint.rods) segments += double(rod.joints.size()) + 1;
  const double edges = segments * edges_per_segment;
  if (rung == preset::Rung::net) return 0;
  // an edge brings a node, and joints, which two rods share, are counted twice
  const double nodes = edges - double(footprint.joints.size());
  return 3 * nodes + (rung == preset::Rung::twist ? edges : 0);
}

double memory_GB(const Footprint& footprint, preset::Rung rung, const LevelPlan& plan) {
  double unknowns = 0;
  for (const int edges : plan.edges_per_segment) unknowns += unknowns_of(footprint, rung, edges);
  const double joints = double(footprint.joints.size());
  const double doublings = std::max(0.0, std::log2(joints / joints_of_a_small_net));
  const double meshes = double(plan.edges_per_segment.size());
  return 1e-9 *
         (unknowns * (rung == preset::Rung::twist ? bytes_a_twist_unknown : bytes_an_unknown) +
          meshes * joints * doublings * bytes_a_doubling);
}

Result<void> fits_memory(const Scene& scene, const LevelPlan& plan) {
  const double asked = scene.memory_GB;
  const double given = asked > 0 ? asked : default_memory_GB();
  const double wanted = memory_GB(scene.footprint, scene.rung, plan);
  if (given == 0 || wanted <= given) return {};
  const int edges = plan.edges_per_segment.back();
  return fail(
      Fault::bad_input,
      fmt::format("{} edges a segment, {:.3g} unknowns, take about {:.2g} GB, more than the {:.2g} "
                  "GB of {}; {} needs less",
                  edges, unknowns_of(scene.footprint, scene.rung, edges), wanted, given,
                  asked > 0 ? "[accuracy] memory_GB"
                            : "half of the machine's memory ([accuracy] "
                              "memory_GB changes that)",
                  scene.edges_per_segment > 0 ? "a smaller [accuracy] edges_per_segment"
                                              : "a larger [accuracy] tolerance"));
}

}  // namespace gridshell
