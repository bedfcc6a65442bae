#include "engine/scene/drawn_footprint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "engine/core/dense.h"
#include "engine/core/try.h"
#include "engine/footprint/domains.h"
#include "engine/footprint/network.h"
#include "engine/preset/consistency.h"

namespace gridshell {
namespace {

/// The points of a drawing's closed line, 2 x n; without columns if it is not a single line.
Eigen::Matrix2Xd outline_of(const preset::NetworkData& file) {
  Eigen::Matrix2Xd line(2, 0);
  if (file.rods.size() != 1) return line;
  const Eigen::Matrix2Xd points = preset::matrix_of<2>(file.points);
  return points(Eigen::all, std::vector<int>(file.rods[0].begin(), file.rods[0].end()));
}

/// Translation of a drawn outline: the middle of its bounding box moves to the origin or, if that
/// is outside the outline, the centroid of its area.
Eigen::Vector2d middle_of(const Eigen::Matrix2Xd& line) {
  const Eigen::Vector2d middle = 0.5 * (line.rowwise().minCoeff() + line.rowwise().maxCoeff());
  double twice = 0, turns = 0;
  Eigen::Vector2d moment(0, 0);
  for (Eigen::Index k = 0; k + 1 < line.cols(); ++k) {
    const Eigen::Vector2d a = line.col(k) - middle, b = line.col(k + 1) - middle;
    const double cross = a.x() * b.y() - a.y() * b.x();
    twice += cross;
    moment += cross / 3 * (a + b);
    turns += std::atan2(cross, a.dot(b));
  }
  // the line turns once about a point inside it, and by zero about one outside
  const bool inside = std::abs(turns) > M_PI;
  return inside || twice == 0 ? middle : Eigen::Vector2d(middle + moment / twice);
}

Result<ClosedCurve> curve_of(const preset::Curve& requested, double radius, double scale,
                             const Eigen::Matrix2Xd& drawn) {
  const double x = scale * requested.half_x_mm, y = scale * requested.half_y_mm;
  switch (requested.kind) {
    case preset::CurveKind::circle:
      return ClosedCurve::ellipse(scale * radius, scale * radius);
    case preset::CurveKind::ellipse:
      return ClosedCurve::ellipse(x, y);
    case preset::CurveKind::superellipse:
      return ClosedCurve::superellipse(x, y, requested.exponent);
    case preset::CurveKind::polygon:
      return ClosedCurve::polygon(scale * preset::matrix_of<2>(requested.points));
    case preset::CurveKind::file:
      return ClosedCurve::polygon(scale * drawn);
    case preset::CurveKind::spline:
      break;
  }
  return ClosedCurve::spline(scale * preset::matrix_of<2>(requested.points));
}

tl::unexpected<Error> refuse(const char* which, const Error& error) {
  return fail(error.fault, std::string(which) + error.message);
}

Eigen::Vector3d vector_of(const std::vector<double>& row, std::size_t first) {
  return {row.at(first), row.at(first + 1), row.at(first + 2)};
}

/// Middle of the bottom of the bounding box of all rods; heights are measured from it.
Eigen::Vector3d origin_of(const preset::NetworkData& file) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY), high = -low;
  for (const auto& rod : file.rods)
    for (const int point : rod) {
      const Eigen::Vector3d at = vector_of(file.points[std::size_t(point)], 0);
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
  Eigen::Vector3d origin = 0.5 * (low + high);
  origin.z() = low.z();
  return origin;
}

RodNetwork network_of(const preset::NetworkData& file, preset::EndKind ends,
                      const Eigen::Vector3d& origin) {
  constexpr double in_plane_mm = 1e-3;  // also the distance within which points become one
  RodNetwork network;
  network.points.resize(3, Eigen::Index(file.points.size()));
  for (std::size_t k = 0; k < file.points.size(); ++k)
    network.points.col(Eigen::Index(k)) = vector_of(file.points[k], 0) - origin;
  const bool in_plane = std::ranges::all_of(file.rods, [&](const std::vector<int>& rod) {
    return network.points(2, rod).cwiseAbs().maxCoeff() < in_plane_mm;
  });
  if (in_plane) network.points.row(2).setZero();
  network.rods = file.rods;
  network.supported.assign(file.points.size(), 0);
  network.free.assign(file.points.size(), 0);
  for (const auto& row : file.supports) network.supported[std::size_t(row[0])] = 1;
  for (const int point : file.free) network.free[std::size_t(point)] = 1;
  for (const auto& row : file.joint_laws) network.joined.insert(int(row[0]));
  network.end_constraint = rod_end_of(ends);
  for (const auto& row : file.end_constraints)
    network.end_constraints[int(2 * row[0] + row[1])] = rod_end_of(preset::EndKind(int(row[2])));
  for (const auto& row : file.springs) network.springs[int(row[0])] = vector_of(row, 1);
  return network;
}

/// Prescribed displacement of the supports.
class EndMotion {
 public:
  EndMotion(const preset::Preset& preset, const Scene& scene)
      : scale_(preset.actuation.scale > 0 ? preset.actuation.scale : 1), flat_(scene.flat) {
    for (const auto& row : preset.footprint.file.supports)
      if (row.size() == 4) to_[int(row[0])] = vector_of(row, 1);
  }
  /// (u, v) and height of a drawn position; a height is not scaled.
  Eigen::Vector3d begin(const Eigen::Vector3d& from) const {
    return flat_.at(from.head<2>()) + from.z() * Eigen::Vector3d::UnitZ();
  }
  Eigen::Vector3d end(int point, const Eigen::Vector3d& from) const {
    const auto named = to_.find(point);
    if (named != to_.end()) return named->second;
    return begin({scale_ * from.x(), scale_ * from.y(), from.z()});
  }

