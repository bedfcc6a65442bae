#include "engine/simulate/frame_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/elastic/model.h"
#include "engine/elastic/shell_rods.h"

namespace gridshell::simulate {
namespace {

constexpr double deg = 180 / M_PI;

/// Joints of two rods with an edge centred there, which have an angle of their own.
std::vector<int> joints_with_angles(const RodMesh& mesh, const Bolts& now) {
  std::vector<int> joints;
  for (int joint = 0; joint < mesh.joints; ++joint)
    if (mesh.is_centred(joint) && now.rods[std::size_t(joint)].size() == 2) joints.push_back(joint);
  return joints;
}

/// Values of one mesh as the first row of a matrix, for certify_vectors().
Eigen::Matrix3Xd columns_of(const std::vector<double>& values) {
  Eigen::Matrix3Xd columns = Eigen::Matrix3Xd::Zero(3, Eigen::Index(values.size()));
  for (std::size_t k = 0; k < values.size(); ++k) columns(0, Eigen::Index(k)) = values[k];
  return columns;
}

}  // namespace

void put_joints(const Simulation& simulation, record::Frame& frame) {
  const NestedShell& shell = simulation.shell();
  const Model& model = shell.model();
  if (model.hinges.empty() && model.forces() == Eigen::Index(model.edges.size())) return;
  std::vector<int> joints;
  std::vector<Eigen::Matrix3Xd> angles, means, torques, springs;
  for (int level = shell.first_of_last_three(); level < shell.levels(); ++level) {
    const RodMesh& mesh = shell.mesh(level);
    const State& state = shell.state().levels[std::size_t(level)];
    const Bolts now = tightened(mesh, shell.model(level), state, 1);
    joints = joints_with_angles(mesh, now);
    if (joints.empty()) return;
    std::vector<double> angle;
    double mean = 0;
    for (const int joint : joints) {
      angle.push_back(deg * now.angle(joint));
      mean += angle.back() / double(joints.size());
    }
    angles.push_back(columns_of(angle));
    means.push_back(columns_of({mean}));
    torques.push_back(
        columns_of(joint_torques(mesh, shell.model(level), state, shell.outside(level).opening)));
    const Energies energies = shell.energies(level);
    springs.push_back(columns_of({energies[Term::shear] + energies[Term::joint]}));
  }
  const bool extrapolate = shell.extrapolates();
  const Energies energies = shell.energies(shell.last());
  const auto certified = [&](const std::vector<Eigen::Matrix3Xd>& levels, double& error) {
    CertifiedVectors found = certify_forces(levels, extrapolate, model, energies);
    error = found.error;
    return Eigen::VectorXd(found.value.row(0).transpose());
  };
  double of_a_joint = record::unknown;
  const Eigen::VectorXd angle = certified(angles, of_a_joint);
  frame.angle_deg = Eigen::VectorXd::Constant(shell.finest().joints, record::unknown);
  for (std::size_t k = 0; k < joints.size(); ++k)
    frame.angle_deg[joints[k]] = angle[Eigen::Index(k)];
  frame.torque_Nmm = certified(torques, frame.joint_torque_error_Nmm);
  (void)certified(means, frame.joint_angle_error_deg);
  (void)certified(springs, frame.springs_error_mJ);
  // errors of joints may cancel in their mean on two meshes, and need not on others
  constexpr double of_mean = 0.05;
  frame.joint_angle_error_deg = std::max(frame.joint_angle_error_deg, of_mean * of_a_joint);
  // all meshes have the angles at which bolts were tightened, with their error
  const double before = simulation.rods().bolts ? simulation.rods().bolts->angle_error_rad : 0;
  frame.joint_angle_error_deg += deg * before;
  frame.one_angle_error_deg = of_a_joint + deg * before;
  put_joint_ranges(frame);
}

void put_joint_ranges(record::Frame& frame) {
  double sum = 0;
  int count = 0;
  frame.smallest_joint_angle_deg = frame.largest_joint_angle_deg = record::unknown;
  for (const double angle : frame.angle_deg) {
    if (std::isnan(angle)) continue;
    sum += angle, ++count;
    frame.smallest_joint_angle_deg = std::fmin(frame.smallest_joint_angle_deg, angle);
    frame.largest_joint_angle_deg = std::fmax(frame.largest_joint_angle_deg, angle);
  }
  if (count == 0) return;
  frame.joint_angle_deg = sum / count;
  frame.joint_torque_Nmm = frame.torque_Nmm.cwiseAbs().maxCoeff();
}

std::string text_of_joints(const record::Frame& frame) {
  std::string text =
      fmt::format("joints at {:.2f} degrees on average, {:.2f} to {:.2f}, torques to {:.4g} N mm",
                  frame.joint_angle_deg, frame.smallest_joint_angle_deg,
                  frame.largest_joint_angle_deg, frame.joint_torque_Nmm);
  // the errors of a single mesh are not known
  if (std::isfinite(frame.joint_angle_error_deg))
    text += fmt::format(" (errors to {:.2g} degrees on average, {:.2g} of a joint, {:.2g} N mm)",
                        frame.joint_angle_error_deg, frame.one_angle_error_deg,
                        frame.joint_torque_error_Nmm);
  return text;
}

}  // namespace gridshell::simulate
