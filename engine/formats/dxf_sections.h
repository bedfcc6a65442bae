// A DXF file by its sections, before anything is made of it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/formats/point_file.h"

namespace gridshell::preset {

/// A group code and the value on the line after it.
struct DxfGroup {
  int code = 0;
  std::string_view value;
  int line = 0;  ///< of the value
};

/// An entity as the file has it, with the vertices of a polyline or the attributes of a block.
struct RawEntity {
  std::string kind;
  int line = 0;
  std::vector<DxfGroup> groups = {};
  std::vector<RawEntity> parts = {};

  std::string_view text(int code) const {
    for (const DxfGroup& group : groups)
      if (group.code == code) return group.value;
    return {};
  }
  double number(int code, double otherwise = 0) const {
    return number_of(text(code)).value_or(otherwise);
  }
  int flags(int code) const { return int(std::clamp(number(code), 0.0, 1e6)); }
  Eigen::Vector3d point(int code,
                        const Eigen::Vector3d& otherwise = Eigen::Vector3d::Zero()) const {
    return {number(code, otherwise.x()), number(code + 10, otherwise.y()),
            number(code + 20, otherwise.z())};
  }
  /// All values of a code, in order.
  std::vector<double> numbers(int code) const {
    std::vector<double> all;
    for (const DxfGroup& group : groups)
      if (group.code == code) all.push_back(number_of(group.value).value_or(0));
    return all;
  }
  std::vector<Eigen::Vector3d> points(int code) const {
    const auto x = numbers(code), y = numbers(code + 10), z = numbers(code + 20);
    std::vector<Eigen::Vector3d> all;
    for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k)
      all.emplace_back(x[k], y[k], k < z.size() ? z[k] : 0);
    return all;
  }
};

struct Block {
  Eigen::Vector3d base;
  bool outside = false;  ///< of another file
  std::vector<RawEntity> entities;
};

/// What a file says, by its sections.
struct RawDrawing {
  int unit = 0;
  std::map<std::string, bool> layers;  ///< whether they are shown
  std::map<std::string, Block> blocks;
  std::vector<RawEntity> entities;
};

/// Whether something is drawn by an entity of this kind that can be read.
bool is_curve(const std::string& kind);

/// Errors (bad_input), with `name` and line: a file that is no text of DXF, or is cut short; a
/// coordinate that is no number.
Result<RawDrawing> read_sections(std::string_view bytes, const std::string& name);

}  // namespace gridshell::preset
