#include "engine/scene/mesh_net.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/core/point_grid.h"

namespace gridshell {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Position at which a rod ends, and why.
struct End {
  Eigen::Vector3d at;
  RodStop why;
};

std::vector<End> ends_of(const MarchedGrid& grid) {
  std::vector<End> ends;
  for (int j = -grid.most(); j <= grid.most(); ++j)
    for (int i = -grid.most(); i <= grid.most(); ++i) {
      const auto& node = grid.at(i, j);
      if (node.known || node.stop == RodStop::none) continue;
      for (const auto& [a, b] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        if (grid.known(i + a, j + b)) ends.push_back({grid.at(i + a, j + b).p, node.stop});
    }
  return ends;
}

/// Nets on a coarse grid, with their properties.
struct Trial {
  const Surface& surface;
  const Barriers& lines;
  const Surface::Function& outside;
  double least_angle, chord, area;
  int most;

  std::optional<NetStart> from(const Eigen::Vector3d& near, double axis_deg,
                               const std::vector<AreaSample>& samples) const {
    constexpr double steepest = 0.1;
    const auto apex = surface.nearest(near);
    if (!apex || !(outside(*apex) < 0)) return std::nullopt;
    NetStart start;
    Eigen::Vector3d up = surface.gradient(*apex).normalized();
    if (up.z() < 0) up = -up;
    if (!(up.z() > steepest)) return std::nullopt;
    const Eigen::Vector3d x = (Eigen::Vector3d::UnitX() - up.x() * up).normalized();
    start.pose = {*apex, Eigen::AngleAxisd(axis_deg * degree, up) * x, up, outside};
    start.axis_deg = axis_deg;
    const MarchedGrid grid(surface, start.pose, lines, least_angle, chord, most);
    double left_out = 0;
    for (const AreaSample& one : left_out_of(grid, lines, samples)) left_out += one.area;
    start.reached = 1 - left_out;
    start.seams =
        double(std::ranges::count(ends_of(grid), RodStop::net, &End::why)) * chord * chord / area;
    start.least_angle_deg = 90;
    grid.each_known([&](int i, int j) {
      if (!grid.joined(i, j, -1, 0) || !grid.joined(i, j, 0, -1)) return;
      const Eigen::Vector3d a = grid.at(i, j).p - grid.at(i - 1, j).p,
                            b = grid.at(i, j).p - grid.at(i, j - 1).p;
      const double angle = std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) / degree;
      start.least_angle_deg = std::min(start.least_angle_deg, angle);
    });
    return start;
  }
};

/// The quality of a start: larger is better.
struct Ranking {
  bool by_angle = false;
  double enough = 0;  ///< fraction of the area from which only the angle counts

  static double area_of(const NetStart& start) { return start.reached - 0.5 * start.seams; }
  double operator()(const NetStart& start) const {
    const double area = area_of(start), angle = start.least_angle_deg / 90;
    if (!by_angle) return area + 0.01 * angle;
    return area < enough ? area - 1 : angle;
  }
};

/// `count` of the points, each as far as possible from the previous ones.
std::vector<Eigen::Vector3d> spread(const std::vector<AreaSample>& samples, std::size_t count) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const AreaSample& one : samples) middle += one.area * one.at;
  const auto nearest = std::ranges::min_element(
      samples, {}, [&](const AreaSample& one) { return (one.at - middle).norm(); });
  std::vector<Eigen::Vector3d> positions{nearest->at};
  std::vector<double> far(samples.size(), INFINITY);
  while (positions.size() < std::min(count, samples.size())) {
    for (std::size_t k = 0; k < samples.size(); ++k)
      far[k] = std::min(far[k], (samples[k].at - positions.back()).norm());
    positions.push_back(samples[std::size_t(std::ranges::max_element(far) - far.begin())].at);
  }
  return positions;
}

bool alike(const NetStart& one, const NetStart& other, double size) {
  const double turned = std::abs(std::remainder(one.axis_deg - other.axis_deg, 90));
  return (one.pose.apex - other.pose.apex).norm() < 0.1 * size && turned < 20;
}

