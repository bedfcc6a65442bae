// Attributes of an SVG: numbers, paths, transforms.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/formats/outline_file.h"

namespace gridshell::preset {

/// Reads numbers and commands of an attribute, one after the other.
class SvgWords {
 public:
  explicit SvgWords(std::string text) : text_(std::move(text)), rest_(text_) {}
  SvgWords(const SvgWords&) = delete;

  bool at_end() { return skip(), rest_.empty(); }
  /// The next command; empty: a number is next.
  std::optional<char> command();
  std::optional<double> number();
  /// A flag of an arc, 0 or 1; no space is needed after it.
  std::optional<double> flag();
  std::string_view rest() const { return rest_; }

 private:
  void skip();
  std::string text_;
  std::string_view rest_;
};

/// Adds the lines of a path to `lines`; a curve has 64 points, an arc one per degree. Returns the
/// error, or an empty text.
std::string read_path(const std::string& text, std::vector<PlanLine>& lines);

/// The transform of a text such as "translate(3 4) rotate(30)"; empty: it is not supported.
std::optional<Eigen::Affine2d> transform_of(std::string_view text);

}  // namespace gridshell::preset
