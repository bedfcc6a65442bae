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
/// zero with two derivatives at x = 1. Half way through the gap they press with 1.2 k gap. Below
/// x = 0.05, where that is 24 k gap, b goes on as its parabola: so states of a coarser mesh that
/// overlap a little on a finer one still have an energy and are pressed apart, and what keeps rods
/// from going through one another is clear_share().
struct ContactBarrier {
  double gap_mm = 0;              ///< 0: none
  double stiffness_N_per_mm = 0;  ///< k

  /// E and its first two derivatives by d^2.
  struct Value {
    double energy = 0, slope = 0, curvature = 0;
  };
  Value at(double distance2, double radii) const;
};

/// An edge that may touch others.
struct ContactEdge {
  /// An end of its segment: its place along the rod, and how far the edge reaches from there, mm.
  struct End {
    int node = 0;
    double at = 0, reach = 0;
  };
  int edge = 0;  ///< of the model
  int rod = 0;
  double begin = 0, end = 0;     ///< along the rod at rest, mm
  std::array<End, 2> ends = {};  ///< of its segment
  double half = 0;               ///< of its segment's length, mm
  std::array<int, 2> nodes{};    ///< of the mesh: spring joints have one place, and two nodes
};

/// Edges that may touch, and how they are kept apart. Not of one another (`may_touch`):
/// edges that share a node; of two segments that meet at a joint, edges that lie wholly in the
/// halves next to it, half the shorter segment counting (straight rods part from one another there,
/// and what detection tells beyond, a cell that closes, is resisted); edges of one rod that are
/// within pi (S + gap) along it.
struct ContactPairs {
  ContactBarrier barrier;
  std::vector<ContactEdge> edges;
  std::vector<double> radius_mm;         ///< of each rod
  std::vector<double> closed_length_mm;  ///< of each rod that is a ring, else 0

  bool any() const { return !edges.empty(); }
  double radii(const ContactEdge& a, const ContactEdge& b) const {
    return radius_mm[std::size_t(a.rod)] + radius_mm[std::size_t(b.rod)];
  }
  bool may_touch(const ContactEdge& a, const ContactEdge& b) const;
};

/// The edges of a meshed footprint that may touch, of a model built on it. Ends of rods that lie at
/// one place in the flat, to within their radii, count as one joint.
ContactPairs contact_pairs(const RodMesh& mesh, const Model& model, const ContactBarrier& barrier,
                           const std::vector<double>& radius_mm);

/// The energy between two edges with its derivatives by their four ends: of e, then of f.
struct EdgeContact {
  std::array<int, 4> node{};
  int e = 0, f = 0;
  double energy = 0;
  Eigen::Matrix<double, 12, 1> gradient;
  Eigen::Matrix<double, 12, 12> hessian;
};

/// The squared distance of two edges is the least over s and t in [0, 1] of
///     |p(s) - q(t)|^2 + m_e (s - 1/2)^2 + m_f (t - 1/2)^2 - (m_e + m_f)/4,
/// m so small (a twentieth of the gap's range of d^2) that it is the distance but where edges are
/// parallel within a degree: there the nearest points would leap from end to end, and with it they
/// move smoothly, so that the energy has a continuous slope everywhere. It never is above the
/// distance. Where edges are shorter than the range S + gap they count by that share each, so that
/// a contact does not grow stiffer with the mesh. A node's contact is that of both its edges.
/// Calls for every two edges with an energy; with derivatives also for those within two gaps, whose
/// blocks are zero: so the pattern of the Hessian seldom changes. Time: a sweep of their boxes.
void each_contact(const Model& model, const Eigen::Matrix3Xd& x, bool with_derivatives,
                  const std::function<void(const EdgeContact&)>& visit);

/// The share of a straight move that goes ahead before the axes of two edges are within half their
/// radii (half their distance, where they are within already), 1 where none are: edges never go
/// through one another. By conservative steps, none longer than the distance left [Li 2021, ACCD].
double clear_share(const Model& model, const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& dx);

}  // namespace gridshell
