// The problem that all methods of a study solve, from one certified state to another on any mesh,
// and the reference solution by which they are judged.
#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "engine/core/result.h"
#include "engine/elastic/model.h"
#include "engine/elastic/shell_rods.h"
#include "engine/preset/preset.h"
#include "engine/scene/scene.h"
#include "engine/solve/nested_shell.h"

namespace gridshell::study {

/// The task: move the boundary, find the equilibrium next to the net, or push a joint.
enum class Task { actuation, near_net, push };

/// Rod model and joints of a method.
struct ModelVariant {
  RodModel rod_model = RodModel::bend;
  double spring_N_per_mm = 0;  ///< stiffness of spring joints; 0: shared nodes
};

/// The task on one mesh. The path parameter of the pinned nodes, with a push also of the pushed
/// joint, increases from t to 1.
struct Problem {
  int edges = 0;  ///< per segment
  RodMesh mesh;
  Model model;
  PinnedMotion motion;
  double t = 0;  ///< path parameter at the start
  State start;   ///< certified on this mesh (near_net: the net itself)
  State end;     ///< the equilibrium of *this* mesh at t = 1 on the branch of the reference

  /// Path parameter of load step `k` of `steps`, between which the boundary or the joint moves by
  /// equal parts.
  double load_parameter(int k, int steps) const;
};

/// A scene with its reference. The start is the first buckled state, at a mean shortening of the
/// rods of 2 % (for a circle: R_a = 0.98 R_o), the net, or the unloaded shell. The reference is
/// followed from there on meshes of 4, 8, ... `finest` edges per segment and extrapolated over the
/// last two. On every coarser mesh the equilibrium is computed from the reference's positions, so
/// that all starts and ends are on one branch. A push also constrains the joint perpendicular to it
/// (`lateral = "held"`), which makes it one problem for methods that cannot prescribe a single
/// direction.
class BenchmarkProblem {
 public:
  /// Errors: bad_input (scene), no_equilibrium (the path is lost or snaps: there is no reference),
  /// cancelled. `EA_scale` multiplies the rods' EA.
  static Result<std::unique_ptr<BenchmarkProblem>> create(const preset::Preset& preset, int finest,
                                                          Watch& watch, double EA_scale = 1);

  /// The problem on the mesh with `edges` per segment, made at its first use; may be called from
  /// any thread. Errors: no_equilibrium if the mesh has no state near the reference's; cancelled.
  Result<const Problem*> problem(int edges, const Watch& watch);

  /// Largest distance of a joint from its position at the reference's end, over the length scale;
  /// `x` has the joints in its first columns.
  double error_of(const Eigen::Matrix3Xd& x) const;
  double scale_mm() const { return scene_->length_scale_mm; }
  int joints() const { return int(scene_->footprint.joints.size()); }
  const Scene& scene() const { return *scene_; }
  /// The problem with another rod model or other joints; its end is that of the bend model.
  Problem on_model(const Problem& problem, const ModelVariant& on) const;
  Task task() const { return task_; }
  double reference_error() const { return reference_error_; }  ///< estimated, over scale_mm()

  /// A nested shell as an experiment makes it for a tolerance (over the length scale).
  NestedShell shell(const LevelPlan& plan, double tolerance, const ModelVariant& on = {}) const;
  /// Sets the shell to the start of the task. Does nothing for near_net, whose equilibrium is the
  /// method's own work.
  NestedReport begin(NestedShell& shell, const Watch& watch);
  /// Moves the shell from the start to the end, in load steps as the experiments choose them, with
  /// `stops` certified states on the path of an actuation.
  NestedReport go(NestedShell& shell, const Watch& watch, int stops = 1) const;

 private:
  BenchmarkProblem(std::shared_ptr<const Scene> scene, const preset::Indentation& pushed);
  Result<void> follow(int finest, Watch& watch);
  Result<State> equilibrium_near(const Problem& problem, const Eigen::Matrix3Xd& requested,
                                 double t, const Watch& watch) const;
  ShellRods rods_on(const ModelVariant& on) const;
  void push(NestedShell& shell) const;

  std::shared_ptr<const Scene> scene_;
  preset::Indentation pushed_;
  Task task_;
  double t_ = 0;    // path parameter at which the actuation starts
  int joint_ = -1;  // the pushed one
  Eigen::Vector3d displacement_ = Eigen::Vector3d::Zero();
  RodMesh finest_;
  Eigen::Matrix3Xd start_, end_;  // positions of the reference on finest_
  double reference_error_ = 0;
  std::mutex mutex_;  // guards problems_
  std::map<int, Problem> problems_;
};

}  // namespace gridshell::study
