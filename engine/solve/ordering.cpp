#include "engine/elastic/model.h"
#include "engine/solve/linear_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

namespace gridshell {
namespace {

constexpr int small_piece = 48;  // nodes; below, minimum degree beats another cut

class Dissection {
 public:
  Dissection(const Model& model, std::vector<std::vector<int>> graph)
      : model_(model), graph_(std::move(graph)), piece_(graph_.size(), 0) {
    order_.reserve(graph_.size());
    for (int column : model.free_columns)
      flat_.push_back({model.flat(0, column), model.flat(1, column)});
  }

  std::vector<int> run() {
    condense();
    std::vector<int> rest;
    for (int node = 0; node < int(graph_.size()); ++node)
      if (!eliminated(node)) rest.push_back(node);
    dissect(std::move(rest));
    return std::move(order_);
  }

 private:
  struct Cut {
    int axis = -1;
    double at = 0, cost = 0;
  };

  /// Eliminates first the columns inside a segment that are adjacent only to the segment and its
  /// two joints, one after the other: each has few neighbours then. The joints and their neighbours
  /// remain, so the remaining work does not grow with the number of edges per segment.
  void condense() {
    const auto segment = [&](int free) {
      return model_.segment[std::size_t(model_.free_columns[std::size_t(free)])];
    };
    // chosen on the graph before anything is eliminated
    std::vector<int> first;
    for (int column : model_.inside) {
      const int node = model_.free_index[std::size_t(column)];
      if (node < 0) continue;
      const auto& around = graph_[std::size_t(node)];
      const bool within = std::all_of(around.begin(), around.end(), [&](int other) {
        return segment(other) < 0 || segment(other) == segment(node);
      });
      if (within) first.push_back(node);
    }
    for (int node : side_by_side(first)) eliminate(node);
  }

  /// Orders four segments together, the first node of each, the second of each, ...: adjacent
  /// columns in the order do not depend on each other.
  std::vector<int> side_by_side(const std::vector<int>& nodes) const {
    constexpr int together = 4;
    struct Entry {
      int group, along, node;
    };
    std::vector<Entry> entries;
    int segments = 0, along = 0, before = -1;
    for (int node : nodes) {
      const int segment = model_.segment[std::size_t(model_.free_columns[std::size_t(node)])];
      segments += segment != before;
      along = segment != before ? 0 : along + 1;
      before = segment;
      entries.push_back({segments / together, along, node});
    }
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return a.group != b.group ? a.group < b.group : a.along < b.along;
    });
    std::vector<int> order;
    for (const Entry& entry : entries) order.push_back(entry.node);
    return order;
  }

  /// Eliminates a node: its neighbours become neighbours of one another.
  void eliminate(int node) {
    order_.push_back(node);
    piece_[node] = -1;
    around_.clear();
    for (int other : graph_[node])
      if (!eliminated(other)) around_.push_back(other);
    for (int a : around_) {
      std::vector<int>& list = graph_[a];
      std::erase(list, node);
      for (int b : around_)
        if (b != a && std::find(list.begin(), list.end(), b) == list.end()) list.push_back(b);
    }
    graph_[node].clear();
  }

  double coordinate(int node, int axis) const {
    return flat_[std::size_t(node)][std::size_t(axis)];
  }

