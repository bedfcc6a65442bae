#include "engine/design/design_shell.h"

#include "engine/core/try.h"
#include "engine/elastic/edge_energies.h"
#include "engine/elastic/state.h"
#include "engine/solve/eigenmodes.h"

namespace gridshell {
namespace {

EdgeGeometry geometry_of(const Eigen::Matrix3Xd& x, const ModelEdge& edge) {
  const Eigen::Vector3d along = x.col(edge.to) - x.col(edge.from);
  return {along.normalized(), along.norm()};
}

/// Sum of the natural lengths of the two edges at a bend; that of a ghost is 0.
double lengths_at(const Model& model, const ModelBend& bend) {
  return 2 * length_between(model, bend.e, bend.f);
}

double& stiffness_of(Model& model, int bend) {
  const auto end = law_of<EndBending>(model, bend);
  return end ? end->stiffness : model.bends[std::size_t(bend)].stiffness;
}

}  // namespace

DesignShell::DesignShell(const Scene& scene, RodMesh mesh)
    : scene_(scene), mesh_(std::move(mesh)) {}

Eigen::Matrix3Xd DesignShell::joints() const { return state_.x.leftCols(mesh_.joints); }

Result<std::unique_ptr<DesignShell>> DesignShell::make(const Scene& scene, int edges_per_segment,
                                                       const RodMesh& mesh, const Model& model,
                                                       const State& state, const Watch& watch) {
  std::unique_ptr<DesignShell> made(
      new DesignShell(scene, mesh_rods(scene.footprint, edges_per_segment)));
  TRY(built, build_model(made->mesh_, scene.rods, RodModel::bend));
  made->model_ = std::move(*built);
  made->ends_ = ends_of(scene);
  made->diameter_ = made->ends_.diameter;
  made->state_ = mesh.edges_per_segment == edges_per_segment
                     ? state
                     : StateTransfer(mesh, model, made->mesh_, made->model_).carry(state);
  made->system_ = std::make_unique<Linearisation>(made->model_);
  made->find_legs();
  TRY_DO(made->settle(made->ends_, 0.5 * scene.footprint.spacing, watch));
  return made;
}

void DesignShell::find_legs() {
  legs_.resize(std::size_t(mesh_.edge_points));
  for (std::size_t r = 0; r < model_.rods.size(); ++r) {
    const Model::Rod& rod = model_.rods[r];
    const auto& joints = scene_.footprint.rods[r].joints;
    for (const int side : {0, 1}) {
      Leg& leg = legs_[2 * r + std::size_t(side)];
      if (!scene_.rods.weight_N_per_mm.empty())
        leg.weight_N_per_mm = scene_.rods.weight_N_per_mm[r];
      const int edge_point = mesh_.joints + int(2 * r) + side;
      const int first = side == 0 ? edge_point : joints.back(),
                last = side == 0 ? joints.front() : edge_point;
      bool inside = false;
      for (const int k : rod.edges) {
        const ModelEdge& edge = model_.edges[std::size_t(k)];
        if (edge.from == first) inside = true;
        if (inside) leg.edges.push_back(k);
        if (edge.to == last) inside = false;
      }
      leg.at_end = side == 0 ? leg.edges.front() : leg.edges.back();
      const auto& nodes = mesh_.rods[r];
      const int outer = side == 0 ? nodes.front() : nodes.back();
      if (mesh_.is_ghost(outer)) leg.ghost = outer;
      if (!mesh_.far_ends.empty()) leg.far = mesh_.far_ends[2 * r + std::size_t(side)];
    }
  }
  for (Leg& leg : legs_)
    for (std::size_t k = 0; k < model_.bends.size(); ++k)
      if (leg.edges_of(model_.bends[k]) > 0) leg.bends.push_back(int(k));
  std::vector<std::size_t> rod_of(model_.edges.size(), 0);
  for (std::size_t r = 0; r < model_.rods.size(); ++r)
    for (const int edge : model_.rods[r].edges) rod_of[std::size_t(edge)] = r;
  bends_.resize(model_.rods.size());
  for (std::size_t k = 0; k < model_.bends.size(); ++k)
    bends_[rod_of[std::size_t(model_.bends[k].e)]].push_back(int(k));
}

/// Sets the diameters of the model: EA grows with the square of a diameter, EI with its fourth
/// power.
void DesignShell::set_diameters(const ShellEnds& ends) {
  for (std::size_t r = 0; r < model_.rods.size(); ++r) {
    double& now = diameter_[Eigen::Index(r)];
    const double requested = ends.diameter[Eigen::Index(r)];
    if (requested == now) continue;
    const double square = requested * requested / (now * now);
    for (const int edge : model_.rods[r].edges) model_.edges[std::size_t(edge)].EA *= square;
    for (const int bend : bends_[r]) stiffness_of(model_, bend) *= square * square;
    now = requested;
  }
}

/// Sets the lengths of the legs, distributed evenly over their edges, and with them their weight at
/// the nodes (dead_loads()).
void DesignShell::set_legs(const ShellEnds& ends) {
  for (std::size_t k = 0; k < legs_.size(); ++k) {
    const Leg& leg = legs_[k];
    const double fraction = ends.leg[Eigen::Index(k)] / double(leg.edges.size());
    if (model_.edges[std::size_t(leg.edges.front())].rest_length == fraction) continue;
    std::vector<double> before;
    for (const int bend : leg.bends)
      before.push_back(lengths_at(model_, model_.bends[std::size_t(bend)]));
    for (const int number : leg.edges) {
      ModelEdge& edge = model_.edges[std::size_t(number)];
      const double weight = 0.5 * leg.weight_N_per_mm * (fraction - edge.rest_length);
      for (const int node : {edge.from, edge.to})
        if (weight != 0) model_.loads[std::size_t(node)].force.z() -= weight;
      edge.rest_length = fraction;
    }
    for (std::size_t b = 0; b < leg.bends.size(); ++b)
      stiffness_of(model_, leg.bends[b]) *=
          before[b] / lengths_at(model_, model_.bends[std::size_t(leg.bends[b])]);
  }
}

void DesignShell::impose(const ShellEnds& ends, Eigen::Matrix3Xd& x) const {
  for (Eigen::Index k = 0; k < ends.at.cols(); ++k) {
    const Leg& leg = legs_[std::size_t(k)];
    if (model_.pinned(mesh_.joints + int(k))) x.col(mesh_.joints + k) = ends.at.col(k);
    const double side = k % 2 == 0 ? -1 : 1;
    if (leg.ghost >= 0)
      x.col(leg.ghost) = ends.at.col(k) + side * mesh_.ghost_length * ends.direction.col(k);
    if (leg.far >= 0)
      x.col(leg.far) = scene_.motion.end_far.col(k) + ends.at.col(k) - scene_.motion.end.col(k);
  }
}

void DesignShell::back_to(const ShellPosition& to) {
  set_legs(to.ends);
  set_diameters(to.ends);
  state_ = to.state;
  ends_ = to.ends;
  system_->at(state_, false);
}

/// Sets the ends and finds the equilibrium by Newton's method from the current positions. Errors:
/// no_equilibrium, cancelled.
Result<void> DesignShell::settle(const ShellEnds& ends, double farthest_mm, const Watch& watch) {
  const auto failed = [](const std::string& why) { return fail(Fault::no_equilibrium, why); };
  set_legs(ends);
  set_diameters(ends);
  impose(ends, state_.x);
  const Eigen::Matrix3Xd from = state_.x;
  NewtonOptions options;
  options.tolerance_mm = 1e-8;
  const NewtonReport report = newton(*system_, state_, options, watch);
  if (report.outcome == Outcome::cancelled) return stopped();
  if (report.outcome != Outcome::reached) return failed(words_of(report.outcome).what);
  if (max_column_norm(state_.x - from) > farthest_mm) return failed("the state jumped");
  if (!system_->at(state_, false).positive_definite()) return failed("the state is not stable");
  ends_ = ends;
  return {};
}

Result<void> DesignShell::move(const ShellEnds& ends, double farthest_mm, const Watch& watch) {
  const ShellPosition before = position();
  Eigen::Matrix3Xd there = state_.x;
  impose(ends, there);
  const Eigen::Matrix3Xd dx =
      follow({there - state_.x, ends.leg - ends_.leg,
              (ends.diameter.array() / ends_.diameter.array()).log().matrix()});
  state_.force += system_->force_change(dx);
  state_.x += dx;
  auto settled = settle(ends, farthest_mm, watch);
  if (!settled) back_to(before);
  return settled;
}

Result<void> DesignShell::move_in_steps(const ShellEnds& ends, double farthest_mm,
                                        const Watch& watch) {
  constexpr double shortest = 1.0 / 64;
  const ShellPosition before = position();
  double at = 0, step = 1;
  while (at < 1) {
    const double next = std::min(1.0, at + step);
    ShellEnds there = ends;
    if (next < 1) {
      there.at = before.ends.at + next * (ends.at - before.ends.at);
      there.leg = before.ends.leg + next * (ends.leg - before.ends.leg);
      there.direction = before.ends.direction + next * (ends.direction - before.ends.direction);
      for (auto direction : there.direction.colwise()) direction.normalize();
      there.diameter = before.ends.diameter + next * (ends.diameter - before.ends.diameter);
    }
    const auto moved = move(there, farthest_mm, watch);
    if (moved) {
      at = next;
      step *= 2;
      continue;
    }
    step /= 2;
    if (step >= shortest && !watch.cancelled()) continue;
    back_to(before);
    return moved;
  }
  return {};
}

/// First-order change of all columns: dx = -H^-1 dg, plus the prescribed displacements.
Eigen::Matrix3Xd DesignShell::follow(const Change& change) const {
  Eigen::Matrix3Xd x;
  multiply(model_, system_->assembly().hessian, change.prescribed, x);
  x *= -1;
  for (int end = 0; end < mesh_.edge_points; ++end)
    if (change.longer[end] != 0) add_leg_gradient(end, change.longer[end], x);
  for (std::size_t r = 0; r < model_.rods.size(); ++r)
    if (const double thicker = change.thicker[Eigen::Index(r)]; thicker != 0)
      add_diameter_gradient(r, thicker, x);
  system_->solve(x);
  return x + change.prescribed;
}

/// Adds -dg/d(ln diameter) = -(4 g_bend + 2 g_stretch) of a rod, times `change`.
void DesignShell::add_diameter_gradient(std::size_t rod, double change,
                                        Eigen::Matrix3Xd& minus_dg) const {
  for (const int k : model_.rods[rod].edges) {
    const ModelEdge& edge = model_.edges[std::size_t(k)];
    if (edge.EA == 0) continue;  // a ghost edge
    const EdgeGeometry g = geometry_of(state_.x, edge);
    const Eigen::Vector3d pull =
        2 * change * edge.EA * (g.length / edge.rest_length - 1) * g.tangent;
    minus_dg.col(edge.to) -= pull;
    minus_dg.col(edge.from) += pull;
  }
  for (const int k : bends_[rod]) add_bend_gradient(k, -4 * change, minus_dg);
}

/// Adds `fraction` times the gradient of a bend to minus_dg.
void DesignShell::add_bend_gradient(int k, double fraction, Eigen::Matrix3Xd& minus_dg) const {
  const ModelBend& bend = model_.bends[std::size_t(k)];
  const ModelEdge &e = model_.edges[std::size_t(bend.e)], &f = model_.edges[std::size_t(bend.f)];
  const EdgeGeometry at_e = geometry_of(state_.x, e), at_f = geometry_of(state_.x, f);
  BendEnergy energy;
  if (const auto end = law_of<EndBending>(model_, k)) {
    PairGeometry at;
    PairEnergy pair;
    at.e = at_e, at.f = at_f;
    end->add(at, pair);
    energy.gradient_e = pair.gradient.head<3>(), energy.gradient_f = pair.gradient.segment<3>(3);
  } else {
    bend_gradient(bend.stiffness, at_e, at_f, energy);
  }
  minus_dg.col(e.from) -= fraction * energy.gradient_e;
  minus_dg.col(e.to) += fraction * (energy.gradient_e - energy.gradient_f);
  minus_dg.col(f.to) += fraction * energy.gradient_f;
}

/// Adds -dg/dl of each edge of a leg, times its fraction of the leg's change: a longer edge reduces
/// the pull on its two nodes by EA |e|/l^2, adds half of its weight per length to each, and reduces
/// the stiffness of every adjacent bend by the fraction 1/(2 l_v), l_v being the mean natural
/// length there.
void DesignShell::add_leg_gradient(int end, double change, Eigen::Matrix3Xd& minus_dg) const {
  const Leg& leg = legs_[std::size_t(end)];
  const double fraction = change / double(leg.edges.size());
  for (const int k : leg.edges) {
    const ModelEdge& edge = model_.edges[std::size_t(k)];
    const EdgeGeometry g = geometry_of(state_.x, edge);
    const Eigen::Vector3d pull =
        fraction * edge.EA * g.length / (edge.rest_length * edge.rest_length) * g.tangent;
    minus_dg.col(edge.to) += pull;
    minus_dg.col(edge.from) -= pull;
    for (const int node : {edge.from, edge.to})
      minus_dg(2, node) -= 0.5 * fraction * leg.weight_N_per_mm;
  }
  for (const int k : leg.bends) {
    const ModelBend& bend = model_.bends[std::size_t(k)];
    const double longer = fraction * leg.edges_of(bend);
    add_bend_gradient(k, longer / lengths_at(model_, bend), minus_dg);
  }
}

Sensitivity DesignShell::sensitivity(const std::vector<DesignVariable>& variables,
                                     const std::vector<DesignVariables::Rate>& rates,
                                     const Eigen::MatrixXd& changes, const Watch& watch) {
  Sensitivity found;
  found.leg_force = Eigen::MatrixXd::Zero(mesh_.edge_points, changes.cols());
  for (Eigen::Index c = 0; c < changes.cols() && !watch.cancelled(); ++c) {
    Eigen::Matrix3Xd prescribed = Eigen::Matrix3Xd::Zero(3, model_.columns());
    Eigen::VectorXd longer = Eigen::VectorXd::Zero(mesh_.edge_points),
                    thicker = Eigen::VectorXd::Zero(mesh_.edge_points / 2);
    for (std::size_t k = 0; k < variables.size(); ++k) {
      const double change = changes(Eigen::Index(k), c);
      if (change == 0) continue;
      const int end = variables[k].end;
      const Leg& leg = legs_[std::size_t(end)];
      prescribed.col(mesh_.joints + end) += change * rates[k].at;
      if (leg.far >= 0) prescribed.col(leg.far) += change * rates[k].at;
      const double side = end % 2 == 0 ? -1 : 1;
      if (leg.ghost >= 0)
        prescribed.col(leg.ghost) +=
            change * (rates[k].at + side * mesh_.ghost_length * rates[k].direction);
      longer[end] += change * rates[k].leg;
      thicker[end / 2] += change * rates[k].ln_diameter;
    }
    Eigen::Matrix3Xd x = follow({prescribed, longer, thicker});
    for (int end = 0; end < mesh_.edge_points; ++end) {
      const Leg& leg = legs_[std::size_t(end)];
      const ModelEdge& edge = model_.edges[std::size_t(leg.at_end)];
      const EdgeGeometry g = geometry_of(state_.x, edge);
      const double l = edge.rest_length, longer_edge = longer[end] / double(leg.edges.size());
      found.leg_force(end, c) =
          edge.EA * (g.tangent.dot(x.col(edge.to) - x.col(edge.from)) / l -
                     g.length / (l * l) * longer_edge + 2 * thicker[end / 2] * (g.length / l - 1));
    }
    found.x.push_back(std::move(x));
  }
  return found;
}

Eigen::VectorXd DesignShell::leg_forces() const {
  Eigen::VectorXd forces(mesh_.edge_points);
  for (int end = 0; end < mesh_.edge_points; ++end) {
    const ModelEdge& edge = model_.edges[std::size_t(legs_[std::size_t(end)].at_end)];
    forces[end] = edge.EA * (geometry_of(state_.x, edge).length / edge.rest_length - 1);
  }
  return forces;
}

double DesignShell::smallest_eigenvalue(const Watch& watch) {
  const Eigen::VectorXd length = lumped(mesh_, std::vector<double>(mesh_.rods.size(), 1.0));
  Eigen::Matrix3Xd weight = Eigen::Matrix3Xd::Zero(3, model_.columns());
  weight.leftCols(length.size()).rowwise() = length.transpose();
  const auto softest = softest_modes(*system_, weight, 1, 0, watch);
  return softest ? softest->values[0] : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace gridshell
