// The energies of a model's elements, each with gradient and Hessian: external actions on nodes,
// springs and bars between nodes, bending and torsion of rods, the laws of joints.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "engine/core/energies.h"

namespace gridshell {

/// An external action on a node at x:
///   E = -f . x + 1/2 sum over the axes of k (x - a)^2 - p/6 x . (y x z).
/// The terms are a force, springs to fixed points (the ground), and a pressure p on the triangle of
/// x and the two `corners`, at y and z: p times the volume between the triangle and the
/// origin, so that the force stays normal to the triangle. For a pressure along a plane curve, z is
/// the anchor (three times the plane's normal) and p a force per length.
struct NodeAction {
  int node = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();      ///< f, N
  Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();  ///< k, N/mm
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();     ///< a, mm
  Term term = Term::load;
  double pressure = 0;                 ///< p, N/mm^2
  std::array<int, 2> corners{-1, -1};  ///< nodes at y and z; the second -1: z is the anchor

  NodeAction& operator*=(double factor);
  bool is_none() const { return force.isZero(0) && stiffness.isZero(0) && pressure == 0; }
  double value(const Eigen::Matrix3Xd& x) const;
  void add_gradient(double factor, const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& gradient) const;
  Eigen::Vector3d apex(const Eigen::Matrix3Xd& x) const {  ///< z, mm
    return corners[1] < 0 ? anchor : Eigen::Vector3d(x.col(corners[1]));
  }
};

// Two nodes connected by a spring: crossing rods, each with a node of its own at the joint, or
// a support and the rod's end or joint that is connected to it.

/// A spring of natural length zero between nodes a and b: E = 1/2 sum over x, y, z of k (x_b -
/// x_a)^2.
struct NodeSpring {
  int a = 0, b = 0;
  Eigen::Vector3d stiffness{0, 0, 0};  ///< k along x, y, z, N/mm
  Term term = Term::joint;

  double value(const Eigen::Vector3d& gap) const;
  Eigen::Vector3d gradient(const Eigen::Vector3d& gap) const;
};

/// A straight bar between nodes a and b: E = EA l F(e) with the strain e = |x_b - x_a|/l - 1.
/// - Strut: F' = e.
/// - Cable, without compression: F' = 0 for e < 0, e^2/(2w) for e < w, e - w/2 above. The small
///   strain w makes the stiffness continuous.
struct NodeBar {
  int a = 0, b = 0;
  double rest_length = 0;  ///< l, mm
  double EA = 0;           ///< N
  bool cable = false;
  static constexpr double taking_up = 1e-5;  ///< w, strain over which a cable becomes taut

  double strain(double length) const { return length / rest_length - 1; }
  double value(double strain) const;
  double force(double strain) const;      ///< N
  double stiffness(double strain) const;  ///< change of the force with the strain, N
};

// All energies of two edges e and f have eight local unknowns, and use the curvature binormal and
// its derivatives.

/// Direction and length of an edge.
struct EdgeGeometry {
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();  ///< unit
  double length = 0;                                   ///< current length, mm
};

/// The part of a state that an energy of two edges e, f depends on.
struct PairGeometry {
  EdgeGeometry e, f;
  double angle_e = 0, angle_f = 0;         ///< theta of each edge, rad
  Eigen::Vector3d director_e, director_f;  ///< first directors of their reference frames
  double reference_twist = 0;              ///< m_ref from e to f, if they are consecutive
  double opening = 0;  ///< factor of the joint actuation, times JointAngle::opening

  /// tau = theta_f - theta_e + m_ref
  double twist() const { return angle_f - angle_e + reference_twist; }
};

using PairVector = Eigen::Matrix<double, 8, 1>;
using PairMatrix = Eigen::Matrix<double, 8, 8>;

/// Gradient and Hessian of an energy of two edges by (e, f, theta_e, theta_f): the two edge vectors
/// and the two angles. The reference frames are transported in parallel with the edges (parallel in
/// time). Their change is part of the derivatives, so the Hessian is symmetric and exact.
struct PairEnergy {
  PairVector gradient = PairVector::Zero();
  PairMatrix hessian = PairMatrix::Zero();
  bool with_hessian = true;  ///< else the Hessian is not computed

