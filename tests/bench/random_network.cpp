// Random networks: flat or in space, joints of several laws, ends of several conditions.
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tests/bench/random_scenes.h"

namespace gridshell::bench {
namespace {

/// A line of a family, x . normal = offset, and its joints with their positions along it.
struct Line {
  Eigen::Vector2d normal;
  double offset = 0;
  std::vector<std::pair<double, int>> joints{};

  Eigen::Vector2d along() const { return {-normal.y(), normal.x()}; }
};

/// Two families at any angle, or three at 60 degrees of which no three lines meet.
std::vector<Line> random_lines(RandomDraw& draw, double spacing) {
  const int families = draw.once_in(3) ? 3 : 2, rods = draw.integer(2, 3);
  const double first = draw.between(0, M_PI),
               between = families == 3 ? M_PI / 3 : draw.between(0.7, M_PI / 2);
  std::vector<Line> lines;
  for (int family = 0; family < families; ++family)
    for (int k = -rods; k < rods; ++k) {
      const double angle = first + family * between;
      lines.push_back({{std::cos(angle), std::sin(angle)}, (k + 0.5) * spacing});
    }
  return lines;
}

/// Adds rods along random lines to the file. Joints are the crossings inside an ellipse, at the
/// heights of a dome; each rod has a leg outside its outer joints. The first points of the file are
/// the joints; returns their number.
int lay_rods(RandomDraw& draw, double spacing, double rise, preset::NetworkData& file) {
  std::vector<Line> lines = random_lines(draw, spacing);
  const Eigen::Array2d half(spacing * draw.between(1.6, 3.2), spacing * draw.between(1.6, 3.2));
  const auto add = [&](const Eigen::Vector2d& at) {
    const double height = rise * (1 - (at.array() / half).square().sum());
    file.points.push_back({at.x(), at.y(), height});
    return int(file.points.size()) - 1;
  };
  for (std::size_t a = 0; a < lines.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      Eigen::Matrix2d normals;
      normals << lines[a].normal.transpose(), lines[b].normal.transpose();
      if (std::abs(normals.determinant()) < 0.1) continue;
      const Eigen::Vector2d at =
          normals.inverse() * Eigen::Vector2d(lines[a].offset, lines[b].offset);
      if ((at.array() / half).square().sum() > 1) continue;
      const int joint = add(at);
      for (Line* line : {&lines[a], &lines[b]})
        line->joints.emplace_back(line->along().dot(at), joint);
    }
  const int joints = int(file.points.size());
  const double leg = spacing * draw.between(0.3, 1.2);
  for (Line& line : lines) {
    if (line.joints.empty()) continue;
    std::ranges::sort(line.joints);
    const auto end = [&](double s) { return add(line.offset * line.normal + s * line.along()); };
    std::vector<int>& rod = file.rods.emplace_back();
    rod.push_back(end(line.joints.front().first - leg));
    for (const auto& [s, joint] : line.joints) rod.push_back(joint);
    rod.push_back(end(line.joints.back().first + leg));
  }
  return joints;
}

void mix_laws(RandomDraw& draw, int joints, preset::NetworkData& file) {
  const double laws[][2] = {{0, -1}, {-1, -1}, {draw.between(1, 50), draw.between(0, 50)}};
  for (int joint = 0; joint < joints; ++joint)
    if (const int law = draw.integer(0, 3); law < 3)
      file.joint_laws.push_back({double(joint), laws[law][0], laws[law][1]});
}

void mix_holds(RandomDraw& draw, preset::NetworkData& file) {
  for (std::size_t rod = 0; rod < file.rods.size(); ++rod)
    for (const int end : {0, 1}) {
      const double point = end == 0 ? file.rods[rod].front() : file.rods[rod].back();
      const int hold = draw.integer(0, 4);  // pinned, tangent, clamped, on a spring, any
      if (hold < 3) file.end_constraints.push_back({double(rod), double(end), double(hold)});
      if (hold != 3) continue;
      const double k = std::pow(10, draw.between(-2, 1));
      file.supports.push_back({point});
      file.springs.push_back({point, k, k, k});
    }
}

}  // namespace

void random_network(RandomDraw& draw, preset::Preset& p) {
  p.footprint.kind = preset::FootprintKind::network;
  preset::NetworkData& file = p.footprint.file;
  const double spacing = draw.between(15, 30);
  const bool in_space = draw.once_in(2);
  const int joints = lay_rods(draw, spacing, in_space ? draw.between(5, 30) : 0, file);
  p.actuation.scale = in_space && draw.once_in(2) ? 0 : draw.between(0.75, 0.98);
  p.imperfection.seed = draw.integer(1, 1000);
  p.rod.shear_GPa = 31;
  if (draw.once_in(2)) mix_laws(draw, joints, file);
  if (draw.once_in(2)) mix_holds(draw, file);
  if (draw.once_in(3)) {
    p.rod.width_mm = draw.between(0.3, 0.8);
    p.rod.thickness_mm = draw.between(0.15, 0.3);
  }
  if (draw.once_in(3)) file.own.push_back({0, "young_GPa", draw.between(40, 200)});
  if (draw.once_in(4)) {
    p.rod.density_kg_m3 = 6450;
    p.loads.gravity_m_s2 = draw.between(-20, 40);
  }
}

}  // namespace gridshell::bench
