#include "engine/elastic/model.h"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <cmath>

#include "engine/core/try.h"

namespace gridshell {

namespace {

Result<void> check(int index, int nodes, const ModelRod& rod, RodModel rod_model) {
  const auto wrong = [&](const std::string& what) { return invalid("rod {}: {}", index, what); };
  const RodMaterial& m = rod.material;
  if (rod.position.size() != rod.nodes.size() && !rod.closed())
    return wrong(fmt::format("got {} nodes and {} arc lengths, expected as many of each",
                             rod.nodes.size(), rod.position.size()));
  if (rod.nodes.size() < 2) return wrong("has no edge");
  for (int node : rod.nodes)
    if (node < 0 || node >= nodes)
      return wrong(fmt::format("got node {}, expected a number below {}", node, nodes));
  for (std::size_t k = 1; k < rod.position.size(); ++k)
    if (!(rod.position[k] > rod.position[k - 1]))
      return wrong(fmt::format("arc lengths: got {} after {}, expected ascending values",
                               rod.position[k], rod.position[k - 1]));
  if (!(m.EA > 0)) return wrong(fmt::format("EA: got {} N, expected above 0", m.EA));
  if (!(m.EI1 > 0 && m.EI2 > 0))
    return wrong(fmt::format("EI: got {} and {} N mm^2, expected above 0", m.EI1, m.EI2));
  if (rod_model == RodModel::twist && !(m.GJ > 0))
    return wrong(fmt::format(
        "GJ: got {} N mm^2, expected above 0: the model twist needs the torsional stiffness",
        m.GJ));
  if (!m.curvature.allFinite() || !std::isfinite(m.twist))
    return wrong("natural curvature or twist is not finite");
  if (rod.closed() && (rod.begin != RodEnd::free || rod.end != RodEnd::free))
    return wrong("a closed rod has no ends to prescribe");
  return {};
}

/// Builds a model from rods, one after the other.
class Builder {
 public:
  Builder(int nodes, RodModel rod_model) : twist_(rod_model == RodModel::twist) {
    model_.nodes = nodes;
  }

  void add(const ModelRod& rod) {
    Model::Rod entry;
    entry.closed = rod.closed();
    entry.director = rod.director;
    entry.gyration_mm2 = (rod.material.EI1 + rod.material.EI2) / rod.material.EA;
    entry.fibres = rod.material.fibres;
    entry.first_bend = int(model_.bends.size());
    const auto& s = rod.position;
    const int edges = int(s.size()) - 1;
    if (fixes_direction(rod.begin))
      entry.ghost_begin =
          add_edge(entry, ghost(rod.ghost_begin), rod.nodes.front(), s[1] - s[0], 0);
    const auto node = [&](int k) { return rod.nodes[std::size_t(k) % rod.nodes.size()]; };
    const auto centred = [&](int k) {
      return !rod.centred.empty() && rod.centred[std::size_t(k) % rod.nodes.size()];
    };
    for (int k = 0; k < edges; ++k) {
      const int edge = add_edge(entry, node(k), node(k + 1), s[k + 1] - s[k], rod.material.EA);
      if (centred(k) || centred(k + 1))
        model_.edges[std::size_t(edge)].centre = node(centred(k) ? k : k + 1);
      if (centred(k) && (k > 0 || entry.closed))
        model_.followers.push_back({node(k + 1), node(k), node(k > 0 ? k - 1 : edges - 1)});
    }
    if (fixes_direction(rod.end))
      entry.ghost_end =
          add_edge(entry, rod.nodes.back(), ghost(rod.ghost_end), s[edges] - s[edges - 1], 0);
    for (std::size_t k = 1; k < entry.edges.size(); ++k) {
      const int e = entry.edges[k - 1], f = entry.edges[k];
      // at an end that leaves the spin free the frame is that of the adjacent edge
      double fraction = 0.5;
      if (e == entry.ghost_begin) fraction = rod.begin == RodEnd::clamped ? 0 : 1;
      if (f == entry.ghost_end) fraction = rod.end == RodEnd::clamped ? 1 : 0;
      const std::size_t node = entry.ghost_begin >= 0 ? k - 1 : k;
      add_bend(rod.material, {e, f}, fraction, turn_of(rod, node));
    }
    if (entry.closed) rings_.push_back({model_.rods.size(), rod.material, turn_of(rod, 0)});
    model_.rods.push_back(std::move(entry));
  }

