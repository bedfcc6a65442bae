#include <algorithm>
#include <array>
#include <cmath>

#include "engine/gridshell/twist_model.h"
#include "engine/rod/frame.h"
#include "engine/rod/joint_spin.h"
#include "engine/rod/stretch.h"

namespace gridshell {
namespace {

using LinkUnknowns = std::array<int, 6>;
using PairUnknowns = std::array<int, 14>;

LinkUnknowns unknowns_of_link(int from, int to) {
  return {3 * from, 3 * from + 1, 3 * from + 2, 3 * to, 3 * to + 1, 3 * to + 2};
}

PairUnknowns unknowns_of_pair(const TwistModel& model, int e, int f) {
  PairUnknowns all;
  int at = 0;
  for (int node : {model.edges[e].from, model.edges[e].to, model.edges[f].from, model.edges[f].to})
    for (int c = 0; c < 3; ++c) all[at++] = 3 * node + c;
  all[at++] = model.angle_of(e);
  all[at++] = model.angle_of(f);
  return all;
}

EdgeGeometry geometry_of(const TwistModel& model, const TwistState& state, int edge) {
  EdgeGeometry g;
  g.tangent = state.x.col(model.edges[edge].to) - state.x.col(model.edges[edge].from);
  g.length = g.tangent.norm();
  g.tangent /= g.length;
  return g;
}

/// bending's value, without derivatives
double bend_value_of(const TwistBend& bend, const EdgeGeometry& e, const EdgeGeometry& f,
                     const TwistState& state, double twist) {
  if (bend.round) return bend_value(2 * bend.bend.stiffness[0], e, f);
  const HalfwayFrame mu =
      halfway_frame(e.tangent, state.director.col(bend.e), state.angle[bend.e] + twist / 2);
  return material_bend_value(bend.bend, mu.transpose() * curvature_binormal(e.tangent, f.tangent));
}

double shear_angle(const JointShear& shear, const EdgeGeometry& e, const EdgeGeometry& f) {
  return std::acos(std::clamp(e.tangent.dot(f.tangent), -1.0, 1.0)) - shear.rest;
}

double load_energy(const TwistModel& model, const TwistState& state) {
  return -state.load * (model.load.array() * state.x.array()).sum();
}

}  // namespace

Energies energies_of(const TwistModel& model, const TwistState& state) {
  Energies sum;
  std::vector<EdgeGeometry> geometry;
  for (int k = 0; k < int(model.edges.size()); ++k) {
    geometry.push_back(geometry_of(model, state, k));
    sum[Term::stretch] +=
        stretch(model.edges[k].EA, model.edges[k].rest_length, geometry[k].length).value;
  }
  for (int k = 0; k < int(model.bends.size()); ++k) {
    const TwistBend& bend = model.bends[k];
    const double excess = excess_twist(model, state, k);
    sum[Term::twist] += 0.5 * bend.GJ_l * excess * excess;
    sum[Term::bend] +=
        bend_value_of(bend, geometry[bend.e], geometry[bend.f], state, excess + bend.rest_twist);
  }
  for (const JointSpring& spring : model.springs)
    sum[Term::joint] +=
        0.5 * spring.stiffness * (state.x.col(spring.a) - state.x.col(spring.b)).squaredNorm();
  for (const JointShear& shear : model.shears) {
    const double angle = shear_angle(shear, geometry[shear.e], geometry[shear.f]);
    sum[Term::shear] += 0.5 * shear.stiffness * angle * angle;
  }
  for (const JointTwist& joint : model.twists) {
    const EdgeGeometry &e = geometry[joint.e], &f = geometry[joint.f];
    const double on_e = joint_spin(1, state.angle[joint.e], e, state.director.col(joint.e), f),
                 on_f = joint_spin(-1, state.angle[joint.f], f, state.director.col(joint.f), e);
    sum[Term::joint] += 0.5 * joint.stiffness * (on_e * on_e + on_f * on_f);
  }
  sum[Term::load] = load_energy(model, state);
  return sum;
}

TwistAssembly::TwistAssembly(const TwistModel& model) : model_(model) {
  std::vector<LinkUnknowns> links;
  std::vector<PairUnknowns> pairs;
  for (const TwistEdge& edge : model.edges) links.push_back(unknowns_of_link(edge.from, edge.to));
  for (const JointSpring& spring : model.springs)
    links.push_back(unknowns_of_link(spring.a, spring.b));
  for (const TwistBend& bend : model.bends)
    pairs.push_back(unknowns_of_pair(model, bend.e, bend.f));
  for (const JointShear& shear : model.shears)
    pairs.push_back(unknowns_of_pair(model, shear.e, shear.f));
  for (const JointTwist& joint : model.twists) {
    pairs.push_back(unknowns_of_pair(model, joint.e, joint.f));
    pairs.push_back(unknowns_of_pair(model, joint.f, joint.e));
  }

  // the pattern, its diagonal always there for shifts
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < model.dof(); ++k) entries.emplace_back(k, k, 0.0);
  const auto visit = [&](const auto& elements, const auto& take) {
    for (const auto& element : elements)
      for (int i : element)
        for (int j : element) take(model.index[i], model.index[j]);
  };
  const auto add = [&](int row, int column) {
    if (column >= 0 && row >= column) entries.emplace_back(row, column, 0.0);
  };
  visit(links, add);
  visit(pairs, add);
  hessian_.resize(model.dof(), model.dof());
  hessian_.setFromTriplets(entries.begin(), entries.end());
  hessian_.makeCompressed();
  const auto remember = [&](int row, int column) {
    int place = -1;
    if (column >= 0 && row >= column) {
      const int *first = hessian_.innerIndexPtr() + hessian_.outerIndexPtr()[column],
                *last = hessian_.innerIndexPtr() + hessian_.outerIndexPtr()[column + 1];
      place = int(std::lower_bound(first, last, row) - hessian_.innerIndexPtr());
    }
    places_.push_back(place);
  };
  visit(links, remember);
  visit(pairs, remember);
}

