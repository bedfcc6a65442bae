// The fabrication plan has the model's own lengths and positions.
#include <map>

#include "engine/footprint/mesh.h"
#include "engine/simulate/run.h"
#include "tests/engine/simulate/run.h"

using namespace gridshell;
using exports::CutRod;
using exports::FabricationPlan;
using exports::Pin;

namespace {

preset::Preset paper_circle() { return circle(12, 126, 94.5); }

preset::Preset ringed_cap(double second_ring_mm) {
  preset::Preset p = cap(0.3);
  p.footprint.placement = Placement::half;
  p.actuation.start = preset::Start::flat;
  p.ends.second_ring_mm = second_ring_mm;
  return p;
}

FabricationPlan made(const preset::Preset& preset) {
  return value_of(simulate::fabrication_plan_of(preset));
}

}  // namespace

TEST_CASE("the cut list's total is the natural length of the model, marks are its joints") {
  for (const auto& preset : {paper_circle(), ringed_cap(0), ringed_cap(10)}) {
    const FabricationPlan work = made(preset);
    const Scene scene = scene_of(preset).value();
    const RodMesh mesh = mesh_rods(scene.footprint, 4);
    double rest = 0;
    for (const auto& along : mesh.position) rest += along.back() - along.front();
    CHECK(work.total_length_mm() == Approx(rest).epsilon(1e-12));
    std::size_t marks = 0;
    for (const CutRod& rod : work.rods) {
      marks += rod.joint_marks_mm.size();
      CHECK((rod.end - rod.begin).norm() == Approx(rod.length_mm).epsilon(1e-12));
      CHECK(std::is_sorted(rod.joint_marks_mm.begin(), rod.joint_marks_mm.end()));
      CHECK(rod.leg_begin_mm > 0);
      CHECK(rod.leg_end_mm > 0);
      CHECK(rod.joint_marks_mm.back() < rod.length_mm);
    }
    // each joint ties two rods
    CHECK(marks == 2 * work.joints.size());
  }
}

TEST_CASE("pins lie on the actuated boundary, those of the second ring do not") {
  const FabricationPlan circle = made(paper_circle());
  CHECK(circle.pins.size() == 2 * circle.rods.size());
  for (const Pin& pin : circle.pins) {
    CHECK(pin.in_ring);
    CHECK(pin.at.head<2>().norm() == Approx(94.5).epsilon(1e-9));
  }
  const FabricationPlan ring = made(ringed_cap(10));
  CHECK(ring.pins.size() == 4 * ring.rods.size());
  CHECK(std::ranges::count(ring.pins, false, &Pin::in_ring) == long(2 * ring.rods.size()));
  for (const CutRod& rod : ring.rods) {
    REQUIRE(rod.pin_marks_mm.size() == 2);
    CHECK(rod.pin_marks_mm[0] == 10);
  }
}

TEST_CASE("drawings of a circle: lines as long as its rods, true circles, one hole a pin") {
  const FabricationPlan work = made(paper_circle());
  const auto drawing = exports::footprint_drawing(work);
  const auto& rods = drawing.layers[0];
  REQUIRE(rods.lines.size() == work.rods.size());
  for (std::size_t r = 0; r < rods.lines.size(); ++r)
    CHECK((rods.lines[r].points[1] - rods.lines[r].points[0]).norm() ==
          Approx(work.rods[r].length_mm).epsilon(1e-12));
  const auto plate = value_of(exports::plate_drawing(work));
  CHECK(plate.layers[0].circles.at(0).radius_mm == 94.5);
  CHECK(plate.layers[1].circles.size() == work.pins.size());
}

TEST_CASE("a plate is refused where the edge points do not lie in a plane") {
  preset::Preset preset = ringed_cap(0);
  preset.net.kind = preset::NetKind::cylinder;
  preset.net.radius_mm = 100;
  preset.net.length_mm = 125;
  CHECK_THAT(refusal(exports::plate_drawing(made(preset))), Catch::Contains("no flat plate"));
}

TEST_CASE("legs too short to build are named in the cut list") {
  preset::Preset preset = paper_circle();
  preset.footprint.radius_mm = 110.5;  // longest leg 0.025 d
  preset.actuation.radius_mm = 90;
  const FabricationPlan work = made(preset);
  const std::string csv = exports::cut_list_csv(work);
  CHECK(std::ranges::any_of(work.rods, &CutRod::hard_to_build));
  CHECK(csv.find("a leg below 3 mm: hard to build") != csv.npos);
}

