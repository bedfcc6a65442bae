#include "engine/geometry/surface.h"

#include <fmt/format.h>
#include <muParser.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "engine/core/dense.h"
#include "engine/core/try.h"

namespace gridshell {

Eigen::Vector3d Surface::gradient(const Eigen::Vector3d& p) const {
  Eigen::Vector3d slope;
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3d ahead = p, behind = p;
    ahead[k] += h_, behind[k] -= h_;
    slope[k] = (F_(ahead) - F_(behind)) / (ahead[k] - behind[k]);
  }
  return slope;
}

Result<Eigen::Vector3d> Surface::nearest(const Eigen::Vector3d& p) const {
  constexpr int most_iterations = 50;
  constexpr double near_mm = 1e-11;
  Eigen::Vector3d x = p;
  for (int k = 0; k < most_iterations; ++k) {
    const double value = F_(x);
    const Eigen::Vector3d slope = gradient(x);
    if (!std::isfinite(value) || !slope.allFinite())
      return invalid("the surface's function has no value at ({:.6g}, {:.6g}, {:.6g}) mm", x.x(),
                     x.y(), x.z());
    if (slope.squaredNorm() == 0)
      return invalid("the surface's function has no slope at ({:.6g}, {:.6g}, {:.6g}) mm", x.x(),
                     x.y(), x.z());
    const Eigen::Vector3d step = -value / slope.squaredNorm() * slope;
    x += step;
    if (step.norm() <= near_mm + 1e-15 * x.norm()) return x;
  }
  return invalid("no point of the surface is found near ({:.6g}, {:.6g}, {:.6g}) mm", p.x(), p.y(),
                 p.z());
}

Surface::Curvature Surface::curvature(const Eigen::Vector3d& p) const {
  constexpr double alike = 1e-4, as_large = 1 - 1e-6;  // of the larger curvature
  const Eigen::Vector3d slope = gradient(p), normal = slope.normalized();
  // differences of differences need more room than those
  const double h = 20 * h_;
  Eigen::Matrix3d second;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
    second.col(k) = (gradient(p + step) - gradient(p - step)) / (2 * h);
  }
  second = (0.5 * (second + second.transpose())).eval();
  Eigen::Matrix<double, 3, 2> plane;
  plane.col(0) = normal.unitOrthogonal();
  plane.col(1) = normal.cross(plane.col(0));
  const Eigen::Matrix2d form = -plane.transpose() * second * plane / slope.norm();
  const EigenPairs own = eigen_pairs(form);
  const int larger = std::abs(own.values[1]) >= as_large * std::abs(own.values[0]) ? 1 : 0;
  Curvature found;
  found.first = own.values[larger];
  found.second = own.values[1 - larger];
  found.axes.col(0) = plane * own.vectors.col(larger);
  found.axes.col(1) = plane * own.vectors.col(1 - larger);
  found.axes.col(2) = normal;
  found.umbilic = std::abs(found.first - found.second) <= alike * std::abs(found.first);
  return found;
}

namespace {

constexpr double finest = 0.25;     // of the detail: distance of centres at least
constexpr double fit_over = 4;      // radius of a fit over that distance
constexpr double reach_over = 2;    // radius of a patch over it
constexpr double rim_reach = 1;     // of the detail: patches go on beyond the rim
constexpr double rough = 0.01;      // of the detail: what a vertex may be off
constexpr double least_turn = 0.1;  // cosine between a patch's normal and those around
constexpr std::size_t most_entries = 30000000, most_fitted = 10000000;

Eigen::AlignedBox3d box_about(const Eigen::Vector3d& p, double radius) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(radius);
  return {p - half, p + half};
}

/// (1 - t^2)^4, three times continuously differentiable at t = 1.
double falling(double square) {
  const double left = 1 - square;
  return left > 0 ? left * left * left * left : 0;
}

/// Vertices of the mesh no nearer to one another than `apart`, but so that none lies further from
/// one of them.
Result<std::vector<int>> spread_centres(const Eigen::Matrix3Xd& x, double apart) {
  std::vector<int> centres;
  BoxGrid taken(apart);
  for (int k = 0; k < int(x.cols()); ++k) {
    const auto* near = taken.at(x.col(k));
    if (near && std::ranges::any_of(
                    *near, [&](int other) { return (x.col(other) - x.col(k)).norm() < apart; }))
      continue;
    centres.push_back(k);
    if (!taken.add(k, box_about(x.col(k), apart), most_entries))
      return invalid("the mesh is too large for the rods' spacing");
  }
  return centres;
}

