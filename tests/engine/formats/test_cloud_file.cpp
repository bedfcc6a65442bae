// Clouds of points in files.
#include "tests/results.h"

#include <cstring>

using namespace gridshell;
using preset::read_cloud;

namespace {

std::string fault_of(const std::string& bytes, const std::string& name) {
  return refusal(read_cloud(bytes, name));
}

Eigen::Matrix3Xd two_points() {
  Eigen::Matrix3Xd points(3, 2);
  points << 1, -4, 2, 5e-1, 3, 6;
  return points;
}

}  // namespace

TEST_CASE("points are read of lines, with remarks, normals, colours or columns in any order") {
  const Eigen::Matrix3Xd points = two_points();
  for (const auto& [text, name] : {
           std::pair("1 2 3\n-4 0.5 6\n", "a.xyz"),
           {"# a scan\n\n1,2,3 # first\r\n-4;+5e-1\t6\n", "a.csv"},
           {"1 2 3 0 0 1 255 0 0\n-4 .5 6 0 0 1 9 9 9", "a.TXT"},
           {"x,y,z\n1,2,3\n-4,0.5,6\n", "a.csv"},
           {"i,z_mm,Y,x_mm\n7,3,2,1\n8,6,0.5,-4\n", "a.csv"},
       }) {
    const auto read = read_cloud(text, name);
    INFO(text);
    REQUIRE(read);
    CHECK(*read == points);
  }
}

TEST_CASE("points are the vertices of a PLY, as text and as bytes") {
  const std::string head =
      "element vertex 2\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const auto text = value_of(
      read_cloud("ply\nformat ascii 1.0\n" + head + "1 2 3 9\n-4 0.5 6 9\n3 0 1 1\n", "a.ply"));
  CHECK(text == two_points());
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" + head;
  const Eigen::Matrix3Xd points = two_points();
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto single = float(points(axis, k));
      char raw[4];
      std::memcpy(raw, &single, 4);
      bytes.append(raw, 4);
    }
    bytes += '\x09';
  }
  bytes.append("\x03\0\0\0\0\1\0\0\0\1\0\0\0", 13);
  const auto binary = value_of(read_cloud(bytes, "a.ply"));
  CHECK(binary == two_points());
  CHECK(fault_of(bytes.substr(0, bytes.size() - 20), "a.ply") ==
        "a.ply: vertex 2: the file ends there, or what stands there is no number");
}

TEST_CASE("what is no cloud is refused with its place") {
  CHECK(fault_of("", "a.xyz") == "a.xyz: holds no point");
  CHECK(fault_of("x y z\n", "a.xyz") == "a.xyz: holds no point");
  CHECK(fault_of("1 2\n", "a.xyz") == "a.xyz:1: holds 2 numbers, must be x, y, z");
  CHECK(fault_of("1 2 3\n1 nan 3\n", "a.xyz") == "a.xyz:2: 'nan' is no number");
  CHECK(fault_of("1 2 3\n1 2 inf\n", "a.csv") == "a.csv:2: 'inf' is no number");
  CHECK(fault_of("1 2 3\nfoo 2 3\n", "a.csv") == "a.csv:2: 'foo' is no number");
  CHECK(fault_of("1 2 3e10\n", "a.csv") ==
        "a.csv:1: a coordinate is too large, must be a number of at most 1e9");
  CHECK(fault_of("u,v\n1,2\n", "a.csv") ==
        "a.csv:1: names columns, of which x, y, z (or x_mm, y_mm, z_mm) are missing");
  CHECK(fault_of("1 2 3\n", "a.obj") ==
        "a.obj: its name must end in .ply, .xyz, .txt, .asc or .csv");
  CHECK(fault_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
                 "a.ply") ==
        "a.ply: vertex 1: a coordinate is not a number, must be a number of at most 1e9");
  CHECK(fault_of("ply\nformat ascii 1.0\nend_header\n", "a.ply") == "a.ply: holds no point");
}
