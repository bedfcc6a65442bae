// Why the end of a path may not be the state that was meant, although its meshes agree.
#pragma once

#include <string>

#include "engine/simulate/equilibrium_path.h"

namespace gridshell::simulate {

/// A sentence on what the meshes of a path do not confirm; else on a state that nearly coincides
/// with its image under a symmetry, on a branch that is entered late, or on a rod that turns
/// freely; else empty. Of a push or steps, also on the formed shell.
std::string doubt_about(const EquilibriumPath& path);

}  // namespace gridshell::simulate
