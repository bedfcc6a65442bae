#include "app/baselines.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <set>

#include "engine/core/atomic_file.h"
#include "render/image/png.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

Result<std::set<fs::path>> names_in(const fs::path& folder) {
  std::set<fs::path> names;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error))
    if (at->path().extension() == ".png") names.insert(at->path().lexically_relative(folder));
  if (error)
    return fail(Fault::bad_input,
                fmt::format("'{}' cannot be read: {}", folder.string(), error.message()));
  return names;
}

Result<std::optional<render::Image>> picture(const fs::path& folder, const fs::path& name,
                                             const std::set<fs::path>& there) {
  if (!there.contains(name)) return std::optional<render::Image>();
  auto image = render::read_png(folder / name);
  if (!image) return tl::unexpected(image.error());
  return std::optional(std::move(*image));
}

}  // namespace

Result<std::vector<render::PicturePair>> pictures_of(const fs::path& before,
                                                     const fs::path& after) {
  const auto old_names = names_in(before), new_names = names_in(after);
  for (const auto* names : {&old_names, &new_names})
    if (!*names) return tl::unexpected(names->error());
  std::set<fs::path> all = *old_names;
  all.insert(new_names->begin(), new_names->end());
  std::vector<render::PicturePair> pairs;
  for (const fs::path& name : all) {
    auto a = picture(before, name, *old_names), b = picture(after, name, *new_names);
    for (const auto* image : {&a, &b})
      if (!*image) return tl::unexpected(image->error());
    pairs.push_back({name.generic_string(), std::move(*a), std::move(*b)});
  }
  return pairs;
}

Result<void> update_baselines(const fs::path& before, const std::vector<render::PicturePair>& pairs,
                              double threshold, const std::string& why) {
  std::string names;
  for (const render::PicturePair& pair : pairs) {
    if (render::judge(pair, threshold).same) continue;
    names += (names.empty() ? "" : ", ") + pair.name;
    const fs::path file = before / pair.name;
    if (!pair.after) {
      std::error_code error;
      if (!fs::remove(file, error))
        return fail(Fault::io, fmt::format("cannot remove '{}'", file.string()));
      continue;
    }
    auto written = make_folder(file.parent_path()).and_then([&] {
      return render::write_png(*pair.after, file);
    });
    if (!written) return written;
  }
  if (names.empty()) return {};
  std::error_code missing;
  std::string text = "# Why the kept pictures changed\n\n";
  if (fs::exists(before / "WHY.md", missing)) {
    auto kept = read_whole(before / "WHY.md");
    if (!kept) return tl::unexpected(kept.error());
    text = std::move(*kept);
  }
  const std::time_t now = std::time(nullptr);
  text += fmt::format("- {:%Y-%m-%d}: {} ({})\n", fmt::gmtime(now), why, names);
  return write_atomically(before / "WHY.md", text);
}

}  // namespace gridshell::app
