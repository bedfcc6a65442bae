// The copy of the edited shell that the engine's thread passes to the window. It includes marks on
// the paths of the shell: intervals that are unstable, and events. A path may lose its stability
// and regain it within one step of the user; the pivots of the load steps in between show this.
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

/// An interval of a path, or one position on it. The position is, while the boundary moves, its
/// progress, 0 at the original and 1 at the actuated boundary; while a joint is pushed, its
/// distance in mm from where its constraint was set.
struct PathMark {
  double from = 0, to = 0;  ///< from <= to
  int joint = -1;           ///< the joint that is pushed; -1: the boundary moves
  bool unstable = false;    ///< states `from` to `to` are unstable; else an event is at `from`
  std::string what = {};
};

/// The marks of a path, from the pivots of its load steps and from its events; `position` maps the
/// path parameter to the position. An unstable interval ends at an event between the unstable and
/// the stable load step; without such an event it ends at the last unstable step.
std::vector<PathMark> marks_of(const PathRecord& path, const std::vector<Event>& events, int joint,
                               const std::function<double(double)>& position);

/// Adds marks. Intervals of the same kind and joint that touch or overlap are merged, so that a
/// path that is followed forward and back is marked once.
void add_marks(std::vector<PathMark>& marks, const std::vector<PathMark>& more);

/// The events of a step as text: "stability lost; limit point: snapped to another state".
std::string text_of_events(const std::vector<Event>& events);

/// "124.2 to 122.9" for an interval, one number for a position; `shown` converts positions.
std::string text_of_range(const PathMark& mark, const std::function<double(double)>& shown);

struct ConstrainedJoint {
  int joint = 0;
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();   ///< its reaction
  Eigen::Vector3d moved_mm = Eigen::Vector3d::Zero();  ///< since its constraint was set
  /// unit vector of the constrained direction; zero: every direction is constrained
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
};

/// An edge point that was dragged off the boundary's motion.
struct DraggedEdge {
  int edge_point = 0;
  double off_mm = 0;  ///< distance from its position in that motion
};

/// The push of [indentation]: the joint, its start, and its complete displacement.
struct PresetPush {
  int joint = -1;  ///< -1: none
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), displacement = Eigen::Vector3d::Zero();
};

/// A certified step of a design; the first one is the shell before the design.
struct DesignPoint {
  int iteration = 0;
  double max_mm = 0, mean_mm = 0;  ///< distances of the joints from the target
  double eigenvalue = 0;           ///< smallest on 32 edges per segment, N/mm^2
  double largest_move_mm = 0;
  double thinnest_mm = 0, thickest_mm = 0;  ///< of the rods
};

/// Progress or result of a design.
struct DesignProgress {
  preset::Inverse inverse;
  double length_scale_mm = 1;
  std::vector<DesignPoint> points;
  int iterations = 0;  ///< including refused ones
  bool under_way = true, stopped = false, kept = false;
  std::optional<double> rounded_max_mm;  ///< of the rounded shell, if that is stable
};

/// The values of an equilibrium that can be plotted.
struct PlotPoint {
  double equilibrium = 0, radius_mm = 0, progress = 0, height_mm = 0, energy_mJ = 0, depth_mm = 0,
         force_N = 0, total_K = 0, residual_N = 0, error_mm = 0;
  int joint = -1;  ///< the constrained joint that was moved last; -1: none
  int steps = 0;   ///< number of steps that were done
  bool refined = true, stable = true;
  bool coarse = false;  ///< computed on the coarsest mesh only, during a drag
};

/// What a command can change, and a view shows, in addition to the state of the rods.
struct ViewedState {
  preset::Preset preset;  ///< in a ShellView it has the current radius of the boundary
  PresetPush push;
  std::shared_ptr<const record::Frame> first;  ///< first state; null before the shell is formed
  StepHistory steps;                           ///< of the user, since the shell was formed
  std::vector<PathMark> marks;                 ///< of the paths that led to the current state
  bool refined = false;            ///< to the preset's tolerance; else coarse, as in a drag
  bool rods_changed_late = false;  ///< keys of its rods were changed after steps
  bool snapped = false;            ///< it snapped to another equilibrium
  std::string
      path_left;  ///< event and position at which the shell left the marked path; empty: it did not
  std::shared_ptr<const DesignProgress> design;  ///< the design that made the shell; null: none
};

/// An equilibrium of the shell; without a layout there is none yet.
struct ShellView : ViewedState {
  std::shared_ptr<const record::Layout> layout;  ///< of the frame's nodes
  record::Frame frame;
  Certificate certificate;
  std::vector<int> meshes;       ///< edges per segment, coarse to fine
  std::string accuracy_warning;  ///< why a refined state misses the tolerance; empty: it does not
  double progress = 0;           ///< of the boundary; above 1: moved further than in the preset
  double least_progress = 0;     ///< the least one to which the boundary can be moved back
  std::string symmetry;          ///< "two diagonal mirrors"; empty during a drag
  std::vector<ConstrainedJoint> constrained;
  double radius_end_mm = 0;  ///< of a circular boundary at the end of its motion
  std::vector<DraggedEdge> edges_dragged;
  Eigen::Matrix3Xd normals;  ///< one per joint: t_u x t_v
  /// one per cell, mean over its joints: distance over rho from the net, for a designed shell from
  /// the target of the design; empty without a net
  Eigen::VectorXd deviation;
  Eigen::Matrix3Xd soft_mode;  ///< of an unstable state: displacements of its nodes, largest 1
  std::string message;         ///< what was done or happened on the path
  std::string event;           ///< an event on the path; empty: none
  std::string error;           ///< why the last command failed; empty: it did not
  /// After a refused preset: the nearest one that works; null: none is known.
  std::shared_ptr<const preset::Preset> offer;
  /// The equilibria that were found on one boundary; null: fewer than two.
  std::shared_ptr<const std::vector<std::shared_ptr<const ShellView>>> found;
  std::vector<PlotPoint> push_path;  ///< equilibria on the path of the last push, without its end
  int undo_steps = 0, redo_steps = 0;
  int equilibria = 0;  ///< found so far
  double seconds = 0;  ///< time of the last command or refinement

  Eigen::VectorXd net_K;  ///< K□ of the cells on the Chebyshev net, rad; empty without a net

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

/// The view of a state of a run; `first`: the run's first state.
std::shared_ptr<const ShellView> view_of(record::Layout layout, record::Frame frame,
                                         record::Frame first);

/// Why the shell cannot be designed; empty if it can.
std::string why_not_designed(const ShellView& shell);

}  // namespace gridshell::window
