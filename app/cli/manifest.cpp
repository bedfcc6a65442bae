#include "app/cli/staged_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "app/cli/delivery.h"
#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/gridshell.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

// the first line of a manifest: the command that made the folder follows; version 0.2.0 named none
const std::string first_line = "gridshell run 1", made_by = ", made by ";

// all files and empty folders under a folder, relative to it, sorted
std::vector<std::string> contents(const fs::path& folder, std::error_code& error) {
  std::vector<std::string> found;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    // a link counts as a file, so that a circle of links is not followed
    const bool inner =
        !at->is_symlink(error) && at->is_directory(error) && !fs::is_empty(at->path(), error);
    if (!inner) found.push_back(at->path().lexically_relative(folder).generic_string());
  }
  std::ranges::sort(found);
  return found;
}

struct Manifest {
  std::string command;  // that made the folder, or empty
  std::set<std::string> names;

  /// Whether it lists a file or an empty folder, or what a folder that was emptied contained.
  bool lists(const std::string& name) const {
    const auto inside = names.lower_bound(name + "/");
    return names.contains(name) || (inside != names.end() && inside->starts_with(name + "/"));
  }
};

// the manifest of a folder; nothing if it has none
std::optional<Manifest> manifest_of(const fs::path& folder) {
  const auto text = read_file(folder / manifest_name, largest_text);
  if (!text) return std::nullopt;
  std::istringstream lines(*text);
  std::string line;
  if (!std::getline(lines, line)) return std::nullopt;
  if (line != first_line && !line.starts_with(first_line + made_by)) return std::nullopt;
  Manifest manifest{line.substr(std::min(line.size(), (first_line + made_by).size())),
                    {manifest_name}};
  while (std::getline(lines, line)) manifest.names.insert(line);
  return manifest;
}

// the names that files of a run or chart without a manifest may have
struct LegacyRunFiles {
  std::set<std::string> stems;  // names of pictures begin with these
  std::set<std::string> cases;  // folders that are runs
};

// the names of a run's files, from the summary or the journal of its folder; nothing if it has none
std::optional<LegacyRunFiles> named(const fs::path& folder) {
  LegacyRunFiles run;
  const auto name_pictures = [&](const fs::path& preset) {
    run.stems = {
        preset.filename().string(), "accuracy", "unknowns", "scaling", "stability", "branches"};
    if (run.stems.contains("")) run.stems.erase("");
  };
  const auto text = read_file(folder / "summary.json", largest_text);
  const auto json = text ? parsed(*text) : Json();
  const auto has = [&](const char* key) { return json.is_object() && json.contains(key); };
  if (has("preset") && json["preset"].is_string() &&
      (has("negative_pivots") || has("cases") || has("chart"))) {
    name_pictures(json["preset"].get<std::string>());
    if (has("cases") && json["cases"].is_array())
      for (const auto& one : json["cases"])
        for (const char* key : {"name", "preset"})
          if (one.is_object() && one.contains(key) && one[key].is_string())
            run.cases.insert(fs::path(one[key].get<std::string>()).filename().string());
    // a folder is not its own case
    for (const char* name : {"", ".", ".."}) run.cases.erase(name);
    return run;
  }
  const auto preset = record::preset_of_journal(folder);
  if (!preset) return std::nullopt;
  name_pictures(*preset);
  return run;
}

// the names of the files of a run, or of a folder of unfinished cases, which has neither summary
// nor journal. Deeper folders are not searched, since a user may give any folder of the machine.
std::optional<LegacyRunFiles> unlisted(const fs::path& folder) {
  if (auto run = named(folder)) return run;
  LegacyRunFiles run;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->is_directory(error) && named(at->path()))
      run.cases.insert(at->path().filename().string());
  if (run.cases.empty()) return std::nullopt;
  return run;
}

bool is_temporary(const std::string& name) { return name.starts_with(".partial-"); }

/// "frames/frame_00012.png", with five digits or more
bool is_frame(const std::string& name) {
  const std::string begin = "frames/frame_", end = ".png";
  if (!name.starts_with(begin) || !name.ends_with(end)) return false;
  const auto digits = name.substr(begin.size(), name.size() - begin.size() - end.size());
  return digits.size() >= 5 && digits.find_first_not_of("0123456789") == digits.npos;
}

