#include "engine/preset/field_groups.h"

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

namespace {

using P = Preset;

// the rods of a table: all, or those of one family
template <auto rods>
std::vector<Field> fields_of_rods(const std::string& table) {
  return {
      {table, "diameter_mm", "mm", real<rods, &Rod::diameter_mm>(above(0)),
       "diameter of round rods"},
      {table, "young_GPa", "GPa", real<rods, &Rod::young_GPa>(above(0)), "Young's modulus E"},
      {table, "shear_GPa", "GPa", real<rods, &Rod::shear_GPa>(at_least(0)),
       "shear modulus G; 0: not given, which is enough where no rod is twisted"},
      {table, "density_kg_m3", "kg/m^3", real<rods, &Rod::density_kg_m3>(at_least(0)),
       "density; 0: not given, which is enough without gravity and motion"},
      {table, "width_mm", "mm", real<rods, &Rod::width_mm>(at_least(0)),
       "of a rectangular section, in the flat; 0: the rods are round"},
      {table, "thickness_mm", "mm", real<rods, &Rod::thickness_mm>(at_least(0)),
       "of a rectangular section, upright; 0: the rods are round"},
      {table, "curvature_per_mm", "1/mm", real<rods, &Rod::curvature_per_mm>({}),
       "curvature at rest in the upright plane; above 0 arches up"},
      {table, "curvature_sideways_per_mm", "1/mm", real<rods, &Rod::curvature_sideways_per_mm>({}),
       "curvature at rest in the flat; above 0 turns left, seen from above"},
      {table, "twist_rad_per_mm", "rad/mm", real<rods, &Rod::twist_rad_per_mm>({}),
       "twist at rest"},
  };
}

}  // namespace

std::vector<Field> rod_fields() {
  auto fields = fields_of_rods<&P::rod>("rod");
  fields.push_back({"rod", "table", "",
                    points<&P::rod_table>({"family", "rod", "diameter_mm"}, {{"u", "v"}}),
                    "rods that have diameters of their own, by family and number"});
  fields.push_back(
      {"rod_v", "differs", "", flag<&P::rod_v, &RodV::differs>(),
       "whether the v rods are others than those of [rod]; the keys below then count"});
  for (auto& field : fields_of_rods<&P::rod_v>("rod_v")) fields.push_back(std::move(field));
  return fields;
}

std::vector<Field> joint_fields() {
  return {
      {"joints", "kind", "", word<&P::joints, &Joints::kind>(),
       "\"shared\": crossing rods share the joint's node; \"spring\": each has its own, held "
       "together by a spring"},
      {"joints", "stiffness_N_per_mm", "N/mm",
       real<&P::joints, &Joints::stiffness_N_per_mm>(at_least(0)), "of spring joints"},
      {"joints", "shear_Nmm", "N mm/rad", real<&P::joints, &Joints::shear_Nmm>(at_least(0)),
       "resistance to the change of the crossing angle; 0: joints shear freely"},
      {"joints", "twist_Nmm", "N mm/rad", real<&P::joints, &Joints::twist_Nmm>(at_least(0)),
       "resistance to a rod's spin beside the joint's normal; 0: joints pass no twist"},
      {"joints", "diameter_mm", "mm", real<&P::joints, &Joints::diameter_mm>(above(0)),
       "of the joint's cylinder, of which a scan sees the top"},
      {"joints", "height_mm", "mm", real<&P::joints, &Joints::height_mm>(at_least(0)),
       "how far the top of that cylinder lies above the rods' crossing, along the shell's normal"},
      {"ends", "kind", "", word<&P::ends, &Ends::kind>(),
       "\"pinned\": position held, direction and spin free; \"tangent\": direction held too, along "
       "the net's tangents or, in a circle, as in the flat; \"clamped\": spin held too"},
      {"ends", "rings", "", word<&P::ends, &Ends::rings>(),
       "whether the ends on the rings of a surface of revolution are held like the others or free"},
      {"ends", "second_ring_mm", "mm", real<&P::ends, &Ends::second_ring_mm>(at_least(0)),
       "length of tails without joints beyond the boundary, their far ends pinned so that the rods "
       "keep the net's tangents at it; 0: none"},
      {"ends", "table", "",
       points<&P::ends, &Ends::table>(
           {"family", "rod", "end", "x_mm", "y_mm", "z_mm", "leg_mm", "tx", "ty", "tz"},
           {{"u", "v"}, {}, {"begin", "end"}}),
       "of a designed shell, in the place of the boundary: where ends are held, how long their "
       "legs "
       "are, and along which direction of the rod where one is held"},
  };
}

std::vector<Field> inverse_fields() {
  return {
      {"inverse", "vary", "", word_list<&P::inverse, &Inverse::vary>(),
       "what may change so that the shell meets its target: \"pins_radial\": where ends are held, "
       "along the radius; \"pins\": in the boundary's plane; \"pins_3d\": in space; \"legs\": "
       "their lengths; \"directions\": along which tangent ends are held; \"diameters\": of every "
       "rod; empty: nothing is designed"},
      {"inverse", "target", "", word<&P::inverse, &Inverse::target>(),
       "\"surface\": the joints on the net's surface; \"net\": each in its place on the net"},
      {"inverse", "norm", "", real<&P::inverse, &Inverse::norm>(between(2, 32)),
       "p of the mean of |distance|^p that is made small in the last stage; the first has 2"},
      {"inverse", "mu", "", real<&P::inverse, &Inverse::mu>(at_least(0)),
       "weight of the mean square of all moves (mm; rad of a direction; a tenth of a rod's "
       "diameter) beside that of the distances (mm)"},
      {"inverse", "move_limit_mm", "mm", real<&P::inverse, &Inverse::move_limit_mm>(above(0)),
       "furthest that a pin is moved or a leg's length is changed"},
      {"inverse", "round_mm", "mm", real<&P::inverse, &Inverse::round_mm>(at_least(0)),
       "to which a builder measures: the shell must be stable after rounding to it; 0: exact"},
      {"inverse", "min_stability", "", real<&P::inverse, &Inverse::min_stability>(between(0, 1)),
       "of the smallest eigenvalue, over that of the shell before"},
      {"inverse", "max_leg_force_N", "N", real<&P::inverse, &Inverse::max_leg_force_N>(at_least(0)),
       "largest force in a leg, unless it is larger before; 0: any"},
  };
}

std::vector<Field> load_fields() {
  return {
      {"loads", "gravity_m_s2", "m/s^2", real<&P::loads, &Loads::gravity_m_s2>({}),
       "gravity, downwards; loads come on with the actuation, in full at its end"},
      {"loads", "field_N_per_mm", "N/mm", real<&P::loads, &Loads::field_N_per_mm>({}),
       "artificial gravity: force on every millimetre of rod, downwards"},
      {"loads", "points", "", points<&P::loads, &Loads::points>({"i", "j", "F_x", "F_y", "F_z"}),
       "forces in N on joints"},
      {"dynamics", "snap", "", flag<&P::dynamics, &Dynamics::snap>(),
       "whether a loss of stability is followed in time to the next rest, with frames of its own"},
      {"dynamics", "step_s", "s", real<&P::dynamics, &Dynamics::step_s>(above(0)), "time step"},
      {"dynamics", "damping_per_s", "1/s", real<&P::dynamics, &Dynamics::damping_per_s>(above(0)),
       "damping, in proportion to the mass: a velocity falls to 1/e in the inverse of it"},
  };
}

}  // namespace gridshell::preset
