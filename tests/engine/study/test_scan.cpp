// Scans made of simulated shells, with a known pose.
#include "engine/study/scan.h"

#include <catch2/catch.hpp>

#include "tests/engine/simulate/run.h"
#include "tests/engine/study/synthetic_scan.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::study;

namespace {

/// The shell of Fig. 1, with two diagonal mirrors.
const ScanTarget& circle() {
  static const ScanTarget form = [] {
    preset::Preset p;
    p.movie.frames = 2;
    p.imperfection.size = 0;
    p.accuracy.edges_per_segment = 4;
    const simulate::ExperimentResult outcome = run(p);
    return form_of(outcome.trajectory.layout, outcome.trajectory.frames.back());
  }();
  return form;
}

const ScanTarget& hemisphere() {
  static const ScanTarget form = [] {
    preset::Preset p;
    p.footprint.kind = preset::FootprintKind::net;
    p.net.radius_mm = 120;
    p.actuation.start = preset::Start::net;
    p.accuracy.edges_per_segment = 4;
    const simulate::ExperimentResult outcome = run_stills(p);
    return form_of(outcome.trajectory.layout, outcome.trajectory.frames.back());
  }();
  return form;
}

std::optional<RegisteredScan> laid(const MadeScan& made, const ScanTarget& form) {
  const auto clusters = value_of(cluster_joint_tops(made.cloud, 3));
  return register_points(clusters, form, {});
}

}  // namespace

TEST_CASE("normals of a hemisphere's joints are radial, its joints lie on a sphere") {
  const ScanTarget& form = hemisphere();
  const auto off = (form.joints.colwise().normalized() - form.normals).colwise().norm().eval();
  CHECK(off.maxCoeff() < 0.1);
  CHECK(form.mirror);
}

TEST_CASE("scans of known pose: joints within 0.1 mm, none wrong, a fifth missing or spurious") {
  int seed = 0;
  for (const ScanTarget* form : {&circle(), &hemisphere()})
    for (const double missing : {0.0, 0.1, 0.2})
      for (const int spurious : {0, 12}) {
        if (missing == 0.1 && spurious > 0) continue;
        ScanMaking how;
        how.seed = unsigned(++seed);
        how.missing = missing;
        how.spurious = spurious;
        how.mirrored = seed % 2 == 0;
        CAPTURE(seed, missing, spurious);
        const MadeScan made = make_scan(*form, how);
        const auto scan = value_of(laid(made, *form));
        CHECK(scan_matches(scan, {}));
        CHECK(scan.rms_mm < 0.1);
        CHECK(scan.found == int(made.joints.size()));
        CHECK(wrong_joints(made, *form, scan, 5) == 0);
        CHECK(int(scan.outliers.cols()) <= spurious);
      }
}

TEST_CASE("a scan of another shell shows none") {
  const MadeScan made = make_scan(hemisphere(), {});
  const auto scan = laid(made, circle());
  if (scan) CHECK_FALSE(scan_matches(*scan, {}));
  // nor does a shell pushed aside by more than the bar at every third joint
  ScanTarget bent = circle();
  for (Eigen::Index k = 0; k < bent.joints.cols(); k += 3) bent.joints(2, k) += 5;
  const auto other = laid(make_scan(bent, {}), circle());
  if (other) CHECK_FALSE(scan_matches(*other, {}));
}

TEST_CASE("a joint that lies elsewhere is told with its distance") {
  ScanTarget bent = circle();
  bent.joints.col(40) += Eigen::Vector3d(0, 0, 1.2);
  const auto scan = value_of(laid(make_scan(bent, {}), circle()));
  CHECK(scan.max_mm == Approx(1.2).margin(0.15));
  CHECK(scan_matches(scan, {}));
}

TEST_CASE("tops that all lie further out along the normals tell by how much") {
  for (const ScanTarget* form : {&circle(), &hemisphere()})
    for (const double height : {7.5, 3.2}) {
      ScanMaking how;
      how.cylinder.height_mm = height;
      how.missing = 0.1;
      const MadeScan made = make_scan(*form, how);
      const auto scan = value_of(laid(made, *form));
      double told = JointCylinder{}.height_mm + beyond_height(scan, *form);
      CAPTURE(height, told);
      CHECK(told == Approx(height).margin(0.15));
    }
  // of the height known nothing is left
  const auto known = value_of(laid(make_scan(hemisphere(), {}), hemisphere()));
  CHECK(std::abs(beyond_height(known, hemisphere())) < 0.05);
}
