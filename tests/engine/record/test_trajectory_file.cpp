#include <hdf5.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <thread>

#include "engine/core/file_io.h"
#include "engine/record/trajectory_file.h"
#include "tests/engine/record/changed_file.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::record;
namespace fs = std::filesystem;

namespace {

std::string bytes_of(const Trajectory& run) {
  TemporaryFolder folder;
  REQUIRE(write_trajectory(folder / "a.h5", run));
  return read_file(folder / "a.h5").value();
}

/// Checks that two layouts are equal bit for bit, but for `extrapolated`, which is not read.
void check_same(const Layout& a, const Layout& b) {
  const auto numbers = [](const Layout& of) {
    Eigen::VectorXd all(6);
    all << of.spacing_mm, of.rod_diameter_mm, of.length_scale_mm, of.joint_diameter_mm,
        of.joint_height_mm, of.table_mm;
    return all;
  };
  const auto lists = [](const Layout& of) {
    return std::tie(of.diameters_mm, of.laths_mm, of.strength_MPa, of.rods, of.families,
                    of.supports, of.sprung, of.edge_points, of.joints, of.above, of.cells,
                    of.seam_rods);
  };
  CHECK(same_bits(numbers(a), numbers(b)));
  CHECK((lists(a) == lists(b)));
  CHECK(same_bits(a.spring_N_per_mm, b.spring_N_per_mm));
  CHECK(same_bits(a.original_boundary, b.original_boundary));
  CHECK(same_bits(a.actuated_boundary, b.actuated_boundary));
  CHECK(same_bits(a.net_nodes, b.net_nodes));
  CHECK(same_bits(a.flat_nodes, b.flat_nodes));
  REQUIRE(a.parts.size() == b.parts.size());
  for (std::size_t k = 0; k < a.parts.size(); ++k) {
    CHECK((a.parts[k].name == b.parts[k].name && a.parts[k].rods == b.parts[k].rods));
    CHECK(same_bits(a.parts[k].net, b.parts[k].net));
    CHECK(same_bits(a.parts[k].flat, b.parts[k].flat));
  }
  REQUIRE(a.loaded_joints.size() == b.loaded_joints.size());
  for (std::size_t k = 0; k < a.loaded_joints.size(); ++k) {
    CHECK(a.loaded_joints[k].joint == b.loaded_joints[k].joint);
    CHECK(a.loaded_joints[k].direction == b.loaded_joints[k].direction);
    CHECK(a.loaded_joints[k].at_times == b.loaded_joints[k].at_times);
  }
}

}  // namespace

TEST_CASE("a trajectory comes back bit for bit") {
  TemporaryFolder folder;
  const fs::path path = folder / "trajectory.h5";
  Trajectory run = sample_trajectory();
  run.layout.laths_mm = {0, 0, 1.0 / 3, 0.1, 0, 0, 2, 1};
  run.layout.above = {0, 1, 7, 3};
  run.layout.net_nodes = Eigen::Matrix3Xd::Random(3, 12);
  run.layout.flat_nodes = Eigen::Matrix3Xd::Random(3, 12);
  REQUIRE(write_trajectory(path, run));
  CHECK(folder.entries() == std::vector<std::string>{"trajectory.h5"});
  const auto back = value_of(read_trajectory(path));
  check_same(back.layout, run.layout);
  CHECK(back.origin.title == run.origin.title);
  CHECK(back.origin.preset == run.origin.preset);
  CHECK(back.origin.program == run.origin.program);
  REQUIRE(back.frames.size() == run.frames.size());
  for (std::size_t k = 0; k < run.frames.size(); ++k)
    CHECK(packed_frame(back.frames[k]) == packed_frame(run.frames[k]));
}

TEST_CASE("a trajectory without frames, joints or cells comes back too") {
  TemporaryFolder folder;
  const fs::path path = folder / "trajectory.h5";
  Trajectory run;
  run.layout.spacing_mm = 3;
  REQUIRE(write_trajectory(path, run));
  const auto back = value_of(read_trajectory(path));
  check_same(back.layout, run.layout);
  CHECK(back.frames.empty());
}

