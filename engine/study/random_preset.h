// Random scenes of every kind that presets can express.
#pragma once

#include <random>

#include "engine/core/words.h"
#include "engine/preset/preset.h"

namespace gridshell::study {

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
  rods
};
constexpr auto words(SceneKind) {
  return word_table<SceneKind>({{SceneKind::circle, "circle"},
                                {SceneKind::curve, "curve"},
                                {SceneKind::cap, "cap"},
                                {SceneKind::revolution, "cylinder and saddle"},
                                {SceneKind::profile, "profile"},
                                {SceneKind::translation, "translation"},
                                {SceneKind::blocks, "blocks"},
                                {SceneKind::push, "push"},
                                {SceneKind::load, "load"},
                                {SceneKind::rods, "rods and ends"}});
}

/// A preset of that kind, of 4 to 14 rods a direction, with a tolerance of 1e-2 to 1e-4; the same
/// for the same numbers drawn, on every machine.
preset::Preset random_preset(SceneKind kind, std::mt19937& random);

}  // namespace gridshell::study
