// Text of a value with its error, and values of a frame along its rods: curvature and axial force
// at a rod's points, axial force and bending energy at the nodes. Used by exports, pictures and the
// window.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "engine/record/trajectory.h"

namespace gridshell::record {

/// A value with its unit, in the digits that its error allows: "0.1234 ± 0.0007 N"; four digits if
/// the error is not known. From 10 J, 1 kJ and 10 kN on in these units.
std::string with_error(double value, double error, const char* unit);

/// Curvature at the node between two edges with unit tangents te and tf and mean length l, 1/mm:
/// |kb|/l with kb = 2 te x tf / (1 + te.tf) [Bergou 2008, eq. 1].
double curvature_between(const Eigen::Vector3d& te, const Eigen::Vector3d& tf, double length);

/// curvature_between() at each of a rod's points (3 x n, mm), 1/mm; 0 at the ends.
std::vector<double> curvature_per_mm(const Eigen::Matrix3Xd& points);

/// Curvature at each point of rod `rod` as the run recorded it, 1/mm; if it did not, computed from
/// the rod's points.
std::vector<double> curvature_per_mm(const Layout& layout, const Frame& frame, std::size_t rod);

/// Axial force at each of a rod's points, N: the mean of the edges that meet there, below 0 where
/// they are compressed; NaN if the run did not record it.
std::vector<double> axial_force_N(const Layout& layout, const Frame& frame, std::size_t rod);

/// Axial force at each node of the frame, N: the mean of all edges that meet there, of both rods
/// at a joint; 0 at a node of no rod. Empty if the run did not record it.
Eigen::VectorXd axial_force_of_nodes_N(const Layout& layout, const Frame& frame);

/// Largest stress of a fibre at each point of a rod, MPa; NaN if the run did not record it.
std::vector<double> stress_MPa(const Layout& layout, const Frame& frame, std::size_t rod);
/// Largest stress of all rods at each node of the frame, MPa; if `utilised`, the stress over the
/// rod's strength instead. Empty if the run did not record it, or if no strength is known.
Eigen::VectorXd stress_of_nodes_MPa(const Layout& layout, const Frame& frame,
                                    bool utilised = false);

/// Bending energy over length at each node of the frame, mJ/m: the mean of the rods that pass
/// through it, or else of those that end there. Empty if the run did not record it.
Eigen::VectorXd bending_of_nodes_mJ_per_m(const Layout& layout, const Frame& frame);

/// Angle between the two rods of joints with laws or springs, degrees, at each node of the frame:
/// along a rod linear in the points from joint to joint, constant past the last; NaN on rods
/// without such a joint. Empty if no joint has an angle.
Eigen::VectorXd joint_angle_of_nodes_deg(const Layout& layout, const Frame& frame);

/// The nodes at both ends of every brace in this frame.
std::vector<std::array<int, 2>> braces_of(const Layout& layout, const Frame& frame);

// Deviation of a frame from the Chebyshev net that it was designed on.

/// Whether the shell was designed on a net.
inline bool has_net(const Layout& layout) { return layout.net_nodes.cols() > 0; }

/// Distance of each node from its position on the net over rho, the layout's length scale; empty
/// without a net.
Eigen::VectorXd deviation_of_nodes(const Layout& layout, const Frame& frame);

/// The mean of the values of the four joints of each cell; values are by node.
Eigen::VectorXd mean_of_cells(const Layout& layout, const Eigen::VectorXd& of_nodes);

/// Deviation of each cell: the mean of its four joints.
Eigen::VectorXd deviation_of_cells(const Layout& layout, const Frame& frame);

}  // namespace gridshell::record
