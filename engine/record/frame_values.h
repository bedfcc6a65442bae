// Text of a value with its error, and values of a frame along its rods: curvature and axial force
// at a rod's points, axial force and bending energy at the nodes. Used by exports, pictures and the
// window.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/record/trajectory.h"

namespace gridshell::record {

/// A value with its unit, in the digits that its error allows: "0.1234 ± 0.0007 N"; four digits if
/// the error is not known. From 10 J, 1 kJ and 10 kN on in these units.
std::string with_error(double value, double error, const char* unit);

/// Curvature at the node between two edges, |kb|/l, from their unit tangents and their mean length.
double curvature_between(const Eigen::Vector3d& te, const Eigen::Vector3d& tf, double length);

/// Curvature at each of a rod's points, 1/mm: |2 t x t'| / (1 + t.t') over the mean of the two
/// edges' lengths, t and t' their unit tangents [Bergou 2008, eq. 1]; 0 at the ends.
std::vector<double> curvature_per_mm(const Eigen::Matrix3Xd& points);

/// Curvature of a rod as its run recorded it; if it did not, from the rod's points.
std::vector<double> curvature_per_mm(const Layout& layout, const Frame& frame, std::size_t rod);

/// Axial force at each of a rod's points, N: the mean of the edges that meet there, below 0 where
/// they are compressed; NaN where the run did not record it.
std::vector<double> axial_force_N(const Layout& layout, const Frame& frame, std::size_t rod);

/// Axial force at each node of the frame, N: the mean of all edges that meet there, of both rods
/// at a joint; 0 at a node of no rod. Empty where the run did not record it.
Eigen::VectorXd axial_force_of_nodes_N(const Layout& layout, const Frame& frame);

/// Largest stress of a fibre at each point of a rod, MPa; NaN where the frame does not know it.
std::vector<double> stress_MPa(const Layout& layout, const Frame& frame, std::size_t rod);
/// The largest of the rods at each node, or, `utilised`, that over the rod's strength; empty where
/// it is not known.
Eigen::VectorXd stress_of_nodes_MPa(const Layout& layout, const Frame& frame,
                                    bool utilised = false);

/// Bending energy over length at each node of the frame, mJ/m: the mean of the rods that go through
/// it, else of those that end there. Empty where the run did not record it.
Eigen::VectorXd bending_of_nodes_mJ_per_m(const Layout& layout, const Frame& frame);

/// Angle between the two rods of joints with laws or springs, degrees, at each node of the frame:
/// along a rod linear in the points from joint to joint, constant past the last; NaN on rods
/// without such a joint. Empty if no joint has an angle.
Eigen::VectorXd joint_angle_of_nodes_deg(const Layout& layout, const Frame& frame);

// How far a frame lies from the net it was designed on, as its run recorded both.

/// Whether a run has a net to lie off.
inline bool has_net(const Layout& layout) { return layout.net_nodes.cols() > 0; }

/// Distance of each node from its position on the net over rho, the layout's length scale; empty
/// without a net.
Eigen::VectorXd deviation_of_nodes(const Layout& layout, const Frame& frame);

/// Deviation of each cell: the mean of its four joints.
Eigen::VectorXd deviation_of_cells(const Layout& layout, const Frame& frame);

}  // namespace gridshell::record
