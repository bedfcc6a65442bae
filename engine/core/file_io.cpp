#include "engine/core/file_io.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

namespace gridshell {
namespace {

// a descriptor that closes itself
struct Descriptor {
  explicit Descriptor(int number) : number(number) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number;
};

tl::unexpected<Error> fail_io(const char* what, const std::filesystem::path& path, int code) {
  return fail(Fault::io, fmt::format("cannot {} '{}': {}", what, path.string(),
                                     std::generic_category().message(code)));
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path final_path) : final_(std::move(final_path)) {
  // the name goes last: encoders choose a format by the extension
  temporary_ =
      final_.parent_path() / fmt::format(".partial-{}-{}", ::getpid(), final_.filename().string());
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!committed_) std::filesystem::remove(temporary_, ignored);
}

Result<void> AtomicFile::commit() {
  std::error_code error;
  std::filesystem::rename(temporary_, final_, error);
  if (error) return fail_io("write", final_, error.value());
  committed_ = true;
  return {};
}

int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(descriptor, bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return put < 0 ? errno : ENOSPC;
    bytes.remove_prefix(std::size_t(put));
  }
  return 0;
}

Result<void> write_file(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile target(path);
  Descriptor file(
      ::open(target.temporary().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.number < 0) return fail_io("write", path, errno);
  if (const int code = write_all(file.number, bytes)) return fail_io("write", path, code);
  // what is still on its way may meet the full disk only now
  if (::close(std::exchange(file.number, -1)) != 0) return fail_io("write", path, errno);
  return target.commit();
}

Result<std::string> read_file(const std::filesystem::path& path, std::uintmax_t limit) {
  // without waiting: opening a pipe that nobody writes to would never end
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (file.number < 0) return fail_io("read", path, errno);
  struct stat about {};
  if (::fstat(file.number, &about) != 0) return fail_io("read", path, errno);
  if (S_ISDIR(about.st_mode)) return fail_io("read", path, EISDIR);
  const auto refuse = [&](const std::string& reason) {
    return fail(Fault::io, fmt::format("cannot read '{}': {}", path.string(), reason));
  };
  if (!S_ISREG(about.st_mode)) return refuse("it is a pipe or a device, must be a regular file");
  // some files of the system say that they are empty, so the count is what decides
  std::string bytes;
  const auto too_large = [&] {
    return refuse(fmt::format("it is larger than {} MB", limit >> 20));
  };
  if (std::uintmax_t(about.st_size) > limit) return too_large();
  bytes.reserve(std::size_t(about.st_size));
  std::vector<char> block(1 << 16);
  for (;;) {
    const ssize_t got = ::read(file.number, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return fail_io("read", path, errno);
    if (got == 0) return bytes;
    bytes.append(block.data(), std::size_t(got));
    if (bytes.size() > limit) return too_large();
  }
}

Result<void> make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail_io("make folder", folder, error.value());
  return {};
}

}  // namespace gridshell
