#include <hdf5.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <thread>
#include <utility>

#include "engine/core/atomic_file.h"
#include "engine/record/frame_columns.h"
#include "engine/record/trajectory_file.h"
#include "tests/engine/record/sample_run.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::record;
namespace fs = std::filesystem;

namespace {

void check_same_layout(const Layout& a, const Layout& b) {
  CHECK(same_bits(a.spacing_mm, b.spacing_mm));
  CHECK(same_bits(a.rod_diameter_mm, b.rod_diameter_mm));
  CHECK(same_bits(a.length_scale_mm, b.length_scale_mm));
  CHECK(a.rods == b.rods);
  CHECK(a.edge_points == b.edge_points);
  CHECK(same_bits(a.original_boundary, b.original_boundary));
  CHECK(same_bits(a.actuated_boundary, b.actuated_boundary));
  REQUIRE(a.joints.size() == b.joints.size());
  for (std::size_t k = 0; k < a.joints.size(); ++k) {
    const Joint &x = a.joints[k], &y = b.joints[k];
    CHECK((x.i == y.i && x.j == y.j && x.node == y.node));
    CHECK((same_bits(x.u_mm, y.u_mm) && same_bits(x.v_mm, y.v_mm)));
  }
  REQUIRE(a.cells.size() == b.cells.size());
  for (std::size_t k = 0; k < a.cells.size(); ++k) {
    const Cell &x = a.cells[k], &y = b.cells[k];
    CHECK((x.i == y.i && x.j == y.j && x.joints == y.joints));
    CHECK((same_bits(x.u_mm, y.u_mm) && same_bits(x.v_mm, y.v_mm)));
  }
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
  }
  REQUIRE(a.seam_rods.size() == b.seam_rods.size());
  for (std::size_t k = 0; k < a.seam_rods.size(); ++k) {
    const SeamRod &x = a.seam_rods[k], &y = b.seam_rods[k];
    CHECK((x.seam == y.seam && x.family == y.family));
    CHECK((same_bits(x.line_mm, y.line_mm) && same_bits(x.gap_mm, y.gap_mm)));
    CHECK(same_bits(x.kink_deg, y.kink_deg));
  }
}

bool same(int a, int b) { return a == b; }
bool same(double a, double b) { return same_bits(a, b); }
bool same(const std::string& a, const std::string& b) { return a == b; }

void check_same_frame(const Frame& a, const Frame& b) {
  CHECK(same_bits(a.nodes, b.nodes));
  CHECK(same_bits(a.cell_K, b.cell_K));
  CHECK(same_bits(a.K_bins, b.K_bins));
  CHECK(same_bits(a.actuation, b.actuation));
  for (const FrameColumn& column : frame_columns) {
    INFO(column.name);
    visit_column(column, a, [&]<class T>(const T& x) {
      visit_column(column, b, [&]<class U>(const U& y) {
        if constexpr (std::is_same_v<T, U>) CHECK(same(x, y));
      });
    });
  }
}

/// the message with which a file of these bytes is refused
std::string refusal(const std::string& bytes, bool unsealed = false) {
  TemporaryFolder folder;
  const fs::path path = folder.path() / "trajectory.h5";
  REQUIRE(write_atomically(path, bytes));
  const auto read = read_trajectory(path, {.unsealed = unsealed});
  REQUIRE_FALSE(read);
  CHECK(read.error().fault == Fault::bad_input);
  const std::string start = "'" + path.string() + "' is no trajectory of a run: ";
  CHECK(read.error().message.substr(0, start.size()) == start);
  return read.error().message.substr(start.size());
}

/// a trajectory as another program would leave it, without a seal, changed by `change(file)`
template <class Change>
std::string changed(Change change, const Trajectory& run = sample_trajectory()) {
  TemporaryFolder folder;
  const fs::path path = folder.path() / "a.h5";
  REQUIRE(write_trajectory(path, run));
  REQUIRE(write_atomically(path, read_whole(path)->substr(512)));
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  change(file);
  H5Fclose(file);
  return read_whole(path).value();
}

std::string bytes_of(const Trajectory& run) {
  TemporaryFolder folder;
  REQUIRE(write_trajectory(folder.path() / "a.h5", run));
  return read_whole(folder.path() / "a.h5").value();
}

}  // namespace

