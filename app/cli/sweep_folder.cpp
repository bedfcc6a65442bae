#include "app/cli/sweep_folder.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/cli/preset_library.h"
#include "engine/core/file_io.h"
#include "engine/core/try.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

/// "shard_2_of_8"
bool is_shard_folder(const fs::path& path) {
  const std::string name = path.filename().string(), begin = "shard_";
  return name.starts_with(begin) && two_numbers(name.substr(begin.size()), "_of_");
}

record::SweepIdentity name_of(const preset::Presets& presets, const preset::SweepGrid& grid) {
  return {presets.base.name, study::config_of(presets), grid.size()};
}

/// A file in a folder without a log that no sweep writes; empty: none.
std::string foreign_in(const fs::path& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const auto name = at->path().filename().string();
    // shards of this sweep may be running in the same folder
    if (!is_shard_folder(name) && !name.starts_with(".partial-")) names.push_back(name);
  }
  std::ranges::sort(names);
  return names.empty() ? "" : names.front();
}

}  // namespace

std::string Shard::folder() const { return fmt::format("shard_{}_of_{}", index, count); }

Result<Shard> parse_shard(const std::string& text) {
  const auto part = two_numbers(text, "/").value_or(std::pair(0, 0));
  const Shard shard{part.first, part.second};
  if (shard.index < 1 || shard.index > shard.count)
    return invalid(
        "--shard {}: expected i/N with i from 1 to N, for example 2/8; where jobs are counted "
        "from 0: --shard $((SLURM_ARRAY_TASK_ID + 1))/N",
        text);
  return shard;
}

Result<record::SweepLog> open_sweep(const fs::path& folder, const preset::Presets& presets,
                                    const preset::SweepGrid& grid) {
  const auto refuse = [&](const std::string& why) {
    return invalid("cannot write the folder '{}': {}; choose another folder with -o",
                   folder.string(), why);
  };
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) return refuse("it is a file");
  if (!fs::exists(folder / record::sweep_log_name, error))
    if (const auto foreign = foreign_in(folder); !foreign.empty())
      return refuse(fmt::format("it is no sweep, and contains '{}'", foreign));
  if (auto made = make_folder(folder); !made)
    return tl::unexpected(Error{Fault::bad_input, made.error().message});
  return record::SweepLog::open(folder / record::sweep_log_name, name_of(presets, grid),
                                axes_of(grid),
                                [&grid](std::size_t point) { return keys_of(grid, point); });
}

record::PointKeys keys_of(const preset::SweepGrid& grid, std::size_t point) {
  auto at = grid.at(point);
  return {std::move(at.case_name), std::move(at.values), at.seed};
}

std::vector<std::string> axes_of(const preset::SweepGrid& grid) {
  std::vector<std::string> keys;
  for (const auto& axis : grid.sweep().over) keys.push_back(axis.key);
  return keys;
}

record::SweepTable table_of(const preset::SweepGrid& grid, const std::vector<std::size_t>& points,
                            const std::map<std::size_t, record::PointResult>& found) {
  record::SweepTable table;
  table.axes = axes_of(grid);
  table.has_cases = grid.has_cases();
  table.has_seeds = grid.sweep().seeds > 1;
  for (const std::size_t point : points)
    table.rows.push_back({keys_of(grid, point), found.at(point)});
  return table;
}

Result<record::SweepTable> read_finished_sweep(const std::string& named) {
  std::error_code error;
  fs::path file = named;
  if (fs::is_directory(file, error)) file /= sweep_table_name;
  const auto shipped = embedded_files().find(named);
  auto text = read_file(file);
  if (!text && shipped != embedded_files().end()) text = shipped->second;
  if (!text) return invalid("no finished sweep: {}", text.error().message);
  auto table = record::read_sweep_csv(*text);
  if (!table)
    return invalid("'{}' is no table of a sweep: {}", file.string(), table.error().message);
  return table;
}

Result<void> gather_shards(const fs::path& folder, record::SweepLog& log,
                           const preset::Presets& presets, const preset::SweepGrid& grid) {
  std::vector<fs::path> shards;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (is_shard_folder(*at)) shards.push_back(*at);
  if (shards.empty())
    return invalid(
        "'{}' contains no shard: they are written by 'gridshell sweep PRESET --shard i/N' "
        "with the same -o",
        folder.string());
  std::ranges::sort(shards);
  std::map<std::size_t, record::PointResult> found;
  for (const auto& shard : shards) {
    auto contents = record::read_sweep_log(shard / record::sweep_log_name);
    if (!contents) return tl::unexpected(Error{Fault::bad_input, contents.error().message});
    if (!contents->name.same_sweep(name_of(presets, grid)))
      return invalid("'{}' is a shard of another preset ('{}'), or of other values", shard.string(),
                     contents->name.preset);
    found.merge(contents->found);
  }
  for (const auto& [point, result] : found)
    if (!log.found().contains(point)) TRY_DO(log.append(result));
  return {};
}

}  // namespace gridshell::app
