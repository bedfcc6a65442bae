#include "engine/core/file_io.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <libdeflate.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <vector>

#include "engine/core/try.h"

namespace gridshell {

tl::unexpected<Error> fail_io(const char* what, const std::filesystem::path& path, int code) {
  return fail(Fault::io, "cannot {} '{}': {}", what, path.string(),
              std::generic_category().message(code));
}

int Descriptor::close() {
  const int number = std::exchange(number_, -1);
  return number >= 0 && ::close(number) != 0 ? errno : 0;
}

AtomicFile::AtomicFile(std::filesystem::path final_path) : final_(std::move(final_path)) {
  // the name is at the end: encoders choose a format by the extension
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

void Checksum::add(std::string_view bytes) {
  if (bytes.empty()) return;  // given no bytes at a null pointer, libdeflate starts a new checksum
  if (kind_ == ChecksumKind::crc32)
    sum_ = libdeflate_crc32(std::uint32_t(sum_), bytes.data(), bytes.size());
  else
    for (const char byte : bytes) sum_ = (sum_ ^ static_cast<unsigned char>(byte)) * 1099511628211u;
}

int append_whole(int descriptor, std::string_view bytes, std::uint64_t& size) {
  const int code = write_all(descriptor, bytes);
  if (code == 0) size += bytes.size();
  // a partial write is removed, so that readers find complete lines only
  if (code && ::ftruncate(descriptor, off_t(size)) == 0) ::lseek(descriptor, off_t(size), SEEK_SET);
  return code;
}

Result<void> write_file(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile target(path);
  Descriptor file(
      ::open(target.temporary().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file < 0) return fail_io("write", path, errno);
  if (const int code = write_all(file, bytes)) return fail_io("write", path, code);
  if (const int code = file.close()) return fail_io("write", path, code);
  return target.commit();
}

Result<ReadableFile> ReadableFile::open(const std::filesystem::path& path) {
  ReadableFile opened;
  // without waiting: opening a pipe that nobody writes to would never end
  opened.file_ = Descriptor(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  struct stat about {};
  if (opened.file_ < 0 || ::fstat(opened.file_, &about) != 0) return fail_io("read", path, errno);
  if (S_ISDIR(about.st_mode)) return fail_io("read", path, EISDIR);
  if (!S_ISREG(about.st_mode))
    return fail(Fault::io, "cannot read '{}': got a pipe or a device, expected a regular file",
                path.string());
  opened.size_ = std::uint64_t(about.st_size);
  return opened;
}

std::optional<std::string> ReadableFile::read(std::uint64_t at, std::uint64_t size) const {
  if (at > size_ || size > size_ - at) return std::nullopt;
  std::string bytes(size, '\0');
  for (std::size_t got = 0; got < size;) {
    const ssize_t now = ::pread(file_, bytes.data() + got, size - got, off_t(at + got));
    if (now < 0 && errno == EINTR) continue;
    if (now <= 0) return std::nullopt;
    got += std::size_t(now);
  }
  return bytes;
}

namespace {

/// Reads an open file from its current position.
Result<std::string> read_all(int file, const std::filesystem::path& path, std::uint64_t expected,
                             std::uintmax_t limit) {
  const auto too_large = [&] {
    return fail(Fault::io, "cannot read '{}': it is larger than {} MB", path.string(), limit >> 20);
  };
  if (expected > limit) return too_large();
  // some files of the system report a size of 0, so the bytes that were read are counted
  std::string bytes;
  bytes.reserve(std::size_t(expected));
  std::vector<char> block(1 << 16);
  for (;;) {
    const ssize_t got = ::read(file, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return fail_io("read", path, errno);
    if (got == 0) return bytes;
    bytes.append(block.data(), std::size_t(got));
    if (bytes.size() > limit) return too_large();
  }
}

}  // namespace

Result<std::string> read_file(const std::filesystem::path& path, std::uintmax_t limit) {
  TRY(opened, ReadableFile::open(path));
  return read_all(opened->file_, path, opened->size(), limit);
}

Result<std::string> read_pipe(const std::filesystem::path& path, std::uintmax_t limit) {
  const Descriptor pipe(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY));
  if (pipe < 0) return fail_io("read", path, errno);
  return read_all(pipe, path, 0, limit);
}

Result<void> make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail_io("make folder", folder, error.value());
  return {};
}

}  // namespace gridshell
