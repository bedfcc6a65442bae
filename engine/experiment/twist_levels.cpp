#include "engine/experiment/twist_levels.h"

#include <algorithm>
#include <cmath>

#include "engine/experiment/frames.h"
#include "engine/measure/gauss.h"

namespace gridshell::experiment {
namespace {

// as on the bend rung, so that estimates stay on the safe side of the true error
constexpr double margin = 1.25, margin_extrapolated = 2.2;

PinnedMotion twist_motion(const ActuationScene& scene, const RodMesh& mesh,
                          const TwistModel& model) {
  PinnedMotion motion = pinned_motion(mesh, scene.motion);
  motion.begin = to_twist_nodes(mesh, model, motion.begin);
  motion.change = to_twist_nodes(mesh, model, motion.change);
  return motion;
}

}  // namespace

Result<TwistLevels> TwistLevels::make(const ActuationScene& scene, const LevelPlan& plan) {
  TwistLevels all(scene, plan);
  PathOptions options;
  options.spacing_mm = scene.footprint.spacing;
  options.tolerance_mm = std::clamp(1e-3 * scene.tolerance * scene.length_scale_mm, 1e-7, 1e-4);
  for (int edges : plan.edges_per_segment) {
    auto level = std::make_unique<Level>();
    level->mesh = mesh_rods(scene.footprint, edges);
    auto model = twist_model_of(level->mesh, scene.twist);
    if (!model) return tl::unexpected<Error>(model.error());
    level->model = std::move(*model);
    const PinnedMotion motion = twist_motion(scene, level->mesh, level->model);
    Eigen::Matrix3Xd flat = scene.flat.all(level->mesh.flat);
    flat.rightCols(level->mesh.ghosts) = motion.begin.rightCols(level->mesh.ghosts);
    level->flat = to_twist_nodes(level->mesh, level->model, flat);
    level->path = std::make_unique<TwistPath>(level->model, motion, options);
    if (!all.levels_.empty()) {
      level->from_coarser.emplace(all.levels_.back()->mesh, level->mesh);
      level->to_coarser.emplace(level->mesh, all.levels_.back()->mesh);
    }
    all.levels_.push_back(std::move(level));
  }
  return all;
}

Eigen::Matrix3Xd TwistLevels::nodes(std::size_t k) const {
  const Level& level = *levels_[k];
  return from_twist_nodes(level.mesh, level.model, level.path->state().x);
}

/// a finer mesh starts from the shape of the coarser one
bool TwistLevels::carry(std::size_t k, double t, const Watch& watch) {
  Level& level = *levels_[k];
  Eigen::Matrix3Xd x;
  level.from_coarser->nodes(nodes(k - 1), x);
  return level.path->start(t, level.flat, to_twist_nodes(level.mesh, level.model, x), watch) &&
         near(k);
}

/// a finer mesh moves the joints by less than a cell, or it went to another state
bool TwistLevels::near(std::size_t k) const {
  const int joints = levels_[k]->mesh.joints;
  return largest_column(nodes(k).leftCols(joints) - nodes(k - 1).leftCols(joints)) <
         0.5 * scene_.footprint.spacing;
}

bool TwistLevels::start(double t, const Eigen::Matrix3Xd& coarse, const Watch& watch) {
  Level& first = *levels_.front();
  if (!first.path->start(t, first.flat, to_twist_nodes(first.mesh, first.model, coarse), watch))
    return false;
  for (std::size_t k = 1; k < levels_.size(); ++k)
    if (!carry(k, t, watch)) return false;
  return true;
}

bool TwistLevels::advance(double t, const Watch& watch, bool& jumped) {
  jumped = false;
  TwistPath& first = *levels_.front()->path;
  TwistPathEnd end = first.advance(t, watch);
  for (int tries = 0; tries < 8 && end == TwistPathEnd::jumped; ++tries) {
    jumped = true;
    if (!first.resume(t, watch)) return false;
    end = first.advance(t, watch);
  }
  if (end != TwistPathEnd::reached) return false;
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    const bool followed =
        !jumped && levels_[k]->path->advance(t, watch) == TwistPathEnd::reached && near(k);
    if (watch.cancelled()) return false;
    if (!followed && !carry(k, t, watch)) return false;
  }
  return true;
}

void TwistLevels::allow_unstable(bool allow) {
  for (auto& level : levels_) level->path->allow_unstable(allow);
}

double TwistLevels::error_estimate_mm() const {
  const std::size_t last = levels_.size() - 1;
  if (last == 0) return record::unknown;
  const int joints = levels_[last]->mesh.joints;
  const auto joints_of = [&](std::size_t k) -> Eigen::Matrix3Xd {
    return nodes(k).leftCols(joints);
  };
  if (!plan_.extrapolate || last < 2)
    return margin * largest_column(joints_of(last) - joints_of(last - 1)) / 3;
  const auto extrapolated = [&](std::size_t k) -> Eigen::Matrix3Xd {
    return (4 * joints_of(k) - joints_of(k - 1)) / 3;
  };
  return margin_extrapolated * largest_column(extrapolated(last) - extrapolated(last - 1)) / 15;
}

TwistLevels::Measures TwistLevels::measure(std::size_t k) const {
  const Level& level = *levels_[k];
  return {cell_curvature(scene_.footprint, joint_tangents(scene_.footprint, level.mesh, nodes(k))),
          energies_of(level.model, level.path->state())};
}

record::Frame TwistLevels::frame() {
  const std::size_t last = levels_.size() - 1;
  Level& finest = *levels_[last];
  Eigen::Matrix3Xd x = nodes(last);
  Measures found = measure(last);
  if (plan_.extrapolate && last > 0) {
    const Measures coarse = measure(last - 1);
    const auto extrapolate = [](auto& fine, const auto& rough) { fine = (4 * fine - rough) / 3; };
    extrapolate(found.K, coarse.K);
    extrapolate(found.energies, coarse.energies);
    // the correction is known at the coarser nodes; between them it is interpolated
    Eigen::Matrix3Xd on_coarser, correction;
    finest.to_coarser->nodes(x, on_coarser);
    finest.from_coarser->nodes((on_coarser - nodes(last - 1)) / 3, correction);
    x += correction;
  }
  record::Frame frame;
  put_shape(scene_, finest.mesh, x, found.K, frame);
  frame.energies = found.energies;
  frame.residual_N = finest.path->solver().residual_at(finest.path->state());
  frame.negative_pivots = finest.path->report().inertia.negative_pivots;
  frame.error_estimate_mm = error_estimate_mm();
  return frame;
}

Effort TwistLevels::effort() const {
  Effort sum;
  for (const auto& level : levels_) sum += level->path->solver().effort();
  return sum;
}

}  // namespace gridshell::experiment