/// Adds an element's gradient and Hessian. Of the two entries (i, j), (j, i) the lower one counts;
/// unknowns that occur twice in an element add up on the diagonal.
template <int N>
void TwistAssembly::scatter(const int* unknowns, const Eigen::Matrix<double, N, 1>& gradient,
                            const Eigen::Matrix<double, N, N>& hessian, bool with_hessian) {
  for (int i = 0; i < N; ++i) gradient_[unknowns[i]] += gradient[i];
  if (!with_hessian) return;
  double* values = hessian_.valuePtr();
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j)
      if (const int place = places_[next_place_++]; place >= 0) values[place] += hessian(i, j);
}

void TwistAssembly::scatter_link(int from, int to, const Eigen::Vector3d& gradient,
                                 const Eigen::Matrix3d& hessian, bool with_hessian) {
  Eigen::Matrix<double, 6, 1> g;
  Eigen::Matrix<double, 6, 6> h;
  g << -gradient, gradient;
  h << hessian, -hessian, -hessian, hessian;
  scatter<6>(unknowns_of_link(from, to).data(), g, h, with_hessian);
}

void TwistAssembly::scatter_pair(int e, int f, const PairEnergy& energy, bool with_hessian) {
  // columns: both ends of e, both ends of f, the angles; rows: e, f, the angles
  static const Eigen::Matrix<double, 8, 14> ends = [] {
    Eigen::Matrix<double, 8, 14> m = Eigen::Matrix<double, 8, 14>::Zero();
    for (int c = 0; c < 3; ++c) {
      m(c, c) = m(3 + c, 6 + c) = -1;
      m(c, 3 + c) = m(3 + c, 9 + c) = 1;
    }
    m(6, 12) = m(7, 13) = 1;
    return m;
  }();
  const Eigen::Matrix<double, 14, 1> g = ends.transpose() * energy.gradient;
  Eigen::Matrix<double, 14, 14> h;
  if (with_hessian) h.noalias() = ends.transpose() * (energy.hessian * ends).eval();
  scatter<14>(unknowns_of_pair(model_, e, f).data(), g, h, with_hessian);
}

