#include "engine/gridshell/state_transfer.h"

#include "engine/core/knots.h"
#include "engine/rod/frame.h"

namespace gridshell {
namespace {

/// Where each edge of a rod stands along it: its middle, a ghost at the end point itself.
std::vector<double> places_along(const Model& model, const Model::Rod& rod) {
  std::vector<double> places;
  double s = 0;
  for (int edge : rod.edges) {
    const bool ghost = edge == rod.ghost_begin || edge == rod.ghost_end;
    const double length = ghost ? 0 : model.edges[std::size_t(edge)].rest_length;
    places.push_back(s + 0.5 * length);
    s += length;
  }
  return places;
}

/// Linear between known values, straight on beyond the ends.
double interpolated(const std::vector<double>& at, const std::vector<double>& value, double s) {
  if (at.size() == 1) return value.front();
  const std::size_t k = piece_at(at, s);
  const double share = (s - at[k]) / (at[k + 1] - at[k]);
  return value[k] + share * (value[k + 1] - value[k]);
}

Eigen::Vector3d tangent_of(const Model& model, const State& state, int edge) {
  const ModelEdge& e = model.edges[std::size_t(edge)];
  return (state.x.col(e.to) - state.x.col(e.from)).normalized();
}

/// the angle from the material director of an edge of `to` to that of an edge of `from`
double angle_between(const Model& from, const State& a, int edge_a, const Model& to, const State& b,
                     int edge_b) {
  const Eigen::Vector3d t = tangent_of(to, b, edge_b);
  return signed_angle(material_director(to, b, edge_b),
                      transport(material_director(from, a, edge_a), tangent_of(from, a, edge_a), t),
                      t);
}

}  // namespace

StateTransfer::StateTransfer(const RodMesh& from_mesh, const Model& from, const RodMesh& to_mesh,
                             const Model& to)
    : from_mesh_(from_mesh), to_mesh_(to_mesh), from_(from), to_(to), meshes_(from_mesh, to_mesh) {}

State StateTransfer::carry(const State& state) const {
  Eigen::Matrix3Xd nodes;
  meshes_.nodes(nodes_of(from_mesh_, from_, state.x), nodes);
  State carried = start_state(to_, columns_of(to_mesh_, to_, nodes));
  meshes_.edges(state.force, carried.force);
  if (to_.has_spins()) carry_spins(state, carried);
  return carried;
}

/// The carried frames are without twist along each rod, so angles there are the twist itself.
void StateTransfer::carry_spins(const State& state, State& carried) const {
  for (std::size_t r = 0; r < from_.rods.size(); ++r) {
    const Model::Rod &before = from_.rods[r], &after = to_.rods[r];
    const std::vector<double> at = places_along(from_, before);
    std::vector<double> turned{
        angle_between(from_, state, before.edges.front(), to_, carried, after.edges.front())};
    for (std::size_t k = 1; k < before.edges.size(); ++k)
      turned.push_back(turned.back() + twist_at(from_, state, before.first_bend + int(k) - 1));
    const std::vector<double> places = places_along(to_, after);
    const auto angle = [&](int edge) -> double& {
      return carried.x.data()[to_.spin[std::size_t(edge)]];
    };
    for (std::size_t k = 0; k < after.edges.size(); ++k)
      angle(after.edges[k]) = to_.spin_length * interpolated(at, turned, places[k]);
    for (const auto& [old_end, new_end] :
         {std::pair(before.ghost_begin, after.ghost_begin), {before.ghost_end, after.ghost_end}})
      if (new_end >= 0)
        angle(new_end) +=
            to_.spin_length * angle_between(from_, state, old_end, to_, carried, new_end);
  }
}

}  // namespace gridshell
