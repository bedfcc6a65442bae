#include "engine/gridshell/twist_model.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace gridshell {
namespace {

Result<void> check(int index, int nodes, const TwistRod& rod) {
  const auto wrong = [&](const std::string& what) {
    return fail(Fault::bad_input, fmt::format("rod {}: {}", index, what));
  };
  const RodMaterial& m = rod.material;
  if (rod.position.size() != rod.nodes.size() && !rod.closed())
    return wrong(fmt::format("{} nodes and {} arc lengths", rod.nodes.size(), rod.position.size()));
  if (rod.nodes.size() < 2) return wrong("has no edge");
  for (int node : rod.nodes)
    if (node < 0 || node >= nodes)
      return wrong(fmt::format("node {} does not exist, there are {}", node, nodes));
  for (std::size_t k = 1; k < rod.position.size(); ++k)
    if (!(rod.position[k] > rod.position[k - 1]))
      return wrong(fmt::format("arc lengths must ascend, {} follows {}", rod.position[k],
                               rod.position[k - 1]));
  if (!(m.EA > 0)) return wrong(fmt::format("EA = {} N, must be above 0", m.EA));
  if (!(m.EI1 > 0 && m.EI2 > 0))
    return wrong(fmt::format("EI = {}, {} N mm^2, must be above 0", m.EI1, m.EI2));
  if (!(m.GJ > 0))
    return wrong(fmt::format(
        "GJ = {} N mm^2, must be above 0: the twist rung needs the torsional stiffness", m.GJ));
  if (!m.curvature.allFinite() || !std::isfinite(m.twist))
    return wrong("curvature or twist at rest is not finite");
  if (rod.closed() && (rod.begin != RodEnd::free || rod.end != RodEnd::free))
    return wrong("a closed rod has no ends to hold");
  return {};
}

/// One rod's edges and bends into the model; ghost nodes are numbered from `next_ghost`.
class RodBuilder {
 public:
  RodBuilder(TwistModel& model, const TwistRod& rod, int& next_ghost)
      : model_(model), rod_(rod), next_ghost_(next_ghost) {
    entry_.closed = rod.closed();
    entry_.director = rod.director;
  }

  TwistModel::Rod build() {
    const auto& s = rod_.position;
    const int edges = int(s.size()) - 1;
    if (holds_direction(rod_.begin)) {
      const int node = next_ghost_++;
      entry_.ghost_begin = add_edge(node, rod_.nodes.front(), s[1] - s[0], 0);
    }
    for (int k = 0; k < edges; ++k)
      add_edge(rod_.nodes[k], rod_.nodes[(k + 1) % rod_.nodes.size()], s[k + 1] - s[k],
               rod_.material.EA);
    if (holds_direction(rod_.end)) {
      const int node = next_ghost_++;
      entry_.ghost_end = add_edge(rod_.nodes.back(), node, s[edges] - s[edges - 1], 0);
    }
    for (std::size_t k = 1; k < entry_.edges.size(); ++k)
      add_bend(entry_.edges[k - 1], entry_.edges[k]);
    if (entry_.closed) add_bend(entry_.edges.back(), entry_.edges.front());
    return std::move(entry_);
  }

 private:
  int add_edge(int from, int to, double length, double EA) {
    const int edge = int(model_.edges.size());
    model_.edges.push_back({from, to, length, EA});
    entry_.edges.push_back(edge);
    return edge;
  }

  void add_bend(int e, int f) {
    const RodMaterial& m = rod_.material;
    // at a held end only the half edge on the rod's side bends
    const double before = e == entry_.ghost_begin ? 0 : model_.edges[e].rest_length,
                 after = f == entry_.ghost_end ? 0 : model_.edges[f].rest_length;
    TwistBend bend;
    bend.e = e;
    bend.f = f;
    bend.length = 0.5 * (before + after);
    bend.bend = {Eigen::Vector2d(m.EI1, m.EI2) / bend.length, bend.length * m.curvature};
    bend.GJ_l = m.GJ / bend.length;
    bend.rest_twist = bend.length * m.twist;
    bend.round = m.round_and_straight();
    model_.bends.push_back(bend);
  }

  TwistModel& model_;
  const TwistRod& rod_;
  int& next_ghost_;
  TwistModel::Rod entry_;
};

/// fixes what the ends of one rod hold, and its spin if nothing else does
void hold(TwistModel& model, const TwistRod& rod, TwistModel::Rod& entry) {
  if (!entry.closed) {
    if (rod.begin != RodEnd::free) model.fix_node(rod.nodes.front());
    if (rod.end != RodEnd::free) model.fix_node(rod.nodes.back());
  }
  if (entry.ghost_begin >= 0) model.fix_node(model.edges[entry.ghost_begin].from);
  if (entry.ghost_end >= 0) model.fix_node(model.edges[entry.ghost_end].to);
  if (rod.begin == RodEnd::clamped) model.fix_angle(entry.ghost_begin);
  if (rod.end == RodEnd::clamped) model.fix_angle(entry.ghost_end);
  const bool clamped = rod.begin == RodEnd::clamped || rod.end == RodEnd::clamped;
  if (clamped || !rod.material.round_and_straight()) return;
  entry.held_spin = entry.edges.front();
  model.fix_angle(entry.held_spin);
}

}  // namespace

Result<TwistModel> build_twist_model(int nodes, const std::vector<TwistRod>& rods) {
  TwistModel model;
  model.nodes = nodes;
  for (std::size_t r = 0; r < rods.size(); ++r) {
    if (auto fine = check(int(r), nodes, rods[r]); !fine)
      return tl::unexpected<Error>(fine.error());
    model.rods.push_back(RodBuilder(model, rods[r], model.nodes).build());
  }
  model.fixed.assign(model.unknowns(), 0);
  model.load = Eigen::Matrix3Xd::Zero(3, model.nodes);
  for (std::size_t r = 0; r < rods.size(); ++r) hold(model, rods[r], model.rods[r]);
  model.number();
  return model;
}

void TwistModel::number() {
  index.assign(unknowns(), -1);
  free.clear();
  for (int k = 0; k < unknowns(); ++k) {
    if (fixed[k]) continue;
    index[k] = int(free.size());
    free.push_back(k);
  }
}

namespace {

/// the edges of a rod that meet at a node
std::vector<int> edges_beside(const TwistModel& model, int rod, int node) {
  std::vector<int> edges;
  for (int edge : model.rods[rod].edges)
    if (model.edges[edge].from == node || model.edges[edge].to == node) edges.push_back(edge);
  return edges;
}

}  // namespace

void add_joint_shear(TwistModel& model, int rod_a, int node_a, int rod_b, int node_b,
                     double stiffness, double rest_angle) {
  const std::vector<int> first = edges_beside(model, rod_a, node_a),
                         second = edges_beside(model, rod_b, node_b);
  const double share = stiffness / double(first.size() * second.size());
  for (int e : first)
    for (int f : second) model.shears.push_back({e, f, share, rest_angle});
}

void add_joint_twist(TwistModel& model, int rod_a, int node_a, int rod_b, int node_b,
                     double stiffness) {
  const std::vector<int> first = edges_beside(model, rod_a, node_a),
                         second = edges_beside(model, rod_b, node_b);
  const double share = stiffness / double(first.size() * second.size());
  for (int e : first)
    for (int f : second) model.twists.push_back({e, f, share});
  // a spin that cost nothing and was held does now
  for (int rod : {rod_a, rod_b}) {
    int& held = model.rods[rod].held_spin;
    if (held >= 0) model.fixed[model.angle_of(std::exchange(held, -1))] = 0;
  }
  model.number();
}

}  // namespace gridshell