  Model build(const std::vector<ModelRod>& rods, std::vector<char> crossings) {
    // these bends are after all others, as their edges are not consecutive in the list
    for (const auto& [rod, material, turn] : rings_) {
      model_.rods[rod].closing_bend = int(model_.bends.size());
      add_bend(material, {model_.rods[rod].edges.back(), model_.rods[rod].edges.front()}, 0.5,
               turn);
    }
    crossings.resize(std::size_t(model_.nodes), 0);
    mark_shared(rods, crossings);
    for (const ModelEdge& edge : model_.edges)
      if (edge.centre >= 0) crossings[std::size_t(edge.from)] = crossings[std::size_t(edge.to)] = 1;
    model_.fixed.assign(std::size_t(model_.nodes), 0);
    if (twist_) assign_spins(crossings);
    for (std::size_t r = 0; r < rods.size(); ++r) fix_ends(rods[r], model_.rods[r]);
    for (const ModelFollower& one : model_.followers)
      model_.fixed[std::size_t(one.node)] = Model::follows;
    lay_along_rods(rods);
    find_segments(crossings);
    find_waves();
    finish(model_);
    return std::move(model_);
  }

 private:
  int ghost(int known) { return known >= 0 ? known : model_.nodes++; }

  static Eigen::Vector2d turn_of(const ModelRod& rod, std::size_t node) {
    return rod.turns.empty() ? Eigen::Vector2d(0, 0) : rod.turns[node];
  }

  int add_edge(Model::Rod& entry, int from, int to, double length, double EA) {
    entry.edges.push_back(int(model_.edges.size()));
    model_.edges.push_back({from, to, length, EA});
    return entry.edges.back();
  }

  /// Adds the bend between two edges; `fraction`: MaterialBend::fraction, `turn`: one of
  /// ModelRod::turns.
  void add_bend(const RodMaterial& m, std::pair<int, int> edges, double fraction,
                const Eigen::Vector2d& turn) {
    const auto [e, f] = edges;
    // at a fixed end only half of the rod's edge bends; the halves of a centred edge are one edge
    const double before = bending_length(model_, e), after = bending_length(model_, f),
                 length = 0.5 * (before + after), round = 2 * std::min(m.EI1, m.EI2) / length;
    const bool plain = !twist_ || m.round_and_straight(), at_end = fraction != 0.5;
    const int bend = int(model_.bends.size());
    const bool halves = are_halves(e, f);
    model_.bends.push_back({e, f, plain && !at_end && !halves ? round : 0});
    if (halves) return;
    if (plain && at_end)
      std::get<std::vector<Pair<EndBending>>>(model_.pairs).push_back({e, f, bend, {round}});
    if (!twist_) return;
    const Eigen::Vector2d EI(m.EI1, m.EI2);
    MaterialBend law{EI / length, length * m.curvature + turn, fraction};
    double torsion = m.GJ / length;
    if (!at_end && !turn.isZero(1e-9)) {
      const CornerLaw corner(EI, m.GJ, before, after, turn);
      law = corner.bend;
      law.rest += Eigen::Rotation2Dd(-law.axis) * (length * m.curvature);
      torsion = corner.torsion;
    }
    std::get<std::vector<Pair<Torsion>>>(model_.pairs)
        .push_back({e, f, bend, {torsion, length * m.twist}});
    if (!plain)
      std::get<std::vector<Pair<SectionBending>>>(model_.pairs).push_back({e, f, bend, {law}});
  }

