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

/// "2/8". Errors: bad_input for anything else.
Result<Shard> parse_shard(const std::string& text);

/// The log of a sweep in `folder`, which is created if missing, locked. Errors (bad_input): the
/// folder has files that no sweep wrote, and those of SweepLog::open().
Result<record::SweepLog> open_sweep(const std::filesystem::path& folder,
                                    const preset::Presets& presets, const preset::SweepGrid& grid);

/// What a point is set to, as the files say it.
record::PointKeys keys_of(const preset::SweepGrid& grid, std::size_t point);

/// The keys that a sweep goes over, in their order.
std::vector<std::string> axes_of(const preset::SweepGrid& grid);

/// Results of some points of a sweep; all of them are in `found`.
record::SweepTable table_of(const preset::SweepGrid& grid, const std::vector<std::size_t>& points,
                            const std::map<std::size_t, record::PointResult>& found);

/// The table of a sweep, which is written once all of its points are there.
inline constexpr const char* sweep_table_name = "sweep.csv";

/// All points of a sweep that finished: of its folder, of its table, or of one of the tables that
/// come with the presets. Errors (bad_input): no such file, or one without all points.
Result<record::SweepTable> read_finished_sweep(const std::string& named);

/// Adds what the shards in `folder` found to its log. Errors: bad_input where there is no shard or
/// one is of another preset; io.
Result<void> gather_shards(const std::filesystem::path& folder, record::SweepLog& log,
                           const preset::Presets& presets, const preset::SweepGrid& grid);

}  // namespace gridshell::app
