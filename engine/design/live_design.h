// A design that somebody watches, step by step, and stops when it is good enough.
#pragma once

#include <functional>
#include <optional>

#include "engine/core/watch.h"
#include "engine/design/design_work.h"

namespace gridshell {

/// A step that 16 and 32 edges a segment hold: at rest, stable, stable enough.
struct CertifiedStep {
  const DesignStep& step;
  const MovedShell& shell;              ///< on 16 edges, standing in it
  const Eigen::VectorXd& distances_mm;  ///< of the joints from the target
  double eigenvalue = 0;                ///< smallest on 32 edges, N/mm^2
  preset::Points ends, rods;            ///< `[ends] table`, `[rod] table`
};

/// Where the shell stands that is designed: a state of the scene's own model, at rest.
struct DesignFrom {
  std::shared_ptr<const Scene> scene;
  const RodMesh& mesh;
  const Model& model;
  const State& state;
};

/// How it ended.
struct LiveDesign {
  bool stopped = false;  ///< before the optimum
  int iterations = 0;    ///< refused ones too
  /// Largest distance at 32 edges with pins and legs rounded to `[inverse] round_mm`; none where
  /// that shell is lost, and where it was stopped.
  std::optional<double> rounded_max_mm;
};

/// Optimises as design() does, but hands over each step as it comes, certified, the begin first;
/// what the finer mesh does not hold is passed over. Cancelled at any time, within a step too, the
/// last that was handed over is what it came to. It does not build with errors. Errors: as
/// design(); cancelled before the begin was handed over.
Result<LiveDesign> design_live(const preset::Preset& preset, const DesignFrom& from,
                               int most_iterations, const Watch& watch,
                               const std::function<void(const CertifiedStep&)>& seen);

}  // namespace gridshell