  bool are_halves(int e, int f) const {
    const int centre = model_.edges[std::size_t(e)].centre;
    return centre >= 0 && centre == model_.edges[std::size_t(f)].centre;
  }

  /// Marks nodes that belong to several rods.
  void mark_shared(const std::vector<ModelRod>& rods, std::vector<char>& crossings) const {
    std::vector<int> owner(crossings.size(), -1);
    for (std::size_t r = 0; r < rods.size(); ++r)
      for (int node : rods[r].nodes) {
        int& first = owner[std::size_t(node)];
        if (first >= 0 && first != int(r)) crossings[std::size_t(node)] = 1;
        first = int(r);
      }
  }

  /// Assigns three angles to a column. Angles of the edges on both sides of a crossing are together
  /// in a column, so that columns inside a segment have no blocks across the crossing. Two halves
  /// of an edge have one angle.
  void assign_spins(const std::vector<char>& crossings) {
    model_.spin.resize(model_.edges.size());
    model_.spin_length = 0;
    for (const ModelEdge& edge : model_.edges)
      model_.spin_length += edge.rest_length / double(model_.edges.size());
    for (const Model::Rod& rod : model_.rods) {
      int used = 3;  // components of the last column that are assigned
      for (std::size_t k = 0; k < rod.edges.size(); ++k) {
        const int edge = rod.edges[k];
        const bool last = k + 1 == rod.edges.size();
        int other = -1;
        if (rod.closed && last && are_halves(edge, rod.edges.front())) other = rod.edges.front();
        if (k > 0 && are_halves(edge - 1, edge)) other = edge - 1;
        if (other >= 0) {
          model_.spin[std::size_t(edge)] = model_.spin[std::size_t(other)];
          continue;
        }
        const bool after = crossings[std::size_t(model_.edges[std::size_t(edge)].from)],
                   before = crossings[std::size_t(model_.edges[std::size_t(edge)].to)];
        if (used == 3 || (before && !after)) {
          model_.fixed.push_back(Model::all_fixed);
          used = 0;
        }
        const int column = model_.columns() - 1;
        model_.spin[std::size_t(edge)] = 3 * column + used;
        model_.fixed.back() ^= (unsigned char)(1 << used++);
        if (after && !before) used = 3;
      }
    }
  }

  /// Fixes the unknowns that the ends of a rod prescribe, and one angle if nothing else resists
  /// spin.
  void fix_ends(const ModelRod& rod, Model::Rod& entry) {
    if (!entry.closed) {
      if (rod.begin != RodEnd::free) model_.pin(rod.nodes.front());
      if (rod.end != RodEnd::free) model_.pin(rod.nodes.back());
    }
    if (entry.ghost_begin >= 0) model_.pin(model_.edges[std::size_t(entry.ghost_begin)].from);
    if (entry.ghost_end >= 0) model_.pin(model_.edges[std::size_t(entry.ghost_end)].to);
    if (!twist_) return;
    if (rod.begin == RodEnd::clamped) model_.fix_spin(entry.ghost_begin);
    if (rod.end == RodEnd::clamped) model_.fix_spin(entry.ghost_end);
    const bool clamped = rod.begin == RodEnd::clamped || rod.end == RodEnd::clamped;
    if (clamped || !rod.material.round_and_straight()) return;
    entry.fixed_spin = entry.edges.front();
    model_.fix_spin(entry.fixed_spin);
  }

  /// Sets `flat` to parallel rods, for the ordering of a model without flat positions.
  void lay_along_rods(const std::vector<ModelRod>& rods) {
    model_.flat = Eigen::Matrix2Xd::Zero(2, model_.columns());
    for (std::size_t r = 0; r < rods.size(); ++r)
      for (std::size_t k = 0; k < rods[r].nodes.size(); ++k)
        model_.flat.col(rods[r].nodes[k]) << rods[r].position[k], 100.0 * double(r);
    for (std::size_t k = 0; k < model_.spin.size(); ++k)
      model_.flat.col(model_.spin[k] / 3) = model_.flat.col(model_.edges[k].to);
  }

