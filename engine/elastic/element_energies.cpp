#include "engine/elastic/element_energies.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace gridshell {

NodeAction& NodeAction::operator*=(double factor) {
  force *= factor;
  stiffness *= factor;
  pressure *= factor;
  return *this;
}

double NodeAction::value(const Eigen::Matrix3Xd& x) const {
  const Eigen::Vector3d at = x.col(node);
  double value = -force.dot(at) + 0.5 * (stiffness.array() * (at - anchor).array().square()).sum();
  if (pressure != 0)
    value -= pressure / 6 * at.dot(Eigen::Vector3d(x.col(corners[0])).cross(apex(x)));
  return value;
}

void NodeAction::add_gradient(double factor, const Eigen::Matrix3Xd& x,
                              Eigen::Matrix3Xd& gradient) const {
  const Eigen::Vector3d at = x.col(node);
  gradient.col(node) += factor * (stiffness.cwiseProduct(at - anchor) - force);
  if (pressure == 0) return;
  const Eigen::Vector3d y = x.col(corners[0]), z = apex(x);
  const double fraction = factor * pressure / 6;
  gradient.col(node) -= fraction * y.cross(z);
  gradient.col(corners[0]) -= fraction * z.cross(at);
  if (corners[1] >= 0) gradient.col(corners[1]) -= fraction * at.cross(y);
}

double NodeBar::value(double e) const {
  constexpr double w = taking_up;
  if (!cable) return EA * rest_length * 0.5 * e * e;
  if (e <= 0) return 0;
  return EA * rest_length * (e < w ? e * e * e / (6 * w) : 0.5 * e * (e - w) + w * w / 6);
}

double NodeBar::force(double e) const {
  constexpr double w = taking_up;
  if (!cable) return EA * e;
  if (e <= 0) return 0;
  return EA * (e < w ? 0.5 * e * e / w : e - 0.5 * w);
}

double NodeBar::stiffness(double e) const {
  return cable ? EA * std::clamp(e / taking_up, 0.0, 1.0) : EA;
}

