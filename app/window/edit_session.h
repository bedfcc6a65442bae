// Numbers that need not be in memory now.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/window/command.h"
#include "app/window/shell_view.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/gridshell.h"

namespace gridshell::window {

/// Where an array of numbers lies in the file, and its shape.
struct SavedArray {
  std::int64_t at = 0;
  Eigen::Index rows = 0, columns = 0;
};

/// A file without a name, which goes with the program.
class ScratchFile {
 public:
  /// How much of it is in use, bytes.
  std::int64_t bytes() const { return end_; }

  /// Writes an array and empties it; false, and the array as it was, where there is no room.
  template <class Array>
  bool put(Array& array, SavedArray& aside) {
    aside = {end_, array.rows(), array.cols()};
    if (!write(array.data(), std::size_t(array.size()))) return false;
    array = Array();
    return true;
  }
  /// Reads it again, to the bit; false where the file does not give it.
  template <class Array>
  bool take(const SavedArray& aside, Array& array) const {
    array.resize(aside.rows, aside.columns);
    return read(aside.at, array.data(), std::size_t(array.size()));
  }

 private:
  bool write(const double* numbers, std::size_t count);
  bool read(std::int64_t at, double* numbers, std::size_t count) const;

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  std::int64_t end_ = 0;
};

// The shell that a window holds: fulfils wishes on a session and remembers the steps, one thread.

/// A failed command leaves the shell in its last certified state and says why in the sight.
class EditSession {
 public:
  /// Steps to undo take that much memory; older ones stand in a file.
  explicit EditSession(std::int64_t most_bytes = std::int64_t(100) << 20)
      : most_bytes_(most_bytes) {}

  /// Fulfils a command as far as it can.
  void execute(const Command& command, const Watch& watch);
  /// Onto the meshes that the preset's accuracy asks for, where the shell stands on coarser ones.
  void refine(const Watch& watch);

  /// The state that it stands in.
  const ShellView& sight() const { return shell_view_; }
  /// Calls it while a command is at work, each time that there is something to see.
  void tell(std::function<void(const ShellView&)> told) { listener_ = std::move(told); }

 private:
  /// All that a command can change, to go back to.
  struct Step {
    preset::Preset preset;
    std::shared_ptr<const Scene> scene;
    Checkpoint checkpoint;
    PresetPush push;
    std::shared_ptr<const record::Frame> first;
    StepHistory steps;
    bool refined = true, rods_changed_late = false, snapped = false;
    std::shared_ptr<const DesignProgress> design = {};
    std::shared_ptr<DesignTarget> target = {};
    bool before_design = false;          ///< a design was wished for then
    std::vector<SavedArray> aside = {};  ///< the checkpoint's arrays, where they are not in it
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
  Result<void> act(const RefineAfterDrag&, const Watch&) { return {}; }

  Result<void> form(const preset::Preset& preset, const Watch& watch);
  Result<void> rebuild_shell(const preset::Preset& preset, const Watch& watch);
  void begin_again(const preset::Preset& preset, std::shared_ptr<const Scene> scene,
                   Simulation session);
  Result<void> take_push();
  Result<void> show_designed(const preset::Preset& designed, const State& state);
  void show_design_step(const Scene& scene, const CertifiedStep& step, DesignProgress& course);
  void accept_design(const Command& command);
  Result<void> change_rods(const preset::Preset& preset, const Watch& watch);
  void take_numbers(const preset::Preset& preset);
  Result<void> do_step(preset::Step step, const Watch& watch);
  void keep(preset::Step step, const Report& report);
  Result<void> ended(const Report& report);
  void coarsen(const Watch& watch);
  bool remember(const Command& command);
  Result<void> travel(std::deque<Step>& from, std::deque<Step>& to, const char* none);
  Step step() const;
  void keep_within_memory(std::deque<Step>& steps);
  void clear_scratch();
  bool save_to_scratch(Step& step);
  bool load_from_scratch(Step& step) const;
  Result<void> stand(const Step& step);
  void look();
  std::string accuracy_warning() const;
  void look_at_layout();
  void look_at_normals();
  void look_at_symmetry();
  void look_at_rods();
  void look_at_soft_mode();
  void look_at_deviation(const Eigen::VectorXd& of_joints_mm);

  preset::Preset preset_;
  std::shared_ptr<const Scene> scene_;
  std::optional<Simulation> session_;
  std::deque<Step> undo_, redo_;
  ScratchFile aside_;  // the arrays of older ones
  std::int64_t most_bytes_;
  int stroke_ = 0;                        // that the last step to undo belongs to
  StepHistory steps_;                     // what the hand did since the shell was formed
  int now_stroke_ = 0, kept_stroke_ = 0;  // of the command at hand, and of the last of steps_
  bool kept_eventful_ = false;            // whether that came past something
  bool refined_ = false, changed_late_ = false, snapped_ = false;
  bool only_coarse_mesh_ = false;                 // finer meshes do not have the state in hand
  int nodes_shown_ = 0;                           // of the layout in sight
  std::vector<MeshSymmetry> symmetries_;          // that a state of this shell may have
  std::shared_ptr<const DesignProgress> design_;  // that the shell is of
  std::shared_ptr<DesignTarget> target_;          // and what it aims at
  std::function<void(const ShellView&)> listener_;
  ShellView shell_view_;
};

/// The meshes that follow a drag: the coarsest of those that the scene asks for.
LevelPlan coarse_plan(const Scene& scene);

}  // namespace gridshell::window
