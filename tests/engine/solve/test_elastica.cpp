// A single pinned rod compared with the exact elastica.
#include <cmath>

#include "engine/elastic/model.h"
#include "engine/solve/equilibrium.h"
#include "tests/engine/solve/elastica.h"
#include "tests/engine/solve/single_rod.h"

using namespace gridshell;

namespace {

constexpr double length = 252;

struct Found {
  double height, force;
};

Found solved(int edges, double shortening, double stretch_scale) {
  RodSection section = circular_section(0.254, 83);
  section.EA *= stretch_scale;
  const Model model = build_model(single_rod(edges, length), section).value();
  Linearisation system(model);
  State state =
      start_state(model, straight(model, 1 - shortening, 0.6 * std::sqrt(shortening) * length));
  state.force.setZero();
  // round-off in EA x strain leaves corrections of this size
  const NewtonReport report = minimise(system, state, {.tolerance_mm = 1e-5}, unwatched);
  REQUIRE(report.outcome == Outcome::reached);
  system.gradient_at(state);
  return {state.x.row(2).maxCoeff(), std::abs(system.assembly().gradient(0, 0))};
}

}  // namespace

TEST_CASE("elastica: five shortenings, second order over 50, 100, 200 edges") {
  struct Row {
    double shortening, m, height, load;  // h/L, P/P_Euler
  };
  const Row table[] = {{0.05, 0.04968353, 0.140111, 1.025724},
                       {0.10, 0.09871763, 0.194924, 1.052987},
                       {0.25, 0.24165275, 0.292390, 1.145587},
                       {0.50, 0.46400983, 0.373306, 1.349449},
                       {0.75, 0.66169429, 0.402205, 1.657767}};
  const double euler = M_PI * M_PI * circular_section(0.254, 83).EI / (length * length);
  for (const Row& row : table) {
    const PinnedElastica exact(row.m);
    const double height = exact.height, load = exact.thrust / (M_PI * M_PI);
    CHECK(exact.shortening == Approx(row.shortening).margin(1e-7));
    CHECK(height == Approx(row.height).margin(1e-6));  // the table's own digits
    CHECK(load == Approx(row.load).margin(1e-6));
    double before_height = 0, before_load = 0;
    for (int edges : {50, 100, 200}) {
      const Found found = solved(edges, row.shortening, 10);
      const double off_height = std::abs(found.height / length - height);
      const double off_load = std::abs(found.force / euler - load);
      if (before_height > 0) {
        CHECK(std::log2(before_height / off_height) == Approx(2).margin(0.1));
        CHECK(std::log2(before_load / off_load) == Approx(2).margin(0.1));
      }
      before_height = off_height;
      before_load = off_load;
    }
    CHECK(before_height < 1e-4);
  }
}

TEST_CASE("elastica: the discrete heights that other codes find") {
  CHECK(solved(26, 0.25, 10).height == Approx(73.720148).margin(2e-5));
  CHECK(solved(50, 0.25, 10).height == Approx(73.692392).margin(2e-5));
}
