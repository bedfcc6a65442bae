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

/// A temporary file without a name, which is removed when the program ends.
class ScratchFile {
 public:
  /// A range of bytes in the file.
  struct Range {
    std::int64_t at = 0;
    std::size_t size = 0;
  };
  /// Size of the file, bytes.
  std::int64_t bytes() const { return end_; }
  /// Appends bytes and returns their range; nothing if they cannot be written.
  std::optional<Range> put(std::string_view bytes);
  /// Reads a range of bytes; empty if it cannot be read.
  std::string take(const Range& range) const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  std::int64_t end_ = 0;
};

// The engine's side of the window. It is used by one thread.

/// Executes commands on the edited shell and stores the steps to undo. A failed command leaves the
/// shell in its last certified state; the view has the error.
class EditSession {
 public:
  /// `most_bytes`: memory for the steps to undo; older ones are stored in a file.
  explicit EditSession(std::int64_t most_bytes = std::int64_t(100) << 20)
      : most_bytes_(most_bytes) {}

  /// Executes a command as far as possible. An exception becomes an error in the view.
  void execute(const Command& command, const Watch& watch);
  /// Refines the meshes to those that the preset's accuracy requires.
  void refine(const Watch& watch);

  /// The current state of the shell.
  const ShellView& shell() const { return view_; }
  /// Sets a function that is called during a command with each state that may be shown.
  void set_listener(std::function<void(const ShellView&)> message) {
    listener_ = std::move(message);
  }

 private:
  /// What a command can change in addition to the state of the rods.
  struct EditState : ViewedState {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<DesignTarget> target;  ///< the surface or net that the design approaches
  };

  /// A state to return to.
  struct UndoStep {
    EditState state;
    Checkpoint checkpoint;
    bool before_design = false;                    ///< the next command was a design
    std::optional<ScratchFile::Range> saved = {};  ///< the checkpoint's arrays, if in the file
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

  /// A stable equilibrium without constrained joints, to return to.
  struct FoundState {
    EditState state;
    Checkpoint checkpoint;
    std::shared_ptr<const ShellView> seen;

    bool same_boundary(const FoundState& other) const;
    bool same_as(const FoundState& other) const;
  };
  void note_state();
  std::string note_path(const preset::Step& step, const simulate::PathSegment& path,
                        double began_mm, bool began_stable, Report& report);
  bool looks_between() const;
  double pushed_mm(const preset::Step& step) const;
  std::string position_text(const PathMark& mark) const;

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
  void show_design_step(const Scene& scene, const CertifiedStep& step, DesignProgress& design);
  void accept_design();
  Result<void> change_rods(const preset::Preset& preset, const Watch& watch);
  preset::Preset with_boundary_end(preset::Preset preset) const;
  Result<void> do_step(preset::Step step, const Watch& watch);
  Result<void> resist(preset::Step step, const Checkpoint& before, const Eigen::Vector3d& reached,
                      const Watch& watch);
  bool resists(const Eigen::Vector3d& to);
  Result<void> move_boundary(double progress, const Eigen::Matrix3Xd& dragged, const Watch& watch);
  void add_step(preset::Step step, const Report& report);
  Result<void> note_events(const Report& report);
  void coarsen(const Watch& watch);
  bool remember(const Command& command);
  Result<void> swap_state(std::deque<UndoStep>& from, std::deque<UndoStep>& to, const char* none);
  void limit_memory(std::deque<UndoStep>& steps);
  void clear_scratch();
  bool save_to_scratch(UndoStep& step);
  bool load_from_scratch(UndoStep& step) const;
  Result<void> restore(const UndoStep& step);
  void update_view();
  std::string accuracy_warning() const;
  void update_layout();
  void update_normals();
  void update_symmetry();
  void update_deviation();
  void update_lowest_mode();
  void update_deviation(const Eigen::VectorXd& of_joints_mm);

  /// Position in which a dragged joint was stopped before the rods' strain limit, and one that it
  /// came from.
  struct DragStop {
    int drag = 0;
    Eigen::Vector3d at = Eigen::Vector3d::Zero(), from = Eigen::Vector3d::Zero();
  };

  EditState now_;
  DragStop stop_;
  bool passing_ = false;  // the current command is one of a drag that continues
  std::optional<Simulation> session_;
  std::deque<UndoStep> undo_, redo_;
  std::deque<UndoStep> pending_redo_;  // redo_ until the current command is known to be a step
  ScratchFile scratch_;                // the arrays of older steps
  std::int64_t most_bytes_;
  int drag_ = 0;  // drag of the last step to undo
  int this_drag_ = 0,
      steps_drag_ = 0;             // of the current command, and of the last step of now_.steps
  bool last_eventful_ = false;     // whether that last step had events
  bool remembered_ = false;        // whether the current command was added to undo_
  bool only_coarse_mesh_ = false;  // finer meshes do not have this state
  int nodes_shown_ = 0;            // nodes of the layout in the view
  std::vector<MeshSymmetry> symmetries_;  // symmetries that a state of this shell may have
  std::vector<FoundState> found_;         // states found on one boundary
  std::optional<FoundState> last_found_;  // the last such state
  std::function<void(const ShellView&)> listener_;
  ShellView view_;
};

/// The reason of an exception, as a text that fits into the line of errors.
std::string error_text(const std::exception& thrown);

/// The meshes for a drag: the current ones if the shell is small, else only the coarsest mesh of
/// the scene.
LevelPlan drag_plan(const Scene& scene, const LevelPlan& now);

}  // namespace gridshell::window