void TwistAssembly::add_links(const TwistState& state, bool with_hessian) {
  for (int k = 0; k < int(model_.edges.size()); ++k) {
    const TwistEdge& edge = model_.edges[k];
    const EdgeGeometry g = geometry_of(model_, state, k);
    const StretchEnergy s = stretch(edge.EA, edge.rest_length, g.length);
    energies_[Term::stretch] += s.value;
    const double geometric = s.force / g.length;
    Eigen::Matrix3d h =
        (edge.EA / edge.rest_length - geometric) * g.tangent * g.tangent.transpose();
    h.diagonal().array() += geometric;
    scatter_link(edge.from, edge.to, s.force * g.tangent, h, with_hessian);
  }
  for (const JointSpring& spring : model_.springs) {
    const Eigen::Vector3d gap = state.x.col(spring.b) - state.x.col(spring.a);
    energies_[Term::joint] += 0.5 * spring.stiffness * gap.squaredNorm();
    scatter_link(spring.a, spring.b, spring.stiffness * gap,
                 spring.stiffness * Eigen::Matrix3d::Identity(), with_hessian);
  }
}

void TwistAssembly::add_bends(const TwistState& state, bool with_hessian) {
  for (int k = 0; k < int(model_.bends.size()); ++k) {
    const TwistBend& bend = model_.bends[k];
    const EdgeGeometry e = geometry_of(model_, state, bend.e),
                       f = geometry_of(model_, state, bend.f);
    const double cosine = e.tangent.dot(f.tangent), excess = excess_twist(model_, state, k);
    if (!(cosine >= smallest_cosine_)) smallest_cosine_ = cosine;  // a nan is kept, not hidden
    const CurvatureBinormal binormal = binormal_with_derivatives(e.tangent, f.tangent);
    PairEnergy out;
    add_twist(bend.GJ_l, excess, binormal, out);
    energies_[Term::twist] += 0.5 * bend.GJ_l * excess * excess;
    if (!bend.round) {
      const double angle = state.angle[bend.e] + (excess + bend.rest_twist) / 2;
      energies_[Term::bend] += add_material_bend(
          bend.bend, halfway_frame(e.tangent, state.director.col(bend.e), angle), binormal, out);
    }
    scale_to_edges(e.length, f.length, out);
    if (bend.round) {
      const double stiffness = 2 * bend.bend.stiffness[0], w = 1 / (1 + cosine);
      energies_[Term::bend] += bend_value(stiffness, e, f);
      add_cosine(-2 * stiffness * w * w, 4 * stiffness * w * w * w, e, f, out);
    }
    scatter_pair(bend.e, bend.f, out, with_hessian);
  }
}

void TwistAssembly::add_shears(const TwistState& state, bool with_hessian) {
  for (const JointShear& shear : model_.shears) {
    const EdgeGeometry e = geometry_of(model_, state, shear.e),
                       f = geometry_of(model_, state, shear.f);
    const double angle = shear_angle(shear, e, f), c = e.tangent.dot(f.tangent);
    const double slope = 1 / std::sqrt(1 - c * c), k = shear.stiffness;
    energies_[Term::shear] += 0.5 * k * angle * angle;
    PairEnergy out;
    add_cosine(-k * angle * slope, k * slope * slope * (1 - angle * c * slope), e, f, out);
    scatter_pair(shear.e, shear.f, out, with_hessian);
  }
}

void TwistAssembly::add_joint_twists(const TwistState& state, bool with_hessian) {
  for (const JointTwist& joint : model_.twists) {
    const EdgeGeometry e = geometry_of(model_, state, joint.e),
                       f = geometry_of(model_, state, joint.f);
    const double k = joint.stiffness;
    PairEnergy on_e, on_f;
    energies_[Term::joint] +=
        add_joint_spin(k, 1, state.angle[joint.e], e, state.director.col(joint.e), f, on_e) +
        add_joint_spin(k, -1, state.angle[joint.f], f, state.director.col(joint.f), e, on_f);
    scatter_pair(joint.e, joint.f, on_e, with_hessian);
    scatter_pair(joint.f, joint.e, on_f, with_hessian);
  }
}

void TwistAssembly::assemble(const TwistState& state, bool with_hessian) {
  energies_ = {};
  gradient_.setZero(model_.unknowns());
  smallest_cosine_ = 1;
  next_place_ = 0;
  if (with_hessian) std::fill_n(hessian_.valuePtr(), hessian_.nonZeros(), 0.0);
  add_links(state, with_hessian);
  add_bends(state, with_hessian);
  add_shears(state, with_hessian);
  add_joint_twists(state, with_hessian);
  energies_[Term::load] = load_energy(model_, state);
  gradient_.head(3 * model_.nodes) -=
      state.load * Eigen::Map<const Eigen::VectorXd>(model_.load.data(), 3 * model_.nodes);
}

}  // namespace gridshell
