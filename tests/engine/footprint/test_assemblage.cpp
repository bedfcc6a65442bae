// Building blocks: seams that fit and seams that do not, rods that run on, footprints side by side.
#include <cmath>

#include "engine/footprint/assemblage.h"
#include "engine/footprint/domains.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

constexpr double rho = 120, d = 20;

/// u -> (x, -y), v -> (x, y): the diagonal u + v along x
Eigen::Isometry3d diagonal() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(-M_PI_4, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

Block quarter_sphere(const char* name, Side cut, double radius = rho) {
  const auto net = std::make_shared<SphereNet>(radius);
  Block block{name, net, cap_of(*net, 0).value(), diagonal(), d, Placement::half, {}};
  block.cut[std::size_t(cut)] = 0;
  return block;
}

Block cylinder(double radius, double crossing_deg, int west, int east) {
  const double c = std::sin(crossing_deg * M_PI / 360) / radius;
  const auto net = std::make_shared<RevolutionNet>(
      RevolutionNet::make(cylinder_profile(radius, 400).value(), c).value());
  Block block{"middle", net, half_of(*net, 600).value(), {}, d, Placement::half, {}};
  block.pose.setIdentity();
  block.cut[std::size_t(Side::west)] = west;
  block.cut[std::size_t(Side::east)] = east;
  return block;
}

std::vector<Block> stadium(double radius = rho, double crossing_deg = 102) {
  return {quarter_sphere("left", Side::east), cylinder(radius, crossing_deg, -4, 4),
          quarter_sphere("right", Side::west)};
}

const std::vector<Join> in_a_row{{{0, Side::east}, {1, Side::west}},
                                 {{1, Side::east}, {2, Side::west}}};

std::string refused(std::vector<Block> blocks, const std::vector<Join>& joins, double gap = 50) {
  const auto made = Assemblage::make(std::move(blocks), joins, gap);
  return made ? "" : refusal(made);
}

}  // namespace

TEST_CASE(
    "a quarter-sphere's diagonal and a right-angled cylinder's half circle match at R = 0.883 "
    "rho") {
  // 2 u_max on both sides: 0.980507 rho on the sphere's diagonal, pi sqrt(2) R / 4 on the cylinder
  const double match = 0.980507 * 4 / (M_PI * M_SQRT2);
  CHECK(match == Approx(0.883).margin(5e-4));
  const auto made = value_of(Assemblage::make(stadium(match * rho, 90), in_a_row, 50));
  for (const Seam& seam : made.seams()) CHECK(seam.rods.size() == 24);
  CHECK_THAT(refused(stadium(0.8 * match * rho, 90), in_a_row),
             Catch::Contains("left.east - middle.west: got 24 rods across left.east and 20 across "
                             "middle.west, expected equal numbers"));
}

TEST_CASE("gap and kink of a seam are those of the two nets at its joints") {
  const auto made = Assemblage::make(stadium(), in_a_row, 6).value();
  REQUIRE(made.seams().size() == 2);
  const Seam& seam = made.seams().front();
  CHECK(seam.name == "left.east - middle.west");
  // by hand at the joint next to the pole, u = -v = 10 mm: polar angle on the sphere's great
  // circle by quadrature of 2 sin(omega/2), on the cylinder 2 c u
  double angle = 0;
  const int steps = 1000;
  for (int k = 0; k < steps; ++k) {
    const double u = 10.0 * (k + 0.5) / steps / rho;
    angle += 2 * std::sin(SphereNet::shear(-u * u) / 2) * 10 / rho / steps;
  }
  const double around = 2 * 10 * std::sin(51 * M_PI / 180) / rho;
  const double gap = 2 * rho * std::sin(std::abs(angle - around) / 2);
  const auto at = [&](double line, Family family) {
    for (const SeamRod& rod : seam.rods)
      if (rod.family == family && std::abs(rod.line_mm - line) < 1e-9) return rod;
    FAIL("no such rod");
    return SeamRod{};
  };
  CHECK(at(10, Family::v).gap_mm == Approx(gap).margin(1e-6));
  CHECK(at(-10, Family::u).gap_mm == Approx(gap).margin(1e-6));
  // mirror images of one another
  CHECK(at(10, Family::v).kink_deg == Approx(at(-10, Family::v).kink_deg).margin(1e-9));
  CHECK(at(10, Family::v).kink_deg == Approx(at(-10, Family::u).kink_deg).margin(1e-9));
  CHECK(made.seams()[1].max_gap_mm() == Approx(seam.max_gap_mm()).margin(1e-9));
  CHECK_THAT(refused(stadium(), in_a_row, 3),
             Catch::Contains("left.east - middle.west: at the joint") &&
                 Catch::Contains("mm and the rods' tangents") &&
                 Catch::Contains("expected a gap of at most 3 mm"));
}

