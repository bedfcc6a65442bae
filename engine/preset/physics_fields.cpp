#include "engine/preset/physics_fields.h"

#include "engine/preset/field_makers.h"

namespace gridshell::preset {
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
