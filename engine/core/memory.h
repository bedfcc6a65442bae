// How much memory there is to work with.
#pragma once

#include <cstdint>

namespace gridshell {

/// Bytes of the machine, or of the share that a container gives this program; 0 when nobody says.
std::uint64_t machine_memory_bytes();

/// What a command may use where a preset does not say ([accuracy] memory_GB): half of that.
inline double default_memory_GB() { return 0.5e-9 * double(machine_memory_bytes()); }

}  // namespace gridshell