TEST_CASE("datasets bear their names, shapes and units") {
  TemporaryFolder folder;
  const std::string path = (folder / "trajectory.h5").string();
  REQUIRE(write_trajectory(path, sample_trajectory()));
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const auto unit = [&](const char* name) {
    const hid_t attribute = H5Aopen_by_name(file, name, "unit", H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    char text[16] = {};
    H5Aread(attribute, type, text);
    H5Tclose(type);
    H5Aclose(attribute);
    return std::string(text);
  };
  CHECK(unit("/nodes") == "mm");
  CHECK(unit("/cell_K") == "rad");
  CHECK(unit("/axial_force_N") == "N");
  CHECK(unit("/curvature_per_mm") == "1/mm");
  CHECK(unit("/bending_mJ_per_m") == "mJ/m");
  CHECK(unit("/reactions_N") == "N");
  CHECK(unit("/frames/force_N") == "N");
  CHECK(unit("/frames/energy_bend_mJ") == "mJ");
  CHECK(unit("/layout/original_boundary") == "mm");
  for (const char* name : {"/rods", "/joints", "/cells", "/frames/event", "/frames/actuation"})
    CHECK(H5Lexists(file, name, H5P_DEFAULT) > 0);
  const hid_t nodes = H5Dopen2(file, "/nodes", H5P_DEFAULT), space = H5Dget_space(nodes);
  hsize_t dims[3] = {};
  REQUIRE(H5Sget_simple_extent_ndims(space) == 3);
  H5Sget_simple_extent_dims(space, dims, nullptr);
  CHECK((dims[0] == 3 && dims[1] == 12 && dims[2] == 3));
  H5Sclose(space), H5Dclose(nodes), H5Fclose(file);
}

TEST_CASE("a file that is missing, foreign or cut short is refused in a sentence") {
  CHECK(refusal(read_trajectory("/nonexistent/trajectory.h5"), Fault::io) ==
        "cannot read '/nonexistent/trajectory.h5': No such file or directory");

  CHECK(refusal("x,y\n1,2\n") == "it is not an HDF5 file");
  CHECK(refusal("") == "it is not an HDF5 file");
  const std::string whole = bytes_of(sample_trajectory());
  CHECK(refusal(whole.substr(0, 100)) == "it is cut short");
  const std::string damaged =
      "it is cut short, damaged or was changed: its checksum does not match (of one that another "
      "program changed, --no-checksum, in Python no_checksum=True, reads what there is)";
  for (const double part : {0.3, 0.9})
    CHECK(refusal(whole.substr(0, static_cast<std::size_t>(part * whole.size()))) == damaged);
  // one bit anywhere
  for (const std::size_t at :
       {std::size_t{40}, std::size_t{511}, whole.size() / 2, whole.size() - 1}) {
    std::string wrong = whole;
    wrong[at] = static_cast<char>(wrong[at] ^ 4);
    CHECK(refusal(wrong) == damaged);
  }
  // a file that another program rewrote has no checksum, but must still be complete
  CHECK(refusal(whole.substr(512, 2000), true) == "it is cut short or damaged");
}

TEST_CASE("parts that do not fit each other are neither written nor read") {
  TemporaryFolder folder;
  const fs::path path = folder / "a.h5";
  const auto refused = [&](auto change) {
    Trajectory run = sample_trajectory();
    change(run);
    const auto written = write_trajectory(path, run);
    return written ? std::string("none") : written.error().message;
  };
  CHECK(refused([](Trajectory& run) { run.layout.rods[3][1] = 99; }) ==
        "rod 3: got node 99, expected 0 to 11");
  for (const std::vector<int>& rod : {std::vector<int>{}, {3}})
    CHECK(refused([&](Trajectory& run) { run.layout.rods[1] = rod; }) ==
          fmt::format("rod 1: got {} nodes, expected at least 2", rod.size()));
  CHECK(refused([](Trajectory& run) { run.frames.edit()[2].nodes.conservativeResize(3, 11); }) ==
        "frame 2: got 11 nodes, expected 12 as in the first one");
  CHECK(refused([](Trajectory& run) { run.layout.cells[0].joints[3] = -1; }) ==
        "cell 0: got joint -1, expected 0 to 3");
  CHECK(refused([](Trajectory& run) { run.frames.edit()[0].cell_K.resize(0); }) ==
        "frame 0: got 0 values of cell_K, expected 1");
  CHECK(refused([](Trajectory& run) { run.frames.edit()[2].axial_force_N.resize(11); }) ==
        "axial_force_N of frame 2: got 11 values, expected 12");
  CHECK(refused([](Trajectory& run) { run.layout.families.pop_back(); }) ==
        "3 families are named for 4 rods");
  CHECK(
      refused([](Trajectory& run) { run.layout.actuated_boundary.resize(3, 4); }) ==
      "boundaries: got 5 points of the original and 4 of the actuated one, expected equal numbers");
  CHECK(folder.entries().empty());
  // a file whose index another program changed
  const auto wrong_index = [](hid_t file) {
    const hid_t set = H5Dopen2(file, "/layout/edge_points", H5P_DEFAULT);
    const int nodes[8] = {4, 5, 6, 7, 8, 9, 10, 1234};
    H5Dwrite(set, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, nodes);
    H5Dclose(set);
  };
  CHECK(refusal(changed(wrong_index), true) == "edge point 7: got node 1234, expected 0 to 11");
}

TEST_CASE("a column that an older version did not write is unknown") {
  const auto without = [](hid_t file) {
    for (const char* name :
         {"/frames/energy_load_mJ", "/frames/newton_iterations", "/frames/event"})
      H5Ldelete(file, name, H5P_DEFAULT);
  };
  TemporaryFolder folder;
  const fs::path path = folder / "a.h5";
  REQUIRE(write_file(path, changed(without)));
  const auto back = value_of(read_trajectory(path, {.no_checksum = true}));
  const Frame& frame = back.frames[1];
  CHECK(std::isnan(frame.energies[Term::load]));
  CHECK_FALSE(std::isnan(frame.energies[Term::bend]));
  CHECK(frame.newton_iterations == -1);
  CHECK(frame.event.empty());
}

TEST_CASE("a trajectory that another program rewrote is read only where that is requested") {
  TemporaryFolder folder;
  const fs::path path = folder / "a.h5";
  const Trajectory run = sample_trajectory();
  const std::string bytes = changed([](hid_t) {}, run);
  CHECK(refusal(bytes) ==
        "it has no checksum, so another program wrote it (--no-checksum, in Python "
        "no_checksum=True, reads "
        "it all the same)");
  REQUIRE(write_file(path, bytes));
  const auto back = value_of(read_trajectory(path, {.no_checksum = true}));
  CHECK(same_bits(back.frames[2].nodes, run.frames[2].nodes));
}

TEST_CASE("a trajectory that cannot be written says why and leaves the old one") {
  TemporaryFolder folder;
  const fs::path missing = folder / "none" / "trajectory.h5";
  CHECK(refusal(write_trajectory(missing, sample_trajectory()), Fault::io) ==
        "cannot write '" + missing.string() + "': No such file or directory");

  const fs::path path = folder / "trajectory.h5";
  REQUIRE(write_trajectory(path, sample_trajectory()));
  const std::string before = read_file(path).value();
  Trajectory large = sample_trajectory();
  for (Frame& frame : large.frames.edit()) frame.nodes = Eigen::Matrix3Xd::Zero(3, 10000);
  for (const rlim_t limit : {100, 3000, 100000, 700000}) {
    INFO(limit);
    const FileSizeLimit full_disk(limit);
    CHECK(refusal(write_trajectory(path, large), Fault::io) ==
          "cannot write '" + path.string() + "': File too large");
  }
  CHECK(read_file(path).value() == before);
  CHECK(folder.entries() == std::vector<std::string>{"trajectory.h5"});
  // HDF5 works as before after the failures
  CHECK(write_trajectory(path, large));
  CHECK(read_trajectory(path));
}

TEST_CASE("threads write their trajectories at a time") {
  TemporaryFolder folder;
  std::atomic<int> written = 0;
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      for (int again = 0; again < 20; ++again)
        written += write_trajectory(folder / std::to_string(k), sample_trajectory()).has_value();
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(written == 80);
  CHECK(folder.entries() == std::vector<std::string>{"0", "1", "2", "3"});
  for (const std::string& name : folder.entries()) CHECK(read_trajectory(folder / name));
}
