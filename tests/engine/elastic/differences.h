// Gradient and Hessian of a model compared with central differences, for which the frames of edges
// are transported with them.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/elastic/assembly.h"
#include "engine/elastic/model.h"

namespace gridshell {

/// Compares derivatives with differences for all unknowns, positions and angles, including
/// constrained ones but not those that follow others. Tolerances are relative to the largest slope,
/// to the norms of the Hessian's columns and to its own norm. `turns_frames`: the shell is bent so
/// strongly that the rotation of frames must show.
inline void check_derivatives(const Model& model, const State& state, const ExternalLoads& outside,
                              double of_gradient, double of_column, double of_hessian,
                              bool turns_frames = false) {
  std::vector<int> places(std::size_t(3 * model.nodes));
  for (std::size_t k = 0; k < places.size(); ++k) places[k] = int(k);
  std::erase_if(places,
                [&](int place) { return model.fixed[std::size_t(place / 3)] == Model::follows; });
  // two halves of an edge have one angle
  for (const int place : model.spin)
    if (std::ranges::find(places, place) == places.end()) places.push_back(place);
  const auto moved = [&](int place, double by) {
    State other = state;
    Eigen::Matrix3Xd x = state.x;
    x.data()[place] += by;
    move_to(model, x, other);
    return other;
  };
  Assembly here, up, down;
  assemble_hessian(model, state, outside, {}, here);
  const double h = 1e-5, scale = here.gradient.cwiseAbs().maxCoeff();
  const auto n = Eigen::Index(places.size());
  Eigen::MatrixXd found(n, n), slope(n, n);
  Eigen::Matrix3Xd unit, column;
  for (Eigen::Index k = 0; k < n; ++k) {
    const int place = places[std::size_t(k)];
    const State plus = moved(place, h), minus = moved(place, -h);
    INFO("unknown " << place);
    const double rise =
        energies_of(model, plus, outside).total() - energies_of(model, minus, outside).total();
    CHECK(std::abs(rise / (2 * h) - here.gradient.data()[place]) <= of_gradient * scale);
    unit.setZero(3, model.columns());
    unit.data()[place] = 1;
    multiply(model, here.hessian, unit, column);
    assemble_gradient(model, plus, outside, up);
    assemble_gradient(model, minus, outside, down);
    for (Eigen::Index m = 0; m < n; ++m) {
      const int at = places[std::size_t(m)];
      found(m, k) = column.data()[at];
      slope(m, k) = (up.gradient.data()[at] - down.gradient.data()[at]) / (2 * h);
    }
  }
  // a loop of small moves turns frames: the gradient's own derivative is not symmetric
  if (model.spin.empty()) CHECK((slope - slope.transpose()).norm() <= 1e-5 * found.norm());
  if (turns_frames) CHECK((slope - slope.transpose()).norm() > 1e-5 * found.norm());
  const Eigen::MatrixXd off = found - 0.5 * (slope + slope.transpose());
  for (Eigen::Index k = 0; k < n; ++k) CHECK(off.col(k).norm() <= of_column * found.col(k).norm());
  CHECK(off.norm() <= of_hessian * found.norm());
  CHECK((found - found.transpose()).norm() <= 1e-13 * found.norm());
}

}  // namespace gridshell