std::string text_of(const NetStart& start) {
  // adding 0.0 turns -0 into 0
  const Eigen::Array3d apex = (10 * start.pose.apex).array().round() / 10 + 0.0;
  return fmt::format("apex_mm = [{:.1f}, {:.1f}, {:.1f}], axis = \"x\", axis_deg = {:.1f}",
                     apex.x(), apex.y(), apex.z(), start.axis_deg);
}

}  // namespace

std::vector<AreaSample> area_samples(const TriangleMesh& mesh, double apart_mm) {
  std::vector<AreaSample> samples;
  PointGrid near(apart_mm / 2);
  // of many small triangles a few represent those around them
  const auto add = [&](const AreaSample& one) {
    const auto takes = [&](int k) {
      AreaSample& other = samples[std::size_t(k)];
      if ((other.at - one.at).norm() > apart_mm / 2) return false;
      other.area += one.area;
      return true;
    };
    if (near.any_near(one.at, takes)) return;
    near.add(int(samples.size()), one.at);
    samples.push_back(one);
  };
  const double whole = mesh.area();
  for (const auto& triangle : mesh.triangles()) {
    const auto [p, e, f] = mesh.corner_and_sides(triangle);
    const double longest = std::max({e.norm(), f.norm(), (f - e).norm()});
    const int parts = std::clamp(int(std::ceil(longest / apart_mm)), 1, 200);
    const double area = 0.5 * e.cross(f).norm() / whole / (parts * parts);
    if (parts == 1) {
      add({p + (e + f) / 3, area});
      continue;
    }
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j)
        for (const double third : {1.0, 2.0}) {
          if (third == 2 && i + j + 2 > parts) continue;
          samples.push_back({p + (i + third / 3) / parts * e + (j + third / 3) / parts * f, area});
        }
  }
  return samples;
}

double net_chord(const TriangleMesh& mesh, double spacing_mm) {
  return std::max(spacing_mm / 8, mesh.size() / 240);
}

int chords_across(const TriangleMesh& mesh, double chord_mm) {
  return int(std::ceil(2.5 * mesh.size() / chord_mm));
}

std::vector<AreaSample> left_out_of(const MarchedGrid& grid, const Barriers& lines,
                                    const std::vector<AreaSample>& samples) {
  const double h = grid.chord();
  PointGrid near(h);
  std::vector<Eigen::Vector3d> nodes;
  grid.each_known([&](int i, int j) {
    near.add(int(nodes.size()), grid.at(i, j).p);
    nodes.push_back(grid.at(i, j).p);
  });
  const auto ends = ends_of(grid);
  std::vector<AreaSample> rest;
  for (const AreaSample& one : samples) {
    const bool reached = near.any_near(one.at, [&](int k) {
      const Eigen::Vector3d& p = nodes[std::size_t(k)];
      return (p - one.at).norm() <= h && !lines.crossed(p, one.at);
    });
    if (reached) continue;
    rest.push_back(one);
    const auto end = std::ranges::min_element(
        ends, {}, [&](const End& e) { return (e.at - one.at).squaredNorm(); });
    if (end != ends.end()) rest.back().why = end->why;
  }
  return rest;
}

