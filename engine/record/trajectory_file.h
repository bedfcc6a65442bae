// trajectory.h5: a complete trajectory in HDF5, read back bit for bit.
//
//   /nodes          frames x nodes x 3  positions, mm
//   /rods           a list of nodes per rod, from edge point to edge point
//   /joints         {i, j, u_mm, v_mm, node}
//   /cells          {i, j, u_mm, v_mm, joints[4]}
//   /cell_K         frames x cells      integrated Gauss curvature, rad
//   /K_bins         frames x bins x 3   mean, standard deviation of K (rad), number of cells
//   /axial_force_N, ...                 the arrays of each_rod_field() (frame_columns.h)
//   /frames/<name>  frames              the columns of frames.csv, and `actuation`
//   /layout         spacing_mm, rod_diameter_mm, length_scale_mm, joint_diameter_mm,
//                   joint_height_mm, table_mm (attributes); edge_points (nodes),
//                   original_boundary, actuated_boundary (points x 3, mm), net_nodes, flat_nodes
//                   (nodes x 3, mm); if known: families ("u" or "v" for each rod), supports (nodes
//                   that may be constrained), sprung (nodes that springs pull to their supports)
//                   and spring_stiffness (along x, y, z, N/mm), diameters, laths and strength (for
//                   each rod), above (second node of each joint), load_joints, load_directions
//   /parts          building blocks and the rods across their seams
//   /               title, preset, program (attributes)
//
// Reactions are extrapolated as the energies of /frames are. NaN, or no dataset: not known.
//
// The HDF5 part follows a header of 512 bytes with its size and checksum, which HDF5 programs skip.
// Datasets have their unit in the attribute `unit`. Equal trajectories give equal bytes. Frames are
// written and read one at a time.
#pragma once

#include <filesystem>

#include "engine/core/result.h"
#include "engine/record/trajectory.h"

namespace gridshell::record {

/// Writes `path` completely or not at all. Errors: Fault::io with path and reason, for a full disk,
/// too; Fault::bad_input if the trajectory's parts are inconsistent.
Result<void> write_trajectory(const std::filesystem::path& path, const Trajectory& trajectory);

struct TrajectoryReadOptions {
  /// Whether to read files of other programs, which have no header or another checksum.
  bool no_checksum = false;
  /// Whether to read the file in a process of its own first, so that a damaged file cannot end this
  /// one.
  bool trial = true;
};

/// Opens a file of write_trajectory; its frames are read on demand. Columns that an older version
/// did not write are unknown. Errors: Fault::io if it cannot be read; Fault::bad_input, in a
/// sentence with the path, if it is no HDF5 file, is cut short or damaged, is no trajectory, or has
/// inconsistent parts.
Result<Trajectory> read_trajectory(const std::filesystem::path& path,
                                   const TrajectoryReadOptions& how = {});

}  // namespace gridshell::record
