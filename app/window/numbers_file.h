// Numbers that need not be in memory now.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <cstdio>
#include <memory>

namespace gridshell::window {

/// Where an array of numbers lies in the file, and its shape.
struct PutAside {
  std::int64_t at = 0;
  Eigen::Index rows = 0, columns = 0;
};

/// A file without a name, which goes with the program.
class NumbersFile {
 public:
  /// How much of it is in use, bytes.
  std::int64_t bytes() const { return end_; }

  /// Writes an array and empties it; false, and the array as it was, where there is no room.
  template <class Array>
  bool put(Array& array, PutAside& aside) {
    aside = {end_, array.rows(), array.cols()};
    if (!write(array.data(), std::size_t(array.size()))) return false;
    array = Array();
    return true;
  }
  /// Reads it again, to the bit; false where the file does not give it.
  template <class Array>
  bool take(const PutAside& aside, Array& array) const {
    array.resize(aside.rows, aside.columns);
    return read(aside.at, array.data(), std::size_t(array.size()));
  }

 private:
  bool write(const double* numbers, std::size_t count);
  bool read(std::int64_t at, double* numbers, std::size_t count) const;

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  std::int64_t end_ = 0;
};

}  // namespace gridshell::window
