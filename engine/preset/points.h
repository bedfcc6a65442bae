// Points as a preset lists them.
#pragma once

#include <vector>

namespace gridshell::preset {

/// Points of a curve, each of as many coordinates as its key says, mm.
using Points = std::vector<std::vector<double>>;

}  // namespace gridshell::preset
