// Single rods for tests with known answers.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/elastic/model.h"
#include "engine/solve/equilibrium.h"

namespace gridshell {

/// A straight rod along x from the origin.
struct SingleRod {
  int edges = 0;
  double length = 0;
  ModelRod rod;

  SingleRod(int n, double L, const RodMaterial& material, RodEnd begin, RodEnd end)
      : edges(n), length(L), rod{{}, {}, material, {}, {}, begin, end} {
    for (int k = 0; k <= n; ++k) {
      rod.nodes.push_back(k);
      rod.position.push_back(L * k / n);
    }
  }
  Model model() const { return build_model(edges + 1, {rod}, RodModel::twist).value(); }
  /// nodes on the straight line, `stretch` times the natural length, with a bump of this height in
  /// z
  Eigen::Matrix3Xd line(double stretch = 1, double bump = 0) const {
    Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, edges + 1);
    for (int k = 0; k <= edges; ++k) {
      const double s = double(k) / edges;
      x.col(k) << stretch * length * s, 0, bump * std::sin(M_PI * s);
    }
    return x;
  }
};

/// The lowest parameter in [low, high] at which `stable` turns false, to 1e-6 of it.
template <class Stable>
double critical(double low, double high, Stable stable) {
  REQUIRE(stable(low));
  REQUIRE_FALSE(stable(high));
  while (high - low > 1e-6 * high) {
    const double middle = 0.5 * (low + high);
    (stable(middle) ? low : high) = middle;
  }
  return high;
}

/// Sets the angle of an edge, rad.
inline void set_angle(const Model& model, State& state, int edge, double angle) {
  state.x.data()[model.spin[std::size_t(edge)]] = angle * model.spin_length;
}

/// Minimises the energy; the test fails if it does not converge.
inline void settle(Linearisation& system, State& state, double tolerance = 1e-7) {
  MinimiseOptions options;
  options.tolerance_mm = tolerance;
  options.most_iterations = 3000;
  const NewtonReport report = minimise(system, state, options, unwatched);
  CAPTURE(int(report.outcome), report.iterations, report.last_move_mm);
  REQUIRE(report.outcome == Outcome::reached);
  system.gradient_at(state);
}

/// log2 of how an error falls when edges are halved
inline double order(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace gridshell
