#include "tests/bench/random_scenes.h"

#include <cmath>

namespace gridshell::bench {
namespace {

using preset::Preset;

void circle(RandomDraw& draw, Preset& p) {
  p.footprint.rods = draw.integer(4, 14);
  p.footprint.placement = p.footprint.rods % 2 ? Placement::on_axis : Placement::half;
  p.footprint.radius_mm = 20 * ((p.footprint.rods - 1) / 2.0 + draw.between(0.2, 2.5));
  p.actuation.radius_mm = p.footprint.radius_mm * draw.between(0.6, 0.97);
  p.imperfection.seed = draw.integer(1, 1000);
}

void curve(RandomDraw& draw, Preset& p) {
  p.footprint.kind = preset::FootprintKind::curve;
  p.footprint.boundary.kind =
      draw.once_in(2) ? preset::CurveKind::ellipse : preset::CurveKind::superellipse;
  p.footprint.boundary.half_x_mm = draw.between(70, 140);
  p.footprint.boundary.half_y_mm = draw.between(60, 120);
  p.footprint.boundary.exponent = draw.between(2, 5);
  p.actuation.scale = draw.between(0.7, 0.97);
}

void net(RandomDraw& draw, Preset& p, preset::NetKind kind) {
  p.footprint.kind = preset::FootprintKind::net;
  p.net.kind = kind;
  p.footprint.placement = draw.once_in(2) ? Placement::half : Placement::on_axis;
}

void cap(RandomDraw& draw, Preset& p) {
  net(draw, p, preset::NetKind::sphere);
  p.net.radius_mm = draw.between(70, 140);
  p.net.cut_height = draw.between(0, 0.7);
  p.actuation.start = draw.once_in(2) ? preset::Start::net : preset::Start::flat;
}

void revolution(RandomDraw& draw, Preset& p) {
  const int which = draw.integer(0, 2);
  net(draw, p,
      which == 0   ? preset::NetKind::cylinder
      : which == 1 ? preset::NetKind::spool
                   : preset::NetKind::beltrami);
  p.net.radius_mm = which == 0 ? draw.between(60, 110) : draw.between(90, 140);
  // longer ones fold
  const double longest[] = {2.2, 1.4, 0.5};
  p.net.length_mm = p.net.radius_mm * longest[which] * draw.between(0.7, 1);
  if (which > 0) p.net.waist = draw.between(0.5, 0.8);
  // a pseudosphere ends at its rim
  const double w = p.net.waist;
  if (which == 2)
    p.net.length_mm = std::min(p.net.length_mm,
                               1.9 * p.net.radius_mm * (std::acosh(1 / w) - std::sqrt(1 - w * w)));
  p.actuation.start = draw.once_in(2) ? preset::Start::net : preset::Start::flat;
}

void profile(RandomDraw& draw, Preset& p) {
  net(draw, p, preset::NetKind::profile);
  const double radius = draw.between(80, 110), swell = draw.between(-15, 25),
               half = draw.between(70, 115);
  for (int k = -3; k <= 3; ++k)
    p.net.profile.push_back({radius + swell * std::cos(k * M_PI / 6), half * k / 3.0});
  p.net.length_mm = 0;
}

void translation(RandomDraw& draw, Preset& p) {
  net(draw, p, preset::NetKind::translation);
  const auto arch = [&](int axis) {
    const double half = draw.between(70, 120), rise = draw.between(10, 45);
    preset::Points points;
    for (int k = -3; k <= 3; ++k) {
      std::vector<double> at{0, 0, rise * (1 - std::pow(k / 3.0, 2))};
      at[std::size_t(axis)] = half * k / 3.0;
      points.push_back(at);
    }
    return points;
  };
  p.net.curve_u = arch(0);
  p.net.curve_v = arch(1);
  p.actuation.start = preset::Start::net;
}

void blocks(RandomDraw& draw, Preset& p) {
  p.footprint.kind = preset::FootprintKind::blocks;
  p.footprint.placement = Placement::on_axis;
  const double radius = draw.between(70, 120), cut = draw.between(0, 0.5);
  const std::string names[] = {"a", "b"};
  for (const std::string& name : names) {
    preset::Block& block = p.block.emplace_back();
    block.name = name;
    block.net.radius_mm = radius;
    block.net.cut_height = cut;
  }
  p.block[0].east = p.block[1].west = 0;
  preset::Join& seam = p.join.emplace_back();
  seam.first = names[0] + ".east";
  seam.second = names[1] + ".west";
  p.actuation.start = preset::Start::net;
}

void push(RandomDraw& draw, Preset& p) {
  draw.once_in(2) ? circle(draw, p) : cap(draw, p);
  p.indentation.at =
      draw.once_in(2) ? preset::IndentationPosition::highest : preset::IndentationPosition::pole;
  p.indentation.direction =
      draw.once_in(3) ? preset::Direction::outward : preset::Direction::inward;
  p.indentation.lateral = draw.once_in(3) ? preset::Lateral::held : preset::Lateral::free;
  p.indentation.depth = draw.between(0.02, 0.25);
  p.indentation.unload = draw.once_in(4);
}

void load(RandomDraw& draw, Preset& p) {
  draw.once_in(3) ? cap(draw, p) : circle(draw, p);
  p.rod.density_kg_m3 = 6450;
  p.loads.gravity_m_s2 = draw.between(-20, 40);
  if (draw.once_in(2))
    p.loads.points = {{0, 0, draw.between(-0.01, 0.01), 0, draw.between(-0.03, 0.01)}};
}

void rods(RandomDraw& draw, Preset& p) {
  draw.once_in(2) ? circle(draw, p) : cap(draw, p);
  switch (draw.integer(0, 4)) {
    case 0:
      p.rod.diameter_mm = draw.between(0.15, 0.6);
      break;
    case 1:
      p.rod_v.differs = true;
      p.rod_v.diameter_mm = draw.between(0.15, 0.5);
      break;
    case 2:
      p.ends.kind = preset::EndKind::tangent;
      break;
    case 3:
      p.rod.shear_GPa = 31;
      p.joints.shear_Nmm = draw.between(0.01, 1);
      break;
    case 4:
      p.rod.shear_GPa = 31;
      p.joints.twist_Nmm = draw.between(0.1, 5);
      if (p.footprint.kind == preset::FootprintKind::circle) {
        p.footprint.rods = 4;
        p.footprint.placement = Placement::half;
      }
      break;
  }
}

}  // namespace

Preset random_preset(SceneKind kind, std::mt19937& random) {
  RandomDraw draw(random);
  Preset p;
  p.accuracy.tolerance = std::pow(10, draw.between(-4, -2));
  constexpr void (*draw_kind[])(RandomDraw&, Preset&) = {
      circle, curve, cap,  revolution, profile,       translation,
      blocks, push,  load, rods,       random_network};
  static_assert(std::size(draw_kind) == words_of<SceneKind>().size());
  draw_kind[std::size_t(kind)](draw, p);
  return p;
}

}  // namespace gridshell::bench
