#include "engine/formats/dxf_file.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "engine/core/try.h"
#include "engine/formats/dxf_curves.h"
#include "engine/formats/dxf_sections.h"
#include "engine/formats/plain_text.h"

namespace gridshell::preset {
namespace {

using Eigen::Vector3d;

constexpr std::size_t most_entities = 200000, most_insertions = 200000;
constexpr int deepest = 16;  // blocks in blocks

/// Whether entities of this kind are never rods.
bool is_mark(const std::string& kind) {
  static constexpr std::array<std::string_view, 24> marks{
      "TEXT",  "MTEXT", "RTEXT", "ATTDEF", "ATTRIB",      "POINT",      "DIMENSION", "LEADER",
      "HATCH", "SOLID", "TRACE", "IMAGE",  "MULTILEADER", "TOLERANCE",  "VIEWPORT",  "WIPEOUT",
      "XLINE", "RAY",   "SHAPE", "LIGHT",  "OLE2FRAME",   "ACAD_TABLE", "MLEADER",   "OLEFRAME"};
  return std::ranges::find(marks, kind) != marks.end();
}

/// The axes of an entity whose plane has this normal (the 'arbitrary axis algorithm' of DXF).
Eigen::Matrix3d axes_of(const RawEntity& raw) {
  Vector3d normal = raw.point(210, Vector3d::UnitZ());
  if (!(normal.norm() > 0)) normal = Vector3d::UnitZ();
  normal.normalize();
  constexpr double near = 1.0 / 64;
  const bool upright = std::abs(normal.x()) < near && std::abs(normal.y()) < near;
  const Vector3d x = (upright ? Vector3d::UnitY() : Vector3d::UnitZ()).cross(normal).normalized();
  Eigen::Matrix3d axes;
  axes << x, normal.cross(x), normal;
  return axes;
}

/// Converts the entities of a file, with those of blocks at each insertion.
class Gathering {
 public:
  Gathering(const RawDrawing& raw, const std::string& name) : raw_(raw), name_(name) {}

  Result<std::vector<DrawnEntity>> take() {
    TRY_DO(add(raw_.entities, Eigen::Affine3d::Identity(), "", DrawingSpace::model, 0));
    return std::move(entities_);
  }

 private:
  Result<void> add(const std::vector<RawEntity>& list, const Eigen::Affine3d& to,
                   const std::string& layer, DrawingSpace space, int depth) {
    for (const RawEntity& raw : list) {
      DrawnEntity entity;
      entity.kind = raw.kind;
      entity.line = raw.line;
      entity.layer = lower(raw.text(8));
      // entities of a block on layer 0 are on the layer of the insertion
      if (depth > 0 && (entity.layer == "0" || entity.layer.empty())) entity.layer = layer;
      entity.space = space;
      const auto shown = raw_.layers.find(entity.layer);
      const bool hidden = (shown != raw_.layers.end() && !shown->second) || raw.flags(60) == 1;
      if (space == DrawingSpace::model && raw.flags(67) == 1) entity.space = DrawingSpace::paper;
      if (entity.space == DrawingSpace::model && hidden) entity.space = DrawingSpace::hidden;
      if (raw.kind == "INSERT") {
        TRY_DO(insert(raw, to, entity, depth));
        continue;
      }
      if (entities_.size() == most_entities)
        return invalid("{}:{}: got more than {} entities, expected fewer", name_, raw.line,
                       most_entities);
      if (is_mark(raw.kind))
        entity.use = EntityUse::mark;
      else if (!is_curve(raw.kind))
        refuse(entity, "is not read, expected lines and polylines: explode it");
      else
        draw(raw, entity);
      for (Vector3d& point : entity.points) point = to * point;
      entity.centre = to * entity.centre;
      entities_.push_back(std::move(entity));
    }
    return {};
  }

