// Shells from networks of rods: the circle of Fig. 1 as one, and those that are no square grid.
#include <Eigen/Geometry>

#include "engine/formats/drawing.h"
#include "engine/formats/network_file.h"
#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

preset::Preset fig1() {
  preset::Preset p = circle(12, 126, 0.75 * 126);
  p.accuracy.edges_per_segment = 8;
  return p;
}

/// The rods of a scene as the contents of a file: rotated, in reverse order, every other rod
/// reversed; their ends move to `scale` times their positions.
preset::NetworkData as_file(const Scene& scene, double turn, double scale) {
  const Eigen::Rotation2Dd by(turn);
  preset::NetworkData file;
  const auto add = [&](const Eigen::Vector2d& uv) {
    const Eigen::Vector2d at = by * uv;
    file.points.push_back({at.x(), at.y(), 0});
    return int(file.points.size()) - 1;
  };
  for (const FootprintJoint& joint : scene.footprint.joints) add({joint.u, joint.v});
  for (std::size_t k = scene.footprint.rods.size(); k-- > 0;) {
    const FootprintRod& rod = scene.footprint.rods[k];
    std::vector<int> numbers{add(rod.at(rod.span.begin))};
    numbers.insert(numbers.end(), rod.joints.begin(), rod.joints.end());
    numbers.push_back(add(rod.at(rod.span.end)));
    for (const int end : {numbers.front(), numbers.back()}) {
      const auto& at = file.points[std::size_t(end)];
      file.supports.push_back({double(end), scale * at[0], scale * at[1], 0});
    }
    if (k % 2) std::reverse(numbers.begin(), numbers.end());
    file.rods.push_back(numbers);
  }
  return file;
}

Simulation open(const preset::Preset& p) {
  return value_of(Simulation::open(shared_scene(p), plan_of_mesh(p.accuracy.edges_per_segment)));
}

/// For every node of `to` the node of `from` at its position in the flat grid, rotated.
std::vector<int> same_nodes(const RodMesh& from, const RodMesh& to, double turn) {
  const Eigen::Matrix2Xd turned = Eigen::Rotation2Dd(turn).toRotationMatrix() * from.flat;
  std::vector<int> nodes;
  for (int k = 0; k < to.nodes(); ++k) {
    Eigen::Index nearest = 0;
    const double off =
        (turned.colwise() - to.flat.col(k)).colwise().squaredNorm().minCoeff(&nearest);
    REQUIRE(off < 1e-12);
    nodes.push_back(int(nearest));
  }
  return nodes;
}

}  // namespace

TEST_CASE("the circle of Fig. 1 as a network reaches the circle's states", "[standard]") {
  Simulation circle = open(fig1());
  for (const double turn : {0.0, 0.3}) {
    preset::Preset p = fig1();
    p.footprint = {};
    p.footprint.kind = preset::FootprintKind::network;
    p.footprint.file = as_file(circle.scene(), turn, 0.75);
    Simulation network = open(p);
    const Footprint& net = network.scene().footprint;
    CHECK(net.joints.size() == circle.scene().footprint.joints.size());
    // a rotated network is no grid: it has rods and no cells
    CHECK((net.rods[0].family == Family::other) == (turn != 0));
    CHECK(net.cells.size() == (turn == 0 ? circle.scene().footprint.cells.size() : 0));
    CHECK(net.spacing == Approx(20).epsilon(1e-12));

    const Eigen::Matrix3d by = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const auto fine = same_nodes(circle.shell().finest(), network.shell().finest(), turn);
    for (const double shortening : {0.02, 0.05}) {
      circle.begin_buckled(shortening, unwatched).value();
      REQUIRE(circle.move_to(1, unwatched).end == Outcome::reached);
      // both begin at the same state of the finest mesh, a little off its equilibrium
      Eigen::Matrix3Xd off = circle.shell().state().levels.back().x;
      off.row(2) *= 1.01;
      const auto begun = [&](Simulation& session, const Eigen::Matrix3Xd& x) {
        const Model& model = session.shell().model();
        State state = start_state(model, x);
        session.shell().motion().impose(session.shell().system(), 1, state);
        const Report report = session.begin_at(1, state, unwatched);
        REQUIRE(report.end == Outcome::reached);
        CHECK(report.certificate.stable());
        return Eigen::Matrix3Xd(session.nodes());
      };
      const Eigen::Matrix3Xd there = by * off(Eigen::all, fine);
      const Eigen::Matrix3Xd x = begun(network, there), expected = begun(circle, off);
      const double worst = (x - by * expected(Eigen::all, fine)).colwise().norm().maxCoeff();
      CAPTURE(turn, shortening, worst);
      CHECK(worst < 1e-9 * 126);
      CHECK(network.energies().total() == Approx(circle.energies().total()).epsilon(1e-12));
    }
  }
}

