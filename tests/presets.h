// Presets that many tests begin with.
#pragma once

#include <string>

#include "engine/preset/preset_file.h"
#include "tests/results.h"

namespace gridshell {

/// One that comes with the program.
inline preset::Preset shipped(const std::string& name) {
  const auto file = std::filesystem::path(GRIDSHELL_SOURCE_DIR) / "presets" / (name + ".toml");
  return value_of(preset::read_preset_file(file)).base;
}

/// So many rods a direction inside a circle that is drawn in to another.
inline preset::Preset circle(int rods, double radius_mm, double to_mm, int frames = 2) {
  preset::Preset p;
  p.footprint.rods = rods;
  p.footprint.radius_mm = radius_mm;
  p.actuation.radius_mm = to_mm;
  p.footprint.placement = rods % 2 ? Placement::on_axis : Placement::half;
  p.movie.frames = frames;
  return p;
}

/// A superellipse |x/a|^n + |y/b|^n = 1 that is drawn in to so much of its size.
inline preset::Preset superellipse(double a_mm, double b_mm, double n, double scale) {
  preset::Preset p;
  p.footprint.kind = preset::FootprintKind::curve;
  p.footprint.boundary.kind = preset::CurveKind::superellipse;
  p.footprint.boundary.half_x_mm = a_mm;
  p.footprint.boundary.half_y_mm = b_mm;
  p.footprint.boundary.exponent = n;
  p.actuation.scale = scale;
  return p;
}

/// A shell that begins on its net, with rods on the axes.
inline preset::Preset on_net(preset::NetKind kind = preset::NetKind::sphere, double radius_mm = 120,
                             double length_mm = 0) {
  preset::Preset p;
  p.footprint.kind = preset::FootprintKind::net;
  p.footprint.placement = Placement::on_axis;
  p.actuation.start = preset::Start::net;
  p.net.kind = kind;
  p.net.radius_mm = radius_mm;
  if (length_mm > 0) p.net.length_mm = length_mm;
  p.movie.frames = 2;
  return p;
}

/// The part of a sphere of 120 mm above that height over its radius.
inline preset::Preset cap(double cut_height) {
  preset::Preset p = on_net();
  p.net.cut_height = cut_height;
  return p;
}

/// A saddle, its waist 0.6 of its radius.
inline preset::Preset spool(preset::Start start = preset::Start::net) {
  preset::Preset p = on_net(preset::NetKind::spool, 120, 180);
  p.net.waist = 0.6;
  p.actuation.start = start;
  return p;
}

}  // namespace gridshell
