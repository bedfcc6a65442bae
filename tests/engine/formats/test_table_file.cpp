// Tables as other programs write them: one table in every spelling, and what is no table.
#include "engine/formats/table_file.h"

#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

const Points square{{-1.5, 0}, {75.25, -1}, {1, 2000}};

Points read(const std::string& text, const std::vector<std::string>& columns = {"x", "y"}) {
  INFO(text);
  return value_of(points_in(text, "t.csv", columns));
}

void wrong(const std::string& text, const std::string& reason,
           const std::vector<std::string>& columns = {"x", "y"}) {
  INFO(text);
  CHECK_THAT(refusal(points_in(text, "t.csv", columns)), Catch::Contains(reason));
}

}  // namespace

TEST_CASE("a table is read with any byte order mark, separator, decimal sign and quotes") {
  for (const char* text : {
           "\xEF\xBB\xBF-1.5,0\r\n75.25,-1\r\n1,2000\r\n",
           "-1,5;0\n75,25;-1\n1;2000\n",
           "x;y\r\n-1,5;0;\r\n75,25;-1;\r\n1;2000;\r\n;;\r\n",
           "X\tY\n-1,5\t0\n75,25\t-1\n1\t2000\n",
           "-1,5 0\n75,25 -1\n1 2000\n",
           "\"x\",\"y\"\n\"-1.5\",\"0\"\n75.25,-1\n1,2e3\n",
           "\"x\",\"y\"\n\"-1,5\",\"0\"\n\"75,25\",\"-1\"\n\"1\",\"2000\"\n",
           "sep=;\nx;y\n-1,5;0\n75,25;-1\n1;2000\n",
           "% a remark\n! another\n-1.5 0 # the first\n75.25 -1 // and so on\n\n1 2000",
           "3\n-1.5 0\n75.25 -1\n1 2000\n",
           "x,y\r-1.5,0\r75.25,-1\r1,2000\r",
       })
    CHECK(read(text) == square);
}

TEST_CASE("columns are found by their names, wherever they are, and lengths in their unit") {
  for (const char* text : {
           "y,x\n0,-1.5\n-1,75.25\n2000,1\n",
           "# y, x\n0, -1.5\n-1, 75.25\n2000, 1\n",
           "//Y X\n0 -1.5\n-1 75.25\n2000 1\n",
           "Point ID,Northing,Easting\nA 1,0,-1.5\nA 2,-1,75.25\nB 1,2000,1\n",
           "y_mm;x_mm\n0;-1,5\n-1;75,25\n2000;1\n",
           "X [cm],Y [m]\n-0.15,0\n7.525,-0.001\n0.1,2\n",
           "x (mm);note;y (mm)\n-1,5;a;0\n75,25;;-1\n1;b;2000\n",
           "i,x,y,unknown\n1,-1.5,0,\n2,75.25,-1,\n3,1,2000,\n",
       })
    CHECK(read(text) == square);
  CHECK(read("F_z,j,i,Fx,Fy\n-1,2,3,4,5\n", {"i", "j", "F_x", "F_y", "F_z"}) ==
        Points{{3, 2, 4, 5, -1}});
  wrong("x [furlong],y\n1,2\n", "t.csv:1: column x: got 'furlong', expected mm, cm, m, in or ft");
  wrong("Fx [kN],Fy\n1,2\n", "column F_x: got 'kn'", {"F_x", "F_y"});
  wrong("x,z\n1,2\n", "t.csv:1: got columns 'x', 'z', of which y is missing");
  wrong("x,y,X\n1,2,3\n", "t.csv:1: got column x twice");
  wrong("Outline of the shell\nx,y\n1,2\n", "t.csv:1: got columns 'Outline");
}

TEST_CASE("a row that cannot be read is refused with its line, never left out") {
  wrong("14O,0\n75.5,105\n", "t.csv:1: got '14O', which is no number");
  wrong("x,y\n1,2\n1,2O\n", "t.csv:3: got '2O', which is no number");
  wrong("x,y\n1,2\nnan,nan\n", "t.csv:3: got 'nan', which is no number");
  wrong("x,y\n1,2\n3\n", "t.csv:3: got 1 values, expected 2, as the header names");
  wrong("1,2\n3,,4\n", "t.csv:2: got 3 values");
  wrong("x;y\n1;2\n;4\n", "t.csv:3: got an empty cell, which is no number");
  wrong("1,5,2,5\n3,5,4,5\n", "with decimal commas, semicolons separate the columns");
  wrong("x;y\n1.5;2\n1,5;2\n", "t.csv:3: '1,5' after numbers with decimal points");
  wrong("1.400,5;0\n75,5;105\n", "t.csv:1: got '1.400,5', which is no number");
  wrong("4\n1 2\n3 4\n", "t.csv: got 2 points, expected 4 by its first line");
  wrong("u 1\nw 2\n", "t.csv:1: got 'u', which is no number");
  CHECK(refusal(points_in("u,1\nw,2\n", "t.csv", {"family", "x"}, {{"u", "v"}, {}})) ==
        "t.csv:2: got 'w', which is no value of its column, expected 2 values: family, x");
}
