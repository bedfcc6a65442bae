// Fill-reducing elimination order of the free columns.
#pragma once

#include <vector>

#include "engine/gridshell/model.h"

namespace gridshell {

/// Neighbours of each free column (by free index) in the Hessian's graph.
std::vector<std::vector<int>> hessian_graph(const Model& model);

/// Nested dissection by the columns' flat positions [George 1973]: what lies inside a segment goes
/// first, then the plane is cut again and again along u or v where fewest columns touch both sides;
/// those come last. Small pieces are ordered by minimum degree. Returns order[k] = free index of
/// the k-th column to eliminate. Deterministic.
std::vector<int> nested_dissection(const Model& model, const std::vector<std::vector<int>>& graph);

}  // namespace gridshell
