#include "engine/measure/bins.h"

#include <algorithm>
#include <cmath>

namespace gridshell {

CurvatureBins curvature_bins(const Eigen::VectorXd& x_over_L, const Eigen::VectorXd& K, int bins) {
  const double width = 2.0 / bins;
  CurvatureBins found;
  found.low = Eigen::VectorXd::LinSpaced(bins, -1, 1 - width);
  found.high = found.low.array() + width;
  found.cells = Eigen::VectorXi::Zero(bins);
  found.mean = found.deviation = Eigen::VectorXd::Zero(bins);
  const auto bin_of = [&](Eigen::Index cell) {
    return std::clamp(int(std::floor((x_over_L[cell] + 1) / width)), 0, bins - 1);
  };
  for (Eigen::Index cell = 0; cell < K.size(); ++cell) {
    ++found.cells[bin_of(cell)];
    found.mean[bin_of(cell)] += K[cell];
  }
  found.mean.array() /= found.cells.cast<double>().array();
  for (Eigen::Index cell = 0; cell < K.size(); ++cell) {
    const int bin = bin_of(cell);
    found.deviation[bin] += (K[cell] - found.mean[bin]) * (K[cell] - found.mean[bin]);
  }
  found.deviation = (found.deviation.array() / found.cells.cast<double>().array()).sqrt();
  return found;
}

}  // namespace gridshell
