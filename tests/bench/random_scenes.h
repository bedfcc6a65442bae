// Random scenes of every kind that presets can express.
#pragma once

#include <algorithm>
#include <random>

#include "engine/core/enum_words.h"
#include "engine/preset/preset.h"

namespace gridshell::bench {

/// Random values that depend on the generator alone and are the same on every machine, unlike those
/// of the standard library's distributions.
class RandomDraw {
 public:
  explicit RandomDraw(std::mt19937& random) : random_(random) {}
  double between(double low, double high) {
    return low + (high - low) * double(random_() >> 5) / double(1 << 27);
  }
  /// An integer from `low` to `high`, both included.
  int integer(int low, int high) { return std::min(int(between(low, high + 1)), high); }
  bool once_in(int n) { return integer(1, n) == 1; }

 private:
  std::mt19937& random_;
};

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

/// Makes `p` a random network, flat or in space, with joints and ends of one kind or of several.
void random_network(RandomDraw& draw, preset::Preset& p);

/// A preset of that kind, with 4 to 14 rods per direction and a tolerance of 1e-2 to 1e-4; the same
/// for the same random numbers on every machine.
preset::Preset random_preset(SceneKind kind, std::mt19937& random);

}  // namespace gridshell::bench
