// Numbers drawn evenly, the same ones from the same generator on every machine: those of
// std::uniform_real_distribution differ from library to library.
#pragma once

#include <random>

namespace gridshell {

/// The next one in [-1, 1).
inline double even(std::mt19937& random) { return double(random()) / double(1u << 31) - 1; }

}  // namespace gridshell
