// Calls of the system, allocations and solves that fail on order, in this program alone.
#pragma once

#include <string>

/// What can be made to fail.
enum class Call { write, rename, mkdir, allocation, factorisation, solve };

/// From now on counts calls of this kind, and fails the k-th of them (from 1): a write as on a full
/// disk, a factorisation with a pivot that is zero, a solve with numbers that are none, the others
/// as they fail. The calls after it succeed again; 0 fails none.
void fail_call(Call kind, long k);

/// How many calls of the kind there were since fail_call.
long calls_counted();