 private:
  double scale_;
  FlatFrame flat_;
  std::map<int, Eigen::Vector3d> to_;
};

/// Fills the scene's motion: first and last positions of the rods' ends and of the fixed joints.
void put_motion(const NetworkFootprint& made, const Eigen::Matrix3Xd& points,
                const EndMotion& motion, Scene& scene) {
  const auto fill = [&](const std::vector<int>& numbers, Eigen::Matrix3Xd& begin,
                        Eigen::Matrix3Xd& end) {
    begin.resize(3, Eigen::Index(numbers.size()));
    end.resizeLike(begin);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const Eigen::Vector3d from = points.col(numbers[k]);
      begin.col(Eigen::Index(k)) = motion.begin(from);
      end.col(Eigen::Index(k)) = motion.end(numbers[k], from);
    }
  };
  fill(made.ends, scene.motion.begin, scene.motion.end);
  fill(made.joints, scene.motion.begin_joints, scene.motion.end_joints);
}

/// Positions projected on the plane that fits them best.
Eigen::Matrix2Xd seen_across(const Eigen::Matrix3Xd& positions) {
  const Eigen::Vector3d middle = positions.rowwise().mean();
  const Eigen::Matrix3Xd about = positions.colwise() - middle;
  const auto axes = eigen_pairs(about * about.transpose());
  return axes.vectors.rightCols<2>().transpose() * about;
}

/// Fills the scene's boundaries around the constrained points of the rods (only corners for a
/// planar network) and its length scale, half the diagonal of the bounding box of these points.
void put_boundaries(const NetworkFootprint& made, const Eigen::Matrix3Xd& points, Scene& scene) {
  std::vector<int> numbers = made.joints;
  std::vector<Eigen::Vector3d> from, to;
  for (Eigen::Index k = 0; k < scene.motion.end_joints.cols(); ++k) {
    from.push_back(scene.motion.begin_joints.col(k));
    to.push_back(scene.motion.end_joints.col(k));
  }
  for (std::size_t end = 0; end < made.ends.size(); ++end) {
    const FootprintRod& rod = made.footprint.rods[end / 2];
    if (!is_fixed(end % 2 == 0 ? rod.begin : rod.end)) continue;
    numbers.push_back(made.ends[end]);
    from.push_back(scene.motion.begin.col(Eigen::Index(end)));
    to.push_back(scene.motion.end.col(Eigen::Index(end)));
  }
  const Eigen::Matrix3Xd constrained = points(Eigen::all, numbers);
  const std::vector<int> hull = made.footprint.in_space() ? rim_of(seen_across(constrained))
                                                          : hull_of(constrained.topRows<2>());
  scene.original_boundary.resize(3, Eigen::Index(hull.size()));
  scene.actuated_boundary.resizeLike(scene.original_boundary);
  for (std::size_t k = 0; k < hull.size(); ++k) {
    scene.original_boundary.col(Eigen::Index(k)) = from[std::size_t(hull[k])];
    scene.actuated_boundary.col(Eigen::Index(k)) = to[std::size_t(hull[k])];
  }
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& position : from) box.extend(position);
  // for a shell that is constrained at a single position, as a cantilever, the rods give the scale
  if (box.diagonal().norm() < made.footprint.spacing)
    for (const auto& point : points.colwise()) box.extend(scene.flat.origin + point);
  scene.length_scale_mm = 0.5 * box.diagonal().norm();
}

