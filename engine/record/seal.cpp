#include "engine/record/seal.h"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <vector>

#include "engine/record/checksum.h"

namespace gridshell::record {
namespace {

/// Name and checksum of the HDF5 bytes that follow.
std::string seal_of(std::uintmax_t bytes, const Checksum& sum) {
  std::string seal =
      fmt::format("{}\n{} bytes, FNV-1a {:016x}\n", trajectory_format, bytes, sum.value());
  seal.resize(seal_size, '\0');
  return seal;
}

}  // namespace

std::string seal_due(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(seal_size);
  Checksum sum;
  std::uintmax_t bytes = 0;
  std::vector<char> block(1 << 18);
  while (file) {
    file.read(block.data(), std::streamsize(block.size()));
    const auto got = std::size_t(file.gcount());
    sum.add({block.data(), got});
    bytes += got;
  }
  return file.eof() ? seal_of(bytes, sum) : std::string();
}

std::string distrust(const std::filesystem::path& path, bool unsealed) {
  std::string start(seal_size, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), seal_size);
  const auto got = std::size_t(file.gcount());
  start.resize(got);
  if (start.starts_with("\x89HDF\r\n\x1a\n"))
    return unsealed ? ""
                    : "it bears no seal, so another program wrote it ('render --unsealed' reads it "
                      "all the same)";
  if (!start.starts_with(trajectory_format)) return "it is not an HDF5 file";
  if (got < seal_size) return "it is cut short";
  if (start == seal_due(path) || unsealed) return "";
  return "it is cut short, damaged or was changed: its checksum does not match";
}

}  // namespace gridshell::record
