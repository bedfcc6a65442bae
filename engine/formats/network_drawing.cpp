// Reads networks from drawings (Wavefront OBJ, DXF) and from the edges of meshes (PLY, OFF).

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "engine/core/proximity.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/formats/dxf_file.h"
#include "engine/formats/network_file.h"
#include "engine/formats/obj_ply.h"
#include "engine/formats/outline_file.h"
#include "engine/formats/plain_text.h"
#include "engine/formats/point_file.h"

namespace gridshell::preset {
namespace {

/// Makes the network from the lines of a drawing that are in the builder.
Result<NetworkData> finish(NetworkBuilder& builder, const std::string& name, std::size_t lines,
                           const NetworkOptions& options, FileReport& report) {
  if (options.linkage) {
    TRY_DO(builder.join_segments(report));
    return builder.take(name);
  }
  TRY(met, builder.join_in_line());
  TRY_DO(builder.join_ends(name));
  TRY_DO(builder.join_crossings(name));
  builder.thin_out();
  if (*met > 0)
    report.text += fmt::format("{} of {}, which meet end to end at {}; ", "rods",
                               counted(lines, "line"), counted(std::size_t(*met), "point"));
  return builder.take(name);
}

/// Recognises circles that mark points: small compared with the drawing, with the centre on a line.
class Marks {
 public:
  explicit Marks(const std::vector<const DrawnEntity*>& drawn) : drawn_(drawn) {
    for (const DrawnEntity* one : drawn)
      for (const Eigen::Vector3d& point : one->points) box_.extend(point);
  }

  bool contains(const DrawnEntity& circle) const {
    constexpr double small = 0.1;
    if (circle.kind != "CIRCLE" || circle.points.empty()) return false;
    const double radius = (circle.points.front() - circle.centre).norm();
    if (radius > small * box_.sizes().maxCoeff()) return false;
    return std::ranges::any_of(drawn_, [&](const DrawnEntity* one) {
      if (one->kind == "CIRCLE") return false;
      for (std::size_t k = 1; k < one->points.size(); ++k)
        if (distance_to_segment(circle.centre, one->points[k - 1], one->points[k]) < 1e-3 * radius)
          return true;
      return false;
    });
  }

 private:
  const std::vector<const DrawnEntity*>& drawn_;
  Eigen::AlignedBox3d box_;
};

/// Counts the entities that are not used, by reason: "2 circles, 1 line on other layers".
class LeftOut {
 public:
  void add(const std::string& why, const std::string& kind) { ++counts_[why][name_of(kind)]; }
  std::string text() const {
    std::vector<std::string> all;
    for (const auto& [why, kinds] : counts_) {
      std::vector<std::string> some;
      for (const auto& [kind, count] : kinds) some.push_back(counted(count, kind));
      all.push_back(fmt::format("{}{}", fmt::join(some, ", "), why));
    }
    return all.empty() ? "" : fmt::format("; not used: {}", fmt::join(all, "; "));
  }

