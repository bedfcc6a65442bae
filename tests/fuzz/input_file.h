// Bytes as a file, in memory where the system has such files.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

namespace gridshell::fuzz {

class InputFile {
 public:
  explicit InputFile(std::string_view bytes) {
    path_ = std::filesystem::is_directory("/dev/shm") ? "/dev/shm/gridshell-fuzz-XXXXXX"
                                                      : "/tmp/gridshell-fuzz-XXXXXX";
    const int descriptor = mkstemp(path_.data());
    while (!bytes.empty()) {
      const ssize_t put = ::write(descriptor, bytes.data(), bytes.size());
      if (put <= 0) break;
      bytes.remove_prefix(std::size_t(put));
    }
    ::close(descriptor);
  }
  ~InputFile() { ::unlink(path_.c_str()); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::filesystem::path path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace gridshell::fuzz
