// Clusters of points, registration of points, and scans made of simulated shells, with a known
// pose.
#include "engine/study/scan.h"

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
    preset::Preset p = on_net();
    p.footprint.placement = Placement::half;
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

/// Whether a scan shows a form, by its own noise.
bool shows(const Eigen::Matrix3Xd& cloud, const ScanTarget& form) {
  const auto clusters = value_of(cluster_joint_tops(cloud, 3));
  const auto scan = register_points(clusters, form, {});
  return scan && scan_matches(*scan, match_tolerance_mm(clusters, {}));
}

}  // namespace

namespace {

/// points on a level disc, evenly
void add_disc(const Eigen::Vector3d& middle, double radius, int points, unsigned seed,
              std::vector<Eigen::Vector3d>& cloud) {
  std::mt19937_64 draw(seed);
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < points; ++k) {
    const double r = radius * std::sqrt(share(draw)), angle = 2 * M_PI * share(draw);
    cloud.push_back(middle + Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0));
  }
}

Eigen::Matrix3Xd matrix_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3Xd matrix(3, Eigen::Index(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) matrix.col(Eigen::Index(k)) = points[k];
  return matrix;
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
        CHECK(scan_matches(scan, 1.5));
        CHECK(scan.rms_mm < 0.1);
        CHECK(scan.found == int(made.joints.size()));
        CHECK(wrong_joints(made, *form, scan, 5) == 0);
        CHECK(int(scan.outliers.cols()) <= spurious);
      }
}

TEST_CASE("a scan of another shell shows none") {
  const MadeScan made = make_scan(hemisphere(), {});
  const auto scan = laid(made, circle());
  if (scan) CHECK_FALSE(scan_matches(*scan, 1.5));
  // a shell with every third joint displaced by more than the tolerance is another one, too
  ScanTarget bent = circle();
  for (Eigen::Index k = 0; k < bent.joints.cols(); k += 3) bent.joints(2, k) += 5;
  const auto other = laid(make_scan(bent, {}), circle());
  if (other) CHECK_FALSE(scan_matches(*other, 1.5));
}

TEST_CASE("a dent is no noise: the misfit is compared with how much the points scatter") {
  // all joints within two joints of the pole pushed in, most by 7 mm
  ScanTarget dented = hemisphere();
  const Eigen::Vector3d pole(0, 0, dented.joints.row(2).maxCoeff());
  for (Eigen::Index k = 0; k < dented.joints.cols(); ++k) {
    const double way = (dented.joints.col(k) - pole).norm() / 60;
    dented.joints.col(k) -= 7 * std::exp(-way * way) * dented.normals.col(k);
  }
  const MadeScan made = make_scan(dented, {});
  const auto clusters = value_of(cluster_joint_tops(made.cloud, 3));
  const auto scan = value_of(register_points(clusters, hemisphere(), {}));
  CAPTURE(clusters.noise_mm, scan.rms_mm);
  // within two radii every joint, and rms within a radius
  CHECK(scan_matches(scan, 1.5));
  CHECK(scan.rms_mm > 5 * clusters.noise_mm);
  CHECK_FALSE(shows(made.cloud, hemisphere()));
  CHECK(shows(made.cloud, dented));
  CHECK(shows(make_scan(hemisphere(), {}).cloud, hemisphere()));
}

