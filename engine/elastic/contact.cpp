#include "engine/elastic/contact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/proximity.h"
#include "engine/elastic/model.h"
#include "engine/footprint/mesh.h"

namespace gridshell {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double parabola_from = 0.05;      // x of the barrier
constexpr double parallel_fraction = 0.05;  // error of the squared distance over the range of d^2

/// b and its first two derivatives.
std::array<double, 3> log_barrier(double x) {
  const double y = x - 1, log = std::log(x);
  return {-y * y * log, -2 * y * log - y * y / x, -2 * log - 4 * y / x + y * y / (x * x)};
}

/// For every node, the first node at the same position (for edge points: in the flat).
std::vector<int> representatives_of(const RodMesh& mesh, const std::vector<double>& radius_mm) {
  std::vector<int> representative(std::size_t(mesh.nodes()));
  for (int k = 0; k < mesh.nodes(); ++k) representative[std::size_t(k)] = k;
  for (const EccentricJoint& at : mesh.eccentric) representative[std::size_t(at.node)] = at.joint;
  const auto at = [&](int k) {
    const Eigen::Vector2d flat = mesh.flat.col(k);
    return Vector3d(flat.x(), flat.y(), mesh.height.size() > 0 ? mesh.height[k] : 0);
  };
  for (int k = 0; k < mesh.edge_points; ++k)
    for (int other = 0; other < k; ++other) {
      const double radii = radius_mm[std::size_t(k / 2)] + radius_mm[std::size_t(other / 2)];
      const int a = mesh.joints + other, b = mesh.joints + k;
      if (k / 2 == other / 2 || (at(a) - at(b)).norm() >= radii) continue;
      representative[std::size_t(b)] = representative[std::size_t(a)];
      break;
    }
  return representative;
}

/// Two edges p + s u and q + t v near each other, with the distance of each_contact().
struct NearEdges {
  Vector3d u, v, apart;         // apart: p - q
  double mollify_e, mollify_f;  // m
  double s = 0, t = 0, distance2 = 0;
  bool inside_s = false, inside_t = false;

  double at(double s_, double t_) const {
    return (apart + s_ * u - t_ * v).squaredNorm() + mollify_e * (s_ - 0.5) * (s_ - 0.5) +
           mollify_f * (t_ - 0.5) * (t_ - 0.5) - 0.25 * (mollify_e + mollify_f);
  }
  /// Half the second derivatives by s and t.
  Eigen::Matrix2d curvature() const {
    Eigen::Matrix2d A;
    A << u.squaredNorm() + mollify_e, -u.dot(v), -u.dot(v), v.squaredNorm() + mollify_f;
    return A;
  }
  void find() {
    const Eigen::Matrix2d A = curvature();
    const Eigen::Vector2d b(0.5 * mollify_e - u.dot(apart), 0.5 * mollify_f + v.dot(apart));
    const Eigen::Vector2d z = A.inverse() * b;
    if (z.minCoeff() > 0 && z.maxCoeff() < 1) return take(z[0], z[1]);
    distance2 = std::numeric_limits<double>::infinity();
    // the function is convex: if its minimum is outside the square, the least value is on a side
    for (const double side : {0.0, 1.0}) {
      const double other_t = std::clamp((b[1] - A(0, 1) * side) / A(1, 1), 0.0, 1.0),
                   other_s = std::clamp((b[0] - A(0, 1) * side) / A(0, 0), 0.0, 1.0);
      if (at(side, other_t) < distance2) take(side, other_t);
      if (at(other_s, side) < distance2) take(other_s, side);
    }
  }
  void take(double s_, double t_) {
    s = s_, t = t_, distance2 = at(s, t);
    inside_s = s > 0 && s<1, inside_t = t> 0 && t < 1;
  }
};

/// Gradient and Hessian of d^2 by the ends of both edges. With r = p(s) - q(t) and the weights w of
/// the ends in it they are 2 w_i r and 2 w_i w_j I, less a term for s and t, which change with the
/// ends unless they are at 0 or 1.
void differentiate(const NearEdges& near, Eigen::Matrix<double, 12, 1>& gradient,
                   Eigen::Matrix<double, 12, 12>& hessian) {
  const double w[4] = {1 - near.s, near.s, near.t - 1, -near.t};
  const double by_s[4] = {-1, 1, 0, 0}, by_t[4] = {0, 0, 1, -1};
  const Vector3d r = near.apart + near.s * near.u - near.t * near.v;
  Eigen::Matrix<double, 12, 2> mixed;
  for (int i = 0; i < 4; ++i) {
    gradient.segment<3>(3 * i) = 2 * w[i] * r;
    mixed.block<3, 1>(3 * i, 0) = by_s[i] * r + w[i] * near.u;
    mixed.block<3, 1>(3 * i, 1) = by_t[i] * r - w[i] * near.v;
    for (int j = 0; j < 4; ++j)
      hessian.block<3, 3>(3 * i, 3 * j) = 2 * w[i] * w[j] * Matrix3d::Identity();
  }
  const Eigen::Matrix2d A = near.curvature();
  if (near.inside_s && near.inside_t)
    hessian -= 2 * mixed * A.inverse() * mixed.transpose();
  else if (near.inside_s)
    hessian -= 2 / A(0, 0) * mixed.col(0) * mixed.col(0).transpose();
  else if (near.inside_t)
    hessian -= 2 / A(1, 1) * mixed.col(1) * mixed.col(1).transpose();
}

std::vector<Eigen::AlignedBox3d> boxes_of(const Model& model,
                                          std::initializer_list<const Eigen::Matrix3Xd*> at) {
  std::vector<Eigen::AlignedBox3d> boxes(model.contact.edges.size());
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const ModelEdge& edge = model.edges[std::size_t(model.contact.edges[k].edge)];
    for (const Eigen::Matrix3Xd* x : at) {
      boxes[k].extend(x->col(edge.from));
      boxes[k].extend(x->col(edge.to));
    }
  }
  return boxes;
}