/// Checks that rods are thinner than the distance of joints.
Result<void> check_diameters(const preset::Preset& preset, const Footprint& footprint) {
  for (const FootprintRod& drawn : footprint.rods) {
    const preset::Rod rod = preset::rod_of_network(preset, drawn.number);
    const double across = rod.rectangular() ? rod.width_mm : rod.diameter_mm;
    if (!(across < footprint.spacing))
      return invalid(
          "rods[{}]: got a {} of {:g} mm, expected less than the usual distance of {:g} mm "
          "between joints{}",
          drawn.number, rod.rectangular() ? "width" : "diameter", across, footprint.spacing,
          across < 500 * footprint.spacing
              ? "; is the drawing in metres? [footprint] file_unit = \"m\" reads it so"
              : "");
  }
  return {};
}

}  // namespace

Eigen::Matrix2Xd CurveDesign::actuated(const Eigen::Matrix2Xd& on_original) const {
  Eigen::Matrix2Xd moved(2, on_original.cols());
  for (Eigen::Index k = 0; k < moved.cols(); ++k) moved.col(k) = map(on_original.col(k));
  return moved;
}

Result<CurveDesign> curve_design(const preset::Preset& preset) {
  const auto& footprint = preset.footprint;
  const auto& to = preset.actuation;
  using preset::CurveKind;
  Eigen::Matrix2Xd drawn = outline_of(footprint.file), drawn_to = outline_of(to.file);
  const bool from_file = footprint.boundary.kind == CurveKind::file && drawn.cols() > 0;
  if (drawn_to.cols() > 0) drawn_to.colwise() -= middle_of(from_file ? drawn : drawn_to);
  if (drawn.cols() > 0) drawn.colwise() -= middle_of(drawn);
  auto original = curve_of(footprint.boundary, footprint.radius_mm, 1, drawn);
  if (!original) return refuse("[footprint] boundary: ", original.error());
  auto actuated = to.scale > 0 ? curve_of(footprint.boundary, footprint.radius_mm, to.scale, drawn)
                               : curve_of(to.boundary, to.radius_mm, 1, drawn_to);
  if (!actuated) return refuse("[actuation] boundary: ", actuated.error());
  auto map = BoundaryMap::make(*original, *actuated, to.correspondence);
  if (!map && drawn_to.cols() > 0 && from_file)
    map.error().message +=
        "; both drawings are placed by the middle of the original outline: do they have one "
        "origin?";
  if (!map) return tl::unexpected(map.error());
  auto domain = std::make_unique<CurveDomain>(*original);
  const Eigen::Matrix2Xd ring = domain->boundary(1024);
  const double scale = 0.5 * (ring.rowwise().maxCoeff() - ring.rowwise().minCoeff()).norm();
  return CurveDesign{std::move(domain), std::move(*map), scale};
}

RodEnd rod_end_of(preset::EndKind kind) {
  switch (kind) {
    case preset::EndKind::pinned:
      return RodEnd::pinned;
    case preset::EndKind::tangent:
      return RodEnd::tangent;
    case preset::EndKind::clamped:
      break;
  }
  return RodEnd::clamped;
}

Result<void> build_network(const preset::Preset& preset, Scene& scene) {
  const preset::NetworkData& file = preset.footprint.file;
  scene.flat.origin = origin_of(file);
  const RodNetwork network = network_of(file, preset.ends.kind, scene.flat.origin);
  const auto refuse = [](const Error& error) {
    return fail(error.fault, "[footprint] file: " + error.message);
  };
  auto made = network_footprint(network);
  if (!made) return refuse(made.error());
  if (auto thin = check_diameters(preset, made->footprint); !thin) return refuse(thin.error());
  put_motion(*made, network.points, EndMotion(preset, scene), scene);
  put_boundaries(*made, network.points, scene);
  scene.footprint = std::move(made->footprint);
  return {};
}

}  // namespace gridshell