TEST_CASE("half a shell over a table is found, and one seen from one side") {
  const MadeScan whole = make_scan(circle(), {});
  // the points on one side of a plane through the middle of the scan, in the scan's own frame
  const Eigen::Vector3d middle = whole.cloud.rowwise().mean();
  const Eigen::Vector3d low = whole.cloud.rowwise().minCoeff(),
                        high = whole.cloud.rowwise().maxCoeff();
  std::vector<Eigen::Vector3d> half;
  for (const auto& p : whole.cloud.colwise())
    if (p.x() + 0.3 * p.y() > middle.x() + 0.3 * middle.y()) half.push_back(p);
  CHECK(shows(matrix_of(half), circle()));
  // a table next to the shell and below it, each point separate
  std::mt19937_64 draw(5);
  std::uniform_real_distribution<double> share(-0.5, 1.5);
  std::vector<Eigen::Vector3d> over_table = half;
  for (int k = 0; k < 6000; ++k)
    over_table.emplace_back(low.x() + share(draw) * (high.x() - low.x()),
                            low.y() + share(draw) * (high.y() - low.y()), low.z() - 40);
  CHECK(shows(matrix_of(over_table), circle()));
  CHECK_FALSE(shows(matrix_of(over_table), hemisphere()));
  // other discs, away from the shell
  std::vector<Eigen::Vector3d> among = half;
  for (int k = 0; k < 40; ++k)
    add_disc({high.x() + 60 + 15 * (k % 8), low.y() + 15 * (k / 8), high.z() + 30}, 1.5, 60,
             unsigned(100 + k), among);
  CHECK(shows(matrix_of(among), circle()));
}

TEST_CASE("a joint that lies elsewhere is reported with its distance") {
  ScanTarget bent = circle();
  bent.joints.col(40) += Eigen::Vector3d(0, 0, 1.2);
  const auto scan = value_of(laid(make_scan(bent, {}), circle()));
  CHECK(scan.max_mm == Approx(1.2).margin(0.15));
  CHECK(scan_matches(scan, 1.5));
}

TEST_CASE("tops that all lie further out along the normals give the offset") {
  for (const ScanTarget* form : {&circle(), &hemisphere()})
    for (const double height : {7.5, 3.2}) {
      ScanMaking how;
      how.cylinder.height_mm = height;
      how.missing = 0.1;
      const MadeScan made = make_scan(*form, how);
      const auto scan = value_of(laid(made, *form));
      double reported = JointCylinder{}.height_mm + excess_height(scan, *form);
      CAPTURE(height, reported);
      CHECK(reported == Approx(height).margin(0.15));
    }
  // with the known height nothing remains
  const auto known = value_of(laid(make_scan(hemisphere(), {}), hemisphere()));
  CHECK(std::abs(excess_height(known, hemisphere())) < 0.05);
}

TEST_CASE("separate discs are clusters, each with its middle, whatever part of it is seen more") {
  std::vector<Eigen::Vector3d> cloud;
  const Eigen::Vector3d a(0, 0, 1), b(6, 0, 2), c(0, 7, -3);
  add_disc(a, 1.5, 400, 1, cloud);
  add_disc(b, 1.5, 400, 2, cloud);
  add_disc(c, 1.5, 150, 3, cloud);
  // one half of c is seen twice as well
  std::vector<Eigen::Vector3d> more;
  add_disc(c, 1.5, 300, 4, more);
  for (const auto& p : more)
    if (p.x() > 0) cloud.push_back(p);
  const auto found = value_of(cluster_joint_tops(matrix_of(cloud), 3));
  REQUIRE(found.tops.cols() == 3);
  CHECK(found.specks == 0);
  CHECK(found.others == 0);
  for (const Eigen::Vector3d& middle : {a, b, c})
    CHECK((found.tops.colwise() - middle).colwise().norm().minCoeff() < 0.06);
}

TEST_CASE("single points are specks among discs, joints where there is nothing else") {
  std::vector<Eigen::Vector3d> cloud;
  add_disc({0, 0, 0}, 1.5, 100, 1, cloud);
  add_disc({20, 0, 0}, 1.5, 100, 2, cloud);
  cloud.emplace_back(10, 10, 10);
  cloud.emplace_back(-10, 10, 10);
  auto found = cluster_joint_tops(matrix_of(cloud), 3);
  REQUIRE(found);
  CHECK(found->tops.cols() == 2);
  CHECK(found->specks == 2);
  // a table, wider than any joint
  for (int k = 0; k < 60; ++k) cloud.emplace_back(-40, 0.5 * k, 0);
  found = cluster_joint_tops(matrix_of(cloud), 3);
  REQUIRE(found);
  CHECK(found->tops.cols() == 2);
  CHECK(found->others == 1);

  Eigen::Matrix3Xd single(3, 4);
  single << 0, 20, 0, 20, 0, 0, 20, 20, 0, 0, 0, 5;
  found = cluster_joint_tops(single, 3);
  REQUIRE(found);
  CHECK(found->tops.cols() == 4);
}

