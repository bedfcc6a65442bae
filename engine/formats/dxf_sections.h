// The sections of a DXF file as raw groups, before entities are converted (dxf_file.h).
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
  int line = 0;  ///< line of the value
};

/// An entity as the file contains it.
struct RawEntity {
  std::string kind;
  int line = 0;
  std::vector<DxfGroup> groups = {};
  std::vector<RawEntity> parts = {};  ///< vertices of a polyline, attributes of an insertion

  /// First value of a code; empty: there is none.
  std::string_view text(int code) const {
    for (const DxfGroup& group : groups)
      if (group.code == code) return group.value;
    return {};
  }
  /// First value of a code as a number, or `otherwise`.
  double number(int code, double otherwise = 0) const {
    return number_of(text(code)).value_or(otherwise);
  }
  /// First value of a code as bits or as a small count.
  int flags(int code) const { return int(std::clamp(number(code), 0.0, 1e6)); }
  /// The first point whose x, y and z have the codes `code`, `code` + 10 and `code` + 20.
  Eigen::Vector3d point(int code,
                        const Eigen::Vector3d& otherwise = Eigen::Vector3d::Zero()) const {
    return {number(code, otherwise.x()), number(code + 10, otherwise.y()),
            number(code + 20, otherwise.z())};
  }
  /// All values of a code as numbers, in order.
  std::vector<double> numbers(int code) const {
    std::vector<double> all;
    for (const DxfGroup& group : groups)
      if (group.code == code) all.push_back(number_of(group.value).value_or(0));
    return all;
  }
  /// All points of a code, in order.
  std::vector<Eigen::Vector3d> points(int code) const {
    const auto x = numbers(code), y = numbers(code + 10), z = numbers(code + 20);
    std::vector<Eigen::Vector3d> all;
    for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k)
      all.emplace_back(x[k], y[k], k < z.size() ? z[k] : 0);
    return all;
  }
};

/// A block, which INSERT entities show.
struct Block {
  Eigen::Vector3d base;
  bool outside = false;  ///< whether its entities are in another file (XREF)
  std::vector<RawEntity> entities;
};

/// The contents of a file by its sections.
struct RawDrawing {
  int unit = 0;                        ///< $INSUNITS
  std::map<std::string, bool> layers;  ///< whether each layer is shown
  std::map<std::string, Block> blocks;
  std::vector<RawEntity> entities;
};

/// Whether entities of this kind are read as curves (or contain curves).
bool is_curve(const std::string& kind);

/// Reads the sections of a file. Errors (bad_input), with `name` and line: the file is no DXF text
/// or is cut short; a coordinate is no number.
Result<RawDrawing> read_sections(std::string_view bytes, const std::string& name);

}  // namespace gridshell::preset