TEST_CASE("a trajectory comes back bit for bit") {
  TemporaryFolder folder;
  const fs::path path = folder.path() / "trajectory.h5";
  const Trajectory run = sample_trajectory();
  REQUIRE(write_trajectory(path, run));
  CHECK(folder.entries() == std::vector<std::string>{"trajectory.h5"});
  const auto back = read_trajectory(path);
  REQUIRE(back);
  check_same_layout(back->layout, run.layout);
  REQUIRE(back->frames.size() == run.frames.size());
  for (std::size_t k = 0; k < run.frames.size(); ++k)
    check_same_frame(back->frames[k], run.frames[k]);
}

TEST_CASE("a trajectory without frames, joints or cells comes back too") {
  TemporaryFolder folder;
  const fs::path path = folder.path() / "trajectory.h5";
  Trajectory run;
  run.layout.spacing_mm = 3;
  REQUIRE(write_trajectory(path, run));
  const auto back = read_trajectory(path);
  REQUIRE(back);
  check_same_layout(back->layout, run.layout);
  CHECK(back->frames.empty());
}

TEST_CASE("equal trajectories give equal bytes") {
  const Trajectory run = sample_trajectory();
  CHECK(bytes_of(run) == bytes_of(run));
}

TEST_CASE("datasets bear their names, shapes and units") {
  TemporaryFolder folder;
  const std::string path = (folder.path() / "trajectory.h5").string();
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
  const auto missing = read_trajectory("/nonexistent/trajectory.h5");
  REQUIRE_FALSE(missing);
  CHECK(missing.error().fault == Fault::io);
  CHECK(missing.error().message ==
        "cannot read '/nonexistent/trajectory.h5': No such file or directory");

  CHECK(refusal("x,y\n1,2\n") == "it is not an HDF5 file");
  CHECK(refusal("") == "it is not an HDF5 file");
  const std::string whole = bytes_of(sample_trajectory());
  CHECK(refusal(whole.substr(0, 100)) == "it is cut short");
  const std::string damaged =
      "it is cut short, damaged or was changed: its checksum does not match";
  for (const double part : {0.3, 0.9})
    CHECK(refusal(whole.substr(0, static_cast<std::size_t>(part * whole.size()))) == damaged);
  // one bit anywhere
  for (const std::size_t at :
       {std::size_t{40}, std::size_t{511}, whole.size() / 2, whole.size() - 1}) {
    std::string wrong = whole;
    wrong[at] = static_cast<char>(wrong[at] ^ 4);
    CHECK(refusal(wrong) == damaged);
  }
  // what another program rewrote has no seal, but must still be whole
  CHECK(refusal(whole.substr(512, 2000), true) == "it is cut short or damaged");
}