TEST_CASE("points that no shell of such joints could have are refused") {
  Eigen::Matrix3Xd far(3, 2);
  far << 0, 1e9, 0, 0, 0, 0;
  CHECK(refusal(cluster_joint_tops(far, 3)) ==
        "the points extend over 1e+09 mm, too far for joints of 3 mm: check --unit");
}

namespace {

/// a bump without symmetry
Eigen::Matrix3Xd bump() {
  Eigen::Matrix3Xd places(3, 49);
  for (int k = 0; k < 49; ++k) {
    const int column = k % 7 - 3, row = k / 7 - 3;
    const double x = 20 * column, y = 20 * row;
    places.col(k) << x, y, 40 * std::exp(-(x * x + 2 * y * y + x * y) / 3000) + 0.1 * x;
  }
  return places;
}

const Pose tilted{Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 2, -2) / 3).toRotationMatrix(),
                  {500, -20, 7}};

}  // namespace

TEST_CASE("positions find their points again in any pose, exactly") {
  const Eigen::Matrix3Xd places = bump(), points = tilted.of(places);
  const auto found = value_of(register_points(points, places, {}));
  CHECK(found.found == 49);
  for (int k = 0; k < 49; ++k) CHECK(found.point_of[std::size_t(k)] == k);
  CHECK(found.distance.maxCoeff() < 1e-9);
  CHECK((found.pose.of(points) - places).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(found.cost < 1e-15);
}

TEST_CASE("a third missing and as many that belong nowhere mislead nobody") {
  const Eigen::Matrix3Xd places = bump();
  Eigen::Matrix3Xd points(3, 49);
  std::mt19937_64 draw(3);
  std::uniform_real_distribution<double> share(-1, 1);
  for (int k = 0; k < 49; ++k)
    points.col(k) = k % 3 == 0
                        ? Eigen::Vector3d(90 * share(draw), 90 * share(draw), 60 + 40 * share(draw))
                        : Eigen::Vector3d(places.col(k));
  const auto found = value_of(register_points(tilted.of(points), places, {}));
  CHECK(found.found == 32);
  for (int k = 0; k < 49; ++k) CHECK(found.point_of[std::size_t(k)] == (k % 3 == 0 ? -1 : k));
  CHECK(found.cost == Approx(17 * 9));
}

TEST_CASE("a mirror image is another shape, and too few points give no pose") {
  const Eigen::Matrix3Xd places = bump();
  const Eigen::Matrix3Xd mirrored = Eigen::Vector3d(-1, 1, 1).asDiagonal() * places;
  const auto found = value_of(register_points(tilted.of(mirrored), places, {}));
  CHECK(found.cost > 49);
  CHECK(found.pose.turn.determinant() == Approx(1));
  CHECK_FALSE(register_points(places.leftCols(3), places, {}));
  CHECK_FALSE(register_points(Eigen::Matrix3Xd::Zero(3, 10), places, {}));
}

TEST_CASE("normals of a network's joints are those of the same grid, upwards") {
  preset::Preset p = small_shell();
  p.accuracy.edges_per_segment = 2;
  auto outcome = run(p);
  const record::Frame& frame = last_frame(outcome);
  const ScanTarget grid = form_of(outcome.trajectory.layout, frame);
  REQUIRE(grid.normals.row(2).minCoeff() > 0);
  for (std::string& family : outcome.trajectory.layout.families) family = "other";
  const ScanTarget network = form_of(outcome.trajectory.layout, frame);
  CHECK((network.normals - grid.normals).norm() < 1e-12);
}