  /// Finds the columns inside a segment, that is between two crossings of one rod.
  void find_segments(const std::vector<char>& crossings) {
    model_.segment.assign(std::size_t(model_.columns()), -2);  // not seen yet
    int segment = 0;
    const auto take = [&](int column) {
      int& known = model_.segment[std::size_t(column)];
      if (known == -2) model_.inside.push_back(column);
      known = known == -2 || known == segment ? segment : -1;
    };
    for (const Model::Rod& rod : model_.rods) {
      ++segment;
      for (int edge : rod.edges) {
        if (!model_.spin.empty()) take(model_.spin[std::size_t(edge)] / 3);
        const int node = model_.edges[std::size_t(edge)].to;
        if (crossings[std::size_t(node)]) {
          model_.segment[std::size_t(node)] = -1;
          ++segment;
        } else {
          take(node);
        }
      }
      const int first = model_.edges[std::size_t(rod.edges.front())].from;
      if (model_.segment[std::size_t(first)] == -2) model_.segment[std::size_t(first)] = -1;
    }
    std::erase_if(model_.inside, [&](int c) { return model_.segment[std::size_t(c)] < 0; });
  }

  void find_waves() {
    std::vector<std::size_t> next(std::size_t(model_.nodes), 0);  // first wave without the node
    for (std::size_t r = 0; r < model_.rods.size(); ++r) {
      std::size_t wave = 0;
      const auto nodes = [&](const auto& visit) {
        for (const int edge : model_.rods[r].edges) {
          visit(next[std::size_t(model_.edges[std::size_t(edge)].from)]);
          visit(next[std::size_t(model_.edges[std::size_t(edge)].to)]);
        }
      };
      nodes([&](std::size_t there) { wave = std::max(wave, there); });
      nodes([&](std::size_t& there) { there = wave + 1; });
      if (wave == model_.waves.size()) model_.waves.emplace_back();
      model_.waves[wave].push_back(int(r));
    }
  }