/// Whether a file belongs to the saved path of an interrupted run: "segments/version",
/// "segments/CASE/segment_0003".
bool is_of_path(const std::string& name) {
  if (!name.starts_with(std::string(segments_name) + "/")) return false;
  const auto file = fs::path(name).filename().string();
  return file == version_name || file.starts_with("segment_");
}

bool may_be_of(const LegacyRunFiles& run, const std::string& name) {
  static const std::string data = fmt::format(
      " summary.json preset.toml joints.csv cells.csv frames.csv bins.csv seams.csv trajectory.h5 "
      "movie.mp4 movie.webm movie.gif title.png poster.png accuracy.csv scaling.csv stability.csv "
      "branches.csv design.json design.csv "
      "ends.csv ends_rounded.csv rods.csv scan.json scan.csv measured.csv scan.png frames "
      "{} {} {} {} {} {} ",
      record::states_name, record::search_name, record::transitions_name, record::barriers_name,
      record::journal_name, record::coarser_journal_name);
  if ((name.find(' ') == name.npos && data.find(" " + name + " ") != data.npos) ||
      is_temporary(fs::path(name).filename().string()) || is_frame(name) || is_of_path(name))
    return true;
  const auto kind = fs::path(name).extension();
  if (name.find('/') != std::string::npos || (kind != ".png" && kind != ".svg")) return false;
  return std::ranges::any_of(run.stems, [&](const auto& stem) { return name.starts_with(stem); });
}

// appends the names in a folder without a manifest that no run gives its files
void gather_foreign(const fs::path& folder, const LegacyRunFiles& run, const std::string& before,
                    std::vector<std::string>& foreign) {
  std::error_code error;
  for (const auto& name : contents(folder, error)) {
    const auto slash = name.find('/');
    const auto inner = name.substr(0, slash);
    if (run.cases.contains(inner) && fs::is_directory(folder / inner, error)) continue;
    if (!may_be_of(run, name)) foreign.push_back(before + name);
  }
  for (const auto& name : run.cases) {
    if (!fs::is_directory(folder / name, error)) continue;
    if (const auto inner = named(folder / name))
      gather_foreign(folder / name, *inner, before + name + "/", foreign);
    else if (!fs::is_empty(folder / name, error))
      foreign.push_back(before + name);
  }
}

std::string foreign_text(const std::vector<std::string>& foreign) {
  if (foreign.empty()) return "";
  const auto more = foreign.size() - 1;
  return fmt::format("it contains what no run wrote there: '{}'{}", foreign.front(),
                     more ? fmt::format(" and {} more", more) : "");
}

}  // namespace

Result<void> write_manifest(const fs::path& folder, const std::string& command) {
  std::error_code error;
  std::string text = first_line + made_by + command + "\n";
  for (const auto& name : contents(folder, error))
    if (name != manifest_name) text += name + "\n";
  if (error) return fail(Fault::io, "cannot list '{}': {}", folder.string(), error.message());
  return write_file(folder / manifest_name, text);
}

std::string maker_of(const fs::path& folder) {
  if (const auto manifest = manifest_of(folder); manifest && !manifest->command.empty())
    return manifest->command;
  const auto text = read_file(folder / "summary.json", largest_text);
  const auto json = text ? parsed(*text) : Json();
  const auto kind_in = [](const Json& one) -> std::string {
    return one.is_object() && one.contains("kind") && one["kind"].is_string()
               ? one["kind"].get<std::string>()
               : "";
  };
  if (json.is_object() && json.contains("cases") && json["cases"].is_array() &&
      !json["cases"].empty())
    return kind_in(json["cases"].front());
  return kind_in(json);
}

bool has_manifest(const fs::path& folder) { return manifest_of(folder).has_value(); }

std::string why_not_a_run(const fs::path& folder) {
  std::error_code error;
  std::vector<std::string> foreign;
  if (const auto manifest = manifest_of(folder)) {
    for (const auto& name : contents(folder, error))
      if (!manifest->lists(name) && !is_temporary(fs::path(name).filename().string()))
        foreign.push_back(name);
  } else if (const auto run = unlisted(folder)) {
    gather_foreign(folder, *run, "", foreign);
  } else if (fs::exists(folder / "summary.json", error)) {
    return "it exists and is no run (its summary.json is not one of a run)";
  } else {
    return "it exists and is no run (it has no summary.json)";
  }
  if (error) return "it cannot be read: " + error.message();
  return foreign_text(foreign);
}

}  // namespace gridshell::app
