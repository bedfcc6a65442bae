// Rods that touch: a smooth barrier of the distance of two edges [Li 2020, IPC; of thick rods:
// Li 2021, codimensional IPC].
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

namespace gridshell {

struct Model;
struct RodMesh;

/// The energy of two rods whose axes have a distance d below S + gap, S the sum of their radii:
///     E = k gap^2 b(x),   x = (d^2 - S^2) / ((S + gap)^2 - S^2),   b(x) = -(x - 1)^2 ln x.
/// It is zero with two derivatives at x = 1. Halfway through a gap that is thin compared with S the
/// force is 1.2 k gap, for other gaps larger. Below x = 0.05, where the force is 24 k gap, b
/// continues as its parabola: states of a coarser mesh that overlap a little on a finer one still
/// have an energy and are separated by it. Only clear_fraction() keeps rods from passing through
/// one another.
struct ContactBarrier {
  double gap_mm = 0;              ///< 0: none
  double stiffness_N_per_mm = 0;  ///< k

  bool acts() const { return gap_mm > 0; }
  /// E and its first two derivatives by d^2.
  struct Value {
    double energy = 0, slope = 0, curvature = 0;
  };
  /// The value at distance^2 for rods with the sum of radii `radii`; radii and gap are multiplied
  /// by `thinness`.
  Value at(double distance2, double radii, double thinness = 1) const;
};

/// Contact of the rods of a footprint: barrier and sizes.
struct ContactLaw {
  ContactBarrier barrier;
  std::vector<double> radius_mm;  ///< one per rod
  double joint_mm = 0;            ///< diameter of the joints' cylinders
};

/// An edge that may touch others.
struct ContactEdge {
  /// An end of its segment: node, position along the rod, and least distance from the edge, mm.
  struct End {
    int node = 0;
    double at = 0, near = 0;
  };
  int edge = 0;  ///< index in the model
  int rod = 0;
  double begin = 0, end = 0;  ///< natural arc length along the rod, mm
  std::array<End, 2> ends = {};
};

/// Edges that may touch, and their contact barrier. Since rods meet at their joints, radii and gap
/// of two edges on segments with a common joint are reduced near it: by the ratio of the distance
/// of the farther edge from the joint, along its rod, to L, the larger of `joint_mm` and four times
/// S + gap. So rods do not repel each other at their joint, unless the angle between straight rods
/// is below (S + gap)/L (joints' cylinders of this diameter touch before), while contacts that
/// detection reports are resisted. Edges of one rod within pi (S + gap) along it do not touch.
struct ContactPairs {
  ContactBarrier barrier;
  std::vector<ContactEdge> edges;
  std::vector<double> radius_mm;         ///< one per rod
  std::vector<double> closed_length_mm;  ///< one per rod: length of a ring, else 0
  double joint_mm = 0;                   ///< diameter of the joints' cylinders

  bool any() const { return !edges.empty(); }
  double radii(const ContactEdge& a, const ContactEdge& b) const {
    return radius_mm[std::size_t(a.rod)] + radius_mm[std::size_t(b.rod)];
  }
  /// Factor on radii and gap of two edges: 1 far from a common joint, 0 for edges that cannot
  /// touch.
  double thinness(const ContactEdge& a, const ContactEdge& b) const;
};

/// The edges of `model`, built on a meshed footprint, that may touch. Ends of rods at one position
/// in the flat, to within their radii, count as one joint.
ContactPairs contact_pairs(const RodMesh& mesh, const Model& model, const ContactLaw& law);

/// The energy between two edges with its derivatives by their four ends: of e, then of f.
struct EdgeContact {
  std::array<int, 4> node{};
  int e = 0, f = 0;
  double energy = 0;
  bool overlap = false;  ///< nearer than the radii
  Eigen::Matrix<double, 12, 1> gradient;
  Eigen::Matrix<double, 12, 12> hessian;
};

/// Calls `visit` for every two edges with a contact energy; with derivatives also for those within
/// two gaps, whose blocks are zero, so that the pattern of the Hessian seldom changes. The squared
/// distance of two edges is the least, over s and t in [0, 1], of
///     |p(s) - q(t)|^2 + m_e (s - 1/2)^2 + m_f (t - 1/2)^2 - (m_e + m_f)/4.
/// m is a twentieth of the gap's range of d^2. It matters only for edges that are parallel within a
/// degree, whose nearest points would else jump from end to end: the derivative of the energy is
/// continuous everywhere. The value is never above the squared distance. Edges shorter than the
/// range S + gap count by their length over it, so that a contact does not become stiffer with
/// finer meshes. A node has the contacts of both its edges. Near pairs are found by a sweep over
/// boxes.
void each_contact(const Model& model, const Eigen::Matrix3Xd& x, bool with_derivatives,
                  const std::function<void(const EdgeContact&)>& visit);

/// The fraction of the straight move dx before the axes of two edges come nearer than half the sum
/// of their radii; 1 if none do. Axes that are nearer already may halve their distance, down to a
/// quarter of the radii: so edges never pass through one another, in any number of moves. Computed
/// by conservative steps, none longer than the remaining distance [Li 2021, ACCD].
double clear_fraction(const Model& model, const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& dx);

}  // namespace gridshell
