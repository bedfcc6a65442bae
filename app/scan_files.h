// What is written of a scan.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/record/snapshot.h"
#include "engine/scan/scan.h"

namespace gridshell::app {

/// One state that a scan is compared with, and how it lies on it.
struct ComparedState {
  std::string name;  ///< of the run, its case, its state: "out/fig2_states, state 3"
  std::optional<LaidScan> scan;
  bool shown = false;  ///< shows_state()
};

/// A scan compared with all of them.
struct ComparedScan {
  std::string points;  ///< the file
  Clusters clusters;
  JointCylinder cylinder;
  std::vector<ComparedState> states;
  std::size_t best = 0;  ///< the one that it lies on best

  const ComparedState& of_best() const { return states[best]; }
};

/// scan.json: joints_found, joints_missing, outliers, specks, rms_mm, mean_mm, max_mm,
/// joints_within_two_radii; `state`, null where it is none; the pose from the scan's frame to the
/// run's; every state that was compared.
std::string scan_json(const ComparedScan& scan);
/// scan.csv: `i,j,x_mm,y_mm,z_mm,distance_mm,distance_radii` of every joint in the run's frame,
/// empty where it is missing.
std::string scan_csv(const ComparedScan& scan, const record::Layout& layout);
/// measured.csv: `x_mm,y_mm,z_mm` of the joints found, as [figure] scan takes them.
std::string measured_csv(const LaidScan& scan);
/// For the terminal.
std::string scan_text(const ComparedScan& scan);

}  // namespace gridshell::app