TEST_CASE("rods longer than the stock are spliced in the middle between joints") {
  preset::Preset preset = paper_circle();
  preset.figure.stock_mm = 100;
  const FabricationPlan work = made(preset);
  for (const CutRod& rod : work.rods) {
    CHECK(rod.splices_mm.empty() == (rod.length_mm <= 100));
    double from = 0;
    for (const double splice : rod.splices_mm) {
      CHECK(splice - from <= 100);
      for (const double mark : rod.joint_marks_mm) CHECK(std::abs(mark - splice) > 9.9);
      from = splice;
    }
    CHECK(rod.length_mm - from <= 100);
  }
  CHECK_THAT(exports::cut_list_csv(work), Catch::Contains("leg_end_mm,splices_mm,note,section"));
  preset.figure.stock_mm = 8;
  CHECK_THAT(refusal(simulate::fabrication_plan_of(preset)),
             Catch::Contains("stock_mm: got 8, expected more"));
}

TEST_CASE("rods of several sections are named, cut and pinned with their own") {
  preset::Preset preset = paper_circle();
  preset.rod_v.differs = true;
  preset.rod_v.diameter_mm = 0.9;
  preset.rod_table = {{0, 0, 0.5}};
  const FabricationPlan work = made(preset);
  CHECK(work.section_text() ==
        "rods: 11 of 0.254 mm diameter, 1 of 0.5 mm diameter, 12 of 0.9 mm diameter");
  CHECK_THAT(exports::cut_list_csv(work), Catch::Contains("0.9 mm diameter\n"));
  const exports::Drawing plate = value_of(exports::plate_drawing(work));
  std::map<double, int> holes;
  for (const exports::DrawnCircle& hole : plate.layers[1].circles) ++holes[2 * hole.radius_mm];
  const std::map<double, int> expected{{0.254, 22}, {0.5, 2}, {0.9, 24}};
  CHECK(holes == expected);
  // a lath turns in a hole of its diagonal
  preset = paper_circle();
  preset.rod.width_mm = 4, preset.rod.thickness_mm = 3;
  preset.rod.shear_GPa = 30;
  CHECK(made(preset).section_text() == "laths of 4 x 3 mm");
  CHECK(value_of(exports::plate_drawing(made(preset))).layers[1].circles[0].radius_mm == 2.5);
}

TEST_CASE("what is cut in tenths of a millimetre adds up to its rod") {
  const FabricationPlan exact = made(paper_circle());
  const FabricationPlan work = exports::rounded(exact, 0.1);
  double sum = 0;
  for (std::size_t r = 0; r < work.rods.size(); ++r) {
    const CutRod& rod = work.rods[r];
    CHECK(std::abs(rod.length_mm - exact.rods[r].length_mm) <= 0.05 + 1e-9);
    const double between = rod.joint_marks_mm.back() - rod.joint_marks_mm.front();
    CHECK(rod.leg_begin_mm + between + rod.leg_end_mm == Approx(rod.length_mm).margin(1e-9));
    sum += rod.length_mm;
  }
  CHECK(work.total_length_mm() == Approx(sum).margin(1e-9));
  // no more digits than are meant; the section is that of the preset
  FabricationPlan lengths = work;
  for (CutRod& rod : lengths.rods) rod.section = {};
  const std::string csv = exports::cut_list_csv(lengths);
  for (std::size_t at = csv.find('.'); at != csv.npos; at = csv.find('.', at + 1))
    CHECK_FALSE((std::isdigit(csv[at + 1]) && std::isdigit(csv[at + 2])));
  CHECK(exports::cut_list_csv(exports::rounded(exact, 0)) == exports::cut_list_csv(exact));
}

TEST_CASE("what is cut in steps of any size is off by half a step at most") {
  const FabricationPlan exact = made(paper_circle());
  for (const double step : {0.25, 0.3, 0.4, 0.7, 0.75, 1.0, 2.5, 10.0}) {
    const FabricationPlan work = exports::rounded(exact, step);
    CAPTURE(step);
    for (std::size_t r = 0; r < work.rods.size(); ++r)
      CHECK(std::abs(work.rods[r].length_mm - exact.rods[r].length_mm) <= step / 2 + 1e-9);
  }
}

TEST_CASE("a pin at the mark of its first joint remains the pin of the rod's start") {
  // a tail of 20 mm and a leg of 2 mm have one mark in steps of 10 mm
  FabricationPlan plan;
  CutRod rod;
  rod.length_mm = 100;
  rod.pin_marks_mm = {20, 100};
  rod.joint_marks_mm = {22, 60};
  rod.leg_begin_mm = 2, rod.leg_end_mm = 40;
  plan.rods = {rod};
  const FabricationPlan work = exports::rounded(plan, 10);
  CHECK(work.rods[0].leg_begin_mm == 0);
  CHECK(work.rods[0].leg_end_mm == 40);
}
