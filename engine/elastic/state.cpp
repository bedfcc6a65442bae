#include "engine/elastic/state.h"

#include <cmath>

#include "engine/core/algorithms.h"
#include "engine/elastic/along_rods.h"
#include "engine/elastic/edge_energies.h"
#include "engine/elastic/model.h"
#include "engine/elastic/rod_frame.h"

namespace gridshell {
namespace {

Eigen::Vector3d tangent_of(const Model& model, const Eigen::Matrix3Xd& x, int edge) {
  const ModelEdge& e = model.edges[std::size_t(edge)];
  return (x.col(e.to) - x.col(e.from)).normalized();
}

Eigen::Matrix3Xd tangents_of(const Model& model, const Eigen::Matrix3Xd& x) {
  Eigen::Matrix3Xd tangents(3, Eigen::Index(model.edges.size()));
  for (int edge = 0; edge < int(model.edges.size()); ++edge)
    tangents.col(edge) = tangent_of(model, x, edge);
  return tangents;
}

/// Moves the ghost's node to one edge length past the end, along `direction`.
void put_ghost(const Model& model, int ghost, bool at_end, const Eigen::Vector3d& direction,
               Eigen::Matrix3Xd& x) {
  const ModelEdge& edge = model.edges[std::size_t(ghost)];
  const Eigen::Vector3d step = edge.rest_length * direction;
  if (at_end)
    x.col(edge.to) = x.col(edge.from) + step;
  else
    x.col(edge.from) = x.col(edge.to) - step;
}

void put_ghosts(const Model& model, Eigen::Matrix3Xd& x) {
  for (const Model::Rod& rod : model.rods) {
    if (rod.ghost_begin >= 0)
      put_ghost(model, rod.ghost_begin, false, tangent_of(model, x, rod.edges[1]), x);
    if (rod.ghost_end >= 0)
      put_ghost(model, rod.ghost_end, true, tangent_of(model, x, rod.edges[rod.edges.size() - 2]),
                x);
  }
}

void carry_reference_twist(const Model& model, const Eigen::Matrix3Xd& tangents, State& state) {
  for (std::size_t k = 0; k < model.bends.size(); ++k) {
    const int e = model.bends[k].e, f = model.bends[k].f;
    const double now = reference_twist(state.director.col(e), tangents.col(e),
                                       state.director.col(f), tangents.col(f));
    double& known = state.reference_twist[Eigen::Index(k)];
    known = unwrapped(now, known);
  }
}

/// First directors of frames without twist along each rod, starting with the rod's director.
Eigen::Matrix3Xd start_directors(const Model& model, const Eigen::Matrix3Xd& tangents) {
  Eigen::Matrix3Xd directors(3, tangents.cols());
  for (const Model::Rod& rod : model.rods) {
    int before = rod.edges.front();
    Eigen::Vector3d director = normal_near(rod.director, tangents.col(before));
    for (int edge : rod.edges) {
      director = carried_director(director, tangents.col(before), tangents.col(edge));
      directors.col(edge) = director;
      before = edge;
    }
  }
  return directors;
}

/// Sets the first directors of hinged edges to the joints' normals. Of the two normals it takes the
/// one nearer to the present director, so that the angle of a joint that closes becomes negative.
void put_normals(const Model& model, const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& director) {
  for (const auto& [pair, other_half, stiffness, blocks] : model.hinges) {
    const Eigen::Vector3d normal =
        tangent_of(model, x, pair.e).cross(tangent_of(model, x, pair.f)).normalized();
    const double side = std::copysign(1.0, normal.dot(director.col(pair.e)));
    for (const int half : {pair.e, other_half})
      if (half >= 0) director.col(half) = side * normal;
  }
}

/// Moves the ends of centred edges so that their joints are in the middle.
void centre(const Model& model, Eigen::Matrix3Xd& x) {
  for (const auto& [node, middle, first, blocks] : model.followers)
    x.col(first) = x.col(middle) - 0.5 * (x.col(node) - x.col(first));
  model.follow(x);
}

/// The position of each edge along a rod, mm: that of its middle; for a ghost edge the end point.
std::vector<double> positions_along(const Model& model, const Model::Rod& rod) {
  std::vector<double> positions;
  double s = 0;
  for (int edge : rod.edges) {
    const bool ghost = edge == rod.ghost_begin || edge == rod.ghost_end;
    const ModelEdge& one = model.edges[std::size_t(edge)];
    const double length = ghost ? 0 : one.rest_length;
    // half of a centred edge is at the joint
    positions.push_back(s + (one.centre < 0 ? 0.5 : one.centre == one.to ? 1.0 : 0.0) * length);
    s += length;
  }
  return positions;
}

/// Linear interpolation between known values, extrapolated past the ends.
double interpolated(const std::vector<double>& at, const std::vector<double>& value, double s) {
  if (at.size() == 1) return value.front();
  const std::size_t k = piece_at(at, s);
  if (at[k + 1] == at[k]) return value[k];
  const double fraction = (s - at[k]) / (at[k + 1] - at[k]);
  return value[k] + fraction * (value[k + 1] - value[k]);
}

/// m1 of an edge.
Eigen::Vector3d material_director(const Model& model, const State& state, int edge) {
  return halfway_frame(tangent_of(model, state.x, edge), state.director.col(edge),
                       model.angle(state.x, edge))
      .col(0);
}

/// The angle from the material director of an edge of `to` to that of an edge of `from`, rad.
double angle_between(const Model& from, const State& a, int edge_a, const Model& to, const State& b,
                     int edge_b) {
  const Eigen::Vector3d t = tangent_of(to, b.x, edge_b);
  return signed_angle(
      material_director(to, b, edge_b),
      transport(material_director(from, a, edge_a), tangent_of(from, a.x, edge_a), t), t);
}

/// The rod of every bend; those that close rings come last, in the order of their rods.
std::vector<const Model::Rod*> rods_of_bends(const Model& model) {
  std::vector<const Model::Rod*> rods, closed;
  for (const Model::Rod& rod : model.rods) {
    rods.insert(rods.end(), rod.edges.size() - 1, &rod);
    if (rod.closed) closed.push_back(&rod);
  }
  rods.insert(rods.end(), closed.begin(), closed.end());
  return rods;
}

/// tau of a bend in the twist model: from e's material frame to f's, rad.
double twist_at(const Model& model, const State& state, int bend) {
  const ModelBend& b = model.bends[std::size_t(bend)];
  return model.angle(state.x, b.f) - model.angle(state.x, b.e) + state.reference_twist[bend];
}

}  // namespace

State start_state(const Model& model, const Eigen::Matrix3Xd& x) {
  State state{Eigen::Matrix3Xd::Zero(3, model.columns()), Eigen::VectorXd::Zero(model.forces())};
  state.x.leftCols(x.cols()) = x;
  centre(model, state.x);
  if (x.cols() < model.nodes) put_ghosts(model, state.x);
  if (!model.has_spins()) return state;
  state.reference_twist = Eigen::VectorXd::Zero(Eigen::Index(model.bends.size()));
  const Eigen::Matrix3Xd tangents = tangents_of(model, state.x);
  state.director = start_directors(model, tangents);
  for (const ModelHinge& hinge : model.hinges)
    state.director.col(hinge.pair.e) =
        hinge.pair.law.side * tangents.col(hinge.pair.e).cross(tangents.col(hinge.pair.f));
  put_normals(model, state.x, state.director);
  carry_reference_twist(model, tangents, state);
  return state;
}

bool is_closed(const Model& model, const State& state, const ModelHinge& hinge) {
  const auto& [e, f, bend, law, slots] = hinge.pair;
  const Eigen::Vector3d across = tangent_of(model, state.x, e).cross(tangent_of(model, state.x, f));
  return law.side * state.director.col(e).dot(across) < 0;
}

void move_to(const Model& model, const Eigen::Matrix3Xd& x, State& state) {
  if (!model.has_spins()) {
    state.x = x;
    model.follow(state.x);
    return;
  }
  const Eigen::Matrix3Xd before = tangents_of(model, state.x);
  state.x = x;
  model.follow(state.x);
  const Eigen::Matrix3Xd after = tangents_of(model, state.x);
  for (int edge = 0; edge < int(model.edges.size()); ++edge)
    state.director.col(edge) =
        carried_director(state.director.col(edge), before.col(edge), after.col(edge));
  put_normals(model, state.x, state.director);
  carry_reference_twist(model, after, state);
}

void set_end_direction(const Model& model, int rod, bool at_end, const Eigen::Vector3d& direction,
                       State& state) {
  const Model::Rod& r = model.rods[std::size_t(rod)];
  Eigen::Matrix3Xd x = state.x;
  put_ghost(model, at_end ? r.ghost_end : r.ghost_begin, at_end, direction.normalized(), x);
  move_to(model, x, state);
}

StateTransfer::StateTransfer(const RodMesh& from_mesh, const Model& from, const RodMesh& to_mesh,
                             const Model& to)
    : from_mesh_(from_mesh), to_mesh_(to_mesh), from_(from), to_(to), meshes_(from_mesh, to_mesh) {}

State StateTransfer::carry(const State& state) const {
  Eigen::Matrix3Xd nodes;
  meshes_.nodes(nodes_of(from_mesh_, from_, state.x), nodes);
  State carried = start_state(to_, columns_of(to_mesh_, to_, nodes));
  Eigen::VectorXd axial;
  meshes_.edges(state.force, axial);
  // torques belong to the springs of joints: another number of them are other springs
  const Eigen::Index torques = to_.forces() - axial.size();
  carried.force.head(axial.size()) = axial;
  if (from_.forces() - Eigen::Index(from_.edges.size()) == torques)
    carried.force.tail(torques) = state.force.tail(torques);
  if (!to_.has_spins()) return carried;
  for (std::size_t k = 0; k < std::min(from_.hinges.size(), to_.hinges.size()); ++k) {
    if (!is_closed(from_, state, from_.hinges[k])) continue;
    for (const int half : {to_.hinges[k].pair.e, to_.hinges[k].other_half})
      if (half >= 0) carried.director.col(half) *= -1;
  }
  carry_reference_twist(to_, tangents_of(to_, carried.x), carried);
  carry_spins(state, carried);
  return carried;
}

/// Transfers the angles. The transferred frames have no twist along each rod, so angles are the
/// twist itself, except for hinged edges: to their angle from the joint's normal the angle between
/// the normal and the frame without twist is added.
void StateTransfer::carry_spins(const State& state, State& carried) const {
  std::vector<double> off(to_.edges.size(), 0);
  const Eigen::Matrix3Xd tangents = tangents_of(to_, carried.x);
  Eigen::Matrix3Xd plain = start_directors(to_, tangents);
  for (const ModelHinge& hinge : to_.hinges)
    for (const int half : {hinge.pair.e, hinge.other_half})
      if (half >= 0)
        off[std::size_t(half)] =
            signed_angle(carried.director.col(half), plain.col(half), tangents.col(half));
  for (std::size_t r = 0; r < from_.rods.size(); ++r) {
    const Model::Rod &before = from_.rods[r], &after = to_.rods[r];
    const std::vector<double> at = positions_along(from_, before);
    std::vector<double> turned{
        angle_between(from_, state, before.edges.front(), to_, carried, after.edges.front()) -
        off[std::size_t(after.edges.front())]};
    for (std::size_t k = 1; k < before.edges.size(); ++k)
      turned.push_back(turned.back() + twist_at(from_, state, before.first_bend + int(k) - 1));
    const std::vector<double> positions = positions_along(to_, after);
    const auto angle = [&](int edge) -> double& {
      return carried.x.data()[to_.spin[std::size_t(edge)]];
    };
    for (std::size_t k = 0; k < after.edges.size(); ++k)
      angle(after.edges[k]) = to_.spin_length * (interpolated(at, turned, positions[k]) +
                                                 off[std::size_t(after.edges[k])]);
    for (const auto& [old_end, new_end] :
         {std::pair(before.ghost_begin, after.ghost_begin), {before.ghost_end, after.ghost_end}})
      if (new_end >= 0)
        angle(new_end) +=
            to_.spin_length * angle_between(from_, state, old_end, to_, carried, new_end);
  }
  if (to_.hinges.empty()) return;
  for (const ModelHinge& hinge : to_.hinges) {
    double& spin = carried.x.data()[to_.spin[std::size_t(hinge.pair.e)]];
    spin = to_.spin_length * std::remainder(spin / to_.spin_length, 2 * M_PI);
    if (hinge.stiffness == 0) spin = 0;
  }
  // between adjacent edges a rod twists by less than half a turn
  for (std::size_t k = 0; k < to_.bends.size(); ++k) {
    double& known = carried.reference_twist[Eigen::Index(k)];
    known = unwrapped(known, known - twist_at(to_, carried, int(k)));
  }
}

Eigen::Matrix3Xd columns_of(const RodMesh& mesh, const Model& model,
                            const Eigen::Matrix3Xd& nodes) {
  Eigen::Matrix3Xd columns = Eigen::Matrix3Xd::Zero(3, model.columns());
  columns.leftCols(mesh.nodes()) = nodes;
  if (model.nodes > mesh.nodes())
    columns.middleCols(mesh.nodes(), mesh.joints) = nodes.leftCols(mesh.joints);
  return columns;
}

Eigen::Matrix3Xd nodes_of(const RodMesh& mesh, const Model& model,
                          const Eigen::Matrix3Xd& columns) {
  Eigen::Matrix3Xd nodes = columns.leftCols(mesh.nodes());
  if (model.nodes > mesh.nodes())
    nodes.leftCols(mesh.joints) =
        0.5 * (nodes.leftCols(mesh.joints) + columns.middleCols(mesh.nodes(), mesh.joints));
  return nodes;
}

// Energies and bending strains of a state, without derivatives.

Eigen::VectorXd bending_of(const Model& model, const State& state) {
  Eigen::VectorXd energy(Eigen::Index(model.bends.size()));
  for (const Model::Rod& rod : model.rods)
    along_rod(
        model, rod, state.x, [](int, const ModelEdge&, const EdgeGeometry&) {},
        [&](int k, const ModelBend& bend, const EdgeGeometry& e, const EdgeGeometry& f) {
          energy[k] = bend_value(bend.stiffness, e, f);
        });
  each_pair_list(model, [&]<class Law>(const std::vector<Pair<Law>>& list) {
    if constexpr (Law::term == Term::bend)
      for (const Pair<Law>& pair : list)
        energy[pair.bend] += pair.law.value(pair_geometry(model, state, pair));
  });
  return energy;
}

Eigen::VectorXd bending_strain_of(const Model& model, const State& state) {
  Eigen::VectorXd strain(Eigen::Index(model.bends.size()));
  const auto rods = rods_of_bends(model);
  for (const Model::Rod& rod : model.rods)
    along_rod(
        model, rod, state.x, [](int, const ModelEdge&, const EdgeGeometry&) {},
        [&](int k, const ModelBend& bend, const EdgeGeometry& e, const EdgeGeometry& f) {
          const double turn = curvature_binormal(e.tangent, f.tangent).kb.norm();
          strain[k] = rod.fibres.strain(turn / length_between(model, bend.e, bend.f));
        });
  const auto put = [&]<class Law>(const Pair<Law>& pair, const auto& bent) {
    strain[pair.bend] =
        rods[std::size_t(pair.bend)]->fibres.strain(bent / length_between(model, pair.e, pair.f));
  };
  for (const auto& pair : std::get<std::vector<Pair<SectionBending>>>(model.pairs))
    put(pair, pair.law.bend.bent(pair.law.excess(pair_geometry(model, state, pair))));
  // E = k/4 (curvature times length)^2
  for (const auto& pair : std::get<std::vector<Pair<EndBending>>>(model.pairs))
    put(pair,
        2 * std::sqrt(pair.law.value(pair_geometry(model, state, pair)) / pair.law.stiffness));
  return strain;
}

Energies energies_of(const Model& model, const State& state, const ExternalLoads& outside) {
  Energies sum;
  for (const Model::Rod& rod : model.rods)
    along_rod(
        model, rod, state.x,
        [&](int, const ModelEdge& edge, const EdgeGeometry& g) {
          sum[Term::stretch] += stretch(edge.EA, edge.rest_length, g.length).value;
        },
        [&](int, const ModelBend& bend, const EdgeGeometry& e, const EdgeGeometry& f) {
          sum[Term::bend] += bend_value(bend.stiffness, e, f);
        });
  each_pair(model, [&]<class Law>(const Pair<Law>& pair) {
    sum[Law::term] += pair.law.value(pair_geometry(model, state, pair));
  });
  add_joint_energies(model, state, outside.opening, sum);
  for (const ModelSpring& spring : model.springs)
    sum[spring.law.term] += spring.law.value(gap_of(state, spring.law));
  for (const ModelBar& bar : model.bars)
    sum[Term::stretch] +=
        bar.law.value(bar.law.strain(geometry_between(state.x, bar.law.a, bar.law.b).length));
  each_action(model, outside, [&](const NodeAction& action, double factor) {
    sum[action.term] += factor * action.value(state.x);
  });
  each_contact(model, state.x, false,
               [&](const EdgeContact& contact) { sum[Term::contact] += contact.energy; });
  return sum;
}

}  // namespace gridshell