double widest_of(const ContactPairs& contact) {
  return 2 * *std::ranges::max_element(contact.radius_mm);
}

}  // namespace

ContactBarrier::Value ContactBarrier::at(double distance2, double radii, double thinness) const {
  radii *= thinness;
  const double gap = thinness * gap_mm, range = gap * (2 * radii + gap);  // (S + gap)^2 - S^2
  const double x = (distance2 - radii * radii) / range;
  if (!(x < 1)) return {};
  auto [b, slope, curvature] = log_barrier(std::max(x, parabola_from));
  if (x < parabola_from) {
    const double excess = x - parabola_from;
    b += excess * (slope + 0.5 * excess * curvature);
    slope += excess * curvature;
  }
  const double k = stiffness_N_per_mm * gap * gap;
  return {k * b, k * slope / range, k * curvature / (range * range)};
}

double ContactPairs::thinness(const ContactEdge& a, const ContactEdge& b) const {
  const bool one_rod = a.rod == b.rod;
  const double closed = closed_length_mm[std::size_t(a.rod)], range = radii(a, b) + barrier.gap_mm;
  if (one_rod) {
    double along = std::max(a.begin - b.end, b.begin - a.end);
    if (closed > 0) along = std::min(along, closed - std::max(a.end - b.begin, b.end - a.begin));
    if (along < std::numbers::pi * range) return 0;
  }
  double thinness = 1;
  for (const ContactEdge::End& i : a.ends)
    for (const ContactEdge::End& j : b.ends) {
      if (i.node != j.node) continue;
      // where a rod continues through a joint its two sides are not near each other
      const double between = std::abs(i.at - j.at);
      if (one_rod && (between < 1e-9 || std::abs(between - closed) < 1e-9)) continue;
      thinness = std::min(thinness, std::max(i.near, j.near) / std::max(joint_mm, 4 * range));
    }
  return thinness;
}

ContactPairs contact_pairs(const RodMesh& mesh, const Model& model, const ContactLaw& law) {
  ContactPairs pairs{law.barrier, {}, law.radius_mm, {}, law.joint_mm};
  const std::vector<int> representative = representatives_of(mesh, law.radius_mm);
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const std::vector<int>& node = mesh.rods[r];
    const std::vector<double>& s = mesh.position[r];
    const int first = mesh.is_ghost(node.front()) ? 1 : 0;
    const int last = int(node.size()) - (mesh.is_ghost(node.back()) ? 2 : 1);
    pairs.closed_length_mm.push_back(node[std::size_t(first)] == node[std::size_t(last)]
                                         ? s[std::size_t(last)] - s[std::size_t(first)]
                                         : 0);
    for (int begin = first, end = first; begin < last; begin = end) {
      do ++end;
      while (end < last && mesh.joint_of(node[std::size_t(end)]) < 0);
      const auto at = [&](int k) { return s[std::size_t(k)]; };
      const auto representative_of = [&](int k) {
        return representative[std::size_t(node[std::size_t(k)])];
      };
      for (int k = begin; k < end; ++k)
        pairs.edges.push_back({model.rods[r].edges[std::size_t(k)],
                               int(r),
                               at(k),
                               at(k + 1),
                               {{{representative_of(begin), at(begin), at(k) - at(begin)},
                                 {representative_of(end), at(end), at(end) - at(k + 1)}}}});
    }
  }
  return pairs;
}

