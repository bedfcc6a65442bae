#include "engine/core/whole_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

namespace gridshell {
namespace {

tl::unexpected<Error> cannot_write(const std::filesystem::path& path, const char* reason) {
  return fail(Fault::io, fmt::format("cannot write {}: {}", path.string(), reason));
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
    return cannot_write(path, error.message().c_str());
  }
  return {};
}

Result<void> write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
  return write_whole_file(path, [&](const std::filesystem::path& temporary) -> Result<void> {
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    if (!file) return cannot_write(path, std::strerror(errno));
    const bool all = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    const int write_error = errno;
    // a full disk may show only when the buffer is flushed
    const bool closed = std::fclose(file) == 0;
    if (!all || !closed) return cannot_write(path, std::strerror(all ? errno : write_error));
    return {};
  });
}

}  // namespace gridshell
