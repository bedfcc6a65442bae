#include "engine/solve/ordering.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace gridshell {
namespace {

constexpr int small_piece = 48;  // nodes; below, minimum degree beats another cut

class Dissection {
 public:
  Dissection(const Model& model, const std::vector<std::vector<int>>& graph)
      : model_(model), graph_(graph), piece_(graph.size(), 0) {
    order_.reserve(graph.size());
  }

  std::vector<int> run() {
    std::vector<int> all(graph_.size());
    std::iota(all.begin(), all.end(), 0);
    dissect(std::move(all));
    return std::move(order_);
  }

 private:
  struct Cut {
    int axis = -1;
    double at = 0, cost = 0;
  };

  double coordinate(int node, int axis) const { return model_.flat(axis, model_.free_nodes[node]); }

  /// best cut along one axis: left is coordinate <= at; its nodes with a neighbour right separate
  Cut best_cut(std::vector<int>& nodes, int axis) const {
    std::sort(nodes.begin(), nodes.end(), [&](int a, int b) {
      const double ca = coordinate(a, axis), cb = coordinate(b, axis);
      return ca != cb ? ca < cb : a < b;
    });
    const int count = int(nodes.size());
    // opened[k]: separators that a cut after sorted position k gains; they close past their reach
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
      const double share = double(k + 1) / count, uneven = std::abs(share - 0.5);
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
    order_.insert(order_.end(), middle.begin(), middle.end());
  }

  /// exact minimum degree on a small piece; nodes outside count as neighbours eliminated later
  void minimum_degree(const std::vector<int>& nodes) {
    std::vector<std::vector<int>> adjacent(nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (int other : graph_[nodes[k]])
        if (!eliminated(other)) adjacent[k].push_back(other);
    for (auto& list : adjacent) std::sort(list.begin(), list.end());

    std::vector<char> done(nodes.size(), 0);
    for (std::size_t step = 0; step < nodes.size(); ++step) {
      std::size_t pick = nodes.size();
      for (std::size_t k = 0; k < nodes.size(); ++k)
        if (!done[k] && (pick == nodes.size() || adjacent[k].size() < adjacent[pick].size()))
          pick = k;
      done[pick] = 1;
      const int node = nodes[pick];
      order_.push_back(node);
      mark_eliminated(node);
      // the neighbours of an eliminated node become neighbours of one another
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (done[k] || !std::binary_search(adjacent[pick].begin(), adjacent[pick].end(), nodes[k]))
          continue;
        std::vector<int> merged;
        std::set_union(adjacent[k].begin(), adjacent[k].end(), adjacent[pick].begin(),
                       adjacent[pick].end(), std::back_inserter(merged));
        std::erase_if(merged, [&](int other) { return other == nodes[k] || other == node; });
        adjacent[k] = std::move(merged);
      }
    }
  }

  bool eliminated(int node) const { return piece_[node] < 0; }
  void mark_eliminated(int node) { piece_[node] = -1; }

  const Model& model_;
  const std::vector<std::vector<int>>& graph_;
  std::vector<int> piece_;  // which piece a node is in; -1 once eliminated
  int pieces_ = 0;
  std::vector<int> order_;
};

}  // namespace

std::vector<std::vector<int>> hessian_graph(const Model& model) {
  std::vector<std::vector<int>> graph(model.free());
  const auto link = [&](int a, int b) {
    const int fa = model.free_index[a], fb = model.free_index[b];
    if (fa < 0 || fb < 0) return;
    graph[fa].push_back(fb);
    graph[fb].push_back(fa);
  };
  for (const ModelEdge& edge : model.edges) link(edge.from, edge.to);
  for (const ModelBend& bend : model.bends)
    link(model.edges[bend.edge].from, model.edges[bend.edge + 1].to);
  return graph;
}

std::vector<int> nested_dissection(const Model& model, const std::vector<std::vector<int>>& graph) {
  return Dissection(model, graph).run();
}

}  // namespace gridshell
