// The mouse in the view of the shell: what it is over, what it holds, where that goes.
#pragma once

#include "app/window/actions.h"
#include "app/window/viewer_state.h"

namespace gridshell::window {

/// Positions are pixels from the top left of the view.
class Picker {
 public:
  explicit Picker(ViewerState& viewer) : viewer_(viewer) {}

  void hover(double x, double y);
  void leave();
  void press(Button button, bool shift, double x, double y);
  void drag(double x, double y);
  void release(double x, double y);
  void wheel(double steps, double x, double y);

  bool holds() const { return holding_; }

 private:
  void find(double x, double y);
  PointOnRod rod_at(double x, double y) const;
  int cell_at(double x, double y) const;
  bool is_covered(int node, double by_mm) const;
  Eigen::Vector2d pixel_of(int node) const;

  ViewerState& viewer_;
  int joint_ = -1, edge_ = -1;
  bool holding_ = false, moved_ = false;
  Gesture gesture_ = Gesture::orbit;
  double begin_x_ = 0, begin_y_ = 0, last_x_ = 0, last_y_ = 0;
  Eigen::Vector3d place_ = Eigen::Vector3d::Zero(), along_ = Eigen::Vector3d::UnitZ();
};

}  // namespace gridshell::window