TEST_CASE("an HDF5 file of something else is refused") {
  TemporaryFolder folder;
  const fs::path path = folder.path() / "other.h5";
  H5Fclose(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  CHECK(refusal(read_whole(path).value(), true) == "it does not say \"gridshell trajectory 1\"");
}

TEST_CASE("a trajectory that lacks a dataset is refused by its name") {
  for (const std::string name : {"/rods", "/nodes", "/joints", "/cell_K", "/layout/edge_points"}) {
    const auto without = [&](hid_t file) { H5Ldelete(file, name.c_str(), H5P_DEFAULT); };
    CHECK(refusal(changed(without), true) == name + " is missing, or a link");
  }
}

TEST_CASE("parts that do not fit each other are neither written nor read") {
  TemporaryFolder folder;
  const fs::path path = folder.path() / "a.h5";
  Trajectory run = sample_trajectory();
  run.layout.rods[3][1] = 99;
  const auto written = write_trajectory(path, run);
  REQUIRE_FALSE(written);
  CHECK(written.error().message == "rod 3 names node 99 of 12");
  CHECK(folder.entries().empty());

  run = sample_trajectory();
  run.frames[2].nodes.conservativeResize(3, 11);
  CHECK(write_trajectory(path, run).error().message == "frame 2 has 11 nodes, the first one 12");
  run = sample_trajectory();
  run.layout.cells[0].joints[3] = -1;
  CHECK(write_trajectory(path, run).error().message == "cell 0 names joint -1 of 4");
  run = sample_trajectory();
  run.frames[0].cell_K.resize(0);
  CHECK(write_trajectory(path, run).error().message ==
        "frame 0 has 0 values of cell_K for 1 cells");
  run = sample_trajectory();
  run.layout.actuated_boundary.resize(3, 4);
  CHECK(write_trajectory(path, run).error().message ==
        "the original boundary has 5 points, the actuated one 4");

  // a file whose index another program changed
  const auto wrong_index = [](hid_t file) {
    const hid_t set = H5Dopen2(file, "/layout/edge_points", H5P_DEFAULT);
    const int nodes[8] = {4, 5, 6, 7, 8, 9, 10, 1234};
    H5Dwrite(set, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, nodes);
    H5Dclose(set);
  };
  CHECK(refusal(changed(wrong_index), true) == "edge point 7 names node 1234 of 12");
}

TEST_CASE("a column that an older version did not write is unknown") {
  const auto without = [](hid_t file) {
    for (const char* name :
         {"/frames/energy_load_mJ", "/frames/newton_iterations", "/frames/event"})
      H5Ldelete(file, name, H5P_DEFAULT);
  };
  TemporaryFolder folder;
  const fs::path path = folder.path() / "a.h5";
  REQUIRE(write_atomically(path, changed(without)));
  const auto back = read_trajectory(path, {.unsealed = true});
  REQUIRE(back);
  const Frame& frame = std::as_const(back->frames)[1];
  CHECK(std::isnan(frame.energies[Term::load]));
  CHECK_FALSE(std::isnan(frame.energies[Term::bend]));
  CHECK(frame.newton_iterations == -1);
  CHECK(frame.event.empty());
}

TEST_CASE("a trajectory that another program rewrote is read only where that is asked for") {
  TemporaryFolder folder;
  const fs::path path = folder.path() / "a.h5";
  const Trajectory run = sample_trajectory();
  const std::string bytes = changed([](hid_t) {}, run);
  CHECK(
      refusal(bytes) ==
      "it bears no seal, so another program wrote it ('render --unsealed' reads it all the same)");
  REQUIRE(write_atomically(path, bytes));
  const auto back = read_trajectory(path, {.unsealed = true});
  REQUIRE(back);
  CHECK(same_bits(back->frames[2].nodes, run.frames[2].nodes));
}

TEST_CASE("objects that are not what they should be are refused before anything of them is read") {
  const auto put = [](hid_t file, const char* name, hid_t type, std::vector<hsize_t> dims,
                      hid_t how = H5P_DEFAULT) {
    H5Ldelete(file, name, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(int(dims.size()), dims.data(), nullptr);
    H5Dclose(H5Dcreate2(file, name, type, space, H5P_DEFAULT, how, H5P_DEFAULT));
    H5Sclose(space);
  };
  const auto after = [&](auto change) { return refusal(changed(change), true); };
  SECTION("an attribute of many numbers") {
    CHECK(after([](hid_t file) {
            std::vector<double> many(2000, 1.0);
            H5Adelete_by_name(file, "/layout", "spacing_mm", H5P_DEFAULT);
            const hsize_t size = many.size();
            const hid_t space = H5Screate_simple(1, &size, nullptr);
            const hid_t made = H5Acreate_by_name(file, "/layout", "spacing_mm", H5T_NATIVE_DOUBLE,
                                                 space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
            H5Awrite(made, H5T_NATIVE_DOUBLE, many.data());
            H5Aclose(made), H5Sclose(space);
          }) == "/layout has no number spacing_mm");
  }
  SECTION("a text of many elements") {
    CHECK(after([](hid_t file) {
            H5Adelete(file, "format");
            const hid_t type = H5Tcopy(H5T_C_S1);
            H5Tset_size(type, 22);
            const hsize_t size = 100;
            const hid_t space = H5Screate_simple(1, &size, nullptr);
            H5Aclose(H5Acreate2(file, "format", type, space, H5P_DEFAULT, H5P_DEFAULT));
            H5Sclose(space), H5Tclose(type);
          }) == "it does not say \"gridshell trajectory 1\"");
  }
  SECTION("text where numbers are due") {
    CHECK(after([&](hid_t file) {
            const hid_t type = H5Tcopy(H5T_C_S1);
            H5Tset_size(type, 8);
            put(file, "/nodes", type, {3, 12, 3});
          }) == "/nodes is of another type");
  }
  SECTION("another number of dimensions") {
    CHECK(after([&](hid_t file) {
            const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
            H5Pset_alloc_time(how, H5D_ALLOC_TIME_EARLY);
            put(file, "/nodes", H5T_NATIVE_DOUBLE, {3, 36}, how);
          }) == "/nodes has 2 dimensions, expected 3");
  }
  SECTION("more rows than the file has bytes") {
    CHECK(after([&](hid_t file) {
            put(file, "/nodes", H5T_NATIVE_DOUBLE, {hsize_t(1) << 50, 12, 3});
          }) == "/nodes claims to hold more than the file does");
  }
  SECTION("numbers in another file") {
    CHECK(after([&](hid_t file) {
            const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
            H5Pset_external(how, "/etc/hostname", 0, H5F_UNLIMITED);
            put(file, "/nodes", H5T_NATIVE_DOUBLE, {3, 12, 3}, how);
          }) == "/nodes is not stored plainly in this file");
  }
  SECTION("a link to another file") {
    CHECK(after([](hid_t file) {
            H5Ldelete(file, "/nodes", H5P_DEFAULT);
            H5Lcreate_external("/tmp/other.h5", "/nodes", file, "/nodes", H5P_DEFAULT, H5P_DEFAULT);
          }) == "/nodes is missing, or a link");
  }
  SECTION("a rod of three million nodes") {
    CHECK_THAT(after([](hid_t file) {
                 std::vector<int> nodes(3000000, 1);
                 hvl_t list{nodes.size(), nodes.data()};
                 const hid_t type = H5Tvlen_create(H5T_NATIVE_INT);
                 const hsize_t one = 1;
                 const hid_t space = H5Screate_simple(1, &one, nullptr);
                 H5Ldelete(file, "/rods", H5P_DEFAULT);
                 const hid_t set =
                     H5Dcreate2(file, "/rods", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
                 H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &list);
                 H5Dclose(set), H5Sclose(space), H5Tclose(type);
               }),
               Catch::Contains("nodes of 12"));
  }
}

TEST_CASE("a trajectory that cannot be written says why and leaves the old one") {
  TemporaryFolder folder;
  const fs::path missing = folder.path() / "none" / "trajectory.h5";
  const auto nowhere = write_trajectory(missing, sample_trajectory());
  REQUIRE_FALSE(nowhere);
  CHECK(nowhere.error().fault == Fault::io);
  CHECK(nowhere.error().message ==
        "cannot write '" + missing.string() + "': No such file or directory");

  const fs::path path = folder.path() / "trajectory.h5";
  REQUIRE(write_trajectory(path, sample_trajectory()));
  const std::string before = read_whole(path).value();
  Trajectory large = sample_trajectory();
  for (Frame& frame : large.frames) frame.nodes = Eigen::Matrix3Xd::Zero(3, 10000);
  for (const rlim_t limit : {100, 3000, 100000, 700000}) {
    INFO(limit);
    const FileSizeLimit full_disk(limit);
    const auto written = write_trajectory(path, large);
    REQUIRE_FALSE(written);
    CHECK(written.error().message == "cannot write '" + path.string() + "': File too large");
  }
  CHECK(read_whole(path).value() == before);
  CHECK(folder.entries() == std::vector<std::string>{"trajectory.h5"});
  // and the library is fit for the next run
  CHECK(write_trajectory(path, large));
  CHECK(read_trajectory(path));
}

TEST_CASE("threads write their trajectories at a time") {
  TemporaryFolder folder;
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      for (int again = 0; again < 20; ++again)
        (void)write_trajectory(folder.path() / std::to_string(k), sample_trajectory());
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(folder.entries() == std::vector<std::string>{"0", "1", "2", "3"});
  for (const std::string& name : folder.entries()) CHECK(read_trajectory(folder.path() / name));
}
