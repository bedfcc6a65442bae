// A reading tried out where it can do no harm.
#pragma once

#include <functional>

#include "engine/core/result.h"

namespace gridshell::record {

/// Runs `reading` in a process of its own, with little memory and time beyond what it began with:
/// the HDF5 library may crash, loop or ask for all memory on structures that somebody crafted. What
/// it returns does not matter, only that it does. Errors: bad_input when it did not.
Result<void> try_out(const std::function<void()>& reading);

}  // namespace gridshell::record
