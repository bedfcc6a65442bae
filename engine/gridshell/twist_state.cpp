// Moving a state of the twist rung: the reference frames go along.
#include "engine/gridshell/twist_model.h"
#include "engine/rod/frame.h"

namespace gridshell {
namespace {

Eigen::Vector3d tangent_of(const TwistModel& model, const Eigen::Matrix3Xd& x, int edge) {
  return (x.col(model.edges[edge].to) - x.col(model.edges[edge].from)).normalized();
}

void put_ghosts(const TwistModel& model, Eigen::Matrix3Xd& x) {
  const auto straight_on = [&](int ghost, int neighbour, bool at_end) {
    const TwistEdge& g = model.edges[ghost];
    const Eigen::Vector3d step = g.rest_length * tangent_of(model, x, neighbour);
    if (at_end)
      x.col(g.to) = x.col(g.from) + step;
    else
      x.col(g.from) = x.col(g.to) - step;
  };
  for (const TwistModel::Rod& rod : model.rods) {
    if (rod.ghost_begin >= 0) straight_on(rod.ghost_begin, rod.edges[1], false);
    if (rod.ghost_end >= 0) straight_on(rod.ghost_end, rod.edges[rod.edges.size() - 2], true);
  }
}

void carry_reference_twist(const TwistModel& model, TwistState& state) {
  for (std::size_t k = 0; k < model.bends.size(); ++k) {
    const auto [e, f] = std::pair(model.bends[k].e, model.bends[k].f);
    const double now = reference_twist(state.director.col(e), tangent_of(model, state.x, e),
                                       state.director.col(f), tangent_of(model, state.x, f));
    state.reference_twist[Eigen::Index(k)] = unwrapped(now, state.reference_twist[Eigen::Index(k)]);
  }
}

}  // namespace

TwistState start_twist_state(const TwistModel& model, const Eigen::Matrix3Xd& x) {
  TwistState state;
  state.x = Eigen::Matrix3Xd::Zero(3, model.nodes);
  state.x.leftCols(x.cols()) = x;
  if (x.cols() < model.nodes) put_ghosts(model, state.x);
  const Eigen::Index edges = Eigen::Index(model.edges.size());
  state.angle = Eigen::VectorXd::Zero(edges);
  state.director.resize(3, edges);
  state.reference_twist = Eigen::VectorXd::Zero(Eigen::Index(model.bends.size()));
  for (const TwistModel::Rod& rod : model.rods) {
    Eigen::Vector3d before = tangent_of(model, state.x, rod.edges.front());
    Eigen::Vector3d director = normal_near(rod.director, before);
    for (int edge : rod.edges) {
      const Eigen::Vector3d here = tangent_of(model, state.x, edge);
      director = carried_director(director, before, here);
      state.director.col(edge) = director;
      before = here;
    }
  }
  carry_reference_twist(model, state);
  return state;
}

void move_to(const TwistModel& model, const Eigen::Matrix3Xd& x, const Eigen::VectorXd& angle,
             TwistState& state) {
  for (int edge = 0; edge < int(model.edges.size()); ++edge)
    state.director.col(edge) = carried_director(
        state.director.col(edge), tangent_of(model, state.x, edge), tangent_of(model, x, edge));
  state.x = x;
  state.angle = angle;
  carry_reference_twist(model, state);
}

void set_end_direction(const TwistModel& model, int rod, bool at_end,
                       const Eigen::Vector3d& direction, TwistState& state) {
  const TwistModel::Rod& r = model.rods[rod];
  const TwistEdge& ghost = model.edges[at_end ? r.ghost_end : r.ghost_begin];
  Eigen::Matrix3Xd x = state.x;
  const Eigen::Vector3d step = ghost.rest_length * direction.normalized();
  if (at_end)
    x.col(ghost.to) = x.col(ghost.from) + step;
  else
    x.col(ghost.from) = x.col(ghost.to) - step;
  move_to(model, x, state.angle, state);
}

Eigen::Vector3d material_director(const TwistModel& model, const TwistState& state, int edge) {
  return halfway_frame(tangent_of(model, state.x, edge), state.director.col(edge),
                       state.angle[edge])
      .col(0);
}

double excess_twist(const TwistModel& model, const TwistState& state, int bend) {
  const TwistBend& b = model.bends[bend];
  return state.angle[b.f] - state.angle[b.e] + state.reference_twist[bend] - b.rest_twist;
}

}  // namespace gridshell
