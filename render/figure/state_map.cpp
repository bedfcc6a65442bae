#include "render/figure/state_map.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gridshell::render {
namespace {

constexpr Colour ring_ink{0.55f, 0.55f, 0.58f, 1};
constexpr double room = 1.12;  // of the boundary, that mirrors stand out beyond it

/// Directions of the mirrors of a group whose name says where they are, degrees.
std::vector<double> mirrors_of(const std::string& group) {
  if (group == "C4v") return {0, 45, 90, 135};
  if (group == "C2v_axes") return {0, 90};
  if (group == "C2v_diagonals") return {45, 135};
  return {};
}

double radius_of(const record::Layout& layout) {
  return layout.actuated_boundary.topRows<2>().colwise().norm().maxCoeff();
}

}  // namespace

std::vector<int> inflections_of(const record::StateRow& row) {
  std::vector<int> counts;
  std::istringstream words(row.inflections);
  for (std::string word; words >> word;)
    if (word != "|") counts.push_back(std::atoi(word.c_str()));
  return counts;
}

double state_map_scale(const Box& box, const record::Layout& layout) {
  return 0.5 * std::min(box.width, box.height) / (room * radius_of(layout));
}

void draw_state_map(Canvas& canvas, const Box& box, double units_per_mm,
                    const record::Layout& layout, const record::Frame& frame,
                    const record::StateRow& row) {
  const auto place = [&](const Eigen::Vector3d& p) {
    return Point{box.middle().x + units_per_mm * p.x(), box.middle().y - units_per_mm * p.y()};
  };
  const double beyond = room * radius_of(layout);
  for (const double degrees : mirrors_of(row.group)) {
    const double angle = degrees * M_PI / 180;
    const Eigen::Vector3d end(beyond * std::cos(angle), beyond * std::sin(angle), 0);
    canvas.line(place(-end), place(end), {mirror_ink, 0.8, {4, 2, 1, 2}});
  }
  std::vector<Point> ring;
  for (const auto& point : layout.actuated_boundary.colwise()) ring.push_back(place(point));
  canvas.polyline(ring, {ring_ink, 0.8}, true);
  const std::vector<int> inflections = inflections_of(row);
  for (std::size_t r = 0; r < layout.rods.size(); ++r) {
    const bool higher = r < inflections.size() && inflections[r] > 0;
    std::vector<Point> rod;
    for (const int node : layout.rods[r]) rod.push_back(place(frame.nodes.col(node)));
    canvas.polyline(rod, {higher ? higher_order_ink : first_order_ink, 0.6});
  }
  if (row.group == "C4") {
    const double half = 2.6;
    const Point m = box.middle();
    canvas.rectangle({m.x - half, m.y - half, 2 * half, 2 * half}, mirror_ink);
  }
}

}  // namespace gridshell::render
