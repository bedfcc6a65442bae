// Keys of [[step]], [loads] and [[loads.case]].
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/preset/field_list.h"

namespace gridshell::preset {
namespace {

/// Refuses rows whose first `columns` numbers are no integers, or those of an earlier row.
void add_index_rules(FieldList<Step>& list, Points Step::*rows, long columns, const char* what) {
  const auto indices = [=](const std::vector<double>& row) {
    return std::vector<double>(row.begin(), row.begin() + columns);
  };
  list.refused({}, [=](const Step& of) -> std::string {
    std::set<std::vector<double>> known;
    for (const auto& row : of.*rows) {
      const auto index = indices(row);
      if (std::ranges::any_of(index, [](double k) { return k != std::round(k); }))
        return fmt::format("[{:g}] is no {}, expected integers", fmt::join(index, ", "), what);
      if (!known.insert(index).second)
        return fmt::format("[{:g}] twice, expected each {} once", fmt::join(index, ", "), what);
    }
    return "";
  });
}

/// Adds the conflicts of steps with other keys, which are reported for the first step.
void step_rules(FieldList<Step>& list) {
  const auto first = [](const Preset& preset, const Step& of) { return &of == preset.step.data(); };
  list.refused({"[indentation] depth", "[indentation] depth_mm"},
               "[indentation] pushes already, expected a step \"push\" instead of it",
               [=](const Preset& preset, const Step& of) {
                 return first(preset, of) && preset.indentation.requested();
               })
      .refused({"[jitter] trials", "[jitter] confined"},
               "states are searched of a shell without steps, expected no [[step]], or [jitter] "
               "trials and confined 0",
               [=](const Preset& preset, const Step& of) {
                 return first(preset, of) && preset.jitter.requested();
               })
      .needs_equilibrium("the shape of a net does not change with a step", first);
}

/// Adds the keys of the steps that change joints and braces: tighten, open, brace, release.
void add_stiffening(FieldList<Step>& list) {
  using K = StepKind;
  list.add<&Step::stiffness_Nmm>(at_least(0),
                                 "tighten: resistance of each joint to a change of its angle; "
                                 "open: to a deviation from the target angle; 0: rigid");
  list.used_by(&Step::kind, {K::tighten, K::open});
  list.add<&Step::angle_deg>(
      between(0, 180),
      "open: target for the average angle of all crossings of two rods, each turned equally; "
      "between the directions of the rods; 0: `angles` is used");
  list.used_by(&Step::kind, {K::open})
      .refused({}, "both or none of angle_deg and angles, expected one of them",
               [](const Step& of) {
                 return of.kind == K::open && of.angles.empty() == (of.angle_deg == 0);
               });
  list.add<&Step::angles>("open: target angles of single joints; the others are free")
      .points({"i", "j", "angle_deg"});
  list.used_by(&Step::kind, {K::open});
  add_index_rules(list, &Step::angles, 2, "joint");
  list.refused({}, [](const Step& of) -> std::string {
    for (const auto& row : of.angles)
      if (!(row[2] >= 1 && row[2] <= 179))
        return fmt::format("an angle of {:g} degrees, expected 1 to 179", row[2]);
    return "";
  });
  list.add<&Step::drive>(
      "open: \"each\": every joint has a spring; \"mean\": one torque, equal at all joints, brings "
      "their mean angle to the target, from the network as drawn");
  list.used_by(&Step::kind, {K::open})
      .refused({}, "a mean angle has no angles of single joints, expected \"each\"",
               [](const Step& of) {
                 return of.kind == K::open && of.drive == JointDrive::mean && !of.angles.empty();
               });
  list.add<&Step::cells>("brace: the cells; empty: all complete ones").points({"i", "j"});
  list.used_by(&Step::kind, {K::brace});
  list.add<&Step::diagonals>(
      "brace: \"first\" from joint (i, j) to (i + 1, j + 1), \"second\" the other");
  list.used_by(&Step::kind, {K::brace});
  list.add<&Step::brace>("brace: \"cable\": bears no compression; \"strut\": bears both")
      .named("as");
  list.used_by(&Step::kind, {K::brace});
  list.add<&Step::EA_N>(at_least(0), "brace: axial stiffness").unit("N");
  list.used_by(&Step::kind, {K::brace})
      .refused({}, "a brace needs a stiffness, expected above 0",
               [](const Step& of) { return of.kind == K::brace && of.EA_N == 0; });
  list.add<&Step::what>("release: prescribed joints, all bolts or all braces");
  list.used_by(&Step::kind, {K::release});
}

void add_steps(FieldList<Step> list) {
  using K = StepKind;
  const auto only = [&list](std::vector<StepKind> kinds) -> FieldList<Step>& {
    return list.used_by(&Step::kind, std::move(kinds));
  };
  list.add<&Step::kind>(
          "what is done: \"move\" the boundary; \"push\", \"hold\" or \"release\" joints; "
          "\"load\"; \"rest\": descend; \"jitter\"; \"tighten\" bolts; \"brace\" cells; \"open\" "
          "joints to other angles (see Steps)")
      .named("do");
  step_rules(list);
  list.add<&Step::progress>(
      between(0, 10), "move: 0 is the original boundary, 1 the actuated one, above 1 further");
  only({K::move}).unused({"radius_mm"}, "radius_mm replaces it",
                         [](const Step& of) { return of.radius_mm > 0; });
  list.add<&Step::radius_mm>(at_least(0),
                             "move: radius of a circle, instead of `progress`; 0: not given");
  only({K::move})
      .refused({}, "only a circle's boundary has a radius, expected 0: `progress` works for all",
               [](const Preset& preset, const Step& of) {
                 return of.radius_mm > 0 && preset.footprint.kind != FootprintKind::circle;
               })
      .refused({}, [](const Preset& preset, const Step& of) {
        return of.radius_mm > preset.original_radius_mm()
                   ? fmt::format("larger than the footprint, expected at most R_o = {}",
                                 preset.original_radius_mm())
                   : "";
      });
  list.add<&Step::edge_points>(
          "move: displacement of single edge points, counted from 0, relative to the boundary's "
          "motion")
      .points({"edge_point", "x_mm", "y_mm", "z_mm"});
  only({K::move}).refused(
      {}, "an edge point without a number, expected an integer from 0", [](const Step& of) {
        return std::ranges::any_of(of.edge_points, [](const auto& row) { return row[0] < 0; });
      });
  add_index_rules(list, &Step::edge_points, 1, "edge point");
  list.add<&Step::joint>(between(-500, 500), "indices of the joint; release: empty releases all")
      .shape("[i, j]");
  only({K::push, K::hold, K::release})
      .unused({"what"}, "bolts and braces are taken out all together",
              [](const Step& of) { return of.what != Released::joints; })
      .refused({}, "expected [i, j]", [](const Step& of) {
        return of.joint.empty() && (of.kind == K::push || of.kind == K::hold);
      });
  list.add<&Step::to_mm>("push: position to which the joint is moved; empty: `depth_mm` is used")
      .shape("[x, y, z]");
  only({K::push});
  list.add<&Step::depth_mm>(
      "push: displacement of the joint against the shell's normal, inward; negative: outward");
  only({K::push}).refused(
      {}, "both or none of to_mm and depth_mm, expected one of them",
      [](const Step& of) { return of.kind == K::push && of.to_mm.empty() == (of.depth_mm == 0); });
  list.add<&Step::along>(
          "direction in which the joint is prescribed; it is free across it; empty: that of the "
          "push, for \"hold\" all directions")
      .shape("[x, y, z]");
  only({K::push, K::hold})
      .refused({}, "no direction, expected a vector with a length",
               [](const Step& of) {
                 return of.along == std::vector<double>{0, 0, 0};
               })
      .refused({},
               "a joint that is prescribed across the push has no direction of its own, expected "
               "[], or lateral = \"free\"",
               [](const Step& of) {
                 return of.kind == K::push && of.lateral == Lateral::held && !of.along.empty();
               });
  list.add<&Step::lateral>("whether the joint pushed may move across the push");
  only({K::push});
  list.add<&Step::factor>(
      between(-1000, 1000),
      "multiple of [loads], or of the named case, that acts after the step; 0: none");
  only({K::load});
  list.add<&Step::load_case>(
          "load: name of a [[loads.case]], evaluated on the shape at which it is applied; empty: "
          "the loads under which the shell was formed")
      .named("case");
  only({K::load}).refused({"[[loads.case]] name"}, [](const Preset& preset, const Step& of) {
    const bool known = of.load_case.empty() ||
                       std::ranges::count(preset.load_case, of.load_case, &LoadCase::name) > 0;
    return known ? "" : "no such case, expected the name of a [[loads.case]]";
  });
  add_stiffening(list);
  list.add<&Step::side>(
      "\"rest\": from an unstable state to the side of lower energy, or along or against its "
      "lowest mode");
  only({K::rest});
  list.add<&Step::seed>(between(0, 1 << 30), "jitter: seed of the random forces");
  only({K::jitter});
  list.add<&Step::force_N>(above(0), "jitter: largest force on a joint along each axis");
  only({K::jitter});
}

constexpr const char* force_points =
    "forces in N on joints, and on free ends of a network, named as its joints: [point, 0]";

void add_loads(FieldList<Loads> list) {
  list.add<&Loads::gravity_m_s2>(
      "gravity, downwards; loads grow with the actuation to their full value at its end");
  needs_mass<Loads>(list, "gravity", [](const Loads& of) { return of.gravity_m_s2 != 0; });
  list.add<&Loads::field_N_per_mm>(
      "artificial gravity: force on every millimetre of rod, downwards");
  list.add<&Loads::points>(force_points)
      .points({"i", "j", "F_x", "F_y", "F_z"})
      .needs_equilibrium("a net does not answer loads", &Loads::any);
}

void add_area_loads(FieldList<Loads> list) {
  const auto idle = [&list](auto factor) {
    list.unused({"[[loads.case]] name"},
                "no [[loads.case]] has a factor of it; a case has a name and factors, such as "
                "snow = 1.0",
                [=](const Preset& preset) {
                  return std::ranges::none_of(
                      preset.load_case, [&](const LoadCase& one) { return one.*factor != 0; });
                });
  };
  list.add<&Loads::snow_N_m2>(
      at_least(0),
      "cases: snow per area of plan, on the shape at which it is applied; none on overhangs");
  idle(&LoadCase::snow);
  list.add<&Loads::wind_N_m2>(
      at_least(0),
      "cases: wind pressure at normal incidence, elsewhere times the cosine between wind and "
      "normal; inwards on the windward side, outwards on the leeward side");
  idle(&LoadCase::wind);
  list.add<&Loads::wind_deg>(between(-360, 360),
                             "direction to which the wind blows, from +x towards +y");
  list.unused({"[[loads.case]] wind_deg"}, "every case with wind has a direction of its own",
              [](const Preset& preset) {
                return std::ranges::none_of(preset.load_case, [](const LoadCase& one) {
                  return one.wind != 0 && !one.wind_deg;
                });
              });
  list.add<&Loads::pressure_N_m2>(at_least(0),
                                  "cases: pressure on every face against its normal; it turns with "
                                  "the shell; the edge must be fixed");
  idle(&LoadCase::pressure);
  list.add<&Loads::edge_N_m>(at_least(0),
                             "cases: load per length of the edge (sides of faces that no other "
                             "face shares), on the shape at which it is applied");
  idle(&LoadCase::edge);
  list.add<&Loads::edge_direction>(
      "direction of the load on the edge: \"down\"; \"normal\": against the shell's normal; "
      "\"inward\": in the surface, across the edge; \"pressure\": in plan, across the moving edge");
  idle(&LoadCase::edge);
  list.add<&Loads::imperfection>(
      above(0),
      "largest displacement of the shapes of `gridshell load --imperfections N`, mixed from the "
      "lowest modes, over R_o, rho or half the bounding diagonal");
}

void add_load_cases(FieldList<LoadCase> list) {
  using C = LoadCase;
  const auto lacks = [](double C::*factor, double Loads::*load) {
    return [=](const Preset& preset, const C& of) {
      return of.*factor != 0 && preset.loads.*load == 0;
    };
  };
  list.add<&C::name>("name of the case in steps, tables and pictures");
  list.refused({}, "expected a name that no other case has", [](const Preset& preset, const C& of) {
    return of.name.empty() || std::ranges::count(preset.load_case, of.name, &C::name) > 1;
  });
  list.needs_equilibrium("a net does not answer loads", [](const C&) { return true; });
  list.add<&C::dead>(between(-1000, 1000),
                     "multiple of gravity, field and points of [loads], in addition to those under "
                     "which the shell was formed")
      .refused(
          {"[loads] gravity_m_s2"}, "[loads] has no load, expected 0",
          [](const Preset& preset, const C& of) { return of.dead != 0 && !preset.loads.any(); });
  list.add<&C::snow>(between(-1000, 1000), "multiple of snow_N_m2")
      .refused({"[loads] snow_N_m2"}, "there is no snow, expected [loads] snow_N_m2 above 0",
               lacks(&C::snow, &Loads::snow_N_m2));
  list.add<&C::snow_side>("half of the shell, seen from the middle of its joints, that has snow")
      .unused({"snow"}, "the case has no snow", [](const C& of) { return of.snow == 0; });
  list.add<&C::wind>(between(-1000, 1000), "multiple of wind_N_m2")
      .refused({"[loads] wind_N_m2"}, "there is no wind, expected [loads] wind_N_m2 above 0",
               lacks(&C::wind, &Loads::wind_N_m2));
  list.add<&C::wind_deg>(between(-360, 360),
                         "direction to which the wind of this case blows; \"none\": [loads] "
                         "wind_deg")
      .unused({"wind"}, "the case has no wind", [](const C& of) { return of.wind == 0; });
  list.add<&C::pressure>(between(-1000, 1000), "multiple of pressure_N_m2; negative: from inside")
      .refused({"[loads] pressure_N_m2"},
               "there is no pressure, expected [loads] pressure_N_m2 above 0",
               lacks(&C::pressure, &Loads::pressure_N_m2));
  list.add<&C::edge>(between(-1000, 1000), "multiple of edge_N_m")
      .refused({"[loads] edge_N_m"},
               "there is no load on the edge, expected [loads] edge_N_m above 0",
               lacks(&C::edge, &Loads::edge_N_m));
  list.add<&C::points>(force_points).points({"i", "j", "F_x", "F_y", "F_z"});
}

}  // namespace

void add_hand_fields(std::vector<Field>& all) {
  add_steps({all, "step", [](Preset& preset, int item) -> Step& {
               return item < 0 ? preset.step.back() : preset.step[std::size_t(item)];
             }});
  add_loads({all, "loads", &Preset::loads});
  add_area_loads({all, "loads", &Preset::loads});
  add_load_cases({all, "loads.case", [](Preset& preset, int item) -> LoadCase& {
                    return item < 0 ? preset.load_case.back() : preset.load_case[std::size_t(item)];
                  }});
}

}  // namespace gridshell::preset
