// Conversion of values to bytes and back, in the machine's representation.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace gridshell {

/// Converts values to bytes.
class ByteWriter {
 public:
  template <class T>
  void number(T value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void text(const std::string& value) {
    number(std::uint64_t(value.size()));
    text_ += value;
  }
  template <class Matrix>
  void matrix(const Matrix& values) {
    number(std::int64_t(values.rows()));
    number(std::int64_t(values.cols()));
    text_.append(reinterpret_cast<const char*>(values.data()),
                 sizeof(typename Matrix::Scalar) * std::size_t(values.size()));
  }
  void put(int value) { number(std::int32_t(value)); }
  void put(double value) { number(value); }
  void put(const std::string& value) { text(value); }
  void reserve(std::size_t bytes) { text_.reserve(bytes); }
  const std::string& bytes() const& { return text_; }
  std::string bytes() && { return std::move(text_); }

 private:
  std::string text_;
};

/// Reads packed bytes, never past the end; all reads fail after the first that found too few bytes.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}
  bool good() const { return good_; }
  bool at_end() const { return good_ && left_.empty(); }

  template <class T>
  T number() {
    // another byte than 0 and 1 in a bool is undefined behaviour
    if constexpr (std::is_same_v<T, bool>) {
      const auto byte = number<std::uint8_t>();
      good_ = good_ && byte <= 1;
      return good_ && byte == 1;
    }
    T value{};
    if (take(sizeof value)) std::memcpy(&value, taken_.data(), sizeof value);
    return value;
  }
  std::string text() {
    const auto size = number<std::uint64_t>();
    return take(size) ? std::string(taken_) : std::string();
  }
  template <class Matrix>
  void matrix(Matrix& values) {
    const auto rows = number<std::int64_t>(), cols = number<std::int64_t>();
    const auto most = std::int64_t(left_.size() / sizeof(typename Matrix::Scalar));
    const auto fits = [&](std::int64_t extent, int requested) {
      // a matrix without entries may still have rows or columns
      return requested >= 0 ? extent == requested
                            : extent >= 0 && extent <= std::max<std::int64_t>(most, 3);
    };
    good_ = good_ && fits(rows, Matrix::RowsAtCompileTime) &&
            fits(cols, Matrix::ColsAtCompileTime) && (cols == 0 || rows <= most / cols);
    if (!good_ || !take(sizeof(typename Matrix::Scalar) * std::size_t(rows * cols))) return;
    values.resize(rows, cols);
    if (values.size() > 0) std::memcpy(values.data(), taken_.data(), taken_.size());
  }
  void get(int& value) { value = number<std::int32_t>(); }
  void get(double& value) { value = number<double>(); }
  void get(std::string& value) { value = text(); }

 private:
  bool take(std::uint64_t size) {
    good_ = good_ && size <= left_.size();
    if (!good_) return false;
    taken_ = left_.substr(0, size);
    left_.remove_prefix(size);
    return true;
  }
  std::string_view left_, taken_;
  bool good_ = true;
};

}  // namespace gridshell
