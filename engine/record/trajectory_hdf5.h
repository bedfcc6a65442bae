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

/// Reads what write_layout() wrote. Errors are in `file`. The caller checks the indices
/// (check_layout() of trajectory.h).
Layout read_layout(hdf5::Reader& file);

/// The bytes of an HDF5 file with this layout; empty if the library failed.
std::string image_of(const Layout& layout);
/// The layout in bytes of image_of(). Errors: bad_input with the reason.
Result<Layout> layout_of_image(std::string_view bytes);

// The frames of a run in HDF5: all of trajectory.h5 except layout and origin.

/// Writes /nodes, /cell_K, the arrays along rods that frames have, /K_bins and /frames. Each frame
/// is read once, so that only a few are in memory.
void write_frames(hdf5::Writer& file, const Layout& layout, const FrameList& frames);

/// Frames whose arrays are read from the file on demand; their columns are in memory. Columns that
/// an older version did not write are unknown. Errors, also datasets that do not fit `layout`, are
/// in `file`.
FrameList read_frames(const std::shared_ptr<hdf5::Reader>& file, const Layout& layout);

}  // namespace gridshell::record
