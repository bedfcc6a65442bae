// The frames of a run in HDF5: all of trajectory.h5 but layout and origin.
#pragma once

#include <memory>

#include "engine/record/hdf5_reader.h"
#include "engine/record/hdf5_writer.h"
#include "engine/record/snapshot.h"

namespace gridshell::record {

/// Writes /nodes, /cell_K, what is known of the rods, /K_bins and /frames; each frame is taken once
/// and let go.
void write_frames(hdf5::Writer& file, const Layout& layout, const FrameList& frames);

/// Frames that stay in the file until they are asked for; the columns are in memory. A column that
/// an older version did not write is unknown. What failed is in `file`, whose parts must fit
/// `layout`.
FrameList read_frames(const std::shared_ptr<hdf5::Reader>& file, const Layout& layout);

}  // namespace gridshell::record
