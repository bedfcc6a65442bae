#include "engine/record/frame_values.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace gridshell::record {
namespace {

/// Number of points of all rods before rod `rod`.
std::size_t points_before(const Layout& layout, std::size_t rod) {
  std::size_t points = 0;
  for (std::size_t k = 0; k < rod; ++k) points += layout.rods[k].size();
  return points;
}

/// Means of values that several rods give at a node.
class NodeMeans {
 public:
  explicit NodeMeans(Eigen::Index nodes)
      : sum_(Eigen::VectorXd::Zero(nodes)), count_(Eigen::VectorXd::Zero(nodes)) {}

  void add(int node, double value) {
    sum_[node] += value;
    count_[node] += 1;
  }
  bool has(int node) const { return count_[node] > 0; }
  double operator[](int node) const { return has(node) ? sum_[node] / count_[node] : 0; }
  Eigen::VectorXd all() const { return sum_.array() / count_.array().max(1); }

 private:
  Eigen::VectorXd sum_, count_;
};

}  // namespace

double curvature_between(const Eigen::Vector3d& te, const Eigen::Vector3d& tf, double length) {
  return 2 * te.cross(tf).norm() / (1 + te.dot(tf)) / length;
}

namespace {

/// A larger unit for values of at least `from`: 1 `larger` = `times` `unit`.
struct LargeUnit {
  const char *unit, *larger;
  double times, from;
};
constexpr LargeUnit large_units[] = {
    {"mJ", "kJ", 1e6, 1e6}, {"mJ", "J", 1e3, 1e4}, {"N", "kN", 1e3, 1e4}};

/// A number with so many decimals; zero without a sign.
std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find_first_not_of("-0.") == text.npos && text[0] == '-') text.erase(0, 1);
  return text;
}

}  // namespace

std::string with_error(double value, double error, const char* unit) {
  for (const auto& [small, larger, times, from] : large_units)
    if (std::string_view(small) == unit && std::abs(value) >= from && std::isfinite(value))
      return with_error(value / times, error / times, larger);
  const std::string end = *unit ? fmt::format(" {}", unit) : "";
  if (!std::isfinite(error)) return fmt::format("{:.4g}{} (error not known)", value, end);
  constexpr double round_off = 1e-9;
  if (std::max(std::abs(value), error) < round_off) return "0" + end;
  if (error == 0) return fmt::format("{:.9g}{}", value, end);
  const double exponent = std::floor(std::log10(error));
  if (exponent < 1) {
    const int digits = int(std::clamp(-exponent, 0.0, 12.0));
    return fmt::format("{} ± {}{}", fixed(value, digits),
                       error < 1 ? fmt::format("{:.1g}", error) : fmt::format("{:.0f}", error),
                       end);
  }
  // two digits of the error, and the digits of the value down to the last of them
  const double step = std::pow(10, exponent - 1);
  return fmt::format("{} ± {:.0f}{}", fixed(std::nearbyint(value / step) * step, 0),
                     std::nearbyint(error / step) * step, end);
}

std::vector<double> curvature_per_mm(const Eigen::Matrix3Xd& points) {
  std::vector<double> curvature(std::size_t(points.cols()), 0.0);
  for (Eigen::Index k = 1; k + 1 < points.cols(); ++k) {
    const Eigen::Vector3d before = points.col(k) - points.col(k - 1),
                          after = points.col(k + 1) - points.col(k);
    curvature[std::size_t(k)] = curvature_between(before.normalized(), after.normalized(),
                                                  0.5 * (before.norm() + after.norm()));
  }
  return curvature;
}

std::vector<double> curvature_per_mm(const Layout& layout, const Frame& frame, std::size_t rod) {
  const std::vector<int>& nodes = layout.rods[rod];
  if (frame.curvature_per_mm.size() == 0) return curvature_per_mm(frame.nodes(Eigen::all, nodes));
  const double* first = frame.curvature_per_mm.data() + points_before(layout, rod);
  return {first, first + nodes.size()};
}

std::vector<double> axial_force_N(const Layout& layout, const Frame& frame, std::size_t rod) {
  const std::size_t points = layout.rods[rod].size();
  std::vector<double> force(points, unknown);
  if (frame.axial_force_N.size() == 0 || points < 2) return force;
  // each rod before this one has one edge less than points
  const double* edges = frame.axial_force_N.data() + points_before(layout, rod) - rod;
  force.front() = edges[0];
  force.back() = edges[points - 2];
  for (std::size_t k = 1; k + 1 < points; ++k) force[k] = 0.5 * (edges[k - 1] + edges[k]);
  return force;
}

Eigen::VectorXd axial_force_of_nodes_N(const Layout& layout, const Frame& frame) {
  if (frame.axial_force_N.size() == 0) return {};
  NodeMeans means(frame.nodes.cols());
  Eigen::Index edge = 0;
  for (const std::vector<int>& rod : layout.rods)
    for (std::size_t k = 1; k < rod.size(); ++k, ++edge)
      for (const int node : {rod[k - 1], rod[k]}) means.add(node, frame.axial_force_N[edge]);
  return means.all();
}

