#include "engine/solve/dynamics.h"

#include <fmt/format.h>

#include <cmath>

namespace gridshell {

double round_mass_t_per_mm(double density_kg_m3, double diameter_mm) {
  // 1 kg/m^3 = 1e-12 t/mm^3
  return 1e-12 * density_kg_m3 * M_PI * diameter_mm * diameter_mm / 4;
}

Result<Eigen::Matrix3Xd> lumped_mass(const Model& model, const std::vector<double>& mass_t_per_mm) {
  for (double mass : mass_t_per_mm)
    if (!(mass > 0))
      return fail(Fault::bad_input,
                  fmt::format("{} t/mm: motion in time needs a mass, above 0; give the rods' "
                              "density and diameter",
                              mass));
  Eigen::Matrix3Xd mass = Eigen::Matrix3Xd::Zero(3, model.columns());
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    const double per_mm = mass_t_per_mm.size() == 1 ? mass_t_per_mm[0] : mass_t_per_mm[r];
    for (int edge : model.rods[r].edges) {
      const ModelEdge& e = model.edges[std::size_t(edge)];
      const double own = per_mm * e.rest_length;
      if (model.has_spins())
        mass.data()[model.spin[std::size_t(edge)]] +=
            own * model.rods[r].gyration_mm2 / (model.spin_length * model.spin_length);
      if (e.EA == 0) continue;  // a ghost shows a direction and weighs nothing
      for (int node : {e.from, e.to}) mass.col(node).array() += 0.5 * own;
    }
  }
  return mass;
}

double kinetic_energy(const Eigen::Matrix3Xd& mass, const MovingState& moving) {
  return 0.5 * (mass.array() * moving.velocity.array().square()).sum();
}

}  // namespace gridshell
