// Values drawn at random, the same ones from the same generator on every machine: not by the
// library's distributions, which differ from one to another.
#pragma once

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include "engine/core/enum_words.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/study_tables.h"

namespace gridshell::study {

class RandomDraw {
 public:
  explicit RandomDraw(std::mt19937& random) : random_(random) {}
  double between(double low, double high) {
    return low + (high - low) * double(random_() >> 5) / double(1 << 27);
  }
  /// From `low` to `high`, both among them.
  int integer(int low, int high) { return std::min(int(between(low, high + 1)), high); }
  bool once_in(int n) { return integer(1, n) == 1; }

 private:
  std::mt19937& random_;
};

// Random scenes of every kind that presets can express.

enum class SceneKind {
  circle,
  curve,
  cap,
  revolution,
  profile,
  translation,
  blocks,
  push,
  load,
  rods,
  network
};
constexpr auto words(SceneKind) {
  return names_except<SceneKind>(
      {{SceneKind::revolution, "cylinder and saddle"}, {SceneKind::rods, "rods and ends"}});
}

/// A network, flat or in space, its joints and ends of one kind or of several.
void random_network(RandomDraw& draw, preset::Preset& p);

/// A preset of that kind, with 4 to 14 rods per direction and a tolerance of 1e-2 to 1e-4; the same
/// for the same random numbers on every machine.
preset::Preset random_preset(SceneKind kind, std::mt19937& random);

// Whether a user may trust the reports of a run: random scenes of every kind, solved with defaults
// and on meshes of another family (5, 10, 20 edges per segment instead of 4, 8, 16), with load
// steps of half the size, an eighth of the tolerance and other numbers of frames.

struct TrustOptions {
  int scenes = 600;                 ///< of all kinds in turn, networks left out
  std::optional<SceneKind> kind{};  ///< of this one alone
  int seed = 1;
  double seconds = 20;  ///< a longer run is too slow
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