std::vector<double> stress_MPa(const Layout& layout, const Frame& frame, std::size_t rod) {
  const std::size_t points = layout.rods[rod].size();
  if (frame.stress_MPa.size() == 0) return std::vector<double>(points, unknown);
  const double* first = frame.stress_MPa.data() + points_before(layout, rod);
  return {first, first + points};
}

Eigen::VectorXd stress_of_nodes_MPa(const Layout& layout, const Frame& frame, bool utilised) {
  if (frame.stress_MPa.size() == 0 || (utilised && layout.strength_MPa.empty())) return {};
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(frame.nodes.cols());
  Eigen::Index point = 0;
  for (std::size_t r = 0; r < layout.rods.size(); ++r)
    for (const int node : layout.rods[r]) {
      const double over = utilised ? layout.strength_MPa[r] : 1;
      largest[node] = std::max(largest[node], frame.stress_MPa[point++] / over);
    }
  return largest;
}

Eigen::VectorXd bending_of_nodes_mJ_per_m(const Layout& layout, const Frame& frame) {
  if (frame.bending_mJ_per_m.size() == 0) return {};
  // a rod that ends on another one has no bending moment there: rods that pass through count first
  NodeMeans through(frame.nodes.cols()), ends(frame.nodes.cols());
  Eigen::Index point = 0;
  for (const std::vector<int>& rod : layout.rods)
    for (std::size_t k = 0; k < rod.size(); ++k, ++point)
      (k == 0 || k + 1 == rod.size() ? ends : through).add(rod[k], frame.bending_mJ_per_m[point]);
  Eigen::VectorXd bending(frame.nodes.cols());
  for (int node = 0; node < int(bending.size()); ++node)
    bending[node] = through.has(node) ? through[node] : ends[node];
  return bending;
}

Eigen::VectorXd joint_angle_of_nodes_deg(const Layout& layout, const Frame& frame) {
  if (!frame.angle_deg.array().isFinite().any()) return {};
  Eigen::VectorXd of_joints = Eigen::VectorXd::Constant(frame.nodes.cols(), NAN);
  for (std::size_t k = 0; k < layout.joints.size(); ++k) {
    const double angle = frame.angle_deg[Eigen::Index(k)];
    of_joints[layout.joints[k].node] = angle;
    if (!layout.above.empty()) of_joints[layout.above[k]] = angle;
  }
  Eigen::VectorXd at_nodes = of_joints;
  for (const std::vector<int>& rod : layout.rods) {
    std::vector<std::size_t> known;
    for (std::size_t k = 0; k < rod.size(); ++k)
      if (std::isfinite(of_joints[rod[k]])) known.push_back(k);
    for (std::size_t k = 0, next = 0; !known.empty() && k < rod.size(); ++k) {
      while (next + 1 < known.size() && known[next] < k) ++next;
      const std::size_t b = known[next], a = next > 0 ? known[next - 1] : b;
      const double part = a == b ? 1 : std::min(1.0, double(k - a) / double(b - a));
      at_nodes[rod[k]] = part * of_joints[rod[b]] + (1 - part) * of_joints[rod[a]];
    }
  }
  return at_nodes;
}

Eigen::VectorXd deviation_of_nodes(const Layout& layout, const Frame& frame) {
  const Eigen::Index nodes = std::min(frame.nodes.cols(), layout.net_nodes.cols());
  if (!has_net(layout)) return {};
  return (frame.nodes.leftCols(nodes) - layout.net_nodes.leftCols(nodes)).colwise().norm() /
         layout.length_scale_mm;
}

Eigen::VectorXd mean_of_cells(const Layout& layout, const Eigen::VectorXd& of_nodes) {
  Eigen::VectorXd of_cells(Eigen::Index(layout.cells.size()));
  for (std::size_t k = 0; k < layout.cells.size(); ++k) {
    double sum = 0;
    for (const int joint : layout.cells[k].joints)
      sum += of_nodes[layout.joints[std::size_t(joint)].node];
    of_cells[Eigen::Index(k)] = sum / 4;
  }
  return of_cells;
}

Eigen::VectorXd deviation_of_cells(const Layout& layout, const Frame& frame) {
  if (!has_net(layout)) return {};
  return mean_of_cells(layout, deviation_of_nodes(layout, frame));
}

std::vector<std::array<int, 2>> braces_of(const Layout& layout, const Frame& frame) {
  std::vector<std::array<int, 2>> braces;
  for (Eigen::Index k = 0; k < frame.brace_force_N.size(); ++k) {
    if (std::isnan(frame.brace_force_N[k])) continue;
    const auto& joints = layout.cells[std::size_t(k / 2)].joints;
    const auto node = [&](Eigen::Index corner) {
      return layout.joints[std::size_t(joints[std::size_t(corner)])].node;
    };
    braces.push_back({node(k % 2), node(k % 2 + 2)});
  }
  return braces;
}

}  // namespace gridshell::record
