// CHOLMOD as a solver for a model's Hessians, to compare the program's own with.
#pragma once

#include "engine/solve/linear_solver.h"

namespace gridshell {

/// How CHOLMOD factorises, and in which order.
struct CholmodOptions {
  /// L L^T; where that fails, simplicial L D L^T counts the negative pivots
  bool supernodal = true;
  /// nested_dissection(); false: CHOLMOD's own nested dissection (METIS)
  bool own_ordering = true;
};

/// CHOLMOD [Chen, Davis, Hager, Rajamanickam 2008], for comparison with make_block_cholesky(). It
/// ignores the same parts of the Hessian.
std::unique_ptr<LinearSolver> make_cholmod(const Model& model, const CholmodOptions& options = {});

}  // namespace gridshell
