// Presets that many tests start from.
#pragma once

#include <string>

#include "tests/results.h"

namespace gridshell {

/// The preset of that name that comes with the program.
inline preset::Preset shipped(const std::string& name) {
  const auto file = std::filesystem::path(GRIDSHELL_SOURCE_DIR) / "presets" / (name + ".toml");
  return value_of(preset::read_preset_file(file)).base;
}

namespace preset {

/// Reads the text as good.toml, which must be valid.
inline Presets good(const std::string& text, const std::vector<Override>& overrides = {}) {
  return value_of(read_preset_text(text, "good.toml", "good", overrides));
}

/// The errors of the text, read as bad.toml; "none" if there are none.
inline std::string errors_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  return refusal(read_preset_text(text, "bad.toml", "bad", overrides));
}

}  // namespace preset

/// A circle with `rods` rods per direction, contracted to a smaller radius.
inline preset::Preset circle(int rods, double radius_mm, double to_mm, int frames = 2) {
  preset::Preset p;
  p.footprint.rods = rods;
  p.footprint.radius_mm = radius_mm;
  p.actuation.radius_mm = to_mm;
  p.footprint.placement = rods % 2 ? Placement::on_axis : Placement::half;
  p.movie.frames = frames;
  return p;
}

/// A circle with `rods` rods per direction and a longest leg of 0.8 of the spacing of 20 mm, as in
/// the paper, contracted to a fraction of its radius.
inline preset::Preset paper_circle(int rods, double ratio = 0.75) {
  const double radius = 20 * (0.5 * (rods - 1) + 0.8);
  return circle(rods, radius, ratio * radius);
}

/// A closed curve that is contracted to `scale` of its size.
inline preset::Preset curve(preset::CurveKind kind, double half_x_mm, double half_y_mm,
                            double scale) {
  preset::Preset p;
  p.footprint.kind = preset::FootprintKind::curve;
  p.footprint.boundary.kind = kind;
  p.footprint.boundary.half_x_mm = half_x_mm;
  p.footprint.boundary.half_y_mm = half_y_mm;
  p.actuation.scale = scale;
  return p;
}

/// A superellipse |x/a|^n + |y/b|^n = 1 that is contracted to `scale` of its size.
inline preset::Preset superellipse(double a_mm, double b_mm, double n, double scale) {
  preset::Preset p = curve(preset::CurveKind::superellipse, a_mm, b_mm, scale);
  p.footprint.boundary.exponent = n;
  return p;
}

/// A shell that starts on its net, with rods on the axes.
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

/// The cap of a sphere of 120 mm radius above `cut_height` times the radius.
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

/// A circle of six rods, small enough to be formed in a moment.
inline preset::Preset small_shell() {
  preset::Preset preset = circle(6, 66, 54);
  preset.name = preset.title = "small";
  preset.imperfection.size = 0;
  return preset;
}

/// A network, on meshes chosen by the tolerance if `edges` is 0.
inline preset::Preset network(preset::NetworkData file, int edges = 0, int frames = 2) {
  preset::Preset p;
  p.footprint.kind = preset::FootprintKind::network;
  p.footprint.file = std::move(file);
  p.accuracy.edges_per_segment = edges;
  p.movie.frames = frames;
  return p;
}

/// Two rods along x and y that cross in their middles, at point 4; their ends, points 0 to 3, are
/// at these distances from there and `height` below it.
inline preset::NetworkData cross(double half_x, double half_y, double height = 0) {
  preset::NetworkData file;
  file.points = {{-half_x, 0, 0}, {half_x, 0, 0}, {0, -half_y, 0}, {0, half_y, 0}, {0, 0, height}};
  file.rods = {{0, 4, 1}, {2, 4, 3}};
  return file;
}

}  // namespace gridshell
