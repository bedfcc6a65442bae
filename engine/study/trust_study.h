// Whether a user may trust what a run says: random scenes of every kind, solved as by default and
// beside it on meshes of another family (5, 10, 20 edges a segment in the place of 4, 8, 16), with
// load steps of half the size, an eighth of the tolerance and other numbers of frames.
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/trust.h"

namespace gridshell::study {

struct TrustOptions {
  int scenes = 600;  ///< of all kinds in turn
  int seed = 1;
  double seconds = 20;  ///< a run beyond that is too slow
  int threads = 2;
};

/// A scene judged, and the preset that runs it again.
struct TrustScene {
  record::TrustRow row;
  preset::Preset preset;
};

/// Errors: cancelled.
Result<std::vector<TrustScene>> trust_study(const TrustOptions& options, Watch& watch);

}  // namespace gridshell::study
