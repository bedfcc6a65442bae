// What the engine's thread shows of the edited shell: a copy that the window draws. It includes
// what is known of the paths of the shell: where it is unstable, and where events happened. A
// branch may lose its stability and regain it before a step of the user ends; the pivots of the
// load steps in between show this.
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

/// An interval of a path, or one position on it. On the path of the boundary positions are its
/// progress, 0 at the original and 1 at the actuated boundary; on the push of a joint they are its
/// distance from where its constraint was set, mm.
struct PathMark {
  double from = 0, to = 0;  ///< from <= to
  int joint = -1;           ///< that is pushed; -1: the boundary moves
  bool unstable = false;    ///< no state between is stable; else something happened at `from`
  std::string what = {};
};

/// The marks of a path by the pivots of its load steps and by its events; `place` maps the path
/// parameter to the position. Between a stable load step and an unstable one, stability ends where
/// an event says so; else the interval ends at the unstable step, as far as it is known.
std::vector<PathMark> marks_of(const PathRecord& path, const std::vector<Event>& events, int joint,
                               const std::function<double(double)>& place);

/// Adds them. Intervals of the same kind and joint that touch or overlap are merged into one, from
/// the first start to the last end: paths there and back are marked once.
void add_marks(std::vector<PathMark>& marks, const std::vector<PathMark>& more);

/// "the path lost its stability; came to rest in another state" of what a step came past.
std::string text_of_events(const std::vector<Event>& events);

/// "124.2 to 122.9" for an interval, one number for a position; `shown` converts positions.
std::string text_of_place(const PathMark& mark, const std::function<double(double)>& shown);

/// A constrained joint.
struct HeldJoint {
  int joint = 0;
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();   ///< its reaction
  Eigen::Vector3d moved_mm = Eigen::Vector3d::Zero();  ///< since its constraint was set
  /// unit; zero: constrained in every direction
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
};

/// An edge point that was dragged off the boundary's motion.
struct DraggedEdge {
  int edge_point = 0;
  double off_mm = 0;
};

/// The push of the preset itself: the joint, its start, and the complete displacement.
struct PresetPush {
  int joint = -1;  ///< none
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), displacement = Eigen::Vector3d::Zero();
};

/// A step of a design that was certified; the first is the shell before.
struct DesignPoint {
  int iteration = 0;
  double max_mm = 0, mean_mm = 0;  ///< distances of the joints from the target
  double eigenvalue = 0;           ///< smallest on 32 edges per segment, N/mm^2
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
  std::optional<double> rounded_max_mm;  ///< at its end, if the rounded shell is stable
};

/// What the plots show of an equilibrium.
struct PlotPoint {
  double equilibrium = 0, radius_mm = 0, progress = 0, height_mm = 0, energy_mJ = 0, depth_mm = 0,
         force_N = 0, total_K = 0, residual_N = 0, error_mm = 0;
  int joint = -1;  ///< the constrained joint that was moved last; none
  int steps = 0;   ///< that were done
  bool refined = true, stable = true;
  bool coarse = false;  ///< of one mesh alone, in a drag
};

/// What commands change of a shell, in addition to the state of its rods.
struct ViewedState {
  preset::Preset preset;  ///< in a view with the current radius of the boundary
  PresetPush push;
  std::shared_ptr<const record::Frame> first;  ///< where the shell began; null before
  StepHistory steps;                           ///< that the user did since it was formed
  std::vector<PathMark> marks;                 ///< of the paths that led to the current state
  bool refined = false;            ///< to the preset's tolerance; else coarse, as in a drag
  bool rods_changed_late = false;  ///< keys of its rods were changed after steps
  bool snapped = false;            ///< it snapped to another equilibrium
  std::string
      path_left;  ///< event and position at which the known path was left; empty: it was not
  std::shared_ptr<const DesignProgress> design;  ///< that the shell is of; null: none
};

/// One equilibrium of one shell, or none yet (no layout).
struct ShellView : ViewedState {
  std::shared_ptr<const record::Layout> layout;  ///< of the frame's nodes
  record::Frame frame;
  Certificate certificate;
  std::vector<int> meshes;       ///< edges per segment, coarse to fine
  std::string accuracy_warning;  ///< of a refined state: what it lacks; empty: nothing
  double progress = 0;           ///< of the boundary; above 1 further than in the preset
  double least_progress = 0;     ///< to which it can be released
  std::string symmetry;          ///< "two diagonal mirrors"; empty while a drag passes
  std::vector<HeldJoint> held;
  double radius_end_mm = 0;  ///< of a circle's boundary where its motion ends
  std::vector<DraggedEdge> edges_dragged;
  Eigen::Matrix3Xd normals;      ///< one per joint: t_u x t_v
  Eigen::VectorXd axial_N;       ///< one per node, the mean of its edges
  Eigen::VectorXd bending_mJ_m;  ///< one per node: energy over length, J/m / 1000
  /// One a cell, mean of its joints, over rho: from the net, of a designed shell from what the
  /// design aims at; empty without a net.
  Eigen::VectorXd deviation;
  Eigen::Matrix3Xd soft_mode;  ///< of a state that is not stable: unit moves of its nodes
  std::string message;         ///< what was done, or happened on the path; empty: nothing
  std::string event;           ///< what happened to the branch on the path; empty: nothing
  std::string error;           ///< why the last command was not met; empty: it was
  /// The nearest preset that works of one that was refused; null: none is known.
  std::shared_ptr<const preset::Preset> offer;
  /// Equilibria on one boundary, if more than one was found; null: none.
  std::shared_ptr<const std::vector<std::shared_ptr<const ShellView>>> found;
  std::vector<PlotPoint> push_path;  ///< equilibria that the last push came past, but for this one
  int undo_steps = 0, redo_steps = 0;
  int equilibria = 0;  ///< found so far
  double seconds = 0;  ///< the last one took

  Eigen::VectorXd net_K;  ///< of the cells on the net that it was designed on; empty without one

  bool any() const { return layout != nullptr; }
  bool stable() const { return certificate.stable(); }
  /// Radius of a circular boundary at a progress, mm.
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