  /// Finds the best cut along one axis. Nodes with coordinate <= `at` are left of it; those of them
  /// with a neighbour on the right are the separator.
  Cut best_cut(std::vector<int>& nodes, int axis) const {
    std::sort(nodes.begin(), nodes.end(), [&](int a, int b) {
      const double ca = coordinate(a, axis), cb = coordinate(b, axis);
      return ca != cb ? ca < cb : a < b;
    });
    const int count = int(nodes.size());
    // change[k]: size of the separator of a cut after sorted position k less that of the cut
    // before; a node leaves the separator where the cut passes its last neighbour
    std::vector<int> change(count + 1, 0);
    std::vector<double> at(count);
    for (int k = 0; k < count; ++k) at[k] = coordinate(nodes[k], axis);
    for (int k = 0; k < count; ++k) {
      double reach = at[k];
      for (int other : graph_[nodes[k]])
        if (piece_[other] == piece_[nodes[k]]) reach = std::max(reach, coordinate(other, axis));
      const int closes = int(std::lower_bound(at.begin(), at.end(), reach) - at.begin());
      if (closes > k) ++change[k], --change[closes];
    }
    Cut best;
    int separators = 0;
    for (int k = 0; k + 1 < count; ++k) {
      separators += change[k];
      if (at[k + 1] == at[k]) continue;
      const double fraction = double(k + 1) / count, uneven = std::abs(fraction - 0.5);
      if (uneven > 0.3) continue;
      const double cost = separators * (1 + 4 * uneven * uneven);
      if (best.axis < 0 || cost < best.cost) best = {axis, at[k], cost};
    }
    return best;
  }

  void dissect(std::vector<int> nodes) {
    if (int(nodes.size()) <= small_piece) return minimum_degree(nodes);
    const Cut along_u = best_cut(nodes, 0), along_v = best_cut(nodes, 1);
    const Cut cut =
        along_u.axis < 0 || (along_v.axis >= 0 && along_v.cost < along_u.cost) ? along_v : along_u;
    if (cut.axis < 0) return minimum_degree(nodes);

    std::vector<int> left, right, middle;
    for (int node : nodes) (coordinate(node, cut.axis) <= cut.at ? left : right).push_back(node);
    const int right_piece = ++pieces_, middle_piece = ++pieces_;
    for (int node : right) piece_[node] = right_piece;
    std::erase_if(left, [&](int node) {
      const bool touches = std::any_of(graph_[node].begin(), graph_[node].end(),
                                       [&](int other) { return piece_[other] == right_piece; });
      if (touches) middle.push_back(node);
      return touches;
    });
    for (int node : middle) piece_[node] = middle_piece;
    dissect(std::move(left));
    dissect(std::move(right));
    // along the cut, so that neighbours in the separator are neighbours in the order
    std::sort(middle.begin(), middle.end(), [&](int a, int b) {
      const double ca = coordinate(a, 1 - cut.axis), cb = coordinate(b, 1 - cut.axis);
      return ca != cb ? ca < cb : a < b;
    });
    for (int node : middle) piece_[node] = -1;
    order_.insert(order_.end(), middle.begin(), middle.end());
  }

  /// Orders a small piece by exact minimum degree; nodes outside count as neighbours that are
  /// eliminated later.
  void minimum_degree(std::vector<int> nodes) {
    while (!nodes.empty()) {
      const auto pick = std::min_element(nodes.begin(), nodes.end(), [&](int a, int b) {
        const std::size_t da = graph_[a].size(), db = graph_[b].size();
        return da != db ? da < db : a < b;
      });
      eliminate(*pick);
      nodes.erase(pick);
    }
  }

  bool eliminated(int node) const { return piece_[node] < 0; }

  const Model& model_;
  std::vector<std::vector<int>> graph_;  // neighbours among nodes that are not eliminated yet
  std::vector<std::array<double, 2>> flat_;
  std::vector<int> around_;  // neighbours of the node that is eliminated
  std::vector<int> piece_;   // which piece a node is in; -1 once eliminated
  int pieces_ = 0;
  std::vector<int> order_;
};

}  // namespace

std::vector<std::vector<int>> hessian_graph(const Model& model) {
  std::vector<std::vector<int>> graph(std::size_t(model.free()));
  for (auto& around : graph) around.reserve(8);
  for (const auto& [row, column] : model.pattern.pairs()) {
    const int a = model.free_index[std::size_t(row)], b = model.free_index[std::size_t(column)];
    if (a < 0 || b < 0) continue;
    graph[std::size_t(a)].push_back(b);
    graph[std::size_t(b)].push_back(a);
  }
  return graph;
}

std::vector<int> nested_dissection(const Model& model, const std::vector<std::vector<int>>& graph) {
  return Dissection(model, graph).run();
}

}  // namespace gridshell
