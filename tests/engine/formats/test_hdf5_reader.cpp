// Trajectories whose datasets are missing, links to elsewhere, or made by another program.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <new>
#include <thread>
#include <vector>

#include "engine/core/system_info.h"
#include "engine/formats/hdf5_file.h"
#include "tests/engine/record/changed_file.h"

using namespace gridshell;
using namespace gridshell::record;
namespace fs = std::filesystem;

TEST_CASE("an HDF5 file of something else is refused") {
  TemporaryFolder folder;
  const fs::path path = folder / "other.h5";
  H5Fclose(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  CHECK(refusal(read_file(path).value(), true) ==
        "it is not of the format \"gridshell trajectory 1\"");
}

TEST_CASE("a trajectory that lacks a dataset is refused by its name") {
  for (const std::string name : {"/rods", "/nodes", "/joints", "/cell_K", "/layout/edge_points"}) {
    const auto without = [&](hid_t file) { H5Ldelete(file, name.c_str(), H5P_DEFAULT); };
    CHECK(refusal(changed(without), true) == name + " is missing, or a link");
  }
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
  // an attribute of many numbers
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
  // a text of many elements
  CHECK(after([](hid_t file) {
          H5Adelete(file, "format");
          const hid_t type = H5Tcopy(H5T_C_S1);
          H5Tset_size(type, 22);
          const hsize_t size = 100;
          const hid_t space = H5Screate_simple(1, &size, nullptr);
          H5Aclose(H5Acreate2(file, "format", type, space, H5P_DEFAULT, H5P_DEFAULT));
          H5Sclose(space), H5Tclose(type);
        }) == "it is not of the format \"gridshell trajectory 1\"");
  // text where numbers are due
  CHECK(after([&](hid_t file) {
          const hid_t type = H5Tcopy(H5T_C_S1);
          H5Tset_size(type, 8);
          put(file, "/nodes", type, {3, 12, 3});
        }) == "/nodes is of another type");
  // another number of dimensions
  CHECK(after([&](hid_t file) {
          const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
          H5Pset_alloc_time(how, H5D_ALLOC_TIME_EARLY);
          put(file, "/nodes", H5T_NATIVE_DOUBLE, {3, 36}, how);
        }) == "/nodes has 2 dimensions, expected 3");
  // more rows than the file has bytes
  CHECK(after([&](hid_t file) {
          put(file, "/nodes", H5T_NATIVE_DOUBLE, {hsize_t(1) << 50, 12, 3});
        }) == "/nodes claims to contain more than the file does");
  // numbers in another file
  CHECK(after([&](hid_t file) {
          const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
          H5Pset_external(how, "/etc/hostname", 0, H5F_UNLIMITED);
          put(file, "/nodes", H5T_NATIVE_DOUBLE, {3, 12, 3}, how);
        }) == "/nodes is not stored plainly in this file");
  // a link to another file
  CHECK(after([](hid_t file) {
          H5Ldelete(file, "/nodes", H5P_DEFAULT);
          H5Lcreate_external("/tmp/other.h5", "/nodes", file, "/nodes", H5P_DEFAULT, H5P_DEFAULT);
        }) == "/nodes is missing, or a link");
  // a rod of three million nodes
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

TEST_CASE("a reading in a process of its own gets no more than a part of the machine's memory") {
  const auto taking = [](std::uint64_t bytes) {
    return read_in_subprocess([bytes] {
      // allocated, not touched: the limit refuses it
      void* memory = std::malloc(bytes);
      if (!memory) throw std::bad_alloc();
      std::free(memory);
    });
  };
  CHECK(taking(std::uint64_t(256) << 20));
  const std::uint64_t most = std::max(machine_memory_bytes() / 4, std::uint64_t(1) << 30);
  CHECK_THAT(gridshell::refusal(taking(most + (std::uint64_t(64) << 20))),
             Catch::Contains("does not survive reading it"));
}

TEST_CASE(
    "a reading in a process of its own is judged where ended processes leave no status, too") {
  for (const auto on_end : {SIG_DFL, SIG_IGN}) {
    const auto before = std::signal(SIGCHLD, on_end);
    CHECK(read_in_subprocess([] {}));
    for (const auto& failing : {std::function<void()>([] { std::abort(); }),
                                std::function<void()>([] { throw std::bad_alloc(); })})
      CHECK_THAT(gridshell::refusal(read_in_subprocess(failing)),
                 Catch::Contains("does not survive reading it"));
    std::signal(SIGCHLD, before);
  }
}

TEST_CASE("the time of a reading is that of the processor, so that a stopped program may continue",
          "[full]") {
  CHECK(read_in_subprocess([] { std::this_thread::sleep_for(std::chrono::seconds(21)); }));
  CHECK_THAT(gridshell::refusal(read_in_subprocess([] {
               for (volatile bool endless = true; endless;) continue;
             })),
             Catch::Contains("takes more than 20 s"));
}
