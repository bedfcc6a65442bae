// Where a hand took hold of joints: what the depth and the force of its pushes are told from.
#pragma once

#include <map>

#include "engine/record/frame.h"
#include "engine/session/session.h"

namespace gridshell::experiment {

/// The joint held last, and where it was when it was taken hold of.
struct Grip {
  int joint = -1;  ///< none
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
};

/// Remembers, over the steps of a session, where its joints were before they were held.
class Grips {
 public:
  /// Before a step: where every joint stands that nothing holds.
  void note(const Session& session);
  /// After it.
  Grip last(const Session& session) const;

 private:
  std::map<int, Eigen::Vector3d> at_;
};

/// Tells the frame of the state that a session stands in how far the joint of a grip was moved the
/// way it is held, mm, and with what force it resists, N; nothing where none is held.
void put_push(const Session& session, const Grip& grip, record::Frame& frame);

}  // namespace gridshell::experiment
