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
  constexpr double alike = 1e-4, as_large = 1 - 1e-6;  // relative to the larger curvature
  const Eigen::Vector3d slope = gradient(p), normal = slope.normalized();
  // second differences need a larger step than first ones
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

constexpr double finest = 0.25;     // least distance of centres, over the detail
constexpr double rim_reach = 1;     // reach of patches at the rim, over the detail
constexpr double least_turn = 0.1;  // least cosine between a patch's normal and those around
constexpr double apart_over = 0.3;  // least distance of another part of the mesh, over the reach
constexpr int few = 22;             // desired number of vertices of a fit of degree 4
constexpr std::size_t enough = 150;
constexpr std::size_t most_entries = 30000000, most_fitted = 10000000;
// radius of a fit over the distance of centres, the smoothest first
constexpr std::array all_radii{9.0, 7.0, 5.5, 4.0, 3.0, 2.3};
constexpr double usual_radii = 4,
                 smooth = 1e-4;  // largest distance of the vertices of a smooth mesh, over its size

Eigen::AlignedBox3d box_about(const Eigen::Vector3d& p, double radius) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(radius);
  return {p - half, p + half};
}

/// (1 - t^2)^4, three times continuously differentiable at t = 1.
double falling(double square) {
  const double left = 1 - square;
  return left > 0 ? left * left * left * left : 0;
}

/// Chooses vertices of the mesh that are at least `apart` away from each other, so that every
/// vertex is within `apart` of one of them.
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

/// Vertices within a radius of a centre that are connected to it by such vertices and are not
/// behind a crease.
std::vector<int> joined_around(const TriangleMesh& mesh, const Barriers& lines, int centre,
                               double radius, std::vector<int>& mark, int now) {
  const Eigen::Vector3d middle = mesh.vertices().col(centre);
  std::vector<int> around{centre};
  mark[std::size_t(centre)] = now;
  for (std::size_t k = 0; k < around.size(); ++k) {
    // vertices on a crease belong to both sides, so the search stops there
    if (mesh.on_crease(around[k])) continue;
    for (const int next : mesh.neighbours()[std::size_t(around[k])]) {
      const Eigen::Vector3d to = mesh.vertices().col(next);
      if (mark[std::size_t(next)] == now || (to - middle).norm() > radius) continue;
      mark[std::size_t(next)] = now;
      if (!lines.crosses_crease(middle, middle + 0.999 * (to - middle))) around.push_back(next);
    }
  }
  return around;
}

/// Every n-th vertex, from near to far, if there are more than a fit needs.
std::vector<int> thinned(const std::vector<int>& around) {
  if (around.size() <= 2 * enough) return around;
  std::vector<int> some;
  const std::size_t step = around.size() / enough;
  for (std::size_t k = 0; k < around.size(); k += step) some.push_back(around[k]);
  return some;
}

/// Whether the text contains an equals sign that is no part of ==, <=, >= or !=.
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