 private:
  static std::string name_of(const std::string& kind) {
    if (kind == "MTEXT" || kind == "ATTDEF" || kind == "ATTRIB" || kind == "RTEXT") return "text";
    return kind == "LWPOLYLINE" ? "polyline" : lower(kind);
  }
  std::map<std::string, std::map<std::string, std::size_t>> counts_;
};

/// The entities of a drawing that are used as lines; if there is a layer of the name `layer`, only
/// those on it. Errors (bad_input): an entity that may be a line and is not supported.
Result<std::vector<const DrawnEntity*>> choose(const DxfDrawing& drawing, const std::string& name,
                                               const std::string& layer, LeftOut& left_out) {
  const bool by_layer = std::ranges::any_of(drawing.entities, [&](const DrawnEntity& one) {
    return one.layer == layer && one.use != EntityUse::mark && one.space != DrawingSpace::paper;
  });
  std::vector<const DrawnEntity*> chosen;
  for (const DrawnEntity& one : drawing.entities) {
    if (one.space == DrawingSpace::paper)
      left_out.add(" of paper space", one.kind);
    else if (one.space == DrawingSpace::hidden)
      left_out.add(" on layers that are frozen or switched off", one.kind);
    else if (one.use == EntityUse::mark)
      left_out.add("", one.kind);
    else if (by_layer && one.layer != layer)
      left_out.add(fmt::format(" on other layers than \"{}\"", layer), one.kind);
    else if (one.use == EntityUse::refused)
      return invalid("{}:{}: {} {}", name, one.line, one.kind, one.why);
    else
      chosen.push_back(&one);
  }
  const Marks marks(chosen);
  std::vector<const DrawnEntity*> rods;
  for (const DrawnEntity* one : chosen)
    if (!by_layer && marks.contains(*one))
      left_out.add(" that mark points of rods", one->kind);
    else
      rods.push_back(one);
  return rods;
}

/// The unit of a drawing in mm; how it is known is added to `report`.
double unit_of(const DxfDrawing& drawing, const std::vector<const DrawnEntity*>& rods,
               const NetworkOptions& options, FileReport& report) {
  constexpr double longest = 1e5, shortest = 20;  // lengths of a rod over its diameter
  double length = 0;
  for (const DrawnEntity* one : rods)
    for (const Eigen::Vector3d& point : one->points)
      length = std::max(length, (point - one->points.front()).norm());
  if (options.unit_mm > 0) {
    report.text += "unit by file_unit";
    return options.unit_mm;
  }
  if (drawing.unit_mm <= 0) {
    report.text += "in mm, as it names no unit ($INSUNITS)";
    return 1;
  }
  const double rod = options.rod_mm;
  if (rod > 0 && length * drawing.unit_mm > longest * rod && length > shortest * rod &&
      length < longest * rod) {
    report.text += fmt::format("in mm, although it says {} ($INSUNITS)", drawing.unit);
    // the units of the key file_unit
    static constexpr std::array<std::string_view, 5> known{"mm", "cm", "m", "in", "ft"};
    report.notes.push_back(fmt::format(
        "the drawing says that it is in {} ($INSUNITS): {:.4g} mm long, its rods of {:g} mm would "
        "be {:.2g} times as long as thick; it is read in mm; {} reads it in its own unit",
        drawing.unit, length * drawing.unit_mm, rod, length * drawing.unit_mm / rod,
        std::ranges::find(known, drawing.unit) != known.end()
            ? fmt::format("file_unit = \"{}\"", drawing.unit)
            : fmt::format("file_unit = \"m\" with the drawing scaled by {:.6g}",
                          drawing.unit_mm / 1000)));
    return 1;
  }
  report.text += fmt::format("in {} ($INSUNITS)", drawing.unit);
  return drawing.unit_mm;
}

/// The edges of a mesh as lines, each once.
class MeshEdges {
 public:
  explicit MeshEdges(NetworkBuilder& builder) : builder_(builder) {}

  Result<void> add_face(const std::vector<long>& vertices, const std::string& at) {
    if (vertices.size() < 3)
      return invalid("{}: got a face of {} vertices, expected 3 or more", at, vertices.size());
    ++faces_, quads_ += vertices.size() == 4;
    for (std::size_t k = 0; k < vertices.size(); ++k)
      TRY_DO(add_edge({vertices[k], vertices[(k + 1) % vertices.size()]}, at));
    return {};
  }
  Result<void> add_edge(const std::vector<long>& vertices, const std::string& at) {
    if (vertices.size() != 2) return invalid("{}: expected vertex1 and vertex2", at);
    TRY(first, builder_.point(vertices[0], at));
    TRY(second, builder_.point(vertices[1], at));
    if (*first == *second || !known_.insert(std::minmax(*first, *second)).second) return {};
    return builder_.add_rod({*first, *second}, 0, at);
  }
  std::size_t faces() const { return faces_; }

  /// The network, in which edges in line are one rod; or a linkage.
  Result<NetworkData> take(const std::string& name, const NetworkOptions& options,
                           FileReport& report) {
    if (options.linkage) return finish(builder_, name, known_.size(), options, report);
    TRY(met, builder_.join_in_line());
    builder_.thin_out();
    if (faces_ > 0)
      report.text +=
          fmt::format("the edges of {} ({} of four corners); ", counted(faces_, "face"), quads_);
    report.text += fmt::format("rods of {}, which meet in line at {}; ",
                               counted(known_.size(), "edge"), counted(std::size_t(*met), "point"));
    return builder_.take(name);
  }

