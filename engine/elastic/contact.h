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

/// Two rods whose axes are d apart, S the sum of their radii, store from d = S + gap on
///     E = k gap^2 b(x),   x = (d^2 - S^2) / ((S + gap)^2 - S^2),   b(x) = -(x - 1)^2 ln x,
/// zero with two derivatives at x = 1. Halfway through a gap that is thin compared with S they
/// press with 1.2 k gap, more through others. Below x = 0.05, where that is 24 k gap, b continues
/// as its parabola: so states of a coarser mesh that overlap a little on a finer one still have an
/// energy and are pressed apart, and what keeps rods from going through one another is
/// clear_fraction().
struct ContactBarrier {
  double gap_mm = 0;              ///< 0: none
  double stiffness_N_per_mm = 0;  ///< k

  bool acts() const { return gap_mm > 0; }
  /// E and its first two derivatives by d^2.
  struct Value {
    double energy = 0, slope = 0, curvature = 0;
  };
  /// `thinness` times as thick rods, with such a gap.
  Value at(double distance2, double radii, double thinness = 1) const;
};

/// How far the rods of a footprint are kept apart.
struct ContactLaw {
  ContactBarrier barrier;
  std::vector<double> radius_mm;  ///< one per rod
  double joint_mm = 0;            ///< diameter of the joints' cylinders
};

/// An edge that may touch others.
struct ContactEdge {
  /// An end of its segment: its position along the rod, and the least distance of the edge, mm.
  struct End {
    int node = 0;
    double at = 0, near = 0;
  };
  int edge = 0;  ///< of the model
  int rod = 0;
  double begin = 0, end = 0;  ///< natural arc length along the rod, mm
  std::array<End, 2> ends = {};
};

/// Edges that may touch, and how they are kept apart. Rods meet at their joints: two edges on
/// segments with a common joint are as much thinner, in radii and gap, as the farther of them is
/// nearer to it, along the rods, than `joint_mm` or four times S + gap. So what is nothing but the
/// joint does not press (straight rods do where the angle between them is below (S + gap) over that
/// length; joints' cylinders of this diameter meet before), and the contacts that detection reports
/// are resisted. Edges of one rod within pi (S + gap) along it do not touch.
struct ContactPairs {
  ContactBarrier barrier;
  std::vector<ContactEdge> edges;
  std::vector<double> radius_mm;         ///< of each rod
  std::vector<double> closed_length_mm;  ///< of each rod that is a ring, else 0
  double joint_mm = 0;                   ///< diameter of the joints' cylinders

  bool any() const { return !edges.empty(); }
  double radii(const ContactEdge& a, const ContactEdge& b) const {
    return radius_mm[std::size_t(a.rod)] + radius_mm[std::size_t(b.rod)];
  }
  /// 1 of edges far apart along their rods, 0 of those that do not touch.
  double thinness(const ContactEdge& a, const ContactEdge& b) const;
};

/// The edges of a meshed footprint that may touch, of a model built on it. Ends of rods that have
/// one position in the flat, to within their radii, count as one joint.
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

/// The squared distance of two edges is the least over s and t in [0, 1] of
///     |p(s) - q(t)|^2 + m_e (s - 1/2)^2 + m_f (t - 1/2)^2 - (m_e + m_f)/4,
/// m so small (a twentieth of the gap's range of d^2) that it is the distance but where edges are
/// parallel within a degree: there the nearest points would jump from end to end, and with it they
/// move smoothly, so that the energy has a continuous slope everywhere. It never is above the
/// distance. Where edges are shorter than the range S + gap they count by that fraction each, so
/// that a contact does not grow stiffer with the mesh. A node's contact is that of both its edges.
/// Calls for every two edges with an energy; with derivatives also for those within two gaps, whose
/// blocks are zero: so the pattern of the Hessian seldom changes. Time: a sweep of their boxes.
void each_contact(const Model& model, const Eigen::Matrix3Xd& x, bool with_derivatives,
                  const std::function<void(const EdgeContact&)>& visit);

/// The fraction of a straight move that goes ahead before the axes of two edges are within half
/// their radii (where they are within already half their distance, at most to a quarter of their
/// radii), 1 where none are: edges never go through one another, in however many moves. By
/// conservative steps, none longer than the distance left [Li 2021, ACCD].
double clear_fraction(const Model& model, const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& dx);

}  // namespace gridshell