TEST_CASE("rods run on across the seams of an assemblage, its boundary is closed and level") {
  const auto made = Assemblage::make(stadium(), in_a_row, 6).value();
  const auto footprint = cut_footprint(*made.domain(), d, Placement::half).value();
  // the joints of the parts, those on a seam once: 8 rows of joints of the cylinder between
  const auto alone = cut_footprint(*cap_of(SphereNet(rho), 0).value(), d, Placement::half).value();
  CHECK(footprint.joints.size() > alone.joints.size() + 7 * 11);
  for (const FootprintRod& rod : footprint.rods) CHECK(rod.joints.size() >= 2);
  // the footprint is a mirror image of itself about its middle, u + v = 4 d
  for (const FootprintJoint& joint : footprint.joints) {
    const auto mirrored = std::find_if(footprint.joints.begin(), footprint.joints.end(),
                                       [&](const FootprintJoint& other) {
                                         return std::abs(other.u - (4 * d - joint.v)) < 1e-9 &&
                                                std::abs(other.v - (4 * d - joint.u)) < 1e-9;
                                       });
    CHECK(mirrored != footprint.joints.end());
  }
  const Eigen::Matrix2Xd ring = made.domain()->boundary(400);
  for (int k = 0; k < 400; ++k) {
    const Eigen::Vector2d step = ring.col((k + 1) % 400) - ring.col(k);
    CHECK(step.norm() < 8);
    const auto point = value_of(made.net()->at(ring(0, k), ring(1, k)));
    CHECK(std::abs(point.position.z()) < 0.01);
  }
}

TEST_CASE("the nets lie at their positions, and closed() leaves no gap between them") {
  const auto made = Assemblage::make(stadium(), in_a_row, 6).value();
  // the cylinder's middle is four rows from the left pole, cos(51 degrees) of that along x
  const double half = 4 * d * std::cos(51 * M_PI / 180);
  const auto middle = made.net()->at(2 * d, 2 * d).value();
  const auto pole = made.net()->at(4 * d, 4 * d).value();
  CHECK((made.net()->at(-20, -20)->position.head<2>().norm()) < rho);
  CHECK(middle.position.z() == Approx(rho).margin(1e-9));
  CHECK(pole.position.z() == Approx(rho).margin(1e-9));
  CHECK(pole.position.x() - middle.position.x() == Approx(half).margin(1e-6));
  // two positions on either side of a seam joint coincide
  Eigen::Matrix2Xd sides(2, 2);
  const double u = 50, near = 1e-7;
  sides << u - near, u + near, -u - near, -u + near;
  const auto raw = [&](int k) { return made.net()->at(sides(0, k), sides(1, k))->position; };
  CHECK((raw(0) - raw(1)).norm() > 1);
  const Eigen::Matrix3Xd closed = made.closed(sides, 4 * d).value();
  CHECK((closed.col(0) - closed.col(1)).norm() < 1e-5);
}

