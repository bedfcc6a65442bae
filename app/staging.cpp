#include "app/staging.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <vector>

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

// out/x and out/x/ are one folder
fs::path without_slash(const fs::path& folder) {
  const auto normal = fs::absolute(folder).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

// why the folder must not be replaced, or empty
std::string refusal(const fs::path& folder) {
  std::error_code error;
  const auto status = fs::status(folder, error);
  if (!fs::exists(status)) return "";
  if (!fs::is_directory(status)) return "it is a file";
  if (fs::exists(folder / "summary.json", error) || fs::is_empty(folder, error)) return "";
  return "it exists and is no run (it has no summary.json); choose another folder with -o";
}

fs::path outermost_missing(fs::path folder) {
  fs::path missing;
  std::error_code error;
  while (!folder.empty() && !fs::exists(folder, error)) {
    missing = folder;
    if (folder == folder.parent_path()) break;
    folder = folder.parent_path();
  }
  return missing;
}

// both folders exist: they change names at once, so that neither is ever missing
bool exchange(const fs::path& a, const fs::path& b) {
  return renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
}

}  // namespace

Result<StagedFolder> StagedFolder::create(const fs::path& final_folder) {
  const auto refuse = [&](const std::string& reason) {
    return fail(Fault::bad_input,
                fmt::format("cannot write the folder '{}': {}", final_folder.string(), reason));
  };
  const auto target = without_slash(final_folder);
  if (const auto reason = refusal(target); !reason.empty()) return refuse(reason);
  auto partial = target;
  partial += fmt::format(".partial-{}", getpid());
  const auto first_made = outermost_missing(target.parent_path());
  std::error_code error;
  fs::create_directories(partial, error);
  if (error) {
    std::error_code ignored;
    if (!first_made.empty()) fs::remove_all(first_made, ignored);
    return refuse(error.message());
  }
  return StagedFolder(target, partial, first_made);
}

StagedFolder::StagedFolder(fs::path final_folder, fs::path partial, fs::path first_made)
    : final_(std::move(final_folder)),
      partial_(std::move(partial)),
      first_made_(std::move(first_made)) {}

StagedFolder::StagedFolder(StagedFolder&& other) noexcept
    : final_(std::move(other.final_)),
      partial_(std::move(other.partial_)),
      first_made_(std::move(other.first_made_)),
      settled_(std::exchange(other.settled_, true)) {}

StagedFolder::~StagedFolder() {
  if (!settled_) remove();
}

void StagedFolder::remove() noexcept {
  std::error_code error;
  fs::remove_all(partial_, error);
  if (first_made_.empty()) return;
  // only folders made for this run and empty again
  for (auto folder = partial_.parent_path(); fs::is_empty(folder, error) && !error;
       folder = folder.parent_path()) {
    fs::remove(folder, error);
    if (folder == first_made_) break;
  }
}

Result<void> StagedFolder::commit() {
  std::error_code error;
  if (exchange(partial_, final_)) {
    fs::remove_all(partial_, error);
  } else {
    // nothing there yet, or a file system that cannot exchange
    auto old = final_;
    old += fmt::format(".old-{}", getpid());
    const bool replaced = fs::exists(final_, error);
    if (replaced) fs::rename(final_, old, error);
    if (!error) fs::rename(partial_, final_, error);
    if (error) {
      const auto reason = error.message();
      if (replaced && !fs::exists(final_)) fs::rename(old, final_, error);
      return fail(Fault::io,
                  fmt::format("cannot write the folder '{}': {}", final_.string(), reason));
    }
    fs::remove_all(old, error);
  }
  settled_ = true;
  return {};
}

void StagedFolder::keep() {
  remove_unfinished(partial_);
  settled_ = true;
}

void remove_unfinished(const fs::path& folder) noexcept {
  std::error_code error;
  std::vector<fs::path> hidden;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error))
    if (at->path().filename().string().starts_with('.')) hidden.push_back(at->path());
  for (const auto& path : hidden) fs::remove_all(path, error);
}

}  // namespace gridshell::app
