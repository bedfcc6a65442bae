// What a hand does to a formed shell, and what it carries.
#include "engine/preset/field_list.h"

namespace gridshell::preset {
namespace {

/// What the steps of a preset cannot stand beside, said of the first.
void step_rules(FieldList<Step>& list) {
  const auto first = [](const Preset& preset, const Step& of) { return &of == preset.step.data(); };
  list.refused({"[indentation] depth", "[indentation] depth_mm"},
               "[indentation] pushes already, must be a step \"push\" in its place",
               [=](const Preset& preset, const Step& of) {
                 return first(preset, of) && preset.indentation.wanted();
               })
      .refused({"[jitter] trials", "[jitter] confined"},
               "states are looked for of a shell that no hand touches, must be without [[step]], "
               "or [jitter] trials and confined 0",
               [=](const Preset& preset, const Step& of) {
                 return first(preset, of) && preset.jitter.wanted();
               })
      .needs_equilibrium("a net does not answer a hand", first);
}

/// Whether an open finds bolts of another stiffness, which it cannot go on with.
bool meets_other_bolts(const Preset& preset, const Step& of) {
  const Step* bolted = nullptr;
  for (const Step& step : preset.step) {
    if (&step == &of) break;
    if (step.kind == StepKind::tighten || step.kind == StepKind::open) bolted = &step;
    if (step.kind == StepKind::release && step.what == Released::bolts) bolted = nullptr;
  }
  return of.kind == StepKind::open && bolted && bolted->stiffness_Nmm != of.stiffness_Nmm;
}

/// What makes a formed shell stiff, and takes it away again.
void add_stiffening(FieldList<Step>& list) {
  using K = StepKind;
  list.add<&Step::stiffness_Nmm>(at_least(0),
                                 "of a tighten: resistance of each joint to a change of its angle; "
                                 "of an open: of each joint to "
                                 "being off the angle that it is opened to; 0: rigid");
  list.used_by(&Step::kind, {K::tighten, K::open})
      .refused({},
               "bolts of another stiffness are there by then, must be the same, or a release of "
               "\"bolts\" before it",
               meets_other_bolts);
  list.add<&Step::angle_deg>(between(0, 180),
                             "of an open: to what all joints where two rods cross open on average, "
                             "each by as much; between "
                             "the directions in which their rods run; 0: `angles` says it");
  list.used_by(&Step::kind, {K::open})
      .refused({}, "an open has `angle_deg` or `angles`, must be one of the two",
               [](const Step& of) {
                 return of.kind == K::open && of.angles.empty() == (of.angle_deg == 0);
               });
  list.add<&Step::angles>("of an open: joints and to what each opens; the others are let be")
      .points({"i", "j", "angle_deg"});
  list.used_by(&Step::kind, {K::open});
  list.add<&Step::cells>("of a brace: the cells; empty: all complete ones").points({"i", "j"});
  list.used_by(&Step::kind, {K::brace});
  list.add<&Step::diagonals>(
      "of a brace: \"first\" from joint (i, j) to (i + 1, j + 1), \"second\" the other");
  list.used_by(&Step::kind, {K::brace});
  list.add<&Step::brace>("\"cable\": bears no compression; \"strut\"").named("as");
  list.used_by(&Step::kind, {K::brace});
  list.add<&Step::EA_N>(at_least(0), "of a brace: axial stiffness").unit("N");
  list.used_by(&Step::kind, {K::brace})
      .refused({}, "a brace needs a stiffness, must be above 0",
               [](const Step& of) { return of.kind == K::brace && of.EA_N == 0; });
  list.add<&Step::what>("of a release: joints that are held, all bolts or all braces");
  list.used_by(&Step::kind, {K::release});
}

void add_steps(FieldList<Step> list) {
  using K = StepKind;
  const auto only = [&list](std::vector<StepKind> kinds) -> FieldList<Step>& {
    return list.used_by(&Step::kind, std::move(kinds));
  };
  list.add<&Step::kind>(
          "\"move\" the boundary; \"push\" a joint, which is held from then on; \"hold\" one where "
          "it is; \"release\" one; \"load\": more or less of what [loads] says; \"rest\": down the "
          "energy; \"jitter\": random forces on all joints come on and go away again; "
          "\"tighten\" bolts: all joints keep the angles that they have; \"brace\" cells along "
          "diagonals; both free of stress at that moment; \"open\" joints to other angles")
      .named("do");
  step_rules(list);
  list.add<&Step::progress>(
      between(0, 10),
      "of a move: 0 the original boundary, 1 the actuated one, beyond it further on");
  only({K::move}).unused({"radius_mm"}, "radius_mm takes its place",
                         [](const Step& of) { return of.radius_mm > 0; });
  list.add<&Step::radius_mm>(at_least(0),
                             "of a move of a circle, in the place of `progress`; 0: not given");
  only({K::move})
      .refused({}, "only a circle's boundary has a radius, must be 0: `progress` serves all",
               [](const Preset& preset, const Step& of) {
                 return of.radius_mm > 0 && preset.footprint.kind != FootprintKind::circle;
               })
      .refused({}, [](const Preset& preset, const Step& of) {
        return of.radius_mm > preset.original_radius_mm()
                   ? fmt::format("larger than the footprint, must be at most R_o = {}",
                                 preset.original_radius_mm())
                   : "";
      });
  list.add<&Step::edge_points>(
          "of a move: by how much edge points, counted from 0, lie off the boundary's motion; "
          "others lie on it")
      .points({"edge_point", "x_mm", "y_mm", "z_mm"});
  only({K::move}).refused({},
                          "names an edge point that is no number, must be a whole number from 0 on",
                          [](const Step& of) {
                            return std::ranges::any_of(of.edge_points, [](const auto& row) {
                              return row[0] < 0 || row[0] != double(int(row[0]));
                            });
                          });
  list.add<&Step::joint>(between(-500, 500),
                         "of the joint; of a release that names none: all that are held")
      .shape("[i, j]");
  only({K::push, K::hold, K::release})
      .unused({"what"}, "bolts and braces are taken out all together",
              [](const Step& of) { return of.what != Released::joints; })
      .refused({}, "must be [i, j]", [](const Step& of) {
        return of.joint.empty() && (of.kind == K::push || of.kind == K::hold);
      });
  list.add<&Step::to_mm>("place to which a push brings the joint; empty: `depth_mm` says how far")
      .shape("[x, y, z]");
  only({K::push});
  list.add<&Step::depth_mm>(
      "by how much a push moves the joint against the shell's normal, inward, from where it is; "
      "below 0 outward");
  only({K::push}).refused(
      {}, "a push goes to `to_mm` or by `depth_mm`, must be one of the two",
      [](const Step& of) { return of.kind == K::push && of.to_mm.empty() == (of.depth_mm == 0); });
  list.add<&Step::along>(
          "direction in which a joint is held that may move across it; empty: the way of the push, "
          "of a hold all directions")
      .shape("[x, y, z]");
  only({K::push, K::hold})
      .refused({}, "is no direction, must have a length",
               [](const Step& of) {
                 return of.along == std::vector<double>{0, 0, 0};
               })
      .refused(
          {},
          "a joint that is held across the push has no direction of its own, must be empty, or "
          "lateral = \"free\"",
          [](const Step& of) {
            return of.kind == K::push && of.lateral == Lateral::held && !of.along.empty();
          });
  list.add<&Step::lateral>("whether the joint pushed may move across the push");
  only({K::push});
  list.add<&Step::factor>(between(-1000, 1000),
                          "how many times what [loads] or the case named says counts from then on; "
                          "0: not at all");
  only({K::load});
  list.add<&Step::load_case>(
          "of a load: name of a [[loads.case]], whose forces are worked out on the shape in which "
          "it comes on; empty: what the shell was formed under")
      .named("case");
  only({K::load}).refused({"[[loads.case]] name"}, [](const Preset& preset, const Step& of) {
    const bool known = of.load_case.empty() ||
                       std::ranges::count(preset.load_case, of.load_case, &LoadCase::name) > 0;
    return known ? "" : "there is no such case, must be the name of a [[loads.case]]";
  });
  add_stiffening(list);
  list.add<&Step::side>(
      "of a rest from a state that is not stable: where the energy ends lower, or along or against "
      "its soft mode");
  only({K::rest});
  list.add<&Step::seed>(between(0, 1 << 30), "of a jitter: another one shakes otherwise");
  only({K::jitter});
  list.add<&Step::force_N>(above(0), "of a jitter: largest force on a joint along each axis");
  only({K::jitter});
}

void add_loads(FieldList<Loads> list) {
  list.add<&Loads::gravity_m_s2>(
      "gravity, downwards; loads come on with the actuation, in full at its end");
  needs_mass<Loads>(list, "gravity", [](const Loads& of) { return of.gravity_m_s2 != 0; });
  list.add<&Loads::field_N_per_mm>(
      "artificial gravity: force on every millimetre of rod, downwards");
  list.add<&Loads::points>("forces in N on joints")
      .points({"i", "j", "F_x", "F_y", "F_z"})
      .needs_equilibrium("a net does not answer loads", &Loads::any);
}

void add_area_loads(FieldList<Loads> list) {
  const auto idle = [&list](auto factor) {
    list.unused({"[[loads.case]] name"}, "no [[loads.case]] has any of it",
                [=](const Preset& preset) {
                  return std::ranges::none_of(
                      preset.load_case, [&](const LoadCase& one) { return one.*factor != 0; });
                });
  };
  list.add<&Loads::snow_N_m2>(
      at_least(0),
      "of cases: snow on every square metre of the plan of the shape that it comes on; none lies "
      "on what overhangs");
  idle(&LoadCase::snow);
  list.add<&Loads::wind_N_m2>(
      at_least(0),
      "of cases: pressure where the wind meets a face at right angles; elsewhere times the cosine "
      "between wind and normal, inwards to windward, outwards to leeward");
  idle(&LoadCase::wind);
  list.add<&Loads::wind_deg>(between(-360, 360), "where the wind blows to, from +x towards +y");
  idle(&LoadCase::wind);
  list.add<&Loads::pressure_N_m2>(
      at_least(0),
      "of cases: pressure on every face against its normal, which turns with the shell; the edge "
      "must be held");
  idle(&LoadCase::pressure);
  list.add<&Loads::edge_N_m>(
      at_least(0),
      "of cases: on every metre of the edge, the sides of faces that no other face shares, of the "
      "shape that it comes on");
  idle(&LoadCase::edge);
  list.add<&Loads::edge_direction>(
      "of that: \"down\"; \"normal\": against the shell's normal there; \"inward\": in the shell's "
      "surface, across the edge; \"pressure\": in plan, inwards across the edge as it turns");
  idle(&LoadCase::edge);
  list.add<&Loads::imperfection>(
      above(0),
      "largest move by the shapes that `gridshell load --imperfections N` mixes of the softest "
      "modes, over R_o, rho or half the bounding diagonal; `imperfection.seed` draws the first");
}

void add_load_cases(FieldList<LoadCase> list) {
  using C = LoadCase;
  const auto lacks = [](double C::*factor, double Loads::*load) {
    return [=](const Preset& preset, const C& of) {
      return of.*factor != 0 && preset.loads.*load == 0;
    };
  };
  list.add<&C::name>("by which steps, tables and pictures call it");
  list.refused({}, "must be a name of its own", [](const Preset& preset, const C& of) {
    return of.name.empty() || std::ranges::count(preset.load_case, of.name, &C::name) > 1;
  });
  list.needs_equilibrium("a net does not answer loads", [](const C&) { return true; });
  list.add<&C::dead>(between(-1000, 1000),
                     "how many times what [loads] says of gravity, field and points comes on, "
                     "beside the once that the shell was formed under")
      .refused(
          {"[loads] gravity_m_s2"}, "[loads] says nothing that acts, must be 0",
          [](const Preset& preset, const C& of) { return of.dead != 0 && !preset.loads.any(); });
  list.add<&C::snow>(between(-1000, 1000), "how many times snow_N_m2")
      .refused({"[loads] snow_N_m2"}, "there is no snow: [loads] snow_N_m2 must be above 0",
               lacks(&C::snow, &Loads::snow_N_m2));
  list.add<&C::snow_side>(
          "half of the shell, as seen from the middle of its joints, that the snow lies on")
      .unused({"snow"}, "the case has no snow", [](const C& of) { return of.snow == 0; });
  list.add<&C::wind>(between(-1000, 1000), "how many times wind_N_m2")
      .refused({"[loads] wind_N_m2"}, "there is no wind: [loads] wind_N_m2 must be above 0",
               lacks(&C::wind, &Loads::wind_N_m2));
  list.add<&C::pressure>(between(-1000, 1000),
                         "how many times pressure_N_m2; below 0 it blows the shell up")
      .refused({"[loads] pressure_N_m2"},
               "there is no pressure: [loads] pressure_N_m2 must be above 0",
               lacks(&C::pressure, &Loads::pressure_N_m2));
  list.add<&C::edge>(between(-1000, 1000), "how many times edge_N_m")
      .refused({"[loads] edge_N_m"},
               "there is no load on the edge: [loads] edge_N_m must be above 0",
               lacks(&C::edge, &Loads::edge_N_m));
  list.add<&C::points>("forces in N on joints").points({"i", "j", "F_x", "F_y", "F_z"});
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