double MeshSurface::above(const Patch& patch, const Eigen::Vector3d& p) {
  const Eigen::Vector3d local = patch.axes * (p - patch.centre);
  const double u = local.x() / patch.radius, v = local.y() / patch.radius;
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

/// The fit around a vertex; empty if the mesh bends too sharply.
std::optional<MeshSurface::Patch> MeshSurface::patch_of(const TriangleMesh& mesh, int vertex,
                                                        const std::vector<int>& around,
                                                        double radius) {
  const auto& x = mesh.vertices();
  Patch patch;
  patch.centre = x.col(vertex);
  patch.radius = radius;
  const Eigen::Vector3d normal = mesh.normals().col(vertex);
  patch.axes.row(0) = normal.unitOrthogonal();
  patch.axes.row(2) = normal;
  patch.axes.row(1) = normal.cross(patch.axes.row(0).transpose());
  const auto count = Eigen::Index(around.size());
  // a lower degree if the vertices are few compared with the coefficients
  const Eigen::Index used = count >= few ? terms : count >= 14 ? 10 : count >= 8 ? 6 : 3;
  Eigen::MatrixXd rows(count, used);
  Eigen::VectorXd heights(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const int other = around[std::size_t(k)];
    if (!mesh.on_crease(other) && mesh.normals().col(other).dot(normal) < least_turn)
      return std::nullopt;
    const Eigen::Vector3d local = patch.axes * (x.col(other) - patch.centre);
    const double weight =
        std::sqrt(std::max(falling(0.9 * local.squaredNorm() / (radius * radius)), 0.0));
    rows.row(k) = weight * powers(local.x() / radius, local.y() / radius).head(used).transpose();
    heights[k] = weight * local.z();
  }
  // of all best fits the one with the smallest coefficients: near a rim the fit may not be unique
  patch.height.setZero();
  patch.height.head(used) = shortest_least_squares(rows, heights, 1e-7);
  patch.slope = std::hypot(1.0, patch.height[1] / radius, patch.height[2] / radius);
  return patch;
}

Result<MeshSurface> MeshSurface::fitted(const TriangleMesh& mesh, const Barriers& lines,
                                        double detail_mm, double radii) {
  const auto& x = mesh.vertices();
  const double apart = std::max(mesh.mean_edge(), finest * detail_mm);
  MeshSurface surface(radii / 2 * apart);
  surface.lines_ = lines;
  // in a coarse mesh every vertex is a centre, except those very near to another one
  const bool fine = apart > mesh.mean_edge();
  TRY(centres, spread_centres(x, fine ? apart : 0.1 * apart));
  BoxGrid vertices(radii * apart);
  for (int k = 0; k < int(x.cols()); ++k)
    if (!vertices.add(k, {x.col(k), x.col(k)}, most_entries))
      return invalid("the mesh is too large");
  std::vector<int> mark(std::size_t(x.cols()), -1);
  std::size_t visited = 0;
  int now = 0;
  for (const int centre : *centres) {
    if (mesh.on_crease(centre)) continue;
    // a larger radius if vertices are few, a smaller one if the mesh bends too sharply
    double radius = std::max(radii * apart, 1.6 * mesh.longest_edge(centre));
    std::vector<int> around;
    const auto look = [&] {
      around = joined_around(mesh, lines, centre, radius, mark, ++now);
      visited += around.size();
    };
    look();
    for (int k = 0; k < 4 && int(around.size()) < few; ++k) radius *= 1.25, look();
    auto patch = patch_of(mesh, centre, thinned(around), radius);
    for (int k = 0; k < 3 && !patch; ++k) {
      radius *= 0.7, look();
      patch = patch_of(mesh, centre, thinned(around), radius);
    }
    if (visited > most_fitted)
      return invalid("the triangles of the mesh are too uneven in size to be fitted");
    if (!patch) continue;
    patch->reach = std::max(radius / 2, 1.1 * mesh.longest_edge(centre));
    if (std::ranges::any_of(around, [&](int k) { return mesh.on_rim(k); }))
      patch->reach = std::max(patch->reach, rim_reach * detail_mm);
    patch->near_crease = std::ranges::any_of(around, [&](int k) { return mesh.on_crease(k); });
    // no patch where another sheet of the mesh is next to this one
    bool alone = true;
    for (int corner = 0; corner < 8 && alone; ++corner) {
      const Eigen::Vector3d to(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const auto* near = vertices.at(x.col(centre) + radii / 2 * apart * to);
      if (!near) continue;
      for (const int other : *near)
        alone = alone && (mark[std::size_t(other)] == now ||
                          (x.col(other) - x.col(centre)).norm() > radii / 2 * apart ||
                          std::abs(above(*patch, x.col(other))) < apart_over * patch->reach);
    }
    if (!alone) continue;
    if (!surface.near_.add(int(surface.patches_.size()), box_about(patch->centre, patch->reach),
                           most_entries))
      return invalid("the mesh is too large for the rods' spacing");
    surface.patches_.push_back(*patch);
  }
  if (surface.patches_.empty())
    return invalid("the mesh is nowhere smooth enough for a surface through its vertices");
  surface.measure(mesh);
  return surface;
}

void MeshSurface::measure(const TriangleMesh& mesh) {
  for (int k = 0; k < int(mesh.vertices().cols()); ++k) {
    const double off = mesh.on_crease(k) ? 0 : std::abs(at(mesh.vertices().col(k)));
    if (off > farthest_) farthest_ = off, farthest_at_ = mesh.vertices().col(k);
  }
}

Result<MeshSurface> MeshSurface::fit(const TriangleMesh& mesh, double detail_mm, double fit_mm) {
  const Barriers lines(mesh);
  const double requested = fit_mm > 0 ? fit_mm : 1e-3 * mesh.size();
  // the usual radius is enough if the mesh is smooth
  if (fit_mm == 0) {
    TRY(close, fitted(mesh, lines, detail_mm, usual_radii));
    if (close->farthest_ <= smooth * mesh.size()) return std::move(*close);
  }
  std::optional<MeshSurface> best;
  for (const double radii : all_radii) {
    TRY(surface, fitted(mesh, lines, detail_mm, radii));
    if (best && surface->farthest_ > best->farthest_) continue;
    best = std::move(*surface);
    if (best->farthest_ <= requested) break;
  }
  if (fit_mm > 0 && best->farthest_ > fit_mm)
    return mesh_error(fmt::format("the mesh is not that smooth: got fit_mm = {:g}, expected at "
                                  "least {:.2g}, as a vertex lies so far off the closest surface",
                                  fit_mm, best->farthest_),
                      best->farthest_at_);
  return std::move(*best);
}

/// Distance of p from a patch's centre, around the end of a crease if one is between them.
double MeshSurface::distance(const Patch& patch, const Eigen::Vector3d& p) const {
  const double straight = (p - patch.centre).norm();
  if (!patch.near_crease || straight > patch.reach || !lines_.crosses_crease(patch.centre, p))
    return straight;
  double around = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& tip : lines_.tips())
    around = std::min(around, (p - tip).norm() + (tip - patch.centre).norm());
  return around;
}

double MeshSurface::at(const Eigen::Vector3d& p) const {
  const auto* near = near_.at(p);
  if (!near) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0, weights = 0;
  for (const int k : *near) {
    const Patch& patch = patches_[std::size_t(k)];
    const double ratio = distance(patch, p) / patch.reach, weight = falling(ratio * ratio);
    if (weight == 0) continue;
    sum += weight * above(patch, p);
    weights += weight;
  }
  return weights > 0 ? sum / weights : std::numeric_limits<double>::quiet_NaN();
}

std::optional<double> highest_at(const TriangleMesh& mesh, double x, double y) {
  constexpr double outside = -1e-9;
  std::optional<double> highest;
  for (const auto& triangle : mesh.triangles()) {
    const auto [p, e, f] = mesh.corner_and_sides(triangle);
    const double area = e.x() * f.y() - e.y() * f.x();
    const double u = ((x - p.x()) * f.y() - (y - p.y()) * f.x()) / area,
                 v = (e.x() * (y - p.y()) - e.y() * (x - p.x())) / area;
    // vertical triangles have no area in plan: u and v are not finite
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
  if (is_equation(text)) return invalid("got an equation, expected one side of it");
  auto parsed = std::make_shared<Parsed>();
  try {
    parsed->parser.DefineVar("x", &parsed->point.x());
    parsed->parser.DefineVar("y", &parsed->point.y());
    parsed->parser.DefineVar("z", &parsed->point.z());
    parsed->parser.SetExpr(text);
    int values = 0;
    parsed->parser.Eval(values);
    if (values != 1) return invalid("got {} values, expected one", values);
  } catch (const mu::Parser::exception_type& wrong) {
    return invalid("{} (at character {})", wrong.GetMsg(), int(wrong.GetPos()) + 1);
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
