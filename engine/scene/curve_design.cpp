#include "engine/scene/curve_design.h"

#include "engine/footprint/curve_domain.h"

namespace gridshell {
namespace {

Eigen::Matrix2Xd matrix_of(const preset::Points& points, double scale) {
  Eigen::Matrix2Xd matrix(2, points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    matrix.col(Eigen::Index(k)) << scale * points[k].at(0), scale * points[k].at(1);
  return matrix;
}

Result<ClosedCurve> curve_of(const preset::Curve& wanted, double radius, double scale) {
  const double x = scale * wanted.half_x_mm, y = scale * wanted.half_y_mm;
  switch (wanted.kind) {
    case preset::CurveKind::circle:
      return ClosedCurve::ellipse(scale * radius, scale * radius);
    case preset::CurveKind::ellipse:
      return ClosedCurve::ellipse(x, y);
    case preset::CurveKind::superellipse:
      return ClosedCurve::superellipse(x, y, wanted.exponent);
    case preset::CurveKind::polygon:
      return ClosedCurve::polygon(matrix_of(wanted.points, scale));
    case preset::CurveKind::spline:
      break;
  }
  return ClosedCurve::spline(matrix_of(wanted.points, scale));
}

tl::unexpected<Error> refuse(const char* which, const Error& error) {
  return fail(error.fault, std::string(which) + error.message);
}

}  // namespace

Eigen::Matrix2Xd CurveDesign::actuated(const Eigen::Matrix2Xd& on_original) const {
  Eigen::Matrix2Xd moved(2, on_original.cols());
  for (Eigen::Index k = 0; k < moved.cols(); ++k) moved.col(k) = map(on_original.col(k));
  return moved;
}

Result<CurveDesign> curve_design(const preset::Preset& preset) {
  const auto& footprint = preset.footprint;
  auto original = curve_of(footprint.boundary, footprint.radius_mm, 1);
  if (!original) return refuse("[footprint] boundary: ", original.error());
  const auto& to = preset.actuation;
  auto actuated = to.scale > 0 ? curve_of(footprint.boundary, footprint.radius_mm, to.scale)
                               : curve_of(to.boundary, to.radius_mm, 1);
  if (!actuated) return refuse("[actuation] boundary: ", actuated.error());
  auto map = BoundaryMap::make(*original, *actuated, same_word<Correspondence>(to.correspondence));
  if (!map) return tl::unexpected(map.error());
  auto domain = std::make_unique<CurveDomain>(*original);
  const Eigen::Matrix2Xd ring = domain->boundary(1024);
  const double scale = 0.5 * (ring.rowwise().maxCoeff() - ring.rowwise().minCoeff()).norm();
  return CurveDesign{std::move(domain), std::move(*map), scale};
}

}  // namespace gridshell
