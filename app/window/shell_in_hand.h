// The shell that a window holds: fulfils wishes on a session and remembers the steps, one thread.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/window/numbers_file.h"
#include "app/window/sight.h"
#include "app/window/wish.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/design/live_design.h"
#include "engine/experiment/steps.h"
#include "engine/footprint/mesh_symmetry.h"
#include "engine/session/session.h"

namespace gridshell::window {

/// A failed wish leaves the shell in its last certified state and says why in the sight.
class ShellInHand {
 public:
  /// Steps to undo take that much memory; older ones stand in a file.
  explicit ShellInHand(std::int64_t most_bytes = std::int64_t(100) << 20)
      : most_bytes_(most_bytes) {}

  /// Fulfils a wish as far as it can.
  void fulfil(const Wish& wish, const Watch& watch);
  /// Onto the meshes that the preset's accuracy asks for, where the shell stands on coarser ones.
  void refine(const Watch& watch);

  /// The state that it stands in.
  const Sight& sight() const { return sight_; }
  /// Calls it while a wish is at work, each time that there is something to see.
  void tell(std::function<void(const Sight&)> told) { told_ = std::move(told); }

 private:
  /// All that a wish can change, to go back to.
  struct Step {
    preset::Preset preset;
    std::shared_ptr<const Scene> scene;
    Checkpoint checkpoint;
    experiment::HandBoundary boundary;
    std::map<int, Eigen::Vector3d> taken_at;
    PresetPush push;
    std::shared_ptr<const record::Frame> first;
    StepChain steps;
    bool refined = true, changed_late = false, snapped = false;
    std::shared_ptr<const DesignCourse> design = {};
    std::shared_ptr<DesignTarget> target = {};
    bool before_design = false;        ///< a design was wished for then
    std::vector<PutAside> aside = {};  ///< the checkpoint's arrays, where they are not in it
  };

  Result<void> act(const Open& wish, const Watch& watch);
  Result<void> act(const Change& wish, const Watch& watch);
  Result<void> act(const Move& wish, const Watch& watch);
  Result<void> act(const Push& wish, const Watch& watch);
  Result<void> act(const Release& wish, const Watch& watch);
  Result<void> act(const DragEdge& wish, const Watch& watch);
  Result<void> act(const PutEdgeBack& wish, const Watch& watch);
  Result<void> act(const Rest& wish, const Watch& watch);
  Result<void> act(const Jitter& wish, const Watch& watch);
  Result<void> act(const Undo& wish, const Watch& watch);
  Result<void> act(const Redo& wish, const Watch& watch);
  Result<void> act(const Design& wish, const Watch& watch);
  Result<void> act(const KeepDesign&, const Watch&);
  Result<void> act(const PutBack&, const Watch&);
  Result<void> act(const Settle&, const Watch&) { return {}; }

  Result<void> form(const preset::Preset& preset, const Watch& watch);
  Result<void> form_anew(const preset::Preset& preset, const Watch& watch);
  void begin_again(const preset::Preset& preset, std::shared_ptr<const Scene> scene,
                   Session session);
  Result<void> take_push();
  Result<void> stand_designed(const preset::Preset& designed, const State& state);
  void see_step(const Scene& scene, const CertifiedStep& step, DesignCourse& course);
  void accept_design(const Wish& wish);
  Result<void> put_rods(const preset::Preset& preset, const Watch& watch);
  void take_numbers(const preset::Preset& preset);
  Result<void> do_step(preset::Step step, const Watch& watch);
  void keep(preset::Step step, const Report& report);
  Result<void> ended(const Report& report);
  void coarsen(const Watch& watch);
  bool remember(const Wish& wish);
  Result<void> travel(std::deque<Step>& from, std::deque<Step>& to, const char* none);
  Step step() const;
  void keep_within_memory(std::deque<Step>& steps);
  void forget_aside();
  bool put_aside(Step& step);
  bool take_back(Step& step) const;
  Result<void> stand(const Step& step);
  void look();
  std::string weakness() const;
  void look_at_layout();
  void look_at_normals();
  void look_at_symmetry();
  void look_at_rods();
  void look_at_soft_mode();
  void look_at_deviation(const Eigen::VectorXd& of_joints_mm);

  preset::Preset preset_;
  std::shared_ptr<const Scene> scene_;
  std::optional<Session> session_;
  experiment::HandBoundary boundary_;
  std::map<int, Eigen::Vector3d> taken_at_;  // where joints were taken hold of
  std::deque<Step> undo_, redo_;
  NumbersFile aside_;  // the arrays of older ones
  std::int64_t most_bytes_;
  int stroke_ = 0;                        // that the last step to undo belongs to
  StepChain steps_;                       // what the hand did since the shell was formed
  int now_stroke_ = 0, kept_stroke_ = 0;  // of the wish at hand, and of the last of steps_
  bool kept_eventful_ = false;            // whether that came past something
  bool refined_ = false, changed_late_ = false, snapped_ = false;
  bool coarse_alone_ = false;                   // finer meshes do not have the state in hand
  int nodes_shown_ = 0;                         // of the layout in sight
  std::vector<MeshSymmetry> symmetries_;        // that a state of this shell may have
  std::shared_ptr<const DesignCourse> design_;  // that the shell is of
  std::shared_ptr<DesignTarget> target_;        // and what it aims at
  std::function<void(const Sight&)> told_;
  Sight sight_;
};

/// The meshes that follow a drag: the coarsest of those that the scene asks for.
LevelPlan coarse_plan(const Scene& scene);

}  // namespace gridshell::window