PairEnergy& PairEnergy::operator+=(const PairEnergy& other) {
  gradient += other.gradient;
  if (with_hessian) hessian += other.hessian;
  return *this;
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Matrix3d symmetric_product(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Matrix3d m = 0.5 * a * b.transpose();
  return m + m.transpose();
}

Eigen::Matrix3d normal_projector(const Eigen::Vector3d& t) {
  return Eigen::Matrix3d::Identity() - t * t.transpose();
}

namespace {

HalfwayFrame frame_of(const PairGeometry& at, const MaterialBend& bend) {
  return halfway_frame(at.e.tangent, at.director_e,
                       at.angle_e + bend.fraction * at.twist() + bend.axis);
}

/// s of EndBending, and its derivatives by c = cos phi.
struct EndScale {
  double s, by_c, by_cc;

  explicit EndScale(double c) {
    const double w = 1 / (1 + c);
    s = (3 + c * c) * w * w;
    by_c = (2 * c - 6) * w * w * w;
    by_cc = (20 - 4 * c) * w * w * w * w;
  }
};

/// Factor on the curvature binormal: s at an end, else 1.
double scale_of(const MaterialBend& bend, const CurvatureBinormal& b) {
  return bend.at_end() ? EndScale(b.chi - 1).s : 1;
}

/// Gradient (in increments) of chi = 1 + t.s; chi_curvature() is its Hessian.
PairVector chi_slope(const BinormalSlopes& b) {
  PairVector slope = PairVector::Zero();
  slope.head<3>() = b.P * b.s;
  slope.segment<3>(3) = b.Q * b.t;
  return slope;
}

PairMatrix chi_curvature(const BinormalSlopes& b) {
  const PairVector slope = chi_slope(b);
  const double c = b.chi - 1;
  PairMatrix curvature = PairMatrix::Zero();
  curvature.block<3, 3>(0, 0) = -2 * symmetric_product(slope.head<3>(), b.t) - c * b.P;
  curvature.block<3, 3>(3, 3) = -2 * symmetric_product(slope.segment<3>(3), b.s) - c * b.Q;
  curvature.block<3, 3>(0, 3) = b.P * b.Q;
  curvature.block<3, 3>(3, 0) = b.Q * b.P;
  return curvature;
}

/// Adds Y.kb'' for a fixed Y normal to t, as a symmetric matrix (in increments), to `out`.
void add_binormal_curvature(const Eigen::Vector3d& Y, const BinormalSlopes& b, PairMatrix& out) {
  const double k = Y.dot(b.kb), i = 1 / b.chi;
  const Eigen::Vector3d yp = b.by_p.transpose() * Y, yq = b.by_q.transpose() * Y;
  const Eigen::Vector3d hp = b.P * b.s, hq = b.Q * b.t;  // slopes of chi
  const Eigen::Vector3d wp = b.P * (2 * k * b.s - 4 * b.s.cross(Y)) * i;
  const Eigen::Vector3d wq = b.Q * (2 * k * b.t - 4 * Y.cross(b.t)) * i;
  out.block<3, 3>(0, 0) +=
      -k * i * b.P + symmetric_product(b.t, wp) - 2 * i * symmetric_product(yp, hp);
  out.block<3, 3>(3, 3) +=
      -k * i * b.Q + symmetric_product(b.s, wq) - 2 * i * symmetric_product(yq, hq);
  const Eigen::Matrix3d pq =
      -i * (b.P * (2 * cross_matrix(Y) + k * Eigen::Matrix3d::Identity()) * b.Q +
            yp * hq.transpose() + hp * yq.transpose());
  out.block<3, 3>(0, 3) += pq;
  out.block<3, 3>(3, 0) += pq.transpose();
}

/// Adds weight * tau'' (in increments) of the twist tau = theta_f - theta_e + m_ref. With the
/// frames carried along straight lines, by increments p = de/|e|, q = df/|f|:
///   tau'  = kb.(p + q)/2 + theta_f' - theta_e'.
/// The second derivatives of m_ref in the literature are the derivative of kb/(2|e|), which is not
/// symmetric, as a frame that is carried round a loop is turned. The symmetric part is the Hessian.
/// With m = (t + s)/chi and sym(a, b) = (a b^T + b a^T)/2,
///   H_pp = -sym(t + m, kb)/2, H_qq = -sym(s + m, kb)/2, H_pq = ([m]x - sym(m, kb))/2.
void add_twist_curvature(double weight, const CurvatureBinormal& b, PairMatrix& out) {
  const Eigen::Vector3d mean = (b.t + b.s) / b.chi;
  const auto add_own = [&](int at, const Eigen::Vector3d& a) {
    out.block<3, 3>(at, at) -= symmetric_product(0.5 * weight * a, b.kb);
  };
  add_own(0, b.t + mean);
  add_own(3, b.s + mean);
  const Eigen::Matrix3d across =
      cross_matrix(0.5 * weight * mean) - symmetric_product(0.5 * weight * mean, b.kb);
  out.block<3, 3>(0, 3) += across;
  out.block<3, 3>(3, 0) += across.transpose();
}

double material_bend_value(const MaterialBend& bend, const Eigen::Vector2d& w) {
  return 0.5 * (bend.stiffness.array() * (w - bend.rest).array().square()).sum();
}

}  // namespace

double NodeSpring::value(const Eigen::Vector3d& gap) const {
  return 0.5 * stiffness.dot(gap.cwiseAbs2());
}

Eigen::Vector3d NodeSpring::gradient(const Eigen::Vector3d& gap) const {
  return stiffness.cwiseProduct(gap);
}

CurvatureBinormal curvature_binormal(const Eigen::Vector3d& t, const Eigen::Vector3d& s) {
  const double chi = 1 + t.dot(s);
  return {t, s, 2 / chi * t.cross(s), chi};
}

BinormalSlopes binormal_with_slopes(const Eigen::Vector3d& t, const Eigen::Vector3d& s) {
  BinormalSlopes b{curvature_binormal(t, s), {}, {}, {}, {}};
  b.P = normal_projector(t);
  b.Q = normal_projector(s);
  b.by_p.noalias() = -(2 * cross_matrix(s) + b.kb * s.transpose()) / b.chi * b.P;
  b.by_q.noalias() = (2 * cross_matrix(t) - b.kb * t.transpose()) / b.chi * b.Q;
  return b;
}

void scale_to_edges(double length_e, double length_f, PairEnergy& out) {
  PairVector scale;
  scale << Eigen::Vector3d::Constant(1 / length_e), Eigen::Vector3d::Constant(1 / length_f), 1, 1;
  out.gradient.array() *= scale.array();
  if (out.with_hessian)
    out.hessian = (scale.asDiagonal() * out.hessian * scale.asDiagonal()).eval();
}

void add_cosine(double by_c, double by_cc, const EdgeGeometry& e, const EdgeGeometry& f,
                PairEnergy& out) {
  const Eigen::Vector3d &t = e.tangent, &s = f.tangent;
  const double c = t.dot(s), i = 1 / e.length, j = 1 / f.length;
  const Eigen::Vector3d p = i * (s - c * t), q = j * (t - c * s);
  out.gradient.head<3>() += by_c * p;
  out.gradient.segment<3>(3) += by_c * q;
  if (!out.with_hessian) return;
  const Eigen::Matrix3d P = normal_projector(t), Q = normal_projector(s);
  out.hessian.block<3, 3>(0, 0) +=
      by_cc * p * p.transpose() - 2 * by_c * i * symmetric_product(p, t) - by_c * c * i * i * P;
  out.hessian.block<3, 3>(3, 3) +=
      by_cc * q * q.transpose() - 2 * by_c * j * symmetric_product(q, s) - by_c * c * j * j * Q;
  const Eigen::Matrix3d ef = by_cc * p * q.transpose() + by_c * i * j * P * Q;
  out.hessian.block<3, 3>(0, 3) += ef;
  out.hessian.block<3, 3>(3, 0) += ef.transpose();
}

void add_twist(double stiffness, double excess, const CurvatureBinormal& b, PairEnergy& out) {
  PairVector slope;
  slope << 0.5 * b.kb, 0.5 * b.kb, -1, 1;
  out.gradient += stiffness * excess * slope;
  if (!out.with_hessian) return;
  out.hessian.noalias() += (stiffness * slope) * slope.transpose();
  add_twist_curvature(stiffness * excess, b, out.hessian);
}

double Torsion::add(const PairGeometry& at, PairEnergy& out) const {
  PairEnergy here{.with_hessian = out.with_hessian};
  add_twist(stiffness, excess(at), curvature_binormal(at.e.tangent, at.f.tangent), here);
  scale_to_edges(at.e.length, at.f.length, here);
  out += here;
  return value(at);
}

HalfwayFrame halfway_frame(const Eigen::Vector3d& tangent, const Eigen::Vector3d& director,
                           double angle) {
  const Eigen::Vector3d across = tangent.cross(director);
  const double c = std::cos(angle), s = std::sin(angle);
  HalfwayFrame frame;
  frame << c * director + s * across, c * across - s * director;
  return frame;
}

double add_material_bend(const MaterialBend& bend, const HalfwayFrame& mu, const BinormalSlopes& b,
                         PairEnergy& out) {
  const double scale = scale_of(bend, b);
  const Eigen::Vector2d w = mu.transpose() * b.kb;
  Eigen::Vector2d g = bend.stiffness.array() * (scale * w - bend.rest).array();
  PairVector phi;
  phi << 0.5 * bend.fraction * b.kb, 0.5 * bend.fraction * b.kb, 1 - bend.fraction, bend.fraction;
  Eigen::Matrix<double, 8, 2> along = Eigen::Matrix<double, 8, 2>::Zero();  // mu.kb'
  along.topRows<3>() = b.by_p.transpose() * mu;
  along.middleRows<3>(3) = b.by_q.transpose() * mu;
  Eigen::Matrix<double, 8, 2> slope = along;
  slope.col(0) += w[1] * phi;
  slope.col(1) -= w[0] * phi;
  if (bend.at_end()) {  // (s w)' = s w' + w s'
    const EndScale end(b.chi - 1);
    const PairVector by_c = chi_slope(b), pull = slope * g;
    if (out.with_hessian) {
      out.hessian += end.by_c * (by_c * pull.transpose() + pull * by_c.transpose());
      out.hessian += g.dot(w) * (end.by_cc * by_c * by_c.transpose() + end.by_c * chi_curvature(b));
    }
    slope = (scale * slope + end.by_c * by_c * w.transpose()).eval();
  }
  out.gradient += slope * g;
  if (!out.with_hessian) return material_bend_value(bend, scale * w);
  out.hessian.noalias() += slope * bend.stiffness.asDiagonal() * slope.transpose();

  // the second derivatives of w, weighted by g
  g *= scale;
  const Eigen::Vector3d Y = mu * g;
  add_binormal_curvature(Y, b, out.hessian);
  out.hessian.block<3, 3>(0, 0) += symmetric_product(Y, b.kb);
  const PairVector across = g[0] * along.col(1) - g[1] * along.col(0);
  out.hessian += phi * across.transpose() + across * phi.transpose();
  out.hessian -= g.dot(w) * phi * phi.transpose();
  add_twist_curvature(bend.fraction * (g[0] * w[1] - g[1] * w[0]), b, out.hessian);
  return material_bend_value(bend, scale * w);
}

Eigen::Vector2d MaterialBend::bent(const Eigen::Vector2d& excess) const {
  return Eigen::Rotation2Dd(axis) *
         Eigen::Vector2d(corner * corner * excess[0], corner * excess[1]);
}

CornerLaw::CornerLaw(const Eigen::Vector2d& EI, double GJ, double length_e, double length_f,
                     const Eigen::Vector2d& turn) {
  const double h = std::atan(0.5 * turn.norm()), c = std::cos(h), s = std::sin(h),
               length = 0.5 * (length_e + length_f);
  bend.axis = std::atan2(turn[1], turn[0]);
  bend.corner = c;
  const double along = std::pow(std::cos(bend.axis), 2), across = 1 - along;
  const double EI_n = 1 / (along / EI[0] + across / EI[1]),
               EI_m = 1 / (across / EI[0] + along / EI[1]);
  const double vv = length * (c * c / EI_m + s * s / GJ), uu = length * (s * s / EI_m + c * c / GJ),
               vu = 0.5 * (length_e - length_f) * c * s * (1 / EI_m - 1 / GJ);
  bend.stiffness << std::pow(c, 4) * EI_n / length, c * c * uu / (vv * uu - vu * vu);
  bend.rest << turn.norm(), 0;
  bend.fraction = 0.5 - vu / (uu * turn.norm());
  torsion = c * c / uu;
}

Eigen::Vector2d SectionBending::excess(const PairGeometry& at) const {
  const CurvatureBinormal b = curvature_binormal(at.e.tangent, at.f.tangent);
  return frame_of(at, bend).transpose() * (scale_of(bend, b) * b.kb) - bend.rest;
}

double SectionBending::value(const PairGeometry& at) const {
  const CurvatureBinormal b = curvature_binormal(at.e.tangent, at.f.tangent);
  return material_bend_value(bend, frame_of(at, bend).transpose() * (scale_of(bend, b) * b.kb));
}

double SectionBending::add(const PairGeometry& at, PairEnergy& out) const {
  PairEnergy here{.with_hessian = out.with_hessian};
  const double value = add_material_bend(bend, frame_of(at, bend),
                                         binormal_with_slopes(at.e.tangent, at.f.tangent), here);
  scale_to_edges(at.e.length, at.f.length, here);
  out += here;
  return value;
}

double EndBending::value(const PairGeometry& at) const {
  const double c = at.e.tangent.dot(at.f.tangent);
  return stiffness * (1 - c) / (1 + c) * std::pow(EndScale(c).s, 2);
}

double EndBending::add(const PairGeometry& at, PairEnergy& out) const {
  const double c = at.e.tangent.dot(at.f.tangent), w = 1 / (1 + c);
  const EndScale end(c);
  const double x = (1 - c) * w, x_by_c = -2 * w * w, x_by_cc = 4 * w * w * w;  // u^2
  add_cosine(stiffness * end.s * (x_by_c * end.s + 2 * x * end.by_c),
             stiffness * (x_by_cc * end.s * end.s + 4 * x_by_c * end.s * end.by_c +
                          2 * x * (end.by_c * end.by_c + end.s * end.by_cc)),
             at.e, at.f, out);
  return value(at);
}

}  // namespace gridshell
