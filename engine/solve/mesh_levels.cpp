#include "engine/solve/mesh_levels.h"

#include <algorithm>
#include <cmath>

#include "engine/core/try.h"
#include "engine/elastic/model.h"

namespace gridshell {
namespace {

Linearisation::ShellScale scale_of(const Footprint& footprint, const ShellRods& rods) {
  constexpr double spacing_mm = 20;
  const double paper_EA = circular_section(0.254, 83).EA;
  double EA = 0;
  for (const RodMaterial& material : rods.materials) EA = std::max(EA, material.EA);
  if (!(footprint.spacing > 0 && EA > 0)) return {};
  return {footprint.spacing / spacing_mm, EA / footprint.spacing / (paper_EA / spacing_mm)};
}

}  // namespace

MeshLevel::MeshLevel() : own_model(std::make_unique<Model>()), model(*own_model) {}
MeshLevel::~MeshLevel() = default;

Result<void> MeshLevel::build(const Footprint& footprint, const ShellRods& rods, RodModel rod_model,
                              const BoundaryMotion& boundary, int edges_per_segment) {
  const Footprint meshed = centred(footprint, rods.bolts.get());
  mesh = mesh_rods(meshed, edges_per_segment);
  TRY(built, build_model(mesh, rods, rod_model));
  model = std::move(*built);
  motion = pinned_motion(mesh, boundary);
  system = std::make_unique<Linearisation>(model);
  system->scale = scale_of(footprint, rods);
  const auto free_to_turn = turning_rods(meshed, rods, boundary, rod_model);
  if (!free_to_turn.empty()) system->bear_neutral_directions();
  turning = turning_nodes(free_to_turn, meshed, mesh);
  return {};
}

namespace {

constexpr int most_edges = 128;
constexpr std::size_t most_meshes = 3;
// factor on the expected error, so that a plan usually meets the tolerance
constexpr double plan_margin = 1.25;

}  // namespace

double expected_error(const LevelPlan& plan) {
  // estimates, which are above the errors, on circles, caps and hemispheres
  constexpr double plain_of_four = 6e-3, extrapolated_of_sixteen = 2.5e-5;
  const double edges = plan.edges_per_segment.back();
  return plan.extrapolate && plan.edges_per_segment.size() == most_meshes
             ? extrapolated_of_sixteen * std::pow(16 / edges, 4)
             : plain_of_four * std::pow(4 / edges, 2);
}

LevelPlan plan_levels(double tolerance, int base, double growth) {
  const auto meets = [&](const LevelPlan& plan) {
    return tolerance >= plan_margin * growth * expected_error(plan);
  };
  LevelPlan plan{{base, 2 * base}, true};
  if (meets(plan)) return plan;
  // two edges per segment are enough to measure what the others leave, but not on long rods, of
  // which a path has states of little stiffness
  plan = growth > 1 || base % 4 != 0 ? LevelPlan{{2 * base, 4 * base}, true}
                                     : LevelPlan{{base / 2, base, 2 * base}, true};
  if (meets(plan)) return plan;
  plan = {{base, 2 * base, 4 * base}, true};
  while (growth * expected_error(plan) > tolerance) {
    const auto next = finer(plan);
    if (!next) break;  // the tolerance is not met, as the estimate will show
    plan = *next;
  }
  return plan;
}

LevelPlan plan_of_mesh(int edges) {
  LevelPlan plan{{edges}, false};
  for (int k = edges; k % 2 == 0 && k / 2 >= 4 && plan.edges_per_segment.size() < most_meshes;
       k /= 2)
    plan.edges_per_segment.insert(plan.edges_per_segment.begin(), k / 2);
  return plan;
}

std::optional<LevelPlan> finer(const LevelPlan& plan) {
  LevelPlan next = plan;
  auto& edges = next.edges_per_segment;
  if (2 * edges.back() > most_edges) return std::nullopt;
  edges.push_back(2 * edges.back());
  if (edges.size() > most_meshes) edges.erase(edges.begin());
  next.extrapolate = true;
  return next;
}

}  // namespace gridshell
