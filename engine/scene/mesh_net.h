// The part of a mesh that a net reaches, and the best start of a net on it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/geometry/marched_net.h"

namespace gridshell {

/// A point of the mesh that represents its part of the area.
struct AreaSample {
  Eigen::Vector3d at;
  double area = 0;              ///< fraction of the mesh's area, 0 to 1
  RodStop why = RodStop::none;  ///< why it is left out
};

/// Points on the triangles of a mesh, at distances of about `apart_mm` at most.
std::vector<AreaSample> area_samples(const TriangleMesh& mesh, double apart_mm);

/// Chord of the grid on which a net is computed, mm: an eighth of the rods' spacing, or more if the
/// mesh is large.
double net_chord(const TriangleMesh& mesh, double spacing_mm);
/// Number of chords that lead from any point of the mesh to any other.
int chords_across(const TriangleMesh& mesh, double chord_mm);

/// The samples that a grid's rods do not reach within a chord and on their side of every line; each
/// with what ends the rods nearest to it.
std::vector<AreaSample> left_out_of(const MarchedGrid& grid, const Barriers& lines,
                                    const std::vector<AreaSample>& samples);

/// Position and direction of the start of a net, and what the net reaches.
struct NetStart {
  NetPose pose;
  double axis_deg = 0;         ///< angle of the u-axis from x, as seen from above
  double reached = 0;          ///< fraction of the area
  double least_angle_deg = 0;  ///< smallest angle between rods
  double seams = 0;  ///< area of seams between parts of the net, a chord wide, over the area
};

/// Finds the best start, and as the second the best one that is at least a tenth of the mesh's size
/// away or rotated by 20 degrees. Nets on a coarse grid start from positions distributed over the
/// mesh, each in six directions; the best starts are moved and rotated as long as that improves
/// them, then evaluated on the net's own grid. A start is better if the net reaches more area, less
/// half the area of its seams; of equal ones, if its smallest angle is larger. `by_angle`: the
/// largest smallest angle counts among all that reach at most 0.05 of the area less than the most.
/// Errors (bad_input): no position of the mesh faces up inside the boundary.
Result<std::vector<NetStart>> best_starts(const Surface& surface, const TriangleMesh& mesh,
                                          const Barriers& lines, const Surface::Function& outside,
                                          double least_angle, double spacing_mm, bool by_angle);

/// Report of a net on a mesh: its start, what it reaches and what it leaves out.
struct MeshNetReport {
  std::vector<std::string> mended;  ///< repairs of the mesh, one sentence each
  double fit_mm = 0;  ///< largest distance of a vertex from the smooth surface, at `fit_at`
  Eigen::Vector3d fit_at = Eigen::Vector3d::Zero();
  NetStart start;
  std::optional<NetStart> second;    ///< the second best start of a search
  std::vector<AreaSample> left_out;  ///< the parts of the mesh that the net does not reach
  std::vector<std::string> lines;    ///< "1 hole", "2 creases"
  struct Line {
    LineKind kind;
    Eigen::Matrix3Xd points;
  };
  std::vector<Line> drawn;  ///< rim, holes, creases

  /// Fractions of the area that are left out, by reason, the largest first.
  std::vector<std::pair<RodStop, double>> reasons() const;
  /// One sentence each on repairs, the fit, lines of the mesh, start and reached area, the second
  /// start, and what is left out and why.
  std::vector<std::string> sentences() const;
};

}  // namespace gridshell
