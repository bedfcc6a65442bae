// The layout of a run in HDF5: in trajectory.h5, and by itself in a journal.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/formats/hdf5_file.h"
#include "engine/record/trajectory.h"

namespace gridshell::record {

/// Writes /layout, /rods, /joints, /cells and, of building blocks, /parts.
void write_layout(hdf5::Writer& file, const Layout& layout);

/// Reads them; what failed is in `file`. Indices are still to be checked (consistency.h).
Layout read_layout(hdf5::Reader& file);

/// A layout as an HDF5 file in memory; empty when the library failed.
std::string image_of(const Layout& layout);
/// Errors: bad_input with the reason.
Result<Layout> layout_of_image(std::string_view bytes);

// The frames of a run in HDF5: all of trajectory.h5 but layout and origin.

/// Writes /nodes, /cell_K, what is known of the rods, /K_bins and /frames; each frame is taken once
/// and let go.
void write_frames(hdf5::Writer& file, const Layout& layout, const FrameList& frames);

/// Frames that are read from the file on demand; the columns are in memory. Columns that an older
/// version did not write are unknown. `file` has the error, if any; its parts must fit `layout`.
FrameList read_frames(const std::shared_ptr<hdf5::Reader>& file, const Layout& layout);

}  // namespace gridshell::record
