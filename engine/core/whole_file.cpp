#include "engine/core/whole_file.h"

#include <fmt/format.h>

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

tl::unexpected<Error> cannot(const char* what, const std::filesystem::path& path, int code) {
  return fail(Fault::io, fmt::format("cannot {} {}: {}", what, path.string(),
                                     std::generic_category().message(code)));
}

}  // namespace

Result<void> write_whole_file(
    const std::filesystem::path& path,
    const std::function<Result<void>(const std::filesystem::path& temporary)>& write) {
  std::filesystem::path temporary = path;
  temporary += ".part";
  std::error_code ignored, error;
  if (auto written = write(temporary); !written) {
    std::filesystem::remove(temporary, ignored);
    return written;
  }
  std::filesystem::rename(temporary, path, error);
  if (error) {
    std::filesystem::remove(temporary, ignored);
    return cannot("write", path, error.value());
  }
  return {};
}

Result<void> write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
  return write_whole_file(path, [&](const std::filesystem::path& temporary) -> Result<void> {
    File file(std::fopen(temporary.c_str(), "wb"));
    if (!file) return cannot("write", path, errno);
    if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
      return cannot("write", path, errno);
    // a full disk may show only when the buffer is flushed
    if (std::fclose(file.release()) != 0) return cannot("write", path, errno);
    return {};
  });
}

Result<std::string> read_whole_file(const std::filesystem::path& path) {
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) return cannot("read", path, errno);
  std::string bytes;
  char block[1 << 16];
  while (const std::size_t got = std::fread(block, 1, sizeof block, file.get()))
    bytes.append(block, got);
  // a folder opens, but does not read
  if (std::ferror(file.get())) return cannot("read", path, errno);
  return bytes;
}

Result<void> make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return cannot("make folder", folder, error.value());
  return {};
}

}  // namespace gridshell