Result<std::vector<NetStart>> best_starts(const Surface& surface, const TriangleMesh& mesh,
                                          const Barriers& lines, const Surface::Function& outside,
                                          double least_angle, double spacing_mm, bool by_angle) {
  constexpr std::size_t starts = 40, followed = 5;
  constexpr double turn_deg = 15, given_up = 0.05;  // fraction of the area, for a larger angle
  const double size = mesh.size(), chord = std::max(spacing_mm, size / 24);
  const auto trial_on = [&](double h) {
    return Trial{surface, lines, outside, least_angle, h, mesh.area(), chords_across(mesh, h)};
  };
  const Trial trial = trial_on(chord);
  const auto samples = area_samples(mesh, std::sqrt(mesh.area() / 400));
  std::vector<NetStart> found;
  for (const Eigen::Vector3d& apex : spread(samples, starts))
    for (double turned = 0; turned < 90; turned += turn_deg)
      if (auto start = trial.from(apex, turned, samples)) found.push_back(std::move(*start));
  if (found.empty()) return invalid("no part of the mesh faces up inside the boundary");
  Ranking rank{by_angle};
  const auto measure = [&](const std::vector<NetStart>& all) {
    const auto most = std::ranges::max_element(all, {}, Ranking::area_of);
    rank.enough = Ranking::area_of(*most) - given_up;
  };
  measure(found);
  const auto better = [&](const NetStart& a, const NetStart& b) { return rank(a) > rank(b); };
  std::ranges::stable_sort(found, better);
  // the best of each kind
  std::vector<NetStart> kinds;
  for (NetStart& one : found)
    if (kinds.size() < followed &&
        std::ranges::none_of(kinds, [&](const auto& k) { return alike(k, one, size); }))
      kinds.push_back(std::move(one));
  for (NetStart& one : kinds) {
    double step = size / 12, turn = turn_deg / 2;
    for (int round = 0; round < 3; ++round, step /= 2, turn /= 2) {
      const NetStart middle = one;
      const Eigen::Vector3d across = middle.pose.up.cross(middle.pose.along_u);
      for (const auto& [along, left, by] : {std::array{1., 0., 0.},
                                            {-1., 0., 0.},
                                            {0., 1., 0.},
                                            {0., -1., 0.},
                                            {0., 0., 1.},
                                            {0., 0., -1.}}) {
        auto moved =
            trial.from(middle.pose.apex + step * (along * middle.pose.along_u + left * across),
                       middle.axis_deg + by * turn, samples);
        if (moved && rank(*moved) > rank(one)) one = std::move(*moved);
      }
    }
  }
  std::ranges::stable_sort(kinds, better);
  // evaluates each on the grid of the net itself, which decides if the coarse grid was wrong
  constexpr double mistaken = 0.05;  // fraction of the area
  const Trial last = trial_on(net_chord(mesh, spacing_mm));
  const auto fine = area_samples(mesh, last.chord);
  const double promised = Ranking::area_of(kinds.front());
  for (NetStart& one : kinds)
    if (auto measured = last.from(one.pose.apex, one.axis_deg, fine)) one = std::move(*measured);
  if (by_angle || Ranking::area_of(kinds.front()) < promised - mistaken) {
    measure(kinds);
    std::ranges::stable_sort(kinds, better);
  }
  while (kinds.size() > 1 && alike(kinds[0], kinds[1], size)) kinds.erase(kinds.begin() + 1);
  kinds.resize(std::min<std::size_t>(kinds.size(), 2));
  return kinds;
}

std::vector<std::pair<RodStop, double>> MeshNetReport::reasons() const {
  std::map<RodStop, double> sums;
  for (const AreaSample& one : left_out) sums[one.why] += one.area;
  std::vector<std::pair<RodStop, double>> all(sums.begin(), sums.end());
  std::ranges::stable_sort(all, [](const auto& a, const auto& b) { return a.second > b.second; });
  return all;
}

std::vector<std::string> MeshNetReport::sentences() const {
  std::vector<std::string> all = mended;
  all.push_back(fmt::format(
      "the smooth surface lies {:.2g} mm off the mesh's vertices at most, near ({:.4g}, {:.4g}, "
      "{:.4g}) mm",
      fit_mm, fit_at.x(), fit_at.y(), fit_at.z()));
  if (!lines.empty()) all.push_back(fmt::format("the mesh has {}", fmt::join(lines, " and ")));
  all.push_back(
      fmt::format("the net reaches {:.1f} % of the mesh's area, rods cross at {:.0f} "
                  "degrees or more; it begins at {}",
                  100 * start.reached, start.least_angle_deg, text_of(start)));
  if (second)
    all.push_back(
        fmt::format("the second best begins at {}, reaches {:.1f} % and rods cross there at {:.0f} "
                    "degrees or more",
                    text_of(*second), 100 * second->reached, second->least_angle_deg));
  for (const auto& [why, fraction] : reasons())
    if (fraction >= 0.0005)
      all.push_back(fmt::format("left out: {:.1f} % of the area, rods end before it: {}",
                                100 * fraction, gridshell::text_of(why)));
  return all;
}

}  // namespace gridshell
