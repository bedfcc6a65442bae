// An HDF5 driver that writes to a descriptor and never tells the library of a failed write: version
// 1.10 loses track of what it holds on a full disk and may crash. The failure is kept for whoever
// asks.
#pragma once

#include <hdf5.h>

#include <cstddef>

#include "engine/record/hdf5_file.h"

namespace gridshell::record::hdf5 {

/// Where the bytes go; outlives the file.
struct Stream {
  int descriptor = -1;     ///< open for reading and writing, the caller's
  std::size_t before = 0;  ///< bytes of the file that stand before the HDF5 part
  int failure = 0;         ///< errno of the first write that failed
};

/// Access properties of a file that writes to `stream`.
Handle access_of(Stream& stream);

}  // namespace gridshell::record::hdf5
