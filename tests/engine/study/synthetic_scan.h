// A cloud of points as a 3D scanner would see a simulated shell: the tops of its joints alone.
#pragma once

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "engine/study/scan.h"

namespace gridshell::study {

struct ScanMaking {
  unsigned seed = 1;
  double noise_mm = 0.1;  ///< standard deviation of each coordinate
  int points = 100;       ///< per top
  double missing = 0;     ///< fraction of the joints that the scanner does not see
  int spurious = 0;       ///< discs elsewhere
  bool mirrored = false;  ///< the shell is in its mirror image
  JointCylinder cylinder = {};
};

/// A scan that was made, with its pose and the joints that it shows.
struct MadeScan {
  Eigen::Matrix3Xd cloud;
  Pose pose;                ///< from the run's frame to the scanner's
  std::vector<int> joints;  ///< that were seen
  Eigen::Matrix3Xd tops;    ///< of these, then of the spurious discs, in the run's frame
};

inline MadeScan make_scan(const ScanTarget& form, const ScanMaking& how) {
  std::mt19937_64 draw(how.seed);
  std::uniform_real_distribution<double> share(0, 1);
  std::normal_distribution<double> normal;
  MadeScan made;
  std::vector<Eigen::Vector3d> tops, normals;
  std::vector<int> order(std::size_t(form.joints.cols()));
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = int(k);
  std::shuffle(order.begin(), order.end(), draw);
  order.resize(order.size() - std::size_t(how.missing * double(order.size())));
  made.joints = order;
  for (const int k : order) {
    tops.emplace_back(form.joints.col(k) + how.cylinder.height_mm * form.normals.col(k));
    normals.emplace_back(form.normals.col(k));
  }
  const Eigen::Vector3d low = form.joints.rowwise().minCoeff(),
                        span = form.joints.rowwise().maxCoeff() - low;
  const auto random_vector = [&] {
    return Eigen::Vector3d(normal(draw), normal(draw), normal(draw));
  };
  for (int k = 0; k < how.spurious; ++k) {
    const Eigen::Vector3d at(share(draw), share(draw), share(draw));
    tops.emplace_back(low + at.cwiseProduct(span));
    normals.push_back(random_vector().normalized());
  }
  made.tops.resize(3, Eigen::Index(tops.size()));
  for (std::size_t k = 0; k < tops.size(); ++k) made.tops.col(Eigen::Index(k)) = tops[k];
  const Eigen::Vector4d turn(normal(draw), normal(draw), normal(draw), normal(draw));
  made.pose.turn = Eigen::Quaterniond(turn.normalized()).toRotationMatrix();
  if (how.mirrored) made.pose.turn = made.pose.turn * *form.mirror;
  made.pose.shift = 300 * random_vector();
  made.cloud.resize(3, Eigen::Index(tops.size()) * how.points);
  Eigen::Index next = 0;
  for (std::size_t k = 0; k < tops.size(); ++k) {
    const Eigen::Vector3d a = normals[k].unitOrthogonal(), b = normals[k].cross(a);
    for (int p = 0; p < how.points; ++p) {
      const double r = how.cylinder.diameter_mm / 2 * std::sqrt(share(draw)),
                   angle = 2 * M_PI * share(draw);
      const Eigen::Vector3d on = tops[k] + r * (std::cos(angle) * a + std::sin(angle) * b);
      made.cloud.col(next++) =
          made.pose.turn * on + made.pose.shift + how.noise_mm * random_vector();
    }
  }
  // a scanner does not identify the tops
  std::vector<int> places(std::size_t(made.cloud.cols()));
  for (std::size_t k = 0; k < places.size(); ++k) places[k] = int(k);
  std::shuffle(places.begin(), places.end(), draw);
  made.cloud = made.cloud(Eigen::all, places).eval();
  return made;
}

/// Joints that were given the top of another joint, or of none. The shell's own symmetries may
/// exchange joints: then the index is that of the joint which the top was made from.
inline int wrong_joints(const MadeScan& made, const ScanTarget& form, const RegisteredScan& scan,
                        double height_mm) {
  const Eigen::Matrix3Xd back = scan.pose.of(made.pose.of(made.tops));
  int wrong = 0;
  for (Eigen::Index k = 0; k < scan.joints.cols(); ++k) {
    if (scan.joints.col(k).hasNaN()) continue;
    const Eigen::Vector3d place = form.joints.col(k) + height_mm * form.normals.col(k),
                          top = scan.joints.col(k) + height_mm * form.normals.col(k);
    Eigen::Index from = 0;
    (back.colwise() - top).colwise().norm().minCoeff(&from);
    const bool spurious = from >= Eigen::Index(made.joints.size());
    if (spurious || (back.col(from) - place).norm() > 0.5) ++wrong;
  }
  return wrong;
}

}  // namespace gridshell::study
