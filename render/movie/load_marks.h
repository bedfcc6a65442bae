// Where a shell is pushed or pulled: arrows that stand at the joints and go with them.
#pragma once

#include <vector>

#include "engine/record/snapshot.h"

namespace gridshell::render {

/// From tail to tip, mm.
struct LoadArrow {
  int node = 0;  ///< of the joint that it acts on
  Eigen::Vector3d from, to;
};

/// Whether a load acts in this frame. One that comes and goes acts where its joint is held; where
/// the frame knows no reactions, always.
bool acts(const record::LoadedJoint& load, const record::Layout& layout,
          const record::Frame& frame);

/// Of the loads that act. A push has its tip at the joint; a pull away from the shell its tail. As
/// long as a quarter of the length scale.
std::vector<LoadArrow> load_arrows(const record::Layout& layout, const record::Frame& frame);

}  // namespace gridshell::render
