#include "engine/solve/motion.h"

namespace gridshell {

void PinnedMotion::load_up(Linearisation& system, double t) const {
  system.outside.load = grown(load, t);
  system.outside.field_factor = grown(field, t);
}

void PinnedMotion::impose(Linearisation& system, double t, State& state) const {
  load_up(system, t);
  const Model& model = system.model();
  Eigen::Matrix3Xd x = state.x;
  for (int node = 0; node < model.nodes; ++node)
    if (model.pinned(node)) x.col(node) = at(t, node);
  for (const Hold& hold : system.holds())
    x.col(hold.node) += hold.part(at(t, hold.node) - x.col(hold.node));
  move_to(model, x, state);
}

void PinnedMotion::velocity(Linearisation& system, double t, const State& state,
                            State& velocity) const {
  Outside growing = system.outside;
  growing.load = speed(t) * load.change;
  growing.field_factor = speed(t) * field.change;
  system.tangent(speed(t) * change, growing, state, velocity.x);
  velocity.force = system.force_change(velocity.x);
}

}  // namespace gridshell