  Model model_;
  bool twist_;
  struct Ring {
    std::size_t rod;
    RodMaterial material;
    Eigen::Vector2d turn;
  };
  std::vector<Ring> rings_;
};

BlockSlot slot_of(Model& model, int a, int b) { return a == b ? -1 : model.pattern.slot(a, b); }

/// Sets the slots of the blocks between the nodes of a pair of edges; set_slots() also those of
/// their angles.
template <class Law>
void set_vector_slots(Model& model, Pair<Law>& pair) {
  const ModelEdge &e = model.edges[std::size_t(pair.e)], &f = model.edges[std::size_t(pair.f)];
  PairSlots& slots = pair.slots;
  slots.e = e.slot, slots.f = f.slot;
  const int ends[4] = {e.from, e.to, f.from, f.to};
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) slots.across[a][b] = slot_of(model, ends[a], ends[2 + b]);
}

template <class Law>
void set_slots(Model& model, Pair<Law>& pair) {
  set_vector_slots(model, pair);
  if (!model.has_spins()) return;
  const ModelEdge &e = model.edges[std::size_t(pair.e)], &f = model.edges[std::size_t(pair.f)];
  const int ends[4] = {e.from, e.to, f.from, f.to};
  PairSlots& slots = pair.slots;
  const int angle[2] = {model.spin[std::size_t(pair.e)] / 3, model.spin[std::size_t(pair.f)] / 3};
  for (int end = 0; end < 4; ++end)
    for (int k = 0; k < 2; ++k) slots.spin[end][k] = slot_of(model, ends[end], angle[k]);
  slots.spins = slot_of(model, angle[0], angle[1]);
}

/// Sets where the blocks of following columns are added, in the order in which they are
/// transferred: angles first, as they follow nodes of which some follow others.
void set_follower_slots(Model& model) {
  for (ModelHinge& hinge : model.hinges) set_vector_slots(model, hinge.pair);
  std::vector<std::vector<int>> neighbours(std::size_t(model.columns()));
  const auto& pairs = model.pattern.pairs();
  std::size_t seen = 0;
  const auto take_new = [&] {
    for (; seen < pairs.size(); ++seen)
      for (const int k : {0, 1})
        neighbours[std::size_t(pairs[seen][k])].push_back(pairs[seen][1 - k]);
  };
  const auto blocks_of = [&](int follower, std::vector<int> leading) {
    FollowerBlocks blocks{std::move(leading), {}};
    take_new();
    for (const int column : neighbours[std::size_t(follower)])
      blocks.neighbours.push_back({column, slot_of(model, follower, column)});
    // its own block is the last: its blocks with the leading columns must be transferred before
    blocks.neighbours.push_back({follower});
    for (auto& [column, own, slots] : blocks.neighbours)
      for (std::size_t k = 0; k < blocks.leading.size(); ++k)
        slots[k] = slot_of(model, blocks.leading[k], column);
    return blocks;
  };
  for (ModelHinge& hinge : model.hinges) {
    std::vector<int> nodes;
    for (const int edge : {hinge.pair.e, hinge.pair.f})
      for (const int node :
           {model.edges[std::size_t(edge)].from, model.edges[std::size_t(edge)].to})
        if (std::ranges::find(nodes, node) == nodes.end()) nodes.push_back(node);
    hinge.blocks = blocks_of(model.spin[std::size_t(hinge.pair.e)] / 3, nodes);
  }
  for (ModelFollower& one : model.followers)
    one.blocks = blocks_of(one.node, {one.centre, one.first});
}

}  // namespace

Result<Model> build_model(int nodes, const std::vector<ModelRod>& rods, RodModel rod_model,
                          const std::vector<char>& crossings) {
  Builder builder(nodes, rod_model);
  for (std::size_t r = 0; r < rods.size(); ++r) {
    TRY_DO(check(int(r), nodes, rods[r], rod_model));
    builder.add(rods[r]);
  }
  return builder.build(rods, crossings);
}

void finish(Model& model) {
  model.pattern = BlockPattern(model.columns());
  for (ModelEdge& edge : model.edges) edge.slot = model.pattern.slot(edge.from, edge.to);
  for (ModelBend& bend : model.bends)
    bend.slot = model.pattern.slot(model.edges[std::size_t(bend.e)].from,
                                   model.edges[std::size_t(bend.f)].to);
  for (ModelSpring& spring : model.springs)
    spring.slot = model.pattern.slot(spring.law.a, spring.law.b);
  for (const ModelLink& link : model.links)
    for (const int row : nodes_of(link, model))
      for (const int column : nodes_of(link, model))
        if (row != column) model.pattern.slot(row, column);
  for (ModelBar& bar : model.bars) bar.slot = model.pattern.slot(bar.law.a, bar.law.b);
  std::apply(
      [&](auto&... lists) {
        const auto set_list = [&](auto& list) {
          list.shrink_to_fit();  // most of a model's memory
          for (auto& pair : list) set_slots(model, pair);
        };
        (set_list(lists), ...);
      },
      model.pairs);
  set_follower_slots(model);
  model.free_index.assign(std::size_t(model.columns()), -1);
  model.free_columns.clear();
  for (int column = 0; column < model.columns(); ++column) {
    if ((model.fixed[std::size_t(column)] & Model::all_fixed) == Model::all_fixed) continue;
    model.free_index[std::size_t(column)] = model.free();
    model.free_columns.push_back(column);
  }
}

}  // namespace gridshell
