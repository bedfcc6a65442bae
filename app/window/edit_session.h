// The shell that a window edits, with all steps that can be undone.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/window/command.h"
#include "app/window/shell_view.h"
#include "engine/gridshell.h"

namespace gridshell::window {

/// A file without a name, which goes with the program.
class ScratchFile {
 public:
  /// Where bytes lie in it.
  struct Place {
    std::int64_t at = 0;
    std::size_t size = 0;
  };
  /// How much of it is in use, bytes.
  std::int64_t bytes() const { return end_; }
  /// Nothing where there is no room.
  std::optional<Place> put(std::string_view bytes);
  /// Read again; empty where the file does not give it.
  std::string take(const Place& place) const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  std::int64_t end_ = 0;
};

// EditSession executes commands on the shell of a window and stores the steps; for one thread.

/// A failed command leaves the shell in its last certified state and says why in the view.
class EditSession {
 public:
  /// Memory of the steps to undo, bytes; older ones are in a file.
  explicit EditSession(std::int64_t most_bytes = std::int64_t(100) << 20)
      : most_bytes_(most_bytes) {}

  /// Executes a command as far as possible. An exception (memory) becomes an error too.
  void execute(const Command& command, const Watch& watch);
  /// Refines the meshes to those that the preset's accuracy requires, if the current ones are
  /// coarser.
  void refine(const Watch& watch);

  /// The current state.
  const ShellView& shell() const { return view_; }
  /// Calls it while a command is at work, each time that there is something to see.
  void tell(std::function<void(const ShellView&)> message) { listener_ = std::move(message); }

 private:
  /// All that a command can change but the state of the rods.
  struct EditState : ViewedState {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<DesignTarget> target;  ///< that the design aims at
  };

  /// To go back to.
  struct UndoStep {
    EditState state;
    Checkpoint checkpoint;
    bool before_design = false;                    ///< a design was requested then
    std::optional<ScratchFile::Place> saved = {};  ///< the checkpoint's arrays, if not in it
  };

  Result<void> act(const Open& command, const Watch& watch);
  Result<void> act(const Change& command, const Watch& watch);
  Result<void> act(const Move& command, const Watch& watch);
  Result<void> act(const Push& command, const Watch& watch);
  Result<void> act(const Release& command, const Watch& watch);
  Result<void> act(const DragEdge& command, const Watch& watch);
  Result<void> act(const ResetEdgePoint& command, const Watch& watch);
  Result<void> act(const Rest& command, const Watch& watch);
  Result<void> act(const Jitter& command, const Watch& watch);
  Result<void> act(const Undo& command, const Watch& watch);
  Result<void> act(const Redo& command, const Watch& watch);
  Result<void> act(const Design& command, const Watch& watch);
  Result<void> act(const AcceptDesign&, const Watch&);
  Result<void> act(const DiscardDesign&, const Watch&);
  Result<void> act(const Recall& command, const Watch&);
  Result<void> act(const RefineAfterDrag&, const Watch&) { return {}; }

  /// An equilibrium without constraints, to return to.
  struct RestState {
    EditState state;
    Checkpoint checkpoint;
    std::shared_ptr<const ShellView> seen;

    bool beside(const RestState& other) const;
    bool same_as(const RestState& other) const;
  };
  void note_state();
  std::string note_path(const preset::Step& step, const simulate::StepPath& path, double began_mm,
                        bool began_stable, Report& report);
  bool looks_between() const;
  double pushed_mm(const preset::Step& step) const;
  std::string place_text(const PathMark& mark) const;

  void run_command(const Command& command, const Watch& watch);
  void take_back_step();
  void recover(const Command& command, const std::exception& thrown);
  void refine_meshes(const Watch& watch);
  Result<void> form(const preset::Preset& preset, const Watch& watch);
  Result<void> change_preset(const preset::Preset& preset, const Watch& watch);
  Result<void> rebuild_shell(const preset::Preset& preset, const Watch& watch);
  void set_shell(const preset::Preset& preset, std::shared_ptr<const Scene> scene,
                 Simulation session);
  Result<void> set_preset_push();
  Result<void> show_designed(const preset::Preset& designed, const State& state);
  void show_design_step(const Scene& scene, const CertifiedStep& step, DesignProgress& course);
  void accept_design();
  Result<void> change_rods(const preset::Preset& preset, const Watch& watch);
  void take_over_keys(const preset::Preset& preset);
  Result<void> do_step(preset::Step step, const Watch& watch);
  Result<void> resist(preset::Step step, const Checkpoint& before, const Eigen::Vector3d& reached,
                      const Watch& watch);
  bool resists(const Eigen::Vector3d& to);
  Result<void> move_boundary(double progress, const Eigen::Matrix3Xd& dragged, const Watch& watch);
  void add_step(preset::Step step, const Report& report);
  Result<void> note_events(const Report& report);
  void coarsen(const Watch& watch);
  bool remember(const Command& command);
  Result<void> travel(std::deque<UndoStep>& from, std::deque<UndoStep>& to, const char* none);
  void keep_within_memory(std::deque<UndoStep>& steps);
  void clear_scratch();
  bool save_to_scratch(UndoStep& step);
  bool load_from_scratch(UndoStep& step) const;
  Result<void> restore(const UndoStep& step);
  void update_view();
  std::string accuracy_warning() const;
  void update_layout();
  void update_normals();
  void update_symmetry();
  void update_rods();
  void update_soft_mode();
  void update_deviation(const Eigen::VectorXd& of_joints_mm);

  /// Where a dragged joint was stopped before the rods' strain limit, and from where it came.
  struct DragStop {
    int drag = 0;
    Eigen::Vector3d at = Eigen::Vector3d::Zero(), from = Eigen::Vector3d::Zero();
  };

  EditState now_;
  DragStop stop_;
  bool passing_ = false;  // the command at hand is of a drag that continues
  std::optional<Simulation> session_;
  std::deque<UndoStep> undo_, redo_;
  std::deque<UndoStep> redo_aside_;  // until the command at hand is known to be a step
  ScratchFile scratch_;              // the arrays of older ones
  std::int64_t most_bytes_;
  int drag_ = 0;                          // that the last step to undo belongs to
  int this_drag_ = 0, steps_drag_ = 0;    // of the command at hand, and of the last of the steps
  bool last_eventful_ = false;            // whether that came past something
  bool remembered_ = false;               // the command at hand, as a step
  bool only_coarse_mesh_ = false;         // finer meshes do not have this state
  int nodes_shown_ = 0;                   // of the layout in the view
  std::vector<MeshSymmetry> symmetries_;  // that a state of this shell may have
  std::vector<RestState> found_;          // states of one boundary that were met
  std::optional<RestState> at_rest_;      // the last one
  std::function<void(const ShellView&)> listener_;
  ShellView view_;
};

/// Why an exception was thrown, as a text that fits into the line of errors.
std::string error_text(const std::exception& thrown);

/// The meshes that follow a drag: those of now where the shell is small, else the coarsest of those
/// that the scene asks for, alone.
LevelPlan drag_plan(const Scene& scene, const LevelPlan& now);

}  // namespace gridshell::window