/// Vertices within a radius of one, joined to it by such vertices.
std::vector<int> joined_around(const TriangleMesh& mesh, int centre, double radius,
                               std::vector<int>& mark, int now) {
  std::vector<int> around{centre};
  mark[std::size_t(centre)] = now;
  for (std::size_t k = 0; k < around.size(); ++k)
    for (const int next : mesh.neighbours()[std::size_t(around[k])]) {
      if (mark[std::size_t(next)] == now ||
          (mesh.vertices().col(next) - mesh.vertices().col(centre)).norm() > radius)
        continue;
      mark[std::size_t(next)] = now;
      around.push_back(next);
    }
  return around;
}

/// Whether a sign of equality stands in it that is no part of ==, <=, >= or !=.
bool is_equation(std::string_view text) {
  for (std::size_t k = 1; k + 1 < text.size(); ++k)
    if (text[k] == '=' && text[k + 1] != '=' &&
        std::string_view("=<>!").find(text[k - 1]) == std::string_view::npos)
      return true;
  return false;
}

}  // namespace

Eigen::Matrix<double, MeshSurface::terms, 1> MeshSurface::powers(double u, double v) {
  std::array<double, degree + 1> of_u{1}, of_v{1};
  for (std::size_t k = 1; k <= degree; ++k) of_u[k] = of_u[k - 1] * u, of_v[k] = of_v[k - 1] * v;
  Eigen::Matrix<double, terms, 1> all;
  for (int sum = 0; sum <= degree; ++sum)
    for (int b = 0; b <= sum; ++b)
      all[sum * (sum + 1) / 2 + b] = of_u[std::size_t(sum - b)] * of_v[std::size_t(b)];
  return all;
}

double MeshSurface::above(const Patch& patch, const Eigen::Vector3d& p) const {
  const Eigen::Vector3d local = patch.axes * (p - patch.centre);
  const double u = local.x() / fit_radius_, v = local.y() / fit_radius_;
  // Horner's rule in v of polynomials in u
  const auto& c = patch.height;
  double height = 0;
  for (int b = degree; b >= 0; --b) {
    double in_u = 0;
    for (int a = degree - b; a >= 0; --a) in_u = in_u * u + c[(a + b) * (a + b + 1) / 2 + b];
    height = height * v + in_u;
  }
  return (local.z() - height) / patch.slope;
}

Result<void> MeshSurface::add_patch(const TriangleMesh& mesh, int vertex,
                                    const std::vector<int>& around) {
  const auto& x = mesh.vertices();
  Patch patch;
  patch.centre = x.col(vertex);
  const Eigen::Vector3d normal = mesh.normals().col(vertex);
  patch.axes.row(0) = normal.unitOrthogonal();
  patch.axes.row(2) = normal;
  patch.axes.row(1) = normal.cross(patch.axes.row(0).transpose());
  Eigen::MatrixXd rows(Eigen::Index(around.size()), terms);
  Eigen::VectorXd heights(rows.rows());
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    const int other = around[std::size_t(k)];
    if (mesh.normals().col(other).dot(normal) < least_turn)
      return mesh_fault(
          fmt::format("the mesh turns by more than 84 degrees within {:.3g} mm", fit_radius_),
          patch.centre);
    const Eigen::Vector3d local = patch.axes * (x.col(other) - patch.centre);
    const double weight =
        std::sqrt(std::max(falling(0.9 * local.squaredNorm() / (fit_radius_ * fit_radius_)), 0.0));
    rows.row(k) = weight * powers(local.x() / fit_radius_, local.y() / fit_radius_).transpose();
    heights[k] = weight * local.z();
  }
  // the shortest of all best coefficients: beside a rim not all of them may be told apart
  patch.height = shortest_least_squares(rows, heights, 1e-7);
  patch.slope = std::hypot(1.0, patch.height[1] / fit_radius_, patch.height[2] / fit_radius_);
  const bool beside_rim = std::ranges::any_of(around, [&](int k) { return mesh.on_rim(k); });
  patch.reach = beside_rim ? rim_reach_ : reach_;
  if (!near_.add(int(patches_.size()), box_about(patch.centre, patch.reach), most_entries))
    return invalid("the mesh is too large for the rods' spacing");
  patches_.push_back(patch);
  return {};
}