  PairEnergy& operator+=(const PairEnergy& other);
};

/// [v]x, with [v]x w = v x w.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

/// (a b^T + b a^T)/2
Eigen::Matrix3d symmetric_product(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// I - t t^T of a unit tangent.
Eigen::Matrix3d normal_projector(const Eigen::Vector3d& t);

/// kb = 2 t x s/chi, chi = 1 + t.s of unit tangents t (of e) and s (of f).
struct CurvatureBinormal {
  Eigen::Vector3d t, s, kb;
  double chi = 2;
};

/// The curvature binormal and its derivatives by the increments p = de/|e|, q = df/|f|:
/// by_p = -(2 [s]x + kb s^T) (I - t t^T)/chi, by_q = (2 [t]x - kb t^T) (I - s s^T)/chi.
struct BinormalSlopes : CurvatureBinormal {
  Eigen::Matrix3d P, Q;  ///< I - t t^T, I - s s^T
  Eigen::Matrix3d by_p, by_q;
};

CurvatureBinormal curvature_binormal(const Eigen::Vector3d& t, const Eigen::Vector3d& s);

BinormalSlopes binormal_with_slopes(const Eigen::Vector3d& t, const Eigen::Vector3d& s);

/// Converts derivatives by the increments p = de/|e|, q = df/|f| to derivatives by e and f.
void scale_to_edges(double length_e, double length_f, PairEnergy& out);

/// Adds an energy E(c) of the cosine c = t . s between the edges, given E' and E'', to `out` by
/// edge vectors (so after scale_to_edges()). Used for the bending of round rods and the shear of
/// joints.
void add_cosine(double by_c, double by_cc, const EdgeGeometry& e, const EdgeGeometry& f,
                PairEnergy& out);

// Twisting of a rod at a node between two edges [Bergou 2008, 2010].

/// Adds gradient and Hessian, in increments, of E = stiffness/2 (tau - tau_0)^2; `stiffness`: GJ/l
/// (mJ), `excess`: tau - tau_0.
void add_twist(double stiffness, double excess, const CurvatureBinormal& b, PairEnergy& out);

/// Torsion between two consecutive edges of a rod.
struct Torsion {
  static constexpr Term term = Term::twist;
  double stiffness = 0;  ///< GJ/l, mJ
  double rest = 0;       ///< tau_0, rad

  double excess(const PairGeometry& at) const { return at.twist() - rest; }
  double value(const PairGeometry& at) const { return 0.5 * stiffness * excess(at) * excess(at); }
  double add(const PairGeometry& at, PairEnergy& out) const;
};

// Bending of a rod with principal axes and a natural curvature, at a node between two edges.

/// E = 1/2 (w - w_0)^T diag(EI1, EI2)/l (w - w_0). w are the components of the curvature binormal
/// in the material frame in the middle between those of e and f, e's frame turned by half the
/// twist:
///   w_1 + i w_2 = kb.(m1 + i m2)_e exp(-i tau/2).
/// [Bergou 2008] averages the energies of both frames, [Bergou 2010] the frames. With the middle
/// frame the energy of a round rod does not depend on its twist, and a rod with natural curvature
/// and twist is a helix without energy. At an end that prescribes its direction w is multiplied by
/// s (EndBending). Its frame is that of the ghost if the end prescribes the spin, else that of the
/// edge next to it.
struct MaterialBend {
  Eigen::Vector2d stiffness;  ///< EI1/l, EI2/l (mJ)
  Eigen::Vector2d rest;       ///< w_0 = l * natural curvature
  double fraction = 0.5;      ///< of the twist by which e's frame is turned; at an end 0 or 1
  double axis = 0;            ///< from m1 to the first axis of w, about the rod, rad
  double corner = 1;          ///< cos of half the angle by which a rod cut with a corner turns

  bool at_end() const { return fraction == 0 || fraction == 1; }
  /// l times the change of curvature that w - w_0 represents, about m1 and m2.
  Eigen::Vector2d bent(const Eigen::Vector2d& excess) const;
};

/// Bending and torsion at the natural corner of a rod, between two edges that are straight without
/// load and meet at an angle 2h. Half of each edge bends and twists about its own axes; the
/// compliance of the node is that of both halves in series. With the corner's axis n, u = (t + s)/
/// |t + s| and v = n x u, rotations psi of f from the unloaded shape change the measures by
///   w_1' = psi_n/cos^2 h, w_2' = -psi_v/cos h, tau' = psi_u/cos h,
/// since w_1 = 2 tan h. (The stiffness EI/l of a straight rod would be too large by 1/cos^4 h in
/// the corner's plane.) The compliances, to first order in psi and hence in the edge length:
///   psi_n:           l/EI_n;
///   psi_v:           sum over both halves of l_k/2 (cos^2 h/EI_m + sin^2 h/GJ);
///   psi_u:           the same with cos and sin exchanged;
///   psi_u and psi_v: (l_e - l_f)/2 sin h cos h (1/EI_m - 1/GJ), which changes `fraction`.
/// EI_n and EI_m are the stiffnesses about n and perpendicular to it. Their coupling is neglected
/// for a section with two stiffnesses whose axes are not along n.
struct CornerLaw {
  MaterialBend bend;
  double torsion = 0;  ///< mJ

  /// `turn`: the natural curvature binormal about m1 and m2; EI about them.
  CornerLaw(const Eigen::Vector2d& EI, double GJ, double length_e, double length_f,
            const Eigen::Vector2d& turn);
};

/// mu: its columns are m1 and m2 of e turned by half the twist.
using HalfwayFrame = Eigen::Matrix<double, 3, 2>;

/// The middle frame: e's reference director turned by its angle + fraction * tau about e's tangent.
HalfwayFrame halfway_frame(const Eigen::Vector3d& tangent, const Eigen::Vector3d& director,
                           double angle);

/// Adds gradient and Hessian in increments; returns the value. With phi' = theta_e' + fraction
/// tau',
///   w'  = mu.kb' - i phi' w,
///   w'' = mu.kb'' + (mu.p)(kb.p) - 2i phi' mu.kb' - i phi'' w - phi'^2 w.
double add_material_bend(const MaterialBend& bend, const HalfwayFrame& mu, const BinormalSlopes& b,
                         PairEnergy& out);

/// Bending of a section with two stiffnesses, or of a rod with natural curvature, between two
/// consecutive edges.
struct SectionBending {
  static constexpr Term term = Term::bend;
  MaterialBend bend;

  /// w - w_0
  Eigen::Vector2d excess(const PairGeometry& at) const;
  double value(const PairGeometry& at) const;
  double add(const PairGeometry& at, PairEnergy& out) const;
};

/// Bending of a round rod between the direction that its end prescribes (a ghost edge) and its
/// first edge, over half the edge, l = |e|/2. It is half the energy of the edge and its mirror
/// image past the end, between which the angle is 2 phi: (EI/2l) tan^2 phi. Its error has even
/// powers of the edge length, as inside a rod. The law used agrees with it up to phi^6 and has no
/// pole at 90 degrees:
///   E = k (1 - c)/(1 + c) s^2 = (EI/2l) |s kb|^2, s = (3 + c^2)/(1 + c)^2, k = 2EI/l, c = cos phi.
struct EndBending {
  static constexpr Term term = Term::bend;
  double stiffness = 0;  ///< k, mJ

  double value(const PairGeometry& at) const;
  double add(const PairGeometry& at, PairEnergy& out) const;
};

// The laws of a joint, shear and spin. They act on the edges that are centred on the joint.

/// Shear: the resistance to a change of the angle between two rods,
/// E = k/2 (angle - `rest` - factor `opening`)^2. In the mixed form its torque, k times the
/// expression in brackets, is an unknown of its own, as the axial force of an edge is.
struct JointAngle {
  static constexpr Term term = Term::shear;
  double stiffness = 0;  ///< k, N mm/rad
  double rest = M_PI / 2;
  double opening = 0;  ///< complete actuation angle of the joint, rad
  int joint = 0;
  /// Sign of the angle, by the joint's normal (the first edge's director): +1 if t_e x t_f along
  /// the normal is a positive angle, -1 if it is negative. An angle that closes continues below
  /// zero. 0: there is no normal, the angle is between 0 and pi.
  int side = 0;
  /// Weight w in the mean of several joints' angles, which stores K/2 (sum of w times the excess)^2
  /// instead of their own energies (Model::mean_stiffness); 0: the joint is by itself.
  double weight = 0;

  double excess(const PairGeometry& at) const;
  /// First and second derivatives of the angle by the edge vectors.
  PairEnergy slopes(const PairGeometry& at, bool with_hessian) const;

 private:
  double sign(const PairGeometry& at) const;
};

// The spin of a rod at a joint that transmits twist: the angle between its director and the joint's
// normal.

/// Energy of the spin phi of the first edge of a pair: E = k/2 (phi - natural)^2. Its derivatives
/// follow from those of alpha = Im log(s.d), with the complex director d = d1 + i d2, which is
/// carried in time by d(t') = d - (d.t')/(1 + t.t') (t + t'), and z = d/(s.d):
///   (s.d)'/(s.d)  = z.Qq - c z.p,
///   (s.d)''/(s.d) = 2 [c (t.p)(z.p) - (s.q)(z.Qq) - (z.p)(t.Qq + s.Pp/2)] + a real part,
/// where p = de/|e|, q = df/|f|.
struct JointSpin {
  static constexpr Term term = Term::joint;
  double stiffness = 0;  ///< k, N mm/rad
  int side = 1;          ///< +1: the normal is t_e x t_f; -1: t_f x t_e
  double natural = 0;    ///< phi without energy, rad

  double excess(const PairGeometry& at) const;  ///< phi - natural
  double value(const PairGeometry& at) const;
  double add(const PairGeometry& at, PairEnergy& out) const;
  /// First and second derivatives of phi by edge vectors and angles.
  static PairEnergy slopes(const PairGeometry& at, bool with_hessian);
};

}  // namespace gridshell
