#include "engine/preset/shape_fields.h"

#include "engine/preset/field_makers.h"

namespace gridshell::preset {
namespace {

using P = Preset;

/// A closed curve at the end of `path`, in the table of that name.
template <auto... path>
std::vector<Field> curve_fields(const std::string& table, const std::string& meaning) {
  return {
      {table, "boundary", "", word<path..., &Curve::kind>(), meaning},
      {table, "half_x_mm", "mm", real<path..., &Curve::half_x_mm>(above(0)),
       "half axis of an ellipse or superellipse along x"},
      {table, "half_y_mm", "mm", real<path..., &Curve::half_y_mm>(above(0)), "and along y"},
      {table, "exponent", "", real<path..., &Curve::exponent>(between(1, 100)),
       "n of a superellipse, |x/a|^n + |y/b|^n = 1"},
      {table, "points_mm", "mm", points<path..., &Curve::points>({"x", "y"}),
       "corners of a polygon, or points that a closed spline goes through"},
  };
}

/// A net at the end of `path`, in the table of that name.
template <auto... path>
std::vector<Field> fields_of_net(const std::string& table) {
  return {
      {table, "kind", "", word<path..., &Net::kind>(),
       "\"sphere\": a cap of Chebyshev's net; \"translation\": the sum of two curves; \"surface\": "
       "any surface by an expression or a file ([net] alone); the others: "
       "the upper half of a surface of revolution about the x-axis, \"spool\" and \"beltrami\" of "
       "constant K = -1/rho^2"},
      {table, "radius_mm", "mm", real<path..., &Net::radius_mm>(above(0)),
       "radius rho of the sphere or cylinder; K = -1/rho^2 of spool and beltrami"},
      {table, "cut_height", "", real<path..., &Net::cut_height>(between(0, 0.999)),
       "height of a cap's boundary over rho, z*/rho; 0: the hemisphere"},
      {table, "length_mm", "mm", real<path..., &Net::length_mm>(at_least(0)),
       "distance between the end rings of a surface of revolution; 0: all of a profile"},
      {table, "waist", "", real<path..., &Net::waist>({0, 100, true}),
       "radius over rho in the middle of a spool (its smallest) or beltrami surface (below 1)"},
      {table, "crossing_deg", "deg", real<path..., &Net::crossing_deg>(between(1, 179)),
       "angle between the rods, seen along the axis, in the middle of a surface of revolution"},
      {table, "profile", "", points<path..., &Net::profile>({"r", "z"}),
       "points of a profile, mm: radius and place along the axis"},
      {table, "curve_u", "", points<path..., &Net::curve_u>({"x", "y", "z"}),
       "points of the curve X of a translation net X(u) + Y(v), mm"},
      {table, "curve_v", "", points<path..., &Net::curve_v>({"x", "y", "z"}), "and of Y"},
  };
}

/// Of a net on any surface.
std::vector<Field> surface_fields() {
  return {
      {"net", "implicit", "", text<&P::net, &Net::implicit>(),
       "F(x, y, z) of a surface F = 0, mm: \"x^2 + y^2 + z^2 - 120^2\""},
      {"net", "height", "", text<&P::net, &Net::height>(),
       "h(x, y) of a surface z = h, mm, in the place of `implicit`"},
      {"net", "file", "", surface<&P::net, &Net::file>(),
       "in their place: heights x, y, z over a rectangular grid (.csv, .txt), which a spline goes "
       "through, or triangles (.obj, .ply, .stl), to which a smooth surface is fitted; mm"},
      {"net", "apex_mm", "mm", list<&P::net, &Net::apex_mm>({}),
       "[x, y, z], a point of the surface where the net's axes cross at right angles; of a height "
       "or a file [x, y]"},
      {"net", "axis", "", word<&P::net, &Net::axis>(),
       "what the u-axis leaves the apex along: the direction in which the surface curves most "
       "(where it curves alike in all, x), or x"},
      {"net", "axis_deg", "deg", real<&P::net, &Net::axis_deg>(between(-180, 180)),
       "how far it is turned from there, to the left as seen from above"},
      {"net", "cut_mm", "mm", real<&P::net, &Net::cut_mm>({}),
       "height of the plane that cuts the surface: the net is kept above it"},
      {"net", "within", "", text<&P::net, &Net::within>(),
       "G(x, y, z), below zero where the net is kept, in the place of the plane; empty: the plane"},
  };
}

template <std::optional<int> Block::*side>
Field cut_field(const char* key, const char* meaning) {
  return {"block", key, "", optional<&P::block, side>(between(-500, 500)), meaning};
}

void append(std::vector<Field>& fields, std::vector<Field> more) {
  fields.insert(fields.end(), more.begin(), more.end());
}

}  // namespace

std::vector<Field> boundary_fields() {
  auto fields = curve_fields<&P::footprint, &Footprint::boundary>(
      "footprint", "boundary of a footprint of kind \"curve\", about the origin");
  append(fields, {{"actuation", "scale", "", real<&P::actuation, &Actuation::scale>(between(0, 1)),
                   "of a footprint of kind \"curve\": the actuated boundary is the original one "
                   "times this; 0: it is given by `boundary`. Of kind \"network\": ends of which "
                   "the file says nothing move to this times their place from the middle of the "
                   "box around the rods; 0: they stay"}});
  append(fields, curve_fields<&P::actuation, &Actuation::boundary>(
                     "actuation", "actuated boundary of a footprint of kind \"curve\""));
  append(fields,
         {{"actuation", "correspondence", "", word<&P::actuation, &Actuation::correspondence>(),
           "which point of it an edge point moves to: the one at the same fraction of the "
           "length from +x, or at the same polar angle"}});
  return fields;
}

std::vector<Field> net_fields() {
  auto fields = fields_of_net<&P::net>("net");
  append(fields, surface_fields());
  append(fields, {{"blocks", "max_gap_mm", "mm", real<&P::blocks, &Blocks::max_gap_mm>(at_least(0)),
                   "largest distance in space between two blocks at a joint of their seam"},
                  {"block", "name", "", text<&P::block, &Block::name>(), "of the block, its own"}});
  append(fields, fields_of_net<&P::block, &Block::net>("block"));
  append(fields, {cut_field<&Block::east>("east",
                                          "row m of joints at which it is cut: kept where "
                                          "u + v <= m d, u and v its net's own"),
                  cut_field<&Block::west>("west", "kept where u + v >= m d"),
                  cut_field<&Block::north>("north", "kept where v - u <= m d"),
                  cut_field<&Block::south>("south", "kept where v - u >= m d"),
                  {"join", "first", "", text<&P::join, &Join::first>(),
                   "side of a block, as \"name.east\""},
                  {"join", "second", "", text<&P::join, &Join::second>(),
                   "side that faces it, as \"other.west\""}});
  return fields;
}

}  // namespace gridshell::preset