  Result<void> insert(const RawEntity& raw, const Eigen::Affine3d& to, const DrawnEntity& as,
                      int depth) {
    const auto found = raw_.blocks.find(lower(raw.text(2)));
    const auto wrong = [&](const char* what) {
      return invalid("{}:{}: INSERT of block '{}', {}", name_, raw.line, raw.text(2), what);
    };
    if (found == raw_.blocks.end()) return wrong("which is not in the file");
    if (depth == deepest) return wrong("which contains itself");
    if (++insertions_ > most_insertions) return wrong("of too many");
    if (found->second.outside) {
      DrawnEntity missing = as;
      refuse(missing, "is of another drawing (XREF), expected a block of this one: bind it");
      entities_.push_back(std::move(missing));
      return {};
    }
    const Eigen::AngleAxisd turn(raw.number(50) * std::numbers::pi / 180, Vector3d::UnitZ());
    const Vector3d scale{raw.number(41, 1), raw.number(42, 1), raw.number(43, 1)};
    const int columns = std::max(1, raw.flags(70)), rows = std::max(1, raw.flags(71));
    if (std::size_t(columns) * std::size_t(rows) > most_entities) return wrong("too many times");
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column, ++insertions_) {
        if (insertions_ > most_insertions) return wrong("of too many");
        Eigen::Affine3d at = to * Eigen::Affine3d(axes_of(raw));
        at.translate(raw.point(10));
        at.rotate(turn);
        at.translate(Vector3d(column * raw.number(44), row * raw.number(45), 0));
        at.scale(scale);
        at.translate(-found->second.base);
        TRY_DO(add(found->second.entities, at, as.layer, as.space, depth + 1));
      }
    return {};
  }

  static void refuse(DrawnEntity& entity, const char* why) {
    entity.use = EntityUse::refused;
    entity.why = why;
  }

  static void append(DrawnEntity& entity, const std::vector<Vector3d>& points, bool sampled) {
    entity.points.insert(entity.points.end(), points.begin(), points.end());
    entity.sampled.resize(entity.points.size(), sampled);
  }

  static void draw(const RawEntity& raw, DrawnEntity& entity) {
    const Eigen::Matrix3d axes = axes_of(raw);
    if (raw.kind == "LINE")
      append(entity, {raw.point(10), raw.point(11)}, false);
    else if (raw.kind == "LWPOLYLINE")
      draw_light(raw, axes, entity);
    else if (raw.kind == "POLYLINE")
      draw_heavy(raw, axes, entity);
    else if (raw.kind == "ARC" || raw.kind == "CIRCLE")
      draw_arc(raw, axes, entity);
    else if (raw.kind == "ELLIPSE")
      draw_ellipse(raw, axes, entity);
    else if (raw.kind == "SPLINE")
      draw_spline(raw, entity);
    else
      entity.use = EntityUse::mark;  // a vertex outside a polyline
  }

  /// Adds corners in a plane, with an arc after each corner that has a bulge.
  static void draw_corners(const std::vector<Vector3d>& corners, const std::vector<double>& bulges,
                           bool closed, const Eigen::Matrix3d& axes, DrawnEntity& entity) {
    entity.closed = closed;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      append(entity, {axes * corners[k]}, false);
      const bool last = k + 1 == corners.size();
      if (bulges[k] == 0 || (last && !closed)) continue;
      auto arc = bulge_points(corners[k], corners[last ? 0 : k + 1], bulges[k]);
      arc.pop_back();
      for (Vector3d& point : arc) point = axes * point;
      append(entity, arc, true);
    }
  }

  static void draw_light(const RawEntity& raw, const Eigen::Matrix3d& axes, DrawnEntity& entity) {
    std::vector<Vector3d> corners;
    std::vector<double> bulges;
    const double elevation = raw.number(38);
    for (const DxfGroup& group : raw.groups) {
      const double value = number_of(group.value).value_or(0);
      if (group.code == 10) corners.emplace_back(value, 0, elevation), bulges.push_back(0);
      if (corners.empty()) continue;
      if (group.code == 20) corners.back().y() = value;
      if (group.code == 42) bulges.back() = value;
    }
    draw_corners(corners, bulges, raw.flags(70) % 2 == 1, axes, entity);
  }

  static void draw_heavy(const RawEntity& raw, const Eigen::Matrix3d& axes, DrawnEntity& entity) {
    const int flags = raw.flags(70);
    if (flags & (16 | 64)) return refuse(entity, "is a mesh of faces, expected lines");
    const bool in_space = flags & 8;
    std::vector<Vector3d> corners;
    std::vector<double> bulges;
    for (const RawEntity& vertex : raw.parts) {
      if (vertex.kind != "VERTEX" || (vertex.flags(70) & 16)) continue;  // a spline's control point
      corners.push_back(vertex.point(10, {0, 0, in_space ? 0 : raw.number(30)}));
      bulges.push_back(in_space ? 0 : vertex.number(42));
    }
    draw_corners(corners, bulges, flags % 2 == 1, in_space ? Eigen::Matrix3d::Identity() : axes,
                 entity);
    // a polyline that a program fitted as a curve or spline has many points
    if (flags & (2 | 4)) std::ranges::fill(entity.sampled, true);
    if (!entity.sampled.empty()) entity.sampled.front() = entity.sampled.back() = false;
  }