TEST_CASE("blocks that cannot be joined are refused, naming their sides") {
  const auto wrong = [](const char* reason, std::vector<Block> blocks, std::vector<Join> joins) {
    CHECK_THAT(refused(std::move(blocks), joins), Catch::Contains(reason));
  };
  const Join first = in_a_row[0];
  wrong("middle.east is cut and not joined", stadium(), {first});
  wrong("do not face one another", stadium(), {first, {{1, Side::east}, {2, Side::east}}});
  wrong("joined twice", stadium(), {first, first});
  wrong("middle.north is not cut", stadium(), {first, {{1, Side::north}, {2, Side::south}}});
  auto coarse = stadium(), beside = stadium();
  coarse[2].spacing = 25;
  wrong("d = 20 mm and 25 mm", coarse, in_a_row);
  beside[0].placement = Placement::on_axis;
  wrong("on the axes", beside, in_a_row);
  // two pairs of blocks that are not joined to one another
  wrong("no join connects block \"c\"",
        {quarter_sphere("a", Side::east), quarter_sphere("c", Side::east),
         quarter_sphere("b", Side::west), quarter_sphere("e", Side::west)},
        {{{0, Side::east}, {2, Side::west}}, {{1, Side::east}, {3, Side::west}}});
  // a straight row round a loop does not come back to its beginning
  std::vector<Block> ring{cylinder(rho, 102, -4, 4), cylinder(rho, 102, -4, 4)};
  ring[1].name = "other";
  wrong("round the loop leave a gap", ring,
        {{{0, Side::east}, {1, Side::west}}, {{1, Side::east}, {0, Side::west}}});
  CHECK(refused({quarter_sphere("a", Side::east), quarter_sphere("b", Side::west)},
                {{{0, Side::east}, {1, Side::west}}}, 1e-9) == "");
}

TEST_CASE("a hemisphere cut in two or four and joined again is the hemisphere") {
  struct Pieces {
    std::vector<Block> blocks;
    std::vector<Join> joins;
  };
  const auto eighth = [](const char* name, Side a, Side b) {
    Block block = quarter_sphere(name, a);
    block.cut[std::size_t(b)] = 0;
    return block;
  };
  const Pieces all[] = {
      {{quarter_sphere("a", Side::east), quarter_sphere("b", Side::west)},
       {{{0, Side::east}, {1, Side::west}}}},
      {{quarter_sphere("a", Side::south), quarter_sphere("b", Side::north)},
       {{{0, Side::south}, {1, Side::north}}}},
      // four round a loop, that closes
      {{eighth("a", Side::east, Side::north), eighth("b", Side::west, Side::north),
        eighth("c", Side::west, Side::south), eighth("e", Side::east, Side::south)},
       {{{0, Side::east}, {1, Side::west}},
        {{1, Side::north}, {2, Side::south}},
        {{2, Side::west}, {3, Side::east}},
        {{3, Side::south}, {0, Side::north}}}}};
  for (const Placement placement : {Placement::half, Placement::on_axis}) {
    const auto whole = cut_footprint(*cap_of(SphereNet(rho), 0).value(), d, placement).value();
    for (const Pieces& pieces : all) {
      std::vector<Block> blocks = pieces.blocks;
      for (Block& block : blocks) block.placement = placement;
      const auto made = value_of(Assemblage::make(std::move(blocks), pieces.joins, 1e-9));
      for (const Seam& seam : made.seams()) {
        CHECK(seam.max_gap_mm() < 1e-12);
        CHECK(seam.max_kink_deg() < 1e-6);
      }
      const auto joined = cut_footprint(*made.domain(), d, placement).value();
      CHECK(joined.joints.size() == whole.joints.size());
      CHECK(joined.cells.size() == whole.cells.size());
      REQUIRE(joined.rods.size() == whole.rods.size());
      for (std::size_t r = 0; r < whole.rods.size(); ++r) {
        CHECK(joined.rods[r].span.begin == Approx(whole.rods[r].span.begin).margin(1e-9));
        CHECK(joined.rods[r].span.end == Approx(whole.rods[r].span.end).margin(1e-9));
      }
      CHECK(made.net()->at(0, 0)->position.z() == Approx(rho));
    }
  }
}
