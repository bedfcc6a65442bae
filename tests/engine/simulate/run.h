// Runs of presets that must come to an outcome; where one does not, the test fails with the reason.
#pragma once

#include <catch2/catch.hpp>

#include "engine/simulate/run.h"

namespace gridshell {

/// With the frames of a movie.
inline simulate::ExperimentResult run(const preset::Preset& preset, bool stills = false) {
  Watch watch;
  auto outcome = simulate::run(preset, stills, watch);
  if (!outcome) FAIL(outcome.error().message);
  return std::move(*outcome);
}

/// With the frames of a figure.
inline simulate::ExperimentResult run_stills(const preset::Preset& preset) {
  return run(preset, true);
}

}  // namespace gridshell