  static void draw_arc(const RawEntity& raw, const Eigen::Matrix3d& axes, DrawnEntity& entity) {
    const bool circle = raw.kind == "CIRCLE";
    const Vector3d centre = raw.point(10);
    const double radius = raw.number(40), full = 2 * std::numbers::pi;
    const double from = circle ? 0 : raw.number(50) * std::numbers::pi / 180;
    double sweep = circle ? full : std::fmod(raw.number(51) * std::numbers::pi / 180 - from, full);
    if (sweep <= 0) sweep += full;
    entity.centre = axes * centre;
    draw_turn(
        [&](double turn) -> Vector3d {
          return axes * (centre + radius * Vector3d(std::cos(turn), std::sin(turn), 0));
        },
        from, sweep, circle, entity);
  }

  static void draw_ellipse(const RawEntity& raw, const Eigen::Matrix3d& axes, DrawnEntity& entity) {
    const Vector3d centre = raw.point(10), major = raw.point(11);
    const Vector3d minor = raw.number(40, 1) * axes.col(2).cross(major);
    const double full = 2 * std::numbers::pi, from = raw.number(41);
    double sweep = std::fmod(raw.number(42, full) - from, full);
    if (sweep <= 1e-9) sweep += full;
    draw_turn(
        [&](double turn) -> Vector3d {
          return centre + std::cos(turn) * major + std::sin(turn) * minor;
        },
        from, sweep, std::abs(sweep - full) < 1e-9, entity);
  }

  static void draw_turn(const std::function<Vector3d(double)>& at, double from, double sweep,
                        bool closed, DrawnEntity& entity) {
    append(entity, {at(from)}, false);
    auto points = sampled_curve(at, from, from + sweep, pieces_of_turn(sweep));
    if (closed) points.pop_back();
    append(entity, points, true);
    if (!closed) entity.sampled.back() = false;
    entity.closed = closed;
  }

  static void draw_spline(const RawEntity& raw, DrawnEntity& entity) {
    SplineData spline{int(std::clamp(raw.number(71, 3), 0.0, 1000.0)),
                      raw.numbers(40),
                      raw.numbers(41),
                      raw.points(10),
                      raw.points(11),
                      {}};
    if (!raw.text(12).empty() && !raw.text(13).empty())
      spline.tangents = {raw.point(12), raw.point(13)};
    append(entity, spline_points(spline), true);
    if (entity.points.size() < 2)
      return refuse(entity, "has numbers of knots and points that do not go together");
    entity.sampled.front() = entity.sampled.back() = false;
  }

  const RawDrawing& raw_;
  const std::string& name_;
  std::vector<DrawnEntity> entities_;
  std::size_t insertions_ = 0;
};

constexpr double survey_foot = 1200e3 / 3937;  // of the United States

/// Names and lengths in mm of the units of $INSUNITS, by their numbers; empty: no unit.
constexpr std::array<std::pair<const char*, double>, 25> drawing_units{
    {{"", 0},
     {"in", 25.4},
     {"ft", 304.8},
     {"mi", 1609344},
     {"mm", 1},
     {"cm", 10},
     {"m", 1000},
     {"km", 1e6},
     {"uin", 25.4e-6},
     {"mil", 25.4e-3},
     {"yd", 914.4},
     {"A", 1e-7},
     {"nm", 1e-6},
     {"um", 1e-3},
     {"dm", 100},
     {"dam", 10 * 1000},
     {"hm", 100 * 1000},
     {"Gm", 1e12},
     {"AU", 1.495978707e14},
     {"light years", 9.4607304725808e18},
     {"parsecs", 3.0856775814913673e19},
     {"US survey ft", survey_foot},
     {"US survey in", survey_foot / 12},
     {"US survey yd", survey_foot * 3},
     {"US survey mi", survey_foot * 5280}}};

}  // namespace

Result<DxfDrawing> read_dxf(std::string_view bytes, const std::string& name) {
  std::string storage;
  TRY(raw, read_sections(plain_text(bytes, storage), name));
  DxfDrawing drawing;
  TRY(entities, Gathering(*raw, name).take());
  drawing.entities = std::move(*entities);
  if (raw->unit > 0 && raw->unit < int(drawing_units.size()))
    std::tie(drawing.unit, drawing.unit_mm) = drawing_units[std::size_t(raw->unit)];
  return drawing;
}

}  // namespace gridshell::preset
