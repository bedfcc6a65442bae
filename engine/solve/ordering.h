// Fill-reducing elimination order of the free nodes.
#pragma once

#include <vector>

#include "engine/gridshell/model.h"

namespace gridshell {

/// Neighbours of each free node (by free index) in the Hessian's graph: nodes one and two edges
/// away along a rod.
std::vector<std::vector<int>> hessian_graph(const Model& model);

/// Nested dissection by the nodes' flat positions [George 1973]: the plane is cut again and again
/// along u or v where fewest nodes touch both sides; those come last. Small pieces are ordered by
/// minimum degree. Returns order[k] = free index of the k-th node to eliminate. Deterministic.
std::vector<int> nested_dissection(const Model& model, const std::vector<std::vector<int>>& graph);

}  // namespace gridshell
