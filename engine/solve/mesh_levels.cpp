#include "engine/solve/mesh_levels.h"

#include <cmath>

#include "engine/core/try.h"
#include "engine/elastic/model.h"
#include "engine/solve/buckling.h"

namespace gridshell {

MeshLevel::MeshLevel() : own_model(std::make_unique<Model>()), model(*own_model) {}
MeshLevel::~MeshLevel() = default;

Result<void> MeshLevel::build(const Footprint& footprint, const ShellRods& rods, RodModel rung,
                              const BoundaryMotion& boundary, int edges_per_segment) {
  mesh = mesh_rods(footprint, edges_per_segment);
  TRY(built, build_model(mesh, rods, rung));
  model = std::move(*built);
  motion = pinned_motion(mesh, boundary);
  system = std::make_unique<Linearisation>(model);
  if (rung == RodModel::bend && !turning_rods(footprint).empty()) system->bear_neutral_directions();
  return {};
}

namespace {

constexpr int most_edges = 128;
// on the safe side of what a plan leaves as a rule
constexpr double plan_margin = 1.25;

}  // namespace

double expected_error(const LevelPlan& plan) {
  // measured on circles, caps and hemispheres
  constexpr double plain_of_four = 3e-3, extrapolated_of_sixteen = 7.5e-6;
  const double edges = plan.edges_per_segment.back();
  return plan.extrapolate ? extrapolated_of_sixteen * std::pow(16 / edges, 4)
                          : plain_of_four * std::pow(4 / edges, 2);
}

LevelPlan plan_levels(double tolerance, int leader) {
  LevelPlan plan{{leader, 2 * leader}, false, true};
  if (tolerance >= plan_margin * expected_error(plan)) return plan;
  plan = {{leader, 2 * leader, 4 * leader}, true};
  while (expected_error(plan) > tolerance)
    plan.edges_per_segment.push_back(2 * plan.edges_per_segment.back());
  return plan;
}

LevelPlan plan_of_mesh(int edges) {
  LevelPlan plan{{edges}, false};
  for (int k = edges; k % 2 == 0 && k / 2 >= 4; k /= 2)
    plan.edges_per_segment.insert(plan.edges_per_segment.begin(), k / 2);
  return plan;
}

std::optional<LevelPlan> finer(const LevelPlan& plan) {
  LevelPlan next = plan;
  const int finest = 2 * plan.edges_per_segment.back();
  if (finest > most_edges) return std::nullopt;
  next.edges_per_segment.push_back(finest);
  next.extrapolate = next.edges_per_segment.size() > 2;
  next.extrapolate_forces = true;
  return next;
}

std::optional<LevelPlan> with_finer_leader(const LevelPlan& plan) {
  LevelPlan next = plan;
  auto& edges = next.edges_per_segment;
  if (2 * edges.back() <= most_edges) {
    for (int& one : edges) one *= 2;
    return next;
  }
  if (edges.size() <= (plan.extrapolate ? 3 : 2)) return std::nullopt;
  edges.erase(edges.begin());
  return next;
}

}  // namespace gridshell
