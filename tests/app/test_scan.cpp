// The command `scan`, on clouds made of a run.
#include "engine/core/json.h"
#include "engine/record/trajectory_file.h"
#include "tests/app/bench.h"
#include "tests/engine/study/synthetic_scan.h"

using namespace gridshell;
using namespace gridshell::study;

namespace {

void write_text(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

void write_cloud(const Eigen::Matrix3Xd& cloud, const fs::path& file) {
  std::ofstream out(file);
  out << "x_mm,y_mm,z_mm\n";
  for (const auto& p : cloud.colwise()) out << p.x() << "," << p.y() << "," << p.z() << "\n";
}

/// A shell with 6 rods per direction, contracted to that radius.
void form(const std::string& radius_mm, const std::string& name, const fs::path& at) {
  const auto ended =
      good({"run", "s1_actuation", "--set", "footprint.rods=6", "--set", "footprint.radius_mm=60",
            "--set", "actuation.radius_mm=" + radius_mm, "--set", "accuracy.edges_per_segment=4",
            "--frames", "2", "--quiet", "-o", name},
           at);
}

}  // namespace

TEST_CASE("a scan of a run shows that run, with its joints, its picture and what overlays take",
          "[standard]") {
  const TemporaryFolder at;
  form("48", "run", at);
  form("52", "wide", at);
  const auto run = record::read_trajectory(at / "run" / "trajectory.h5");
  REQUIRE(run);
  const ScanTarget shell = form_of(run->layout, run->frames.back());
  ScanMaking how;
  how.missing = 0.1;
  how.spurious = 3;
  write_cloud(make_scan(shell, how).cloud, at / "cloud.csv");
  const auto scan = gridshell_program("scan cloud.csv wide run --size 320x240", at);
  INFO(scan.out << scan.err);
  REQUIRE(scan.code == 0);
  CHECK_THAT(scan.out, Contains("out/cloud_scan: shows run\n"));
  const fs::path out = at / "out" / "cloud_scan";
  const auto json = parsed(text_of(out / "scan.json"));
  CHECK(json["state"] == "run");
  CHECK(json["states"].size() == 2);
  CHECK(json["joints_found"].get<int>() + json["joints_missing"].get<int>() ==
        int(shell.joints.cols()));
  CHECK(json["joints_missing"].get<int>() == int(0.1 * double(shell.joints.cols())));
  CHECK(json["rms_mm"].get<double>() < 0.15);
  const std::string csv = text_of(out / "scan.csv");
  CHECK(csv.starts_with("i,j,x_mm,y_mm,z_mm,distance_mm,distance_radii\n"));
  CHECK(std::ranges::count(csv, '\n') == 1 + shell.joints.cols());
  for (const char* name : {"scan.png", "measured.csv", "manifest.txt"})
    CHECK(fs::exists(out / name));
  // a scan replaces the folder of a scan
  CHECK(gridshell_program("scan cloud.csv run --quiet --size 320x240", at).code == 0);
  CHECK(gridshell_program("check s1_actuation --set figure.scan=out/cloud_scan/measured.csv", at)
            .code == 0);
  // a cloud of another state than the only given one fits nothing
  const auto other = gridshell_program("scan cloud.csv wide --size 320x240 -o other", at);
  CHECK(other.code == 3);
  CHECK_THAT(other.out, Contains("other: does not show wide\n"));
  CHECK(parsed(text_of(at / "other" / "scan.json"))["joint_height_that_fits_mm"].is_null());
  // joints of another height: the key that is wrong, and what it should be
  how.cylinder.height_mm = 7.5;
  write_cloud(make_scan(shell, how).cloud, at / "high.csv");
  const auto high = gridshell_program("scan high.csv run --size 320x240 -o high", at);
  CHECK(high.code == 3);
  CHECK_THAT(high.out,
             Contains("further out along the normals than [joints] height_mm = 5 assumes") &&
                 Contains("with --set joints.height_mm=7.5") && Contains("it shows run"));
  CHECK(parsed(text_of(at / "high" / "scan.json"))["joint_height_that_fits_mm"].get<double>() ==
        Approx(7.5).margin(0.1));
  // centres of the joints, which are taken for the tops of their cylinders
  write_cloud(shell.joints, at / "joints.csv");
  const auto centres = gridshell_program("scan joints.csv run --size 320x240 -o centres", at);
  CHECK(centres.code == 3);
  CHECK_THAT(centres.out, Contains("with --centres it shows run\n"));
  CHECK(parsed(text_of(at / "centres" / "scan.json"))["joint_height_that_fits_mm"] == 0);
}

TEST_CASE("clouds and runs that are none leave a sentence and no folder") {
  const TemporaryFolder at;
  form("48", "run", at);
  const auto refused = [&](const std::string& name, const std::string& text) {
    write_text(at / name, text);
    const auto ended = gridshell_program({"scan", name, "run", "-o", "scan"}, at);
    CHECK(ended.code == 2);
    CHECK_FALSE(fs::exists(at / "scan"));
    return ended.err;
  };
  CHECK_THAT(refused("a.xyz", ""), Contains("a.xyz: got no point"));
  CHECK_THAT(refused("a.xyz", "1 2 nan\n"), Contains("a.xyz:1: got 'nan', which is no number"));
  CHECK_THAT(refused("a.obj", "1 2 3\n"), Contains("a name that ends in"));
  CHECK_THAT(refused("a.xyz", "1 2 3\n9 5 6\n"), Contains("no given shell has its joints there"));
  CHECK_THAT(refused("a.xyz", "1 2 3\n1e9 5 6\n"), Contains("the points extend over 1e+09 mm"));
  CHECK_THAT(gridshell_program("scan none.xyz run", at).err, Contains("none.xyz"));
  CHECK_THAT(gridshell_program("scan a.xyz .", at).err, Contains("is no run"));
  CHECK_THAT(gridshell_program("scan a.xyz run --set rod.young_GPa=70", at).err,
             Contains("cannot change once a run is finished"));
}

TEST_CASE("a tolerance of any size is taken, also for joints that were measured themselves") {
  const TemporaryFolder at;
  form("48", "run", at);
  const auto run = record::read_trajectory(at / "run" / "trajectory.h5");
  REQUIRE(run);
  Eigen::Matrix3Xd joints = form_of(run->layout, run->frames.back()).joints;
  // each is displaced by 0.4 mm, up or down
  for (Eigen::Index k = 0; k < joints.cols(); ++k) joints(2, k) += k % 2 == 0 ? 0.4 : -0.4;
  write_cloud(joints, at / "joints.csv");
  const auto scan = [&](const std::string& tolerance, const std::string& folder) {
    return gridshell_program({"scan", "joints.csv", "run", "--centres", "--size", "320x240",
                              "--tolerance", tolerance, "-o", folder},
                             at);
  };
  const auto far = scan("0.05", "far");
  INFO(far.out << far.err);
  CHECK(far.code == 3);
  CHECK_THAT(far.out, Contains("exceeds the tolerance of 0.05 mm") && !Contains("nan"));
  CHECK(scan("0.5", "near").code == 0);
}
