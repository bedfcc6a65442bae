// The checksum of the files of a run: 64-bit FNV-1a. It tells damage, not intent.
#pragma once

#include <cstdint>
#include <string_view>

namespace gridshell {

class Checksum {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) sum_ = (sum_ ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  }
  std::uint64_t value() const { return sum_; }
  static std::uint64_t of(std::string_view bytes) {
    Checksum sum;
    sum.add(bytes);
    return sum.value();
  }

 private:
  std::uint64_t sum_ = 14695981039346656037u;
};

}  // namespace gridshell