TEST_CASE("a footprint drawn as DXF reads back as the same network") {
  preset::Preset p = shipped("network_triaxial");
  const auto scene = scene_of(p);
  const auto work = simulate::fabrication_plan_of(p);
  REQUIRE(scene);
  REQUIRE(work);
  const auto read = value_of(
      preset::read_network(exports::to_dxf(exports::footprint_drawing(*work)), "triaxial.dxf"));
  p.footprint.file = read;
  const auto again = value_of(scene_of(p));
  const Footprint &a = scene->footprint, &b = again.footprint;
  REQUIRE(b.rods.size() == a.rods.size());
  CHECK(b.joints.size() == a.joints.size());
  CHECK(b.spacing == Approx(a.spacing).epsilon(1e-6));
  for (std::size_t r = 0; r < a.rods.size(); ++r) {
    REQUIRE(b.rods[r].marks.size() == a.rods[r].marks.size());
    for (std::size_t k = 0; k < a.rods[r].marks.size(); ++k)
      CHECK(b.rods[r].marks[k] == Approx(a.rods[r].marks[k]).margin(2e-3));
  }
  CHECK((again.motion.end - scene->motion.end).cwiseAbs().maxCoeff() < 1e-5);
}

TEST_CASE("rods with sections of their own, springs and shearing joints work on a network") {
  preset::Preset p = shipped("network_triaxial");
  auto& file = p.footprint.file;
  const auto plain = value_of(scene_of(p));
  CHECK(plain.footprint.rods.size() == file.rods.size());
  file.diameters.assign(file.rods.size(), 0);
  file.diameters[2] = 2 * p.rod.diameter_mm;
  const auto thick = value_of(scene_of(p));
  CHECK(thick.rods.material(2).EI1 == Approx(16 * plain.rods.material(2).EI1));
  CHECK(thick.rods.material(1).EI1 == plain.rods.material(1).EI1);
  // conflicts of a rod's own keys are reported with the rod
  const auto error_of = [&](const std::string& key, double value) {
    preset::Preset other = shipped("network_triaxial");
    other.footprint.file.own = {{3, key, value}};
    const auto errors = conflicts(other);
    return errors.empty() ? "none" : errors.front().what;
  };
  CHECK_THAT(error_of("widht_mm", 3), Catch::Contains("rods[3]: got an unknown key 'widht_mm'") &&
                                          Catch::Contains("did you mean 'width_mm'"));
  for (const char* key : {"material", "diameter_mm"})
    CHECK_THAT(error_of(key, 2), Catch::Contains(fmt::format("unknown key '{}'", key)) &&
                                     !Catch::Contains("did you mean"));
  CHECK_THAT(error_of("young_GPa", 1e300), Catch::Contains("rods[3]: young_GPa: got 1e+300 (too "
                                                           "large to compute with)"));
  CHECK_THAT(error_of("young_GPa", -1), Catch::Contains("rods[3]: young_GPa: got -1, expected"));
  CHECK_THAT(error_of("width_mm", 3), Catch::Contains("rods[3]") && Catch::Contains("thickness"));
  CHECK_THAT(error_of("curvature_per_mm", 0.01), Catch::Contains("shear_GPa or GJ_Nmm2 above 0"));
  CHECK(error_of("young_GPa", 70) == "none");
  // a given torsional stiffness is no modulus, and each rod needs one
  preset::Preset twisted = shipped("network_triaxial");
  twisted.rod.GJ_Nmm2 = 10, twisted.rod.curvature_per_mm = 0.01;
  CHECK(conflicts(twisted).empty());
  twisted.footprint.file.own = {{3, "GJ_Nmm2", 0}};
  const auto errors = conflicts(twisted);
  REQUIRE(errors.size() == 1);
  CHECK_THAT(errors[0].what, Catch::Contains("expected rods[3] shear_GPa or GJ_Nmm2 above 0"));
  file.diameters[2] = 31;
  CHECK_THAT(refusal(scene_of(p)), Catch::Contains("rods[2]: got a diameter of 31 mm"));
}
