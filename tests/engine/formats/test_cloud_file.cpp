// Clouds of points in files.
#include "tests/results.h"

#include <cstring>

using namespace gridshell;
using preset::read_cloud;

namespace {

std::string error_of(const std::string& bytes, const std::string& name) {
  return refusal(read_cloud(bytes, name));
}

Eigen::Matrix3Xd two_points() {
  Eigen::Matrix3Xd points(3, 2);
  points << 1, -4, 2, 5e-1, 3, 6;
  return points;
}

}  // namespace

TEST_CASE("points are read from lines with remarks, normals, colours or columns in any order") {
  const Eigen::Matrix3Xd points = two_points();
  for (const auto& [text, name] : {
           std::pair("1 2 3\n-4 0.5 6\n", "a.xyz"),
           {"# a scan\n\n1,2,3 # first\r\n-4;+5e-1\t6\n", "a.csv"},
           {"1 2 3 0 0 1 255 0 0\n-4 .5 6 0 0 1 9 9 9", "a.TXT"},
           {"x,y,z\n1,2,3\n-4,0.5,6\n", "a.csv"},
           {"i,z_mm,Y,x_mm\n7,3,2,1\n8,6,0.5,-4\n", "a.csv"},
           {"x;y;z\n1,0;2;3\n-4;0,5;6\n", "a.csv"},
           {"1,0 2,0 3,0\n-4,0 0,5 6,0\n", "a.xyz"},
           {"2\n1 2 3 -900 255 0 0\n-4 0.5 6 -900 255 0 0\n", "a.pts"},
           {"//X Y Z R G B\n2\n1 2 3 9 9 9\n-4 0.5 6 9 9 9\n", "a.asc"},
           {"Point ID,Intensity,X,Y,Z\nA1,9,1,2,3\nA2,9,-4,0.5,6\n", "a.csv"},
           {"\"Points:0\",\"Points:1\",\"Points:2\"\n1,2,3\n-4,0.5,6\n", "a.csv"},
           {"X[m],Y[m],Z[m]\n0.001,0.002,0.003\n-0.004,0.0005,0.006\n", "a.csv"},
       }) {
    const auto read = read_cloud(text, name);
    INFO(text);
    REQUIRE(read);
    CHECK(read->points == points);
  }
}

TEST_CASE("points are the vertices of a PLY, as text and as bytes") {
  const std::string head =
      "element vertex 2\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const auto text = value_of(
      read_cloud("ply\nformat ascii 1.0\n" + head + "1 2 3 9\n-4 0.5 6 9\n3 0 1 1\n", "a.ply"));
  CHECK(text.points == two_points());
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
  CHECK(binary.points == two_points());
  CHECK(error_of(bytes.substr(0, bytes.size() - 20), "a.ply") ==
        "a.ply: vertex 2: got the end of the file or no number, expected a number");
}

TEST_CASE("rows without a point are left out and counted, and a file may be in metres") {
  const auto rows = value_of(read_cloud("nan nan nan\n1 2 3\nNaN NaN NaN 7\n-4 .5 6\n", "a.xyz"));
  CHECK(rows.points == two_points());
  CHECK(rows.empty_rows == 2);
  const auto vertices = value_of(
      read_cloud("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nend_header\n1 2 3\nnan nan nan\n-4 0.5 6\n",
                 "a.ply"));
  CHECK(vertices.points == two_points());
  CHECK(vertices.empty_rows == 1);
  CHECK(value_of(read_cloud("1 2 3\n-4 .5 6\n", "a.xyz", 10)).points == 10 * two_points());
  CHECK(value_of(read_cloud("x_mm y_mm z_mm\n1 2 3\n-4 .5 6\n", "a.xyz", 10)).points ==
        two_points());
}

TEST_CASE("rows with two readings are refused") {
  CHECK_THAT(error_of("1,5,2,5,3,5\n4,5,5,5,6,5\n", "a.csv"),
             Catch::Contains("a.csv:1: six whole numbers between commas: decimal commas, or"));
  CHECK_THAT(error_of("1 9 8 7\n2 8 7 6\n3 7 6 5\n", "a.xyz"),
             Catch::Contains("a.xyz:1: the first column counts the rows"));
  CHECK_THAT(error_of("2\n2\n0 0 0\n", "a.txt"), Catch::Contains("a.txt:2: a second count"));
  CHECK(error_of("1 2 3 9 9\n4 5 6 9\n", "a.xyz") ==
        "a.xyz:2: got 4 values, expected 5, as in the rows before");
}

TEST_CASE("what is no cloud is refused with its position") {
  const std::string numbers = ", expected 3 numbers: x, y, z",
                    none = "a.xyz: got no point, expected one per line, 3 numbers: x, y, z";
  CHECK(error_of("", "a.xyz") == none);
  CHECK(error_of("x y z\n", "a.xyz") == none);
  CHECK(error_of("1 2\n", "a.xyz") == "a.xyz:1: got 2 values" + numbers);
  CHECK(error_of("1 2 3\n1 nan 3\n", "a.xyz") ==
        "a.xyz:2: got 'nan', which is no number" + numbers);
  CHECK(error_of("1 2 3\n1 2 inf\n", "a.csv") ==
        "a.csv:2: got 'inf', which is no number" + numbers);
  CHECK(error_of("1 2 3\nfoo 2 3\n", "a.csv") ==
        "a.csv:2: got 'foo', which is no number" + numbers);
  CHECK(error_of("1 2 3e10\n", "a.csv") ==
        "a.csv:1: got a coordinate that is too large, expected a number of at most 1e9");
  CHECK(error_of("u,v\n1,2\n", "a.csv") ==
        "a.csv:1: got columns 'u', 'v', of which x, y, z are missing (a remark begins with #)");
  CHECK(error_of("1 2 3\n", "a.obj") ==
        "a.obj: expected a name that ends in .ply, .xyz, .txt, .asc, .csv or .pts");
  CHECK(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
                 "a.ply") ==
        "a.ply: vertex 1: got a coordinate that is not a number, expected a number of at most 1e9");
  CHECK(error_of("ply\nformat ascii 1.0\nend_header\n", "a.ply") == "a.ply: got no point");
}
