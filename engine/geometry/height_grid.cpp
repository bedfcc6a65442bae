#include "engine/geometry/height_grid.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "engine/core/knots.h"
#include "engine/geometry/spline_curve.h"

namespace gridshell {
namespace {

/// Where a value lies among knots, and the weights with which values and second derivatives at its
/// two knots make the spline there.
struct Cell {
  Eigen::Index at;
  std::array<double, 2> value, second;

  Cell(const std::vector<double>& knots, double t) {
    const std::size_t k = piece_at(knots, t);
    at = Eigen::Index(k);
    const double h = knots[k + 1] - knots[k], b = (t - knots[k]) / h, a = 1 - b;
    value = {a, b};
    second = {h * h / 6 * (a * a * a - a), h * h / 6 * (b * b * b - b)};
  }
};

bool rises(const std::vector<double>& values) {
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(values[k] > values[k - 1]) || !std::isfinite(values[k] - values[0])) return false;
  return values.size() >= 4;
}

}  // namespace

Result<HeightGrid> HeightGrid::through(std::vector<double> x, std::vector<double> y,
                                       Eigen::MatrixXd z) {
  if (!rises(x) || !rises(y))
    return fail(Fault::bad_input, "x and y of a grid of heights must be 4 or more rising numbers");
  if (z.rows() != Eigen::Index(y.size()) || z.cols() != Eigen::Index(x.size()) || !z.allFinite())
    return fail(Fault::bad_input, "a grid of heights must have a finite one at every place");
  HeightGrid grid;
  grid.z_xx_ = second_derivatives(x, z);
  grid.z_yy_ = second_derivatives(y, z.transpose()).transpose();
  grid.z_xxyy_ = second_derivatives(y, grid.z_xx_.transpose()).transpose();
  grid.x_ = std::move(x), grid.y_ = std::move(y), grid.z_ = std::move(z);
  return grid;
}

double HeightGrid::at(double x, double y) const {
  if (!(x >= x_.front() && x <= x_.back() && y >= y_.front() && y <= y_.back()))
    return std::numeric_limits<double>::quiet_NaN();
  const Cell in_x(x_, x), in_y(y_, y);
  double sum = 0;
  for (std::size_t b = 0; b < 2; ++b)
    for (std::size_t a = 0; a < 2; ++a) {
      const Eigen::Index i = in_x.at + Eigen::Index(a), j = in_y.at + Eigen::Index(b);
      sum += in_y.value[b] * (in_x.value[a] * z_(j, i) + in_x.second[a] * z_xx_(j, i)) +
             in_y.second[b] * (in_x.value[a] * z_yy_(j, i) + in_x.second[a] * z_xxyy_(j, i));
    }
  return sum;
}

}  // namespace gridshell
