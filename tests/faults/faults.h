// Makes system calls, allocations by `new`, factorisations and solves of this program fail on
// request.
#pragma once

#include <string>

/// What can be made to fail.
enum class Call { write, sync, rename, mkdir, allocation, factorisation, solve };

/// Counts calls of this kind from now on, and makes the k-th of them (from 1) fail: a write as on a
/// full disk, a factorisation as one that is not usable, a solve with NaN as its result. An
/// allocation is one by `new`; those of Eigen, HDF5 and other C libraries, by `malloc`, do not
/// fail. The calls after it succeed again; with k = 0 none fails.
void fail_call(Call kind, long k);

/// The number of calls of the kind since fail_call.
long calls_counted();
