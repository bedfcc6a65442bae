#include "app/cli/staged_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "engine/core/try.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

std::string reason(int code) { return std::generic_category().message(code); }

// the absolute path of a folder, without a slash at the end; for a link that of its target
fs::path target_of(const fs::path& folder) {
  auto normal = fs::absolute(folder).lexically_normal();
  if (!normal.has_filename()) normal = normal.parent_path();
  std::error_code error;
  if (!fs::is_symlink(normal, error)) return normal;
  const auto led = fs::canonical(normal, error);
  return error ? normal : led;
}

bool may_replace(const std::string& command, const std::string& maker) {
  return command.empty() || maker.empty() || command == maker ||
         (command == "movie" && maker == "run");
}

// why the folder must not be replaced, or empty
std::string refusal(const fs::path& folder, const std::string& command) {
  std::error_code error;
  const auto status = fs::status(folder, error);
  if (!fs::exists(status)) return fs::is_symlink(folder, error) ? "it is a broken link" : "";
  if (!fs::is_directory(status)) return "it is a file";
  if (fs::is_empty(folder, error) && !error) return "";
  const auto because = why_not_a_run(folder);
  if (!because.empty()) return because + "; choose another folder with -o";
  const auto maker = maker_of(folder);
  if (may_replace(command, maker)) return "";
  return fmt::format(
      "it was made by 'gridshell {}', and 'gridshell {}' replaces only what it made itself; choose "
      "another folder with -o, or remove this one",
      maker, command);
}

tl::unexpected<Error> cannot_write(const fs::path& folder, const std::string& because) {
  return invalid("cannot write the folder '{}': {}", folder.string(), because);
}

Result<void> check_writable(const fs::path& folder, const std::string& command) {
  const auto because = refusal(target_of(folder), command);
  return because.empty() ? Result<void>() : cannot_write(folder, because);
}

long lines_of(const fs::path& file) {
  std::ifstream text(file);
  return std::count(std::istreambuf_iterator<char>(text), {}, '\n');
}

