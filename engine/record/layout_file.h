// The layout of a run in HDF5: in trajectory.h5, and by itself in a journal.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/record/hdf5_reader.h"
#include "engine/record/hdf5_writer.h"
#include "engine/record/snapshot.h"

namespace gridshell::record {

/// Writes /layout, /rods, /joints, /cells and, of building blocks, /parts.
void write_layout(hdf5::Writer& file, const Layout& layout);

/// Reads them; what failed is in `file`. Indices are still to be checked (consistency.h).
Layout read_layout(hdf5::Reader& file);

/// A layout as an HDF5 file in memory; empty when the library failed.
std::string image_of(const Layout& layout);
/// Errors: bad_input with the reason.
Result<Layout> layout_of_image(std::string_view bytes);

}  // namespace gridshell::record
