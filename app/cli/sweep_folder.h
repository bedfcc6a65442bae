// Files of a sweep: its folder, the folders of its shards, its log.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/gridshell.h"

namespace gridshell::app {

/// One part of a sweep that is spread over machines.
struct Shard {
  int index = 1, count = 1;  ///< from 1

  std::string folder() const;  ///< "shard_2_of_8"
};

/// The shard that "2/8" names. Errors: bad_input for any other text.
Result<Shard> parse_shard(const std::string& text);

/// Opens and locks the log of a sweep in `folder`, which is created if it is missing. Errors:
/// bad_input if the folder has files that no sweep wrote; those of SweepLog::open().
Result<record::SweepLog> open_sweep(const std::filesystem::path& folder,
                                    const preset::Presets& presets, const preset::SweepGrid& grid);

/// The case, values and seed of a point, as the files of the sweep name them.
record::PointKeys keys_of(const preset::SweepGrid& grid, std::size_t point);

/// The keys that a sweep varies, in their order.
std::vector<std::string> axes_of(const preset::SweepGrid& grid);

/// The table of some points of a sweep, all of which are in `found`.
record::SweepTable table_of(const preset::SweepGrid& grid, const std::vector<std::size_t>& points,
                            const std::map<std::size_t, record::PointResult>& found);

/// The file with the table of a sweep, which is written when all of its points are computed.
inline constexpr const char* sweep_table_name = "sweep.csv";

/// Reads all points of a finished sweep: `named` is its folder, its table, or the name of a table
/// that comes with the presets. Errors (bad_input): there is no such file, or it is no such table.
Result<record::SweepTable> read_finished_sweep(const std::string& named);

/// Adds the points in the logs of the shards in `folder` to `log`. Errors: bad_input if there is no
/// shard, or one of another preset; io.
Result<void> gather_shards(const std::filesystem::path& folder, record::SweepLog& log,
                           const preset::Presets& presets, const preset::SweepGrid& grid);

}  // namespace gridshell::app
