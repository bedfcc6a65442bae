// The search for contacts in one shape of a layout (contacts.h has the definitions).
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/proximity.h"
#include "engine/record/contacts.h"

namespace gridshell::record {

/// Finds the contacts in one shape. Indices of points are those of ContactSearch::points_.
class ShapeContacts {
 public:
  ShapeContacts(const ContactSearch& search, const Eigen::Matrix3Xd& nodes);
  Contacts found(bool by_all_pairs);

 private:
  using Vector3d = Eigen::Vector3d;
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr int no_tree = std::numeric_limits<int>::min();
  using Box = Eigen::AlignedBox3d;
  using Segment = ContactSearch::Segment;
  /// A common joint of two segments, at position at_a along one rod and at_b along the other. Two
  /// points that are both at most `within` away from it along their rods are not compared.
  struct Joint {
    double at_a = 0, at_b = 0, within = 0;
  };
  /// A segment's chord, from its start to its end, and the largest angle of an edge with it.
  struct Chord {
    Vector3d along{0, 0, 0};  ///< unit vector
    double cosine = 1, sine = 0;
    int node[2] = {-1, -1};  ///< nodes at its start and end
  };
  /// The search for the smallest gap between two segments.
  struct Search {
    int a = 0, b = 0;         ///< the segments
    double radii = 0;         ///< sum of the two radii
    double gap = 0;           ///< smallest gap so far; larger gaps are ignored
    double apart = 0;         ///< least distance along the rod of compared points of one rod
    double round = infinity;  ///< length of the rod if it is a ring
    int joints = 0;           ///< number of common joints
    Joint joint[2];
    Contact found;
    bool any = false;  ///< whether a gap was found

    /// Whether points at these positions along their rods are compared.
    bool reported(double at_a, double at_b) const {
      const double distance = std::abs(at_b - at_a);
      if (std::min(distance, round - distance) < apart) return false;
      for (int k = 0; k < joints; ++k)
        if (std::abs(at_a - joint[k].at_a) <= joint[k].within &&
            std::abs(at_b - joint[k].at_b) <= joint[k].within)
          return false;
      return true;
    }
  };

  /// Node of a point; all rods of a joint have the same.
  int node(int point) const { return of_.joint_nodes_[point]; }
  const Segment& segment(int k) const { return of_.segments_[k]; }
  double length(const Segment& s) const { return along_[s.end] - along_[s.begin]; }
  /// Box of edges begin to end - 1 of a segment with a tree.
  const Box& box_of(int k, int begin, int end) const {
    return end - begin == 1 ? edge_[begin + tree_at_[k]] : tree_[(begin + end) / 2 + tree_at_[k]];
  }
  void lay_out(std::size_t k);
  Vector3d normal_of(const ContactSearch::Axis& at) const;
  void lay_sections(const Segment& s);
  bool side_by_side(int a, int b) const;
  double half_width(int rod) const;
  double gap_of_laths(const Search& search, int edge_a, int edge_b,
                      const NearestPoints& near) const;
  void grow_tree(int k);
  Box grown(int k, int begin, int end);
  bool apart(int a, int b) const;
  bool apart_but_at_joint(int a, int b) const;
  Search between(int a, int b) const;
  void add_joint(Search& search, int point_a, int point_b) const;
  void look(Search& search, int begin_a, int end_a, int begin_b, int end_b) const;
  void look_within(Search& search, int begin, int end) const;
  void look_at_edges(Search& search, int edge_a, int edge_b) const;
  void take(const Search& search);
  void rods(bool by_all_pairs);
  void joints(bool by_all_pairs);
  void table();

  const ContactSearch& of_;
  std::vector<Vector3d> x_;              // position of each point
  std::vector<double> along_;            // position of each point along its rod
  std::vector<Vector3d> normal_, side_;  // axes of the section of each edge, if there are laths
  std::vector<Box> edge_;                // boxes of the edges of segments with a tree
  std::vector<Box> tree_;     // boxes of edges begin to end - 1, stored at the middle point
  std::vector<int> tree_at_;  // offset of a segment's points in edge_ and tree_; or no_tree
  std::vector<Box> box_;      // box of each segment
  std::vector<Chord> chord_;
  const Eigen::Matrix3Xd& nodes_;
  Contacts all_;
};

}  // namespace gridshell::record