Result<MeshSurface> MeshSurface::fit(const TriangleMesh& mesh, double detail_mm) {
  const auto& x = mesh.vertices();
  const double apart = std::max(mesh.mean_edge(), finest * detail_mm);
  const double reach = reach_over * apart;
  MeshSurface surface(reach, std::max(reach, rim_reach * detail_mm), fit_over * apart);
  // of a coarse mesh all vertices but doubled ones
  const bool fine = apart > mesh.mean_edge();
  TRY(centres, spread_centres(x, fine ? apart : 0.1 * apart));
  BoxGrid vertices(2 * reach);
  for (int k = 0; k < int(x.cols()); ++k)
    if (!vertices.add(k, {x.col(k), x.col(k)}, most_entries))
      return invalid("the mesh is too large");
  std::vector<int> mark(std::size_t(x.cols()), -1);
  std::size_t fitted = 0;
  for (const int centre : *centres) {
    const auto around = joined_around(mesh, centre, surface.fit_radius_, mark, centre);
    fitted += around.size();
    if (fitted > most_fitted)
      return invalid("the triangles of the mesh are too uneven in size to be fitted");
    // another sheet beside this one
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d to(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const auto* near = vertices.at(x.col(centre) + reach * to);
      if (!near) continue;
      for (const int other : *near)
        if (mark[std::size_t(other)] != centre && (x.col(other) - x.col(centre)).norm() < reach)
          return mesh_fault(
              fmt::format("two parts of the mesh come within {:.3g} mm of one another", reach),
              x.col(centre));
    }
    TRY_DO(surface.add_patch(mesh, centre, around));
  }
  int worst = 0;
  double farthest = 0;
  for (int k = 0; k < int(x.cols()); ++k) {
    const double off = std::abs(surface.at(x.col(k)));
    if (!(off <= farthest)) farthest = off, worst = k;
  }
  if (!(farthest <= rough * detail_mm))
    return mesh_fault(fmt::format("the mesh is not smooth: a vertex lies {:.2g} mm off the smooth "
                                  "surface through those around it, must be less than {:.2g} mm,",
                                  farthest, rough * detail_mm),
                      x.col(worst));
  return surface;
}

double MeshSurface::at(const Eigen::Vector3d& p) const {
  const auto* near = near_.at(p);
  if (!near) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0, weights = 0;
  for (const int k : *near) {
    const Patch& patch = patches_[std::size_t(k)];
    const double weight = falling((p - patch.centre).squaredNorm() / (patch.reach * patch.reach));
    if (weight == 0) continue;
    sum += weight * above(patch, p);
    weights += weight;
  }
  return weights > 0 ? sum / weights : std::numeric_limits<double>::quiet_NaN();
}

std::optional<double> highest_at(const TriangleMesh& mesh, double x, double y) {
  constexpr double outside = -1e-9;
  std::optional<double> highest;
  for (const auto& [a, b, c] : mesh.triangles()) {
    const Eigen::Vector3d p = mesh.vertices().col(a), e = mesh.vertices().col(b) - p,
                          f = mesh.vertices().col(c) - p;
    const double area = e.x() * f.y() - e.y() * f.x();
    const double u = ((x - p.x()) * f.y() - (y - p.y()) * f.x()) / area,
                 v = (e.x() * (y - p.y()) - e.y() * (x - p.x())) / area;
    // upright triangles have no area in the plan
    if (!(u >= outside && v >= outside && u + v <= 1 - outside)) continue;
    const double z = p.z() + u * e.z() + v * f.z();
    if (!highest || z > *highest) highest = z;
  }
  return highest;
}

struct Expression::Parsed {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  mu::Parser parser;
};

Result<Expression> Expression::parse(const std::string& text) {
  if (is_equation(text)) return invalid("an equation, must be one side of it alone");
  auto parsed = std::make_shared<Parsed>();
  try {
    parsed->parser.DefineVar("x", &parsed->point.x());
    parsed->parser.DefineVar("y", &parsed->point.y());
    parsed->parser.DefineVar("z", &parsed->point.z());
    parsed->parser.SetExpr(text);
    int values = 0;
    parsed->parser.Eval(values);
    if (values != 1) return invalid("{} values, must be one", values);
  } catch (const mu::Parser::exception_type& wrong) {
    return invalid("{} (at place {})", wrong.GetMsg(), int(wrong.GetPos()) + 1);
  }
  return Expression(text, std::move(parsed));
}

double Expression::at(const Eigen::Vector3d& point) const {
  parsed_->point = point;
  try {
    return parsed_->parser.Eval();
  } catch (const mu::Parser::exception_type&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace gridshell
