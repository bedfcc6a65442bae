#include "engine/core/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace gridshell {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

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

Result<void> write_atomically(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile target(path);
  File file(std::fopen(target.temporary().c_str(), "wb"));
  if (!file) return fail_io("write", path, errno);
  if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
    return fail_io("write", path, errno);
  // what is still buffered may meet the full disk only now
  if (std::fclose(file.release()) != 0) return fail_io("write", path, errno);
  return target.commit();
}

Result<std::string> read_whole(const std::filesystem::path& path) {
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) return fail_io("read", path, errno);
  std::string bytes;
  char block[1 << 16];
  while (const std::size_t got = std::fread(block, 1, sizeof block, file.get()))
    bytes.append(block, got);
  // a folder opens, but does not read
  if (std::ferror(file.get())) return fail_io("read", path, errno);
  return bytes;
}

Result<void> make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail_io("make folder", folder, error.value());
  return {};
}

}  // namespace gridshell
