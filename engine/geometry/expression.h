// A function of x, y and z that a user writes down.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "engine/core/result.h"

namespace gridshell {

/// "x^2 + 2*y^2 - sin(z)": arithmetic with ^, the usual functions, _pi, and x, y, z in mm; read by
/// muParser. Its copies share what they compute with: one thread at a time.
class Expression {
 public:
  /// Errors (bad_input): what does not parse, with the place counted from 1.
  static Result<Expression> parse(const std::string& text);

  const std::string& text() const { return text_; }
  /// Not a number where it has no value.
  double at(const Eigen::Vector3d& point) const;

 private:
  struct Parsed;
  Expression(std::string text, std::shared_ptr<Parsed> parsed)
      : text_(std::move(text)), parsed_(std::move(parsed)) {}

  std::string text_;
  std::shared_ptr<Parsed> parsed_;
};

}  // namespace gridshell
