#include "engine/preset/field_list.h"

namespace gridshell::preset {
namespace {

/// Adds the keys of [rod] or [rod_v].
void add_rods(FieldList<Rod> rods, const std::string& table) {
  rods.add<&Rod::material>(
      "gives young_GPa, shear_GPa, density_kg_m3 and strength_MPa where they are not given; "
      "values and sources under Materials in presets/README.md");
  const auto touching = [table](double Rod::*size) {
    return [table, size](const Preset& preset) -> std::string {
      const Rod& rod = table == "rod" ? preset.rod : preset.rod_v;
      const double spacing = preset.footprint.spacing_mm;
      const bool is_used = table == "rod" || preset.rod_v.differs;
      if (!is_used || preset.footprint.kind == FootprintKind::network || rod.*size < spacing)
        return "";
      return fmt::format(
          "neighbouring rods would touch, expected less than [footprint] spacing_mm = {}", spacing);
    };
  };
  rods.add<&Rod::diameter_mm>(above(0), "diameter of round rods, of tubes the outer one")
      .unused({"width_mm", "thickness_mm"},
              fmt::format("[{}] width_mm and thickness_mm make the rods rectangular", table),
              &Rod::rectangular)
      .refused({"[footprint] spacing_mm"}, touching(&Rod::diameter_mm));
  rods.add<&Rod::young_GPa>(above(0), "Young's modulus E").label("Young's modulus");
  rods.add<&Rod::shear_GPa>(
          at_least(0), "shear modulus G; 0: not given, which is enough where no rod is twisted")
      .label("shear modulus");
  rods.add<&Rod::density_kg_m3>(
      at_least(0), "density; 0: not given, which is enough without gravity and motion");
  rods.add<&Rod::strength_MPa>(at_least(0),
                               "strength: largest stress that a fibre bears; utilisation is the "
                               "stress over it; 0: not given");
  rods.add<&Rod::yield_strain>(
          between(0, 1), "largest strain that a fibre bears, instead of strength_MPa; 0: not given")
      .refused({"strength_MPa"},
               "the strength is in strength_MPa already, expected 0 for one of both",
               [](const Rod& rod) { return rod.yield_strain > 0 && rod.strength_MPa > 0; });
  const std::string half = "a rectangular section has both, expected [{}] {} above 0 too";
  const auto two_axes = [](const Rod& rod) {
    return rod.rectangular() && rod.width_mm != rod.thickness_mm;
  };
  rods.add<&Rod::width_mm>(
          at_least(0),
          "width of a rectangular section, in the plane of the grid; 0: the rods are round")
      .refused({"[footprint] spacing_mm"}, touching(&Rod::width_mm))
      .needs_twist("rods that are not equal in all directions twist as they bend", two_axes)
      .refused({}, fmt::format(fmt::runtime(half), table, "thickness_mm"),
               [](const Rod& rod) { return rod.width_mm > 0 && rod.thickness_mm == 0; });
  rods.add<&Rod::thickness_mm>(
          at_least(0),
          "thickness of a rectangular section, across the plane of the grid; 0: the rods are round")
      .refused({}, fmt::format(fmt::runtime(half), table, "width_mm"),
               [](const Rod& rod) { return rod.thickness_mm > 0 && rod.width_mm == 0; });
  rods.add<&Rod::wall_mm>(at_least(0), "wall of a tube, round or rectangular; 0: solid")
      .refused({}, [](const Rod& rod) {
        return rod.wall_fits()
                   ? ""
                   : fmt::format("a tube with such a wall is not hollow, expected below {}",
                                 0.5 * rod.thinnest_mm());
      });
  const char* round = "it is of a section that is equal in all directions, expected width_mm 0";
  rods.add<&Rod::EA_N>(at_least(0), "axial stiffness; 0: from the section");
  rods.add<&Rod::EI_Nmm2>(at_least(0),
                          "bending stiffness, equal in all directions; 0: from the section")
      .unit("N mm²")
      .refused({"width_mm"}, round,
               [](const Rod& rod) { return rod.EI_Nmm2 > 0 && rod.rectangular(); });
  rods.add<&Rod::GJ_Nmm2>(at_least(0), "torsional stiffness; 0: from the section").unit("N mm²");
  rods.add<&Rod::mass_g_per_m>(at_least(0), "mass per length; 0: from the section and its density")
      .unit("g/m");
  rods.add<&Rod::modulus_mm3>(at_least(0),
                              "section modulus W, for the stress M/W; 0: from the section")
      .unit("mm³")
      .refused({"width_mm"}, round,
               [](const Rod& rod) { return rod.modulus_mm3 > 0 && rod.rectangular(); });
  const char* curved = "rods with natural curvature twist as they bend";
  rods.add<&Rod::curvature_per_mm>("natural curvature in the vertical plane; above 0 arches up")
      .needs_twist(curved, [](const Rod& rod) { return rod.curvature_per_mm != 0; });
  rods.add<&Rod::curvature_sideways_per_mm>(
          "natural curvature in the plane of the grid; above 0 turns left, seen from above")
      .needs_twist(curved, [](const Rod& rod) { return rod.curvature_sideways_per_mm != 0; });
  // a round straight rod untwists by itself if its ends can rotate about their axes
  rods.add<&Rod::twist_rad_per_mm>("natural twist")
      .needs_twist(
          "rods with natural twist turn their axes", [=](const Preset& preset, const Rod& rod) {
            const bool curved = rod.curvature_per_mm != 0 || rod.curvature_sideways_per_mm != 0;
            return rod.twist_rad_per_mm != 0 &&
                   (two_axes(rod) || curved || preset.ends.kind == EndKind::clamped ||
                    clamps(preset.footprint.file));
          });
  if (table == "rod")
    rods.add<&Rod::as_drawn>(
            "whether a network's rods are cut as they are drawn, so that their lines are their "
            "shapes without stress; else they are naturally straight")
        .needs_twist("rods cut as drawn keep their curves", &Rod::as_drawn)
        .unused(
            {"[footprint] kind"}, "the rods of a grid are straight as they are drawn",
            [](const Preset& preset) { return preset.footprint.kind != FootprintKind::network; });
}

/// Whether the net is one of a surface of revolution, which ends in two rings.
bool has_rings(const Preset& preset) {
  const NetKind kind = preset.net.kind;
  return preset.footprint.kind == FootprintKind::net && kind != NetKind::sphere &&
         kind != NetKind::translation && kind != NetKind::surface;
}

bool is_network(const Preset& preset) { return preset.footprint.kind == FootprintKind::network; }

constexpr const char* in_the_file = "it names rods of a square grid, a network's file says it";

void add_joints(FieldList<Joints> joints) {
  joints
      .add<&Joints::kind>(
          "\"shared\": crossing rods share the joint's node; \"spring\": each has its own node, "
          "and a spring connects them")
      .needs_twist("spring joints give each rod a node of its own",
                   [](const Joints& of) { return of.kind == JointKind::spring; })
      .refused(
          {"stiffness_N_per_mm"},
          "springs without stiffness connect nothing, expected [joints] stiffness_N_per_mm above 0",
          [](const Joints& of) {
            return of.kind == JointKind::spring && of.stiffness_N_per_mm == 0;
          });
  joints.add<&Joints::stiffness_N_per_mm>(at_least(0), "stiffness of spring joints")
      .refused({"kind"},
               "shared joints have no stiffness, expected 0, or [joints] kind = \"spring\"",
               [](const Joints& of) {
                 return of.kind == JointKind::shared && of.stiffness_N_per_mm > 0;
               });
  joints
      .add<&Joints::shear_Nmm>(
          at_least(0), "resistance to the change of the crossing angle; 0: joints shear freely")
      .needs_twist("the joints resist shear", [](const Joints& of) { return of.shear_Nmm > 0; });
  joints
      .add<&Joints::twist_Nmm>(at_least(0),
                               "resistance to the rotation of a rod relative to the joint's "
                               "normal; 0: joints pass no twist")
      .needs_twist("the joints pass twist", [](const Joints& of) { return of.twist_Nmm > 0; });
  const auto eccentric = [](const Joints& of) { return of.eccentricity_mm != 0; };
  joints
      .add<&Joints::eccentricity_mm>(
          between(-1000, 1000),
          "distance of the second rod's axis (v-rod; in a network the one listed later) above the "
          "first's, along the joint's normal; negative: below it")
      .refused(
          {"kind"},
          "axes at a distance are connected by a bolt, expected 0, or [joints] kind = \"shared\"",
          [=](const Joints& of) { return eccentric(of) && of.kind == JointKind::spring; })
      .needs_equilibrium("a net's rods cross in a point", eccentric);
  joints.add<&Joints::diameter_mm>(
      above(0),
      "diameter of the joint's cylinder, whose top a scan sees; \"none\": 3 mm, or 1.5 times the "
      "thickest rod (of laths the smaller side) if larger");
  joints.add<&Joints::height_mm>(
      at_least(0),
      "height of the cylinder's top above the rods' crossing, along the shell's normal; \"none\": "
      "5 mm, or 1.5 times the thickest rod (of laths the smaller side) if larger");
  joints.add<&Joints::mass_g>(
      at_least(0), "mass of each joint, in addition to that of its rods, for gravity and motion");
}

void add_ends(FieldList<Ends> ends) {
  ends.add<&Ends::kind>(
          "\"pinned\": position prescribed; \"tangent\": direction too, along the net's tangents "
          "or, in a circle, as in the flat grid; \"clamped\": rotation about the axis too")
      .needs_twist("clamped ends prescribe the rods' twist angle",
                   [](const Ends& of) { return of.kind == EndKind::clamped; });
  const char* no_net = "a network has no net whose end rings it could be";
  ends.add<&Ends::rings>(
          "whether ends on the rings of a surface of revolution are pinned like the others, or "
          "free")
      .unused({"[footprint] kind"}, no_net, is_network)
      .refused({"[footprint] kind", "[net] kind"},
               "only a surface of revolution has end rings, expected \"pinned\"",
               [](const Preset& preset, const Ends& of) {
                 return of.rings == Rings::free && !has_rings(preset);
               });
  ends.add<&Ends::second_ring_mm>(
          at_least(0),
          "length of tails outside the boundary, without joints; their far ends are pinned so that "
          "the rods keep the net's tangents at the boundary; 0: none")
      .unused({"[footprint] kind"}, no_net, is_network)
      .refused({"[footprint] kind"},
               "the far ends are pinned along the tangents of a net, and this footprint has none, "
               "expected 0, or [footprint] kind = \"net\"",
               [](const Preset& preset, const Ends& of) {
                 return of.second_ring_mm > 0 && !preset.on_net();
               })
      .refused({"kind"},
               "a tail prescribes the direction of its end, which is prescribed already, expected "
               "0, or [ends] kind = \"pinned\"",
               [](const Ends& of) { return of.second_ring_mm > 0 && of.kind != EndKind::pinned; })
      .needs_equilibrium("a net has no tails",
                         [](const Ends& of) { return of.second_ring_mm > 0; });
  ends.add<&Ends::table>(
          "ends of a designed shell, instead of the boundary: position, length of the leg, and "
          "direction where it is prescribed")
      .points({"family", "rod", "end", "x_mm", "y_mm", "z_mm", "leg_mm", "tx", "ty", "tz"},
              {{"u", "v"}, {}, {"begin", "end"}})
      .unused({"[footprint] kind"}, in_the_file, is_network)
      .needs_equilibrium("a net's ends lie where the net has them",
                         [](const Ends& of) { return !of.table.empty(); });
}

}  // namespace

void add_rod_fields(std::vector<Field>& all) {
  add_rods({all, "rod", &Preset::rod}, "rod");
  FieldList<Preset>(all, "rod", [](Preset& preset) -> Preset& { return preset; })
      .add<&Preset::rod_table>("diameters of single rods, by family and number")
      .named("table")
      .points({"family", "rod", "diameter_mm"}, {{"u", "v"}})
      .unused({"[footprint] kind"}, in_the_file, is_network);
  const char* one_kind = "a network's rods are of one kind, with diameters in its file";
  FieldList<RodV>(all, "rod_v", &Preset::rod_v)
      .unused({"[footprint] kind"}, one_kind, is_network)
      .add<&RodV::differs>(
          "whether the v-rods differ from those of [rod]; the keys below then count")
      .refused(
          {}, "the other keys of [rod_v] would have no effect, expected true",
          [](const RodV& rod) { return !rod.differs && static_cast<const Rod&>(rod) != Rod(); });
  FieldList<Rod> v_rods(all, "rod_v", [](Preset& preset) -> Rod& { return preset.rod_v; });
  v_rods.unused({"[footprint] kind"}, one_kind, is_network).where([](const Preset& preset) {
    return preset.rod_v.differs;
  });
  add_rods(v_rods, "rod_v");
  add_joints({all, "joints", &Preset::joints});
  add_ends({all, "ends", &Preset::ends});
}

}  // namespace gridshell::preset
