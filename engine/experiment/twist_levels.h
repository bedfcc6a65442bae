// A footprint on the `twist` rung, meshed on several levels that follow one path.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/experiment/actuation.h"
#include "engine/solve/twist_path.h"

namespace gridshell::experiment {

/// Meshes of a plan, coarse to fine, each with its model and path.
class TwistLevels {
 public:
  /// Errors (bad_input): materials that the rung cannot take.
  static Result<TwistLevels> make(const ActuationScene& scene, const LevelPlan& plan);

  /// Brings the coarsest mesh to rest at t from positions of its nodes, and the finer ones from
  /// there. False when one of them finds no rest nearby.
  bool start(double t, const Eigen::Matrix3Xd& coarse, const Watch& watch);
  /// All meshes to t. Where one jumps the others are taken on from the coarsest, and `jumped` says
  /// so. False when a mesh finds no rest, or another one than the coarsest.
  bool advance(double t, const Watch& watch, bool& jumped);
  void allow_unstable(bool allow);

  /// The state of all meshes as a frame: extrapolated where planned, with its certificate.
  record::Frame frame();
  double error_estimate_mm() const;
  double largest_strain() const { return levels_.back()->path->largest_strain(); }
  double t() const { return levels_.front()->path->t(); }

  const LevelPlan& plan() const { return plan_; }
  const RodMesh& mesh(std::size_t level) const { return levels_[level]->mesh; }
  const RodMesh& finest() const { return levels_.back()->mesh; }
  int dof() const { return levels_.back()->model.dof(); }
  Effort effort() const;

 private:
  struct Level {
    RodMesh mesh;
    TwistModel model;
    Eigen::Matrix3Xd flat;
    std::unique_ptr<TwistPath> path;
    std::optional<MeshTransfer> from_coarser, to_coarser;
  };
  struct Measures {
    Eigen::VectorXd K;
    Energies energies;
  };
  TwistLevels(const ActuationScene& scene, const LevelPlan& plan) : scene_(scene), plan_(plan) {}
  Eigen::Matrix3Xd nodes(std::size_t level) const;
  Measures measure(std::size_t level) const;
  bool carry(std::size_t level, double t, const Watch& watch);
  bool near(std::size_t level) const;

  const ActuationScene& scene_;
  LevelPlan plan_;
  std::vector<std::unique_ptr<Level>> levels_;
};

}  // namespace gridshell::experiment
