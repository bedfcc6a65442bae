// The shell of a preset before it is computed: footprint, rods, ends and the motion of the
// boundary.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/elastic/shell_rods.h"
#include "engine/footprint/actuation.h"
#include "engine/footprint/assemblage.h"
#include "engine/footprint/footprint.h"
#include "engine/footprint/mesh.h"
#include "engine/geometry/chebyshev_net.h"
#include "engine/preset/preset.h"
#include "engine/scene/load_case.h"
#include "engine/scene/mesh_net.h"

namespace gridshell {

/// Whether a snap is computed in time, and with which settings.
struct SnapDynamics {
  bool requested = false;
  double step_s = 0, damping_per_s = 0;
};

/// The shell of a preset, and the accuracy with which it is computed; scene_of() fills it.
struct Scene {
  Footprint footprint;
  ShellRods rods;
  RodModel rod_model = RodModel::bend;     ///< rod model chosen: net, bend or twist
  std::vector<double> mass_t_per_mm;       ///< one per rod; 0: not known
  std::vector<double> strength_MPa;        ///< one per rod; empty: not known
  double joint_mass_t = 0;                 ///< mass of each joint, in addition to its rods
  double rod_diameter_mm = 0;              ///< diameter in pictures
  std::vector<double> drawn_diameters_mm;  ///< one per rod, for round sections of the rods' areas
  std::vector<double> laths_mm;            ///< as in record::Layout
  /// one per rod; without meaning for rectangular sections
  std::vector<double> diameters_mm;
  BoundaryMotion motion;
  double length_scale_mm = 0;                ///< R_o, rho or half a diagonal: the scale of errors
  FlatFrame flat;                            ///< position of the flat footprint
  std::shared_ptr<const ChebyshevNet> net;   ///< on which the shell was designed, if any
  std::shared_ptr<const Assemblage> blocks;  ///< building blocks of the net, if any
  std::shared_ptr<const MeshNetReport> mesh_net;  ///< report of a net on a mesh
  bool from_net = false;  ///< whether the path starts at the net, at progress 1
  /// Whether the path starts at the equilibrium next to the drawn shape, progress 0: a network in
  /// space, or one with straight rods that are drawn bent.
  bool from_drawing = false;
  Eigen::Matrix3Xd original_boundary;  ///< closed polylines in correspondence, for pictures
  Eigen::Matrix3Xd actuated_boundary;
  /// radius of a circular boundary
  double radius_begin_mm = std::numeric_limits<double>::quiet_NaN();
  double radius_end_mm = std::numeric_limits<double>::quiet_NaN();
  BuckleSeed seed;            ///< selects the branch of the first buckling
  Imperfection imperfection;  ///< selects the branch at later bifurcations
  int base_edges = 4;  ///< edges per segment of the chosen meshes are this times a power of two
  int edges_per_segment = 0;  ///< the requested mesh; 0: chosen from the tolerance
  double load_step = 1;       ///< largest load step, as a factor of the usual one
  double tolerance = 1e-3;    ///< largest error of the joints, over length_scale_mm
  double memory_GB = 0;       ///< limit of the meshes' memory; 0: half of the machine's
  double max_strain = 1e-3;
  double max_bending_strain = 0, max_utilisation = 0;  ///< limits; 0: none
  double joint_diameter_mm = 0, joint_height_mm = 0;   ///< size of the joints' cylinders
  bool stops_at_contact = false;
  bool table = false;  ///< whether rods must not pass the plane of the flat footprint
  SnapDynamics snap;
  std::vector<LoadCase> load_cases;
  double load_imperfection_mm = 0;  ///< size of the imperfection in a load study

  /// The rod model of the mechanics, if there is one.
  RodModel solved_model() const {
    return rod_model == RodModel::twist ? RodModel::twist : RodModel::bend;
  }
  /// Whether rods have a limit of bending strain or utilisation.
  bool limits_strength() const { return max_bending_strain > 0 || max_utilisation > 0; }
  /// Masses of the joints, which are the first nodes of every mesh, t.
  Eigen::RowVectorXd joint_masses() const;
  double radius_at(double progress) const {
    return radius_begin_mm + progress * (radius_end_mm - radius_begin_mm);
  }
  /// Progress at which a circular boundary has a radius; 1 if the boundary does not move.
  double progress_of_radius(double radius_mm) const {
    if (radius_begin_mm == radius_end_mm) return 1;
    return (radius_begin_mm - radius_mm) / (radius_begin_mm - radius_end_mm);
  }
};

/// The joint (i, j), or -1.
int joint_at(const Footprint& footprint, int i, int j);
/// The joint of a key `joint`. Errors (bad_input): there is none, with the range of i and j.
Result<int> joint_named(const Footprint& footprint, const std::vector<int>& name);

/// Builds the scene of a preset. Errors: Fault::bad_input with the reason if the preset's values do
/// not define a footprint.
Result<Scene> scene_of(const preset::Preset& preset);

/// The rods on the net that a scene was designed on, as points at distances of at most `step_mm`;
/// empty without a net.
Result<std::vector<Eigen::Matrix3Xd>> rods_on_net(const Scene& scene, double step_mm);

/// Builds the scene of a preset for shared ownership.
Result<std::shared_ptr<const Scene>> shared_scene_of(const preset::Preset& preset);

}  // namespace gridshell