void each_contact(const Model& model, const Eigen::Matrix3Xd& x, bool with_derivatives,
                  const std::function<void(const EdgeContact&)>& visit) {
  const ContactPairs& contact = model.contact;
  if (!contact.any()) return;
  const ContactBarrier& barrier = contact.barrier;
  const double reach = (with_derivatives ? 2 : 1) * barrier.gap_mm;
  each_near_pair(boxes_of(model, {&x}), widest_of(contact) + reach, [&](int a, int b) {
    const ContactEdge &one = contact.edges[std::size_t(a)], &other = contact.edges[std::size_t(b)];
    const double thinness = contact.thinness(one, other);
    if (thinness == 0) return;
    const ModelEdge &e = model.edges[std::size_t(one.edge)],
                    &f = model.edges[std::size_t(other.edge)];
    const double radii = thinness * contact.radii(one, other), gap = thinness * barrier.gap_mm,
                 range = radii + gap;
    const double le = e.rest_length, lf = f.rest_length;
    const double mollified = 4 * parallel_fraction * gap * (2 * radii + gap) / (le * le + lf * lf);
    NearEdges near{x.col(e.to) - x.col(e.from), x.col(f.to) - x.col(f.from),
                   x.col(e.from) - x.col(f.from), mollified * le * le, mollified * lf * lf};
    near.find();
    if (!(near.distance2 < (radii + reach) * (radii + reach))) return;
    const double fraction = std::min(1.0, le / range) * std::min(1.0, lf / range);
    const ContactBarrier::Value law =
        barrier.at(near.distance2, contact.radii(one, other), thinness);
    EdgeContact at{{e.from, e.to, f.from, f.to},   one.edge, other.edge, fraction * law.energy,
                   near.distance2 < radii * radii, {},       {}};
    if (with_derivatives) {
      differentiate(near, at.gradient, at.hessian);
      at.hessian =
          fraction *
          (law.slope * at.hessian + law.curvature * at.gradient * at.gradient.transpose()).eval();
      at.gradient *= fraction * law.slope;
    }
    visit(at);
  });
}

double clear_fraction(const Model& model, const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& dx) {
  const ContactPairs& contact = model.contact;
  if (!contact.any()) return 1;
  double clear = 1;
  const Eigen::Matrix3Xd moved = x + dx;
  each_near_pair(boxes_of(model, {&x, &moved}), 0.5 * widest_of(contact), [&](int a, int b) {
    const ContactEdge &one = contact.edges[std::size_t(a)], &other = contact.edges[std::size_t(b)];
    const double thinness = contact.thinness(one, other);
    if (thinness == 0) return;
    const ModelEdge &e = model.edges[std::size_t(one.edge)],
                    &f = model.edges[std::size_t(other.edge)];
    double fastest = 0;
    for (const int i : {e.from, e.to})
      for (const int j : {f.from, f.to})
        fastest = std::max(fastest, (dx.col(i) - dx.col(j)).norm());
    const auto distance = [&](double fraction) {
      const auto at = [&](int node) { return Vector3d(x.col(node) + fraction * dx.col(node)); };
      return std::sqrt(nearest_points(at(e.from), at(e.to), at(f.from), at(f.to)).distance2);
    };
    double fraction = 0, d = distance(0);
    // many moves that each halve the distance would pass through in the end
    const double radii = thinness * contact.radii(one, other), end = 0.25 * radii;
    const double least = d > end ? std::max(0.5 * std::min(d, radii), end) : 0.999 * d;
    const int most_steps = d > end ? 200 : 5000;  // steps of the nearest edges are small
    for (int k = 0; k < most_steps && fraction < clear; ++k) {
      if (fraction > 0 && d - least <= 1e-3 * least) break;
      fraction += (d - least) / fastest;
      d = distance(std::min(fraction, 1.0));
    }
    clear = std::min(clear, fraction);
  });
  return clear;
}

}  // namespace gridshell