 private:
  NetworkBuilder& builder_;
  std::set<std::pair<int, int>> known_;
  std::size_t faces_ = 0, quads_ = 0;
};

/// The function that adds the points of a file to a builder, in mm.
auto adder_of_points(NetworkBuilder& builder, const NetworkOptions& options) {
  const double unit = options.unit_mm > 0 ? options.unit_mm : 1;
  return [&builder, unit](std::vector<double> xyz, const std::string& at) {
    for (double& value : xyz) value *= unit;
    return builder.add_point(xyz, at);
  };
}

std::string unit_text(const NetworkOptions& options, const char* format) {
  return options.unit_mm > 0 ? "unit by file_unit"
                             : fmt::format("in mm, as {} names no unit", format);
}

}  // namespace

Result<NetworkData> read_network_obj(std::string_view bytes, const std::string& name,
                                     const NetworkOptions& options, FileReport& report) {
  NetworkBuilder builder(options.join_mm);
  std::size_t lines = 0;
  const auto add_rod = [&](const std::vector<long>& vertices, const std::string& at) {
    std::vector<int> points;
    for (const long vertex : vertices) {
      const auto point = builder.point(vertex, at);
      if (!point) return Result<void>(tl::unexpected(point.error()));
      points.push_back(*point);
    }
    ++lines;
    return builder.add_rod(std::move(points), 0, at);
  };
  TRY(others, read_obj_lines(bytes, name, "l", {adder_of_points(builder, options), add_rod}));
  if (lines == 0 && (*others)["f"] > 0) {
    // no line: the edges of the faces are the members
    NetworkBuilder of_faces(options.join_mm);
    MeshEdges edges(of_faces);
    const auto read = read_obj_lines(
        bytes, name, "f",
        {adder_of_points(of_faces, options),
         [&](const auto& face, const auto& at) { return edges.add_face(face, at); }});
    if (!read) return tl::unexpected(read.error());
    report.text += unit_text(options, "OBJ") + "; ";
    return edges.take(name, options, report);
  }
  LeftOut left_out;
  for (const auto& [kind, count] : *others)
    for (int k = 0; k < count; ++k) left_out.add("", kind == "f" ? "face" : "point");
  report.text += unit_text(options, "OBJ") + left_out.text() + "; ";
  return finish(builder, name, lines, options, report);
}

Result<NetworkData> read_network_mesh(std::string_view bytes, const std::string& name,
                                      const NetworkOptions& options, FileReport& report) {
  NetworkBuilder builder(options.join_mm);
  MeshEdges edges(builder);
  const auto add_point = adder_of_points(builder, options);
  const bool ply = ending_of(name) == ".ply";
  const auto read =
      ply ? each_ply_item(bytes, name,
                          [&](const PlyItem& item) -> Result<void> {
                            const auto at = item.location(name);
                            if (item.element == "vertex")
                              return add_point({item.xyz.x(), item.xyz.y(), item.xyz.z()}, at);
                            if (item.element == "face") return edges.add_face(item.corners, at);
                            if (item.element == "edge") return edges.add_edge(item.corners, at);
                            return {};
                          })
          : read_off_lines(bytes, name, {add_point, [&](const auto& face, const auto& at) {
                                           return edges.add_face(face, at);
                                         }});
  if (!read) return tl::unexpected(read.error());
  report.text += unit_text(options, ply ? "PLY" : "OFF") + "; ";
  return edges.take(name, options, report);
}

Result<PlanDrawing> read_outline_dxf(std::string_view bytes, const std::string& name,
                                     const NetworkOptions& options, FileReport& report) {
  TRY(drawing, read_dxf(bytes, name));
  LeftOut left_out;
  TRY(chosen, choose(*drawing, name, "outline", left_out));
  PlanDrawing plan;
  FileReport unit;
  plan.unit_mm = unit_of(*drawing, *chosen, options, unit);
  plan.unit = unit.text;
  report.notes = std::move(unit.notes);
  for (const DrawnEntity* one : *chosen) {
    PlanLine& line = plan.lines.emplace_back();
    line.closed = one->closed;
    for (const Eigen::Vector3d& point : one->points) line.points.emplace_back(point.head<2>());
  }
  plan.left_out = left_out.text();
  return plan;
}

Result<NetworkData> read_network_dxf(std::string_view bytes, const std::string& name,
                                     const NetworkOptions& options, FileReport& report) {
  TRY(drawing, read_dxf(bytes, name));
  LeftOut left_out;
  TRY(rods, choose(*drawing, name, "rods", left_out));
  const double unit = unit_of(*drawing, *rods, options, report);
  report.text += left_out.text() + "; ";
  if (rods->empty())
    return invalid("{}: got no rods, expected at least one{}", name, left_out.text());
  NetworkBuilder builder(options.join_mm);
  for (const DrawnEntity* one : *rods) {
    const auto where = fmt::format("{}:{}", name, one->line);
    std::vector<int> points;
    for (std::size_t k = 0; k < one->points.size(); ++k) {
      const Eigen::Vector3d xyz = unit * one->points[k];
      TRY(point, builder.find_or_add_point({xyz.x(), xyz.y(), xyz.z()}, where));
      if (one->sampled[k]) builder.mark_sample(*point);
      points.push_back(*point);
    }
    if (one->closed && !points.empty() && points.back() != points.front())
      points.push_back(points.front());
    TRY_DO(builder.add_rod(std::move(points), 0, where));
  }
  return finish(builder, name, rods->size(), options, report);
}

}  // namespace gridshell::preset
