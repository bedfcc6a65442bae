#include "engine/experiment/grip.h"

#include <algorithm>

#include "engine/experiment/steps.h"

namespace gridshell::experiment {

void Grips::note(const Session& session) {
  for (int joint = 0; joint < int(session.scene().footprint.joints.size()); ++joint) {
    const bool held =
        std::ranges::any_of(session.holds(), [&](const Hold& hold) { return hold.node == joint; });
    if (!held) at_[joint] = session.nodes().col(joint);
  }
}

Grip Grips::last(const Session& session) const {
  if (session.holds().empty()) return {};
  const int joint = session.holds().back().node;
  return {joint, at_.at(joint)};
}

void put_push(const Session& session, const Grip& grip, record::Frame& frame) {
  if (grip.joint < 0 || session.holds().empty()) return;
  const Hold& hold = session.holds().back();
  const Eigen::Vector3d moved = hold.part(session.nodes().col(grip.joint) - grip.at);
  frame.depth_mm = moved.norm();
  const Eigen::Vector3d force = hold.part(session.force(session.holds().size() - 1));
  frame.force_N = frame.depth_mm > nearest_mm ? force.dot(moved.normalized()) : 0;
}

}  // namespace gridshell::experiment
