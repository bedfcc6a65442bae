// Which rung of the model ladder a preset needs: no more than its scene asks for.
#pragma once

#include <string>
#include <vector>

#include "engine/preset/consistency.h"
#include "engine/preset/preset.h"

namespace gridshell::preset {

/// Something that a rung does not have.
struct Requirement {
  std::string table, key;
  std::string what;  ///< "ends that are clamped hold the rods' spin"
};

/// Why the `bend` rung (stretch and bend of rods that spin freely, on shared joints) would not be
/// exact. Empty: it is.
std::vector<Requirement> twist_requirements(const Preset& preset);

/// Why the `net` rung (the smooth net itself) is not enough: what needs an equilibrium. Empty: a
/// net is all that is asked for.
std::vector<Requirement> equilibrium_requirements(const Preset& preset);

/// The rung that a preset runs on: the one it asks for, else the lowest that is exact; `net` only
/// where a tolerance of 0.05 or more is asked for a cap of a sphere, of which it is known that
/// shells lie within 0.03 of their net.
RodModel rod_model_of(const Preset& preset);

/// One sentence: which rung, what was left out, and why nothing is lost.
std::string model_reason(const Preset& preset);

/// What the physics of a preset lacks, or a rung that is asked for cannot serve.
std::vector<Conflict> physics_conflicts(const Preset& preset);

}  // namespace gridshell::preset
