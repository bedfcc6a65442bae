// Folders of reference pictures, and the pictures that replace them.

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ctime>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "engine/core/file_io.h"
#include "engine/core/result.h"
#include "engine/core/try.h"
#include "render/gl/image.h"
#include "render/movie/page.h"

namespace gridshell::app {

namespace fs = std::filesystem;
namespace {

Result<std::set<fs::path>> names_in(const fs::path& folder) {
  std::set<fs::path> names;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error))
    if (at->path().extension() == ".png") names.insert(at->path().lexically_relative(folder));
  if (error) return invalid("'{}' cannot be read: {}", folder.string(), error.message());
  return names;
}

Result<std::optional<render::Image>> picture(const fs::path& folder, const fs::path& name,
                                             const std::set<fs::path>& there) {
  if (!there.contains(name)) return std::optional<render::Image>();
  TRY(image, render::read_png(folder / name));
  return std::optional(std::move(*image));
}

/// All PNG files of both folders and the folders in them, by their path in the folder, in order;
/// with `selected` those of `before` alone, without the folders in it that `after` does not have.
Result<std::vector<render::PicturePair>> pictures_of(const fs::path& before, const fs::path& after,
                                                     bool selected) {
  TRY(old_names, names_in(before));
  TRY(new_names, names_in(after));
  std::set<fs::path> all = *old_names;
  // of runs that were not made again nothing is known: `update` must not remove their pictures
  if (!selected)
    all.insert(new_names->begin(), new_names->end());
  else
    std::erase_if(all, [&](const fs::path& name) {
      return name.has_parent_path() && !fs::is_directory(after / *name.begin());
    });
  std::vector<render::PicturePair> pairs;
  for (const fs::path& name : all) {
    TRY(a, picture(before, name, *old_names));
    TRY(b, picture(after, name, *new_names));
    pairs.push_back({name.generic_string(), std::move(*a), std::move(*b)});
  }
  return pairs;
}

/// Replaces every reference picture that changed, removes those that no longer exist, and writes
/// the reason and the number of pictures of each folder into `before`/WHY.md.
Result<void> update_baselines(const fs::path& before, const std::vector<render::PicturePair>& pairs,
                              double threshold, const std::string& why) {
  std::map<std::string, int> changed;
  for (const render::PicturePair& pair : pairs) {
    if (render::compare_versions(pair, threshold).same) continue;
    ++changed[fs::path(pair.name).begin()->string()];
    const fs::path file = before / pair.name;
    if (!pair.after) {
      std::error_code error;
      if (!fs::remove(file, error)) return fail(Fault::io, "cannot remove '{}'", file.string());
      continue;
    }
    TRY_DO(make_folder(file.parent_path()));
    TRY_DO(render::write_png(*pair.after, file));
  }
  if (changed.empty()) return {};
  std::error_code missing;
  std::string text = "# Why the saved pictures changed\n\n";
  if (fs::exists(before / "WHY.md", missing)) {
    TRY(earlier, read_file(before / "WHY.md"));
    text = std::move(*earlier);
  }
  std::vector<std::string> names;
  for (const auto& [name, count] : changed)
    names.push_back(count == 1 ? name : fmt::format("{} {}", name, count));
  const std::time_t now = std::time(nullptr);
  text += fmt::format("- {:%Y-%m-%d}: {} ({})\n", fmt::gmtime(now), why, fmt::join(names, ", "));
  return write_file(before / "WHY.md", text);
}

// `gridshell compare A B`: the image-regression metric, on pictures or folders of them.

struct CompareOptions {
  std::string a, b, difference, why;
  bool update = false, selected = false;
  double threshold = render::default_difference_threshold;
};

Result<void> write_difference(const render::Image& picture, const CompareOptions& options) {
  const fs::path file = options.difference;
  if (file.has_parent_path()) TRY_DO(make_folder(file.parent_path()));
  return render::write_png(picture, file);
}

Result<bool> compare_pictures(const CompareOptions& options) {
  TRY(a, as_input(render::read_png(options.a)));
  TRY(b, as_input(render::read_png(options.b)));
  TRY(worst, render::compare(*a, *b));
  const bool same = worst->same(options.threshold);
  fmt::print("{}: worst {} x {} block at ({}, {}) differs by {:.2f} of 255, threshold {}\n",
             same ? "same" : "different", worst->width, worst->height, worst->x, worst->y,
             worst->difference, options.threshold);
  if (!options.difference.empty())
    TRY_DO(write_difference(render::difference_picture(*a, *b, *worst), options));
  return same;
}

Result<bool> compare_folders(const CompareOptions& options) {
  TRY(pairs, as_input(pictures_of(options.a, options.b, options.selected)));
  // else a folder named wrongly would pass, or remove all that is saved
  if (std::ranges::none_of(*pairs, [](const auto& pair) { return pair.after.has_value(); }))
    return invalid("'{}' has none of the pictures to compare, expected PNG files", options.b);
  std::vector<render::PicturePair> different;
  for (const render::PicturePair& pair : *pairs) {
    const auto verdict = render::compare_versions(pair, options.threshold);
    if (verdict.same) continue;
    fmt::print("{}: {}\n", pair.name, verdict.text);
    different.push_back(pair);
  }
  fmt::print("{} of {} pictures differ, threshold {}\n", different.size(), pairs->size(),
             options.threshold);
  if (!options.difference.empty() && !different.empty()) {
    TRY(sheet, render::contact_sheet(different, options.threshold));
    TRY_DO(write_difference(*sheet, options));
  }
  if (!options.update) return different.empty();
  TRY_DO(update_baselines(options.a, *pairs, options.threshold, options.why));
  return true;
}

Result<int> compare(const CompareOptions& options) {
  const bool a = fs::is_directory(options.a), b = fs::is_directory(options.b);
  if (a != b) {
    std::error_code unknown;
    for (const std::string& given : {options.a, options.b})
      if (!fs::exists(given, unknown) && !unknown) return invalid("'{}' does not exist", given);
    return invalid("'{}' is a folder and '{}' is none: compare two pictures or two folders",
                   a ? options.a : options.b, a ? options.b : options.a);
  }
  if (options.update && (!a || options.why.empty()))
    return invalid(a ? "--update needs --why \"...\": the reason is saved with the pictures"
                     : "--update is for folders of saved pictures");
  TRY(same, a ? compare_folders(options) : compare_pictures(options));
  return *same ? ExitCode::done : ExitCode::different;
}

}  // namespace

void add_compare(CommandLine& program) {
  auto [command, options] = program.add<CompareOptions>(
      "compare", "whether two pictures, or folders of them, are the same to the eye", compare);
  command.option("A", options.a, "a PNG, or a folder of saved ones").required();
  command.option("B", options.b, "another of the same size, or a folder").required();
  command
      .option("--threshold", options.threshold, "largest mean difference of an 8 x 8 block, of 255")
      .in_range(0.0, 255.0)
      .show_default();
  command.option("--difference", options.difference,
                 "PNG to write, differences in red; of folders a sheet of all that differ");
  command.flag("--selected", options.selected,
               "of folders only the pictures in A, without its folders that B does not have");
  command.flag("--update", options.update, "replace A's pictures by B's");
  command.option("--why", options.why, "with --update: the reason, saved in A/WHY.md");
}

}  // namespace gridshell::app
