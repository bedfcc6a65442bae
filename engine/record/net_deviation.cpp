#include "engine/record/net_deviation.h"

#include <algorithm>

namespace gridshell::record {

Eigen::VectorXd deviation_of_nodes(const Layout& layout, const Frame& frame) {
  const Eigen::Index nodes = std::min(frame.nodes.cols(), layout.net_nodes.cols());
  if (!has_net(layout)) return {};
  return (frame.nodes.leftCols(nodes) - layout.net_nodes.leftCols(nodes)).colwise().norm() /
         layout.length_scale_mm;
}

Eigen::VectorXd deviation_of_cells(const Layout& layout, const Frame& frame) {
  if (!has_net(layout)) return {};
  const Eigen::VectorXd off = deviation_of_nodes(layout, frame);
  Eigen::VectorXd of_cells(Eigen::Index(layout.cells.size()));
  for (std::size_t k = 0; k < layout.cells.size(); ++k) {
    double sum = 0;
    for (const int joint : layout.cells[k].joints)
      sum += off[layout.joints[std::size_t(joint)].node];
    of_cells[Eigen::Index(k)] = sum / 4;
  }
  return of_cells;
}

}  // namespace gridshell::record
