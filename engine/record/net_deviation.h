// How far a frame lies from the net it was designed on, as its run recorded both.
#pragma once

#include <Eigen/Core>

#include "engine/record/snapshot.h"

namespace gridshell::record {

/// Whether a run has a net to lie off.
inline bool has_net(const Layout& layout) { return layout.net_nodes.cols() > 0; }

/// Distance of each node from its place on the net over rho, the layout's length scale; empty
/// without a net.
Eigen::VectorXd deviation_of_nodes(const Layout& layout, const Frame& frame);

/// The same of each cell: the mean of its four joints.
Eigen::VectorXd deviation_of_cells(const Layout& layout, const Frame& frame);

}  // namespace gridshell::record
