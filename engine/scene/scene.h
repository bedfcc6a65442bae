// From a preset's values to what will be formed: footprint, rods, ends and the motion of the
// boundary. Knows no solver.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/team.h"
#include "engine/elastic/shell_rods.h"
#include "engine/footprint/actuation.h"
#include "engine/footprint/assemblage.h"
#include "engine/footprint/footprint.h"
#include "engine/footprint/mesh.h"
#include "engine/geometry/chebyshev_net.h"
#include "engine/preset/preset.h"
#include "engine/scene/load_case.h"
#include "engine/scene/mesh_net.h"

namespace gridshell::simulate {
class KeptSegments;
}

namespace gridshell {

/// Whether and how a snap is followed in time.
struct SnapDynamics {
  bool wanted = false;
  double step_s = 0, damping_per_s = 0;
};

/// What will be formed, and how exactly.
struct Scene {
  Footprint footprint;
  ShellRods rods;
  RodModel rung = RodModel::bend;          ///< chosen: net, bend or twist
  std::vector<double> mass_t_per_mm;       ///< one a rod; 0: not known
  std::vector<double> strength_MPa;        ///< one a rod; empty: not known
  double joint_mass_t = 0;                 ///< of each joint, in addition to its rods
  double rod_diameter_mm = 0;              ///< as it is drawn
  std::vector<double> drawn_diameters_mm;  ///< one a rod, of round sections of their areas
  std::vector<double> laths_mm;            ///< record::Layout's
  std::vector<double> diameters_mm;        ///< one a rod; of no meaning where it is rectangular
  BoundaryMotion motion;
  double length_scale_mm = 0;                ///< R_o, rho or half a diagonal: what errors are over
  FlatFrame flat;                            ///< where the flat footprint lies
  std::shared_ptr<const ChebyshevNet> net;   ///< that it was designed on, if it was
  std::shared_ptr<const Assemblage> blocks;  ///< that the net is made of, if it is
  std::shared_ptr<const MeshNetReport> mesh_net;  ///< of a net on a mesh
  bool from_net = false;               ///< the path starts at the net, where progress is 1
  bool drawn_in_space = false;         ///< as it is drawn, where progress is 0
  Eigen::Matrix3Xd original_boundary;  ///< closed polylines in correspondence, for pictures
  Eigen::Matrix3Xd actuated_boundary;
  double radius_begin_mm = std::numeric_limits<double>::quiet_NaN();  ///< of a circular boundary
  double radius_end_mm = std::numeric_limits<double>::quiet_NaN();
  BuckleSeed seed;            ///< decides the first buckling
  Imperfection imperfection;  ///< and every later one
  int base_edges = 4;  ///< the meshes that the tolerance chooses have so many times a power of two
  int edges_per_segment = 0;  ///< the requested mesh; 0: chosen from the tolerance
  double load_step = 1;       ///< largest load steps, of the usual ones
  double tolerance = 1e-3;    ///< of the joints, over length_scale_mm
  double memory_GB = 0;       ///< that the meshes may take; 0: half of the machine's
  double max_strain = 1e-3;
  double max_bending_strain = 0, max_utilisation = 0;  ///< 0: any
  double joint_diameter_mm = 0, joint_height_mm = 0;   ///< of the joints' cylinders
  bool stops_at_contact = false;
  bool table = false;  ///< whether no rod passes the plane of the flat
  SnapDynamics snap;
  std::vector<LoadCase> load_cases;
  double load_imperfection_mm = 0;  ///< of shells that are not perfect
  std::shared_ptr<Team> team;  ///< of whoever follows one path alone: who helps with large shells
  /// Saved segments of the path, for a run that continues from them (simulate/kept_segments.h).
  std::shared_ptr<simulate::KeptSegments> kept;

  /// The rod model of the mechanics, if there is one.
  RodModel solved_model() const {
    return rung == RodModel::twist ? RodModel::twist : RodModel::bend;
  }
  /// Whether rods bear so much and no more.
  bool limits_strength() const { return max_bending_strain > 0 || max_utilisation > 0; }
  /// Masses of the joints, which are the first nodes of every mesh, t.
  Eigen::RowVectorXd joint_masses() const;
  double radius_at(double progress) const {
    return radius_begin_mm + progress * (radius_end_mm - radius_begin_mm);
  }
  /// Where a circular boundary has a radius; 1 where it stays as it is.
  double progress_of_radius(double radius_mm) const {
    if (radius_begin_mm == radius_end_mm) return 1;
    return (radius_begin_mm - radius_mm) / (radius_begin_mm - radius_end_mm);
  }
};

/// The joint (i, j), or -1.
int joint_at(const Footprint& footprint, int i, int j);

/// Builds the scene of a preset. Errors: Fault::bad_input with the reason if the preset's values do
/// not define a footprint.
Result<Scene> scene_of(const preset::Preset& preset);

/// The rods on the net that a scene was designed on, as points at most `step_mm` apart; none
/// without a net.
Result<std::vector<Eigen::Matrix3Xd>> rods_on_net(const Scene& scene, double step_mm);

/// Builds the scene of a preset for shared ownership.
Result<std::shared_ptr<const Scene>> shared_scene_of(const preset::Preset& preset);

}  // namespace gridshell