// the name of a frames.csv in `old` that has more frames than the same file in `made`; else empty
fs::path longer_frames(const fs::path& old, const fs::path& made) {
  std::error_code error;
  for (fs::recursive_directory_iterator at(old, error), end; !error && at != end;
       at.increment(error)) {
    const fs::path name = at->path().lexically_relative(old);
    if (name.filename() == "frames.csv" && lines_of(at->path()) > lines_of(made / name))
      return name;
  }
  return {};
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

// removes folders that are empty, from `folder` up to `outermost`
void remove_empty(fs::path folder, const fs::path& outermost) {
  if (outermost.empty()) return;
  for (;;) {
    if (::rmdir(folder.c_str()) != 0 || folder == outermost) return;
    folder = folder.parent_path();
  }
}

// the number of a folder in its file system; 0 if there is none
ino_t number_of(const fs::path& folder) {
  struct stat about {};
  return ::stat(folder.c_str(), &about) == 0 ? about.st_ino : 0;
}

// makes a folder with a new name; the process id alone may have been used before
Result<fs::path> make_new(const fs::path& target, const char* kind) {
  for (int k = 1;; ++k) {
    auto folder = target;
    folder += fmt::format(".{}-{}", kind, getpid());
    if (k > 1) folder += fmt::format("-{}", k);
    if (::mkdir(folder.c_str(), 0777) == 0) return folder;
    if (errno != EEXIST) return fail(Fault::io, reason(errno));
  }
}

// a descriptor with the lock of a folder, or -1 and the error number: EWOULDBLOCK if another
// program has the lock
struct Lock {
  int descriptor = -1, failure = 0;
};

Lock lock_of(const fs::path& folder) {
  const int number = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (number < 0) return {-1, errno};
  if (::flock(number, LOCK_EX | LOCK_NB) == 0) return {number, 0};
  const int failure = errno;
  ::close(number);
  return {-1, failure};
}

int rename_how(const fs::path& from, const fs::path& to, unsigned flags) {
  return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0 ? 0 : errno;
}

// renames `from` to a name that is free or that of an empty folder; returns 0 or the error number.
// Where the file system has no RENAME_NOREPLACE, a plain rename replaces nothing but empty folders.
int take_free_name(const fs::path& from, const fs::path& to) {
  const int code = rename_how(from, to, RENAME_NOREPLACE);
  if (code == 0 || code == EEXIST) return code;
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

// exchanges the names of two folders in one step; where the file system cannot do that, in three
// steps with the name `aside` of an empty folder. Returns 0 or the error number.
int exchange(const fs::path& a, const fs::path& b, const fs::path& aside) {
  const int code = rename_how(a, b, RENAME_EXCHANGE);
  if (code == 0 || (code != EINVAL && code != ENOSYS)) return code;
  if (::rename(b.c_str(), aside.c_str()) != 0) return errno;
  if (::rename(a.c_str(), b.c_str()) == 0)
    return ::rename(aside.c_str(), a.c_str()) == 0 ? 0 : errno;
  const int failed = errno;
  return ::rename(aside.c_str(), b.c_str()) == 0 ? failed : errno;
}

}  // namespace

std::string refusal_to_write(const fs::path& folder, const std::string& command) {
  return refusal(target_of(folder), command);
}

fs::path next_to(const fs::path& folder, const std::string& suffix) {
  fs::path normal = folder.lexically_normal();
  if (!normal.has_filename()) normal = normal.parent_path();
  if (normal == "." || normal.filename() == "..") normal = target_of(normal);
  return normal += suffix;
}

Result<void> check_output_file(const fs::path& to) {
  std::error_code error;
  if (fs::exists(to, error) && !fs::is_regular_file(to, error))
    return invalid("'{}' is no file that could be written", to.string());
  fs::path folder = fs::absolute(to, error).parent_path();
  while (folder.has_relative_path() && !fs::exists(folder, error)) folder = folder.parent_path();
  if (!fs::is_directory(folder, error) || ::access(folder.c_str(), W_OK) != 0)
    return invalid("'{}' cannot be written: '{}' is no folder in which files can be made",
                   to.string(), folder.string());
  return check_outside_runs(to);
}

Result<void> check_outside_runs(const fs::path& to) {
  std::error_code error;
  for (fs::path folder = fs::weakly_canonical(fs::absolute(to, error), error).parent_path();
       folder != folder.root_path() && !folder.empty(); folder = folder.parent_path())
    if (has_manifest(folder))
      return invalid("'{}' is in the run folder '{}'; choose a folder outside it", to.string(),
                     folder.string());
  return {};
}

Result<StagedFolder> StagedFolder::create(const fs::path& final_folder,
                                          const std::string& command) {
  TRY_DO(check_writable(final_folder, command));
  const auto refuse = [&](const std::string& because) {
    return cannot_write(final_folder, because);
  };
  const auto target = target_of(final_folder);
  const auto parent = target.parent_path(), first_made = outermost_missing(parent);
  std::error_code error;
  fs::create_directories(parent, error);
  if (error) {
    remove_empty(parent, first_made);
    return refuse(error.message());
  }
  auto partial = make_new(target, "partial");
  if (!partial) {
    remove_empty(parent, first_made);
    return refuse(partial.error().message);
  }
  Lock lock = lock_of(*partial);
  // left_behind() in another program has the lock for an instant
  for (int k = 0; k < 100 && lock.failure == EWOULDBLOCK; ++k) {
    ::usleep(1000);
    lock = lock_of(*partial);
  }
  if (lock.failure)
    std::fprintf(stderr,
                 "'%s' cannot be locked (%s): others may take it for left behind while it is "
                 "written\n",
                 partial->c_str(), reason(lock.failure).c_str());
  return StagedFolder(target, command, *partial, first_made, lock.descriptor);
}

Result<StagedFolder> StagedFolder::resume(const fs::path& final_folder, const std::string& command,
                                          const fs::path& partial) {
  TRY_DO(check_writable(final_folder, command));
  const Lock lock = lock_of(partial);
  if (lock.failure)
    return fail(Fault::io, "cannot continue in '{}': {}", partial.string(), reason(lock.failure));
  remove_unfinished(partial);
  return StagedFolder(target_of(final_folder), command, partial, {}, lock.descriptor);
}

StagedFolder::StagedFolder(fs::path final_folder, std::string command, fs::path partial,
                           fs::path first_made, int lock)
    : final_(std::move(final_folder)),
      partial_(std::move(partial)),
      command_(std::move(command)),
      first_made_(std::move(first_made)),
      replaces_(number_of(final_)),
      lock_(lock) {}

StagedFolder::StagedFolder(StagedFolder&& other) noexcept
    : final_(std::move(other.final_)),
      partial_(std::move(other.partial_)),
      command_(std::move(other.command_)),
      first_made_(std::move(other.first_made_)),
      replaces_(other.replaces_),
      lock_(std::exchange(other.lock_, -1)),
      settled_(std::exchange(other.settled_, true)) {}

StagedFolder::~StagedFolder() {
  if (!settled_) remove();
  if (lock_ >= 0) ::close(lock_);
}

void StagedFolder::remove() noexcept {
  try {
    std::error_code error;
    fs::remove_all(partial_, error);
    remove_empty(partial_.parent_path(), first_made_);
  } catch (const std::exception&) {
    // the remains have a partial name
  }
}

Result<std::string> StagedFolder::commit() {
  const auto refuse = [&](const std::string& because) {
    return fail(Fault::io, "cannot write the folder '{}': {}", final_.string(), because);
  };
  TRY_DO(write_manifest(partial_, command_));
  const int code = take_free_name(partial_, final_);
  if (code == 0) {
    settled_ = true;
    return std::string();
  }
  if (code != EEXIST && code != ENOTEMPTY && code != ENOTDIR) return refuse(reason(code));
  // another program may have changed or written the folder since create()
  if (const auto because = refusal(final_, command_); !because.empty()) return refuse(because);
  if (number_of(final_) != replaces_ && !fs::is_empty(final_))
    return refuse("another command wrote it meanwhile; choose another folder with -o");
  if (const auto lost = longer_frames(final_, partial_);
      command_ == "movie" && maker_of(final_) == "run" && !lost.empty())
    return refuse(fmt::format(
        "its run has more frames than this movie ('{}': {} instead of {}); choose another folder "
        "with -o, or --frames as many",
        lost.string(), lines_of(final_ / lost) - 1, lines_of(partial_ / lost) - 1));
  auto old = make_new(final_, "old");
  if (!old) return refuse(old.error().message);
  const auto give_up = [&](const std::string& because) {
    ::rmdir(old->c_str());
    return refuse(because);
  };
  if (const int failed = exchange(partial_, final_, *old); failed) return give_up(reason(failed));
  if (const auto because = refusal(partial_, command_); !because.empty()) {
    // it was changed between the check and the exchange
    if (const int failed = exchange(partial_, final_, *old); failed)
      return give_up(
          fmt::format("{}, and what was there is now in '{}', as it could not be put back: {}",
                      because, partial_.string(), reason(failed)));
    return give_up(because);
  }
  // under this name the old run can be recognised if its removal is interrupted
  ::rmdir(old->c_str());
  settled_ = true;
  if (rename_how(partial_, *old, 0) != 0) old = partial_;
  return remove_old(*old);
}

Result<std::string> StagedFolder::remove_old(const fs::path& old) {
  std::error_code error;
  fs::remove_all(old, error);
  if (!error) return std::string();
  return fmt::format(
      "the earlier run in '{}' could not be removed ({}): what is left of it is "
      "in '{}'",
      final_.string(), error.message(), old.string());
}

void StagedFolder::keep() {
  remove_unfinished(partial_);
  settled_ = true;
}

std::vector<fs::path> left_behind(const fs::path& final_folder) {
  const auto target = target_of(final_folder);
  const auto name = target.filename().string();
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator at(target.parent_path(), error), end; !error && at != end;
       at.increment(error)) {
    const auto other = at->path().filename().string();
    if (!other.starts_with(name + ".partial-") && !other.starts_with(name + ".old-")) continue;
    // without its lock it may be one that another program is writing
    const int lock = lock_of(at->path()).descriptor;
    if (lock < 0) continue;
    ::close(lock);
    found.push_back(at->path());
  }
  std::ranges::sort(found);
  return found;
}

void remove_unfinished(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> hidden;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error))
    if (at->path().filename().string().starts_with('.')) hidden.push_back(at->path());
  for (const auto& path : hidden) fs::remove_all(path, error);
}

}  // namespace gridshell::app
