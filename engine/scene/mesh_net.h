// What a net reaches of a mesh, and where it is best begun.
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
  double area = 0;              ///< of the mesh's, 0 to 1
  RodStop why = RodStop::none;  ///< it is left out
};

/// Points on the triangles of a mesh, no further from one another than about `apart_mm`.
std::vector<AreaSample> area_samples(const TriangleMesh& mesh, double apart_mm);

/// Chord of the grid that a net is found on: an eighth of the rods' spacing, if the mesh is not too
/// large for it, mm; and the number of chords that lead from any point to any other.
double net_chord(const TriangleMesh& mesh, double spacing_mm);
int chords_across(const TriangleMesh& mesh, double chord_mm);

/// Splits them into what a grid's rods reach, within a chord and on their side of every line, and
/// the remaining ones, each with what ends the rods nearest to it; returns these.
std::vector<AreaSample> left_out_of(const MarchedGrid& grid, const Barriers& lines,
                                    const std::vector<AreaSample>& samples);

/// A position and a direction from which a net is marched, and how far it comes.
struct NetStart {
  NetPlace place;
  double axis_deg = 0;         ///< of the u-axis from x, as seen from above
  double reached = 0;          ///< of the area
  double least_angle_deg = 0;  ///< between the rods
  double seams = 0;            ///< where two parts of the net meet, a chord wide, over the area
};

/// The best start and the best of those a tenth of the mesh's size away or 20 degrees turned:
/// nets on a coarse grid from positions spread over the mesh, each in six directions, the best of
/// them moved and turned as long as more is reached, then measured on the net's own grid. Seams,
/// where two parts of the net meet, count half against the area; of those that reach as much the
/// one with the largest least angle is best. `by_angle`: that of all which reach 0.95 of the most.
/// Errors (bad_input): no position of the mesh faces up inside the boundary.
Result<std::vector<NetStart>> best_starts(const Surface& surface, const TriangleMesh& mesh,
                                          const Barriers& lines, const Surface::Function& outside,
                                          double least_angle, double spacing_mm, bool by_angle);

/// Where a net begins on a mesh, what it reaches and what not.
struct MeshNetReport {
  std::vector<std::string> mended;  ///< what was done to make it one sheet, one sentence each
  double fit_mm = 0;  ///< largest distance of a vertex from the smooth surface, and where
  Eigen::Vector3d fit_at = Eigen::Vector3d::Zero();
  NetStart start;
  std::optional<NetStart> second;    ///< of a search
  std::vector<AreaSample> left_out;  ///< of the mesh
  std::vector<std::string> lines;    ///< "1 hole", "2 creases"
  struct Line {
    LineKind kind;
    Eigen::Matrix3Xd points;
  };
  std::vector<Line> drawn;  ///< rim, holes, creases

  /// The parts of the area, by reason, the largest first.
  std::vector<std::pair<RodStop, double>> reasons() const;
  /// A sentence each: what was mended, the fit, where it begins, what is reached, what is left out
  /// and why.
  std::vector<std::string> sentences() const;
};

}  // namespace gridshell
