// Footprints of surfaces that a preset gives by an expression.
#include "tests/engine/geometry/dome_mesh.h"
#include "tests/presets.h"

using namespace gridshell;

namespace {

preset::Preset on_surface() {
  auto p = cap(0.3);
  p.net.kind = preset::NetKind::surface;
  p.net.implicit = "x^2 + y^2 + z^2 - 120^2";
  p.net.apex_mm = {0, 0, 120};
  p.net.cut_mm = 36;
  return p;
}

void refused(const preset::Preset& p, const std::string& reason) {
  CHECK_THAT(refusal(scene_of(p)), Catch::Contains(reason));
}

void same_scene(const Scene& here, const Scene& there) {
  REQUIRE(here.footprint.joints.size() == there.footprint.joints.size());
  REQUIRE(here.motion.end.cols() == there.motion.end.cols());
  CHECK((here.motion.begin - there.motion.begin).colwise().norm().maxCoeff() < 5e-4);
  CHECK((here.motion.end - there.motion.end).colwise().norm().maxCoeff() < 5e-4);
}

}  // namespace

TEST_CASE("a cap of a sphere by expression has the sphere's own footprint and boundary") {
  const auto here = value_of(scene_of(on_surface())), there = value_of(scene_of(cap(0.3)));
  same_scene(here, there);
  CHECK(here.length_scale_mm == Approx(120 * std::sqrt(1 - 0.09)).epsilon(1e-6));
  // the same surface as a height, the same boundary as a curve
  auto other = on_surface();
  other.net.implicit.clear();
  other.net.height = "sqrt(120^2 - x^2 - y^2)";
  other.net.apex_mm = {0, 0};
  other.net.within = "x^2 + y^2 - 120^2 + 36^2";
  same_scene(value_of(scene_of(other)), there);
}

TEST_CASE("rods on a saddle leave along its principal directions, or along x") {
  auto p = on_surface();
  p.net.implicit.clear();
  p.net.height = "x*y/300";
  p.net.apex_mm = {0, 0};
  p.net.within = "x^2 + y^2 - 100^2";
  const auto along = [&] {
    const auto scene = value_of(scene_of(p));
    const Eigen::Vector3d way = scene.net->at(0, 0)->tangent_u;
    return std::atan2(way.y(), way.x()) * 180 / M_PI;
  };
  CHECK(std::abs(along()) == Approx(45).margin(1e-3));
  p.net.axis = preset::NetAxis::x;
  CHECK(along() == Approx(0).margin(1e-3));
  p.net.axis_deg = 20;
  CHECK(along() == Approx(20).margin(1e-3));
}

TEST_CASE("a surface that makes no net is refused with what is wrong") {
  const auto with = [](auto change) {
    auto p = on_surface();
    change(p.net);
    return p;
  };
  refused(with([](auto& n) { n.implicit = "x^2 +"; }), "[net] implicit = \"x^2 +\"");
  refused(with([](auto& n) { n.implicit = "x^2 + y^2 - sqrt(-1)"; }), "no value");
  refused(with([](auto& n) { n.implicit = "5"; }), "no slope");
  refused(with([](auto& n) { n.apex_mm = {0, 0, 110}; }), "lies 10 mm off the surface");
  refused(with([](auto& n) { n.apex_mm = {120, 0, 0}, n.cut_mm = -10; }), "it faces up");
  refused(with([](auto& n) { n.cut_mm = 130; }), "lies outside");
  refused(with([](auto& n) { n.cut_mm = -200; }), "does not cross");
  refused(with([](auto& n) { n.within = "z <"; }), "[net] within");
  // seen from the apex the boundary hides parts of itself
  refused(
      with([](auto& n) { n.within = "max(x^2 + y^2 - 100^2, 12^2 - (x - 50)^2 - (y - 50)^2)"; }),
      "2 crossings of the ray");
}

TEST_CASE("heights and meshes of a cap have the sphere's own footprint and boundary",
          "[standard]") {
  const auto there = value_of(scene_of(cap(0.3)));
  auto p = on_surface();
  p.net.implicit.clear();
  p.net.apex_mm = {0, 0};
  const DomeMesh dome = ellipsoid_mesh({120, 120, 120}, 6, 1.3);
  for (const auto& v : dome.vertices.colwise())
    p.net.file.vertices.push_back({v.x(), v.y(), v.z()});
  p.net.file.triangles = dome.triangles;
  same_scene(value_of(scene_of(p)), there);
  // without a cut the cap ends at the rim of the mesh
  p.net.cut_mm.reset();
  const auto whole = value_of(scene_of(p));
  const double rim = 120 * std::cos(1.3);
  CHECK(whole.motion.end.row(2).minCoeff() == Approx(rim).margin(0.2));
  CHECK(whole.motion.end.row(2).maxCoeff() < rim + 1.5);
  p.net.apex_mm = {130, 0};
  refused(p, "no point at (130, 0)");
  // heights every 3.6 mm, without the steep parts
  p.net.file = {};
  p.net.apex_mm = {0, 0};
  p.net.cut_mm = 84;
  for (int k = -31; k <= 31; ++k) p.net.file.x.push_back(3.6 * k);
  p.net.file.y = p.net.file.x;
  for (const double y : p.net.file.y) {
    p.net.file.z.emplace_back();
    // a paraboloid continues where the sphere has no height
    for (const double x : p.net.file.x) {
      const double square = x * x + y * y;
      p.net.file.z.back().push_back(square < 114 * 114 ? std::sqrt(14400 - square)
                                                       : 37.5 - (square - 114 * 114) / 75);
    }
  }
  same_scene(value_of(scene_of(p)), value_of(scene_of(cap(0.7))));
}

TEST_CASE("of a net that is refused there is a picture to draw, of another there is none") {
  auto p = on_surface();
  CHECK_FALSE(refused_net(p).has_value());
  p.net.cut_mm = -100;
  const auto net = value_of(refused_net(p));
  CHECK(net.lines.size() > 20);
  CHECK(net.narrow.cols() > 10);
  CHECK(net.end.norm() == Approx(120).margin(1e-3));
  CHECK(net.end.z() < 0);
}

TEST_CASE("a preset names the surface once, and a point of it") {
  const auto wrong = [](const std::string& net, const char* reason) {
    CHECK_THAT(preset::errors_of("[footprint]\nkind = \"net\"\n[net]\nkind = \"surface\"\n" + net),
               Catch::Contains(reason));
  };
  wrong("", "needs an expression");
  wrong("implicit = \"x\"\nheight = \"x\"\napex_mm = [0, 0, 0]\n", "given twice");
  wrong("implicit = \"z\"\n", "expected [x, y, z]");
  wrong("height = \"1\"\napex_mm = [1.0]\n", "expected [x, y]");
  wrong("height = \"1\"\nradius_mm = 3.0\n", "does not use it");
}
