// What the engine's thread shows of the edited shell: a copy that the window draws from. It has
// what is known of the paths that a shell came along: where no shell stays, and where something
// happened. A branch may lose its stability and have it again before a step of the hand ends; the
// pivots of the load steps in between tell.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/window/command.h"
#include "engine/gridshell.h"

namespace gridshell::window {

/// A piece of a path, or one place on it. Of the boundary's path places are its progress, 0 at the
/// original and 1 at the actuated boundary; of the push of a joint how far it is from where it was
/// taken, mm.
struct PathMark {
  double from = 0, to = 0;  ///< from <= to
  int joint = -1;           ///< that is pushed; -1: the boundary moves
  bool unstable = false;    ///< no state between is stable; else something happened at `from`
  std::string what = {};
};

/// The marks of a path by the pivots of its load steps and by its events; `place` takes the path
/// parameter to the place. Between a load step that is stable and one that is not, stability ends
/// where an event says so; else the stretch ends at the one that is not, as far as it is known.
std::vector<PathMark> marks_of(const PathRecord& path, const std::vector<Event>& events, int joint,
                               const std::function<double(double)>& place);

/// Adds them. Stretches of the same kind and joint that meet or overlap are one, which reaches from
/// the first begin to the last end: ways there and back are marked once.
void add_marks(std::vector<PathMark>& marks, const std::vector<PathMark>& more);

/// "the path lost its stability; came to rest in another state" of what a step came past.
std::string text_of_events(const std::vector<Event>& events);

/// "124.2 to 122.9" of a stretch, one number of a place, by what `shown` makes of places.
std::string text_of_place(const PathMark& mark, const std::function<double(double)>& shown);

/// A joint that is held.
struct HeldJoint {
  int joint = 0;
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();   ///< that holds it
  Eigen::Vector3d moved_mm = Eigen::Vector3d::Zero();  ///< since it was taken hold of
  Eigen::Vector3d along = Eigen::Vector3d::Zero();     ///< unit; zero: held in every direction
};

/// An edge point that was dragged off the boundary's motion.
struct DraggedEdge {
  int edge_point = 0;
  double off_mm = 0;
};

/// What a preset itself pushes: the joint, from where, and all the way.
struct PresetPush {
  int joint = -1;  ///< none
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), displacement = Eigen::Vector3d::Zero();
};

/// A step of a design that was certified; the first is the shell before.
struct DesignPoint {
  int iteration = 0;
  double max_mm = 0, mean_mm = 0;  ///< distances of the joints from the target
  double eigenvalue = 0;           ///< smallest on 32 edges a segment, N/mm^2
  double largest_move_mm = 0;
  double thinnest_mm = 0, thickest_mm = 0;  ///< rods
};

/// How a design goes, or went.
struct DesignProgress {
  preset::Inverse inverse;
  double length_scale_mm = 1;
  std::vector<DesignPoint> points;
  int iterations = 0;  ///< refused ones too
  bool under_way = true, stopped = false, kept = false;
  std::optional<double> rounded_max_mm;  ///< once it has ended, where the rounded shell holds
};

/// What the plots show of an equilibrium.
struct PlotPoint {
  double equilibrium = 0, radius_mm = 0, progress = 0, height_mm = 0, energy_mJ = 0, depth_mm = 0,
         force_N = 0, total_K = 0, residual_N = 0, error_mm = 0;
  int joint = -1;  ///< that is held and was taken last; none
  int steps = 0;   ///< that were done
  bool refined = true, stable = true;
  bool coarse = false;  ///< of one mesh alone, in a drag
};

/// What commands change of a shell, beside the state of its rods.
struct ViewedState {
  preset::Preset preset;  ///< in a view with the boundary's radius as it stands
  PresetPush push;
  std::shared_ptr<const record::Frame> first;  ///< where the shell began; null before
  StepHistory steps;                           ///< that the user did since it was formed
  std::vector<PathMark> marks;                 ///< of the ways that led here
  bool refined = false;            ///< to the preset's tolerance; else coarse, as in a drag
  bool rods_changed_late = false;  ///< keys of its rods were changed after steps
  bool snapped = false;            ///< it came to rest elsewhere on its way
  std::string way_left;  ///< by what and where the way was left whose losses were known; empty: not
  std::shared_ptr<const DesignProgress> design;  ///< that the shell is of; null: none
};

/// One equilibrium of one shell, or none yet (no layout).
struct ShellView : ViewedState {
  std::shared_ptr<const record::Layout> layout;  ///< of the frame's nodes
  record::Frame frame;
  Certificate certificate;
  std::vector<int> meshes;       ///< edges a segment, coarse to fine
  std::string accuracy_warning;  ///< of a refined state: what it lacks; empty: nothing
  double progress = 0;           ///< of the boundary; beyond 1 further than the preset has it
  double least_progress = 0;     ///< to which it can be released
  std::string symmetry;          ///< "two diagonal mirrors"; empty while a drag passes
  std::vector<HeldJoint> held;
  double radius_end_mm = 0;  ///< of a circle's boundary where its motion ends
  std::vector<DraggedEdge> edges_dragged;
  Eigen::Matrix3Xd normals;      ///< one a joint: t_u x t_v
  Eigen::VectorXd axial_N;       ///< one a node, the mean of its edges
  Eigen::VectorXd bending_mJ_m;  ///< one a node: energy over length, J/m / 1000
  /// One a cell, mean of its joints, over rho: from the net, of a designed shell from what the
  /// design aims at; empty without a net.
  Eigen::VectorXd deviation;
  Eigen::Matrix3Xd soft_mode;  ///< of a state that is not stable: unit moves of its nodes
  std::string message;         ///< what was done, or happened on the way; empty: nothing
  std::string event;           ///< what happened to the branch on the way; empty: nothing
  std::string error;           ///< why the last command was not met; empty: it was
  /// States at rest on one boundary, where more than one was met; null: none.
  std::shared_ptr<const std::vector<std::shared_ptr<const ShellView>>> found;
  std::vector<PlotPoint> way;  ///< equilibria that the last push came past, but for this one
  int undo_steps = 0, redo_steps = 0;
  int equilibria = 0;  ///< found so far
  double seconds = 0;  ///< the last one took

  Eigen::VectorXd net_K;  ///< of the cells on the net that it was designed on; empty without one

  bool any() const { return layout != nullptr; }
  bool stable() const { return certificate.stable(); }
  /// Of a circle's boundary.
  double radius_at(double at) const {
    const double begin = preset.original_radius_mm();
    return begin + at * (radius_end_mm - begin);
  }
  bool designing() const { return design && design->under_way; }
};

PlotPoint plot_point_of(const ShellView& shell);

/// A state of a record, seen against `first`.
std::shared_ptr<const ShellView> view_of(record::Layout layout, record::Frame frame,
                                         record::Frame first);

/// Why the shell cannot be designed, a sentence; empty: it can.
std::string why_not_designed(const ShellView& shell);

}  // namespace gridshell::window
