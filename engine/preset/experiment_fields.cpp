#include "engine/preset/field_list.h"

namespace gridshell::preset {
namespace {

bool by_net_alone(const Preset& preset) { return preset.accuracy.model == RodModel::net; }
constexpr const char* nothing_solved = "nothing is solved with [accuracy] model = \"net\"";

void add_imperfection(FieldList<Imperfection> list) {
  list.unused({"[accuracy] model"}, nothing_solved, by_net_alone);
  const auto perfect = [](const Imperfection& of) { return of.size == 0; };
  const char* why =
      "with [imperfection] size = 0 nothing is chosen: the path stays on the symmetric branch";
  list.add<&Imperfection::size>(
      between(0, 0.05),
      "amplitude over d with which a branch is entered at a bifurcation; it only chooses, states "
      "are those of the perfect shell; 0: the symmetric branch, stable or not");
  list.add<&Imperfection::seed>(between(0, 1e9), "seed of the random numbers")
      .unused({"size"}, why, perfect);
  list.add<&Imperfection::form>(
          "\"random\": the side to which random directions of the joints point; \"soft_mode\": "
          "along the mode that loses its stability, one side for odd seeds, the other for even")
      .unused({"size"}, why, perfect);
}

void add_indentation(FieldList<Indentation> list) {
  using I = Indentation;
  const auto pushed = [&list]() -> FieldList<I>& {
    return list.unused({"depth", "depth_mm"},
                       "nothing is pushed: [indentation] depth and depth_mm "
                       "are 0",
                       [](const I& of) { return !of.requested(); });
  };
  const auto by_position = [&]() -> FieldList<I>& {
    return pushed().unused({"joint"}, "[indentation] joint names the joint that is pushed",
                           [](const I& of) { return !of.joint.empty(); });
  };
  list.add<&I::at>("joint that is pushed: the one nearest to the pole, or the highest");
  by_position().unused({"latitude_deg"}, "[indentation] latitude_deg replaces it",
                       [](const I& of) { return of.latitude_deg < 90; });
  list.add<&I::latitude_deg>(
      between(-90, 90),
      "latitude of the joint pushed, seen from the net's origin; below 90 it replaces `at`");
  by_position();
  list.add<&I::longitude_deg>(between(-360, 360),
                              "longitude of the joint pushed, from +x towards +y");
  by_position().unused({"latitude_deg"}, "at a latitude of 90 degrees there is no longitude",
                       [](const I& of) { return of.latitude_deg >= 90; });
  list.add<&I::joint>(between(-500, 500),
                      "indices of the joint pushed, instead of all of these; empty: not given")
      .shape("[i, j]");
  pushed();
  list.add<&I::direction>(
      "\"inward\": against the normal of the net, or of the unloaded shell, at the joint; "
      "\"outward\": along it; fixed in space");
  pushed();
  list.add<&I::depth>(between(0, 10),
                      "depth of the push over rho of a net or R_o of a circle; 0: nothing is "
                      "pushed")
      .unused({"depth_mm"}, "[indentation] depth_mm replaces it",
              [](const I& of) { return of.depth_mm > 0; })
      .needs_equilibrium("a net does not answer a push",
                         [](const I& of) { return of.requested(); });
  list.add<&I::depth_mm>(at_least(0), "depth of the push in mm, instead of `depth`");
  list.add<&I::lateral>("whether the joint pushed may move across the push");
  pushed();
  list.add<&I::unload>("whether the push is removed again, in the second half of the frames");
  pushed();
}

void add_dynamics(FieldList<Dynamics> list) {
  list.unused({"[accuracy] model"}, nothing_solved, by_net_alone);
  const auto still = [](const Dynamics& of) { return !of.snap; };
  const char* why = "no snap is followed in time without it";
  list.add<&Dynamics::snap>(
      "whether a loss of stability is integrated in time to the next equilibrium, with its own "
      "frames");
  needs_mass<Dynamics>(list, "motion", [](const Dynamics& of) { return of.snap; });
  list.add<&Dynamics::step_s>(above(0), "time step").unused({"snap"}, why, still);
  list.add<&Dynamics::damping_per_s>(
          above(0),
          "damping, in proportion to the mass: a velocity falls to 1/e in the inverse of it")
      .unused({"snap"}, why, still);
}

void add_contact(FieldList<Contact> list) {
  const auto acts = [](const Contact& of) { return of.model == ContactModel::barrier; };
  const auto unless = [&](const char* key, const char* why, auto requested) {
    list.refused({key}, fmt::format("{}, expected \"none\"", why),
                 [=](const Preset& preset, const Contact& of) {
                   return of.model == ContactModel::barrier && requested(preset);
                 });
  };
  list.add<&Contact::model>(
          "\"none\": rods pass through each other, which is reported; \"barrier\": rods repel each "
          "other within a small gap, away from their joints")
      .needs_equilibrium("a net's rods bear no forces", acts);
  unless("[jitter] trials", "a search for states moves rods through one another",
         [](const Preset& preset) { return preset.jitter.requested(); });
  unless("[dynamics] snap", "a snap in time takes no notice of contact",
         [](const Preset& preset) { return preset.dynamics.snap; });
  unless("[inverse] vary", "a design takes no notice of contact",
         [](const Preset& preset) { return !preset.inverse.vary.empty(); });
  const auto none = [=](const Contact& of) { return !acts(of); };
  const char* why = "contact is not modelled: [contact] model is \"none\"";
  list.add<&Contact::gap_mm>(above(0),
                             "gap between the rods' surfaces at which they start to repel")
      .unused({"model"}, why, none);
  list.add<&Contact::stiffness_N_per_mm>(
          above(0),
          "stiffness: at half the gap the force is 1.2 times this times the gap, more if the gap "
          "is not thin compared with the rods")
      .unused({"model"}, why, none);
}

void add_inverse(FieldList<Inverse> list) {
  using I = Inverse;
  const auto varies = [](const I& of, Vary one) {
    return std::ranges::find(of.vary, one) != of.vary.end();
  };
  list.add<&I::vary>(
          "what may change: pins along the radius (\"pins_radial\"), in the plane (\"pins\"), in "
          "space (\"pins_3d\"); lengths of \"legs\"; \"directions\" of tangent ends; \"diameters\" "
          "of rods; empty: no design")
      .refused({"[ends] kind"},
               "directions are prescribed by themselves only with [ends] kind = \"tangent\", "
               "expected a list without \"directions\"",
               [=](const Preset& preset, const I& of) {
                 return varies(of, Vary::directions) && preset.ends.kind != EndKind::tangent;
               })
      .refused({"[rod] width_mm", "[rod_v] width_mm"},
               "rectangular rods have no diameters, expected a list without \"diameters\"",
               [=](const Preset& preset, const I& of) {
                 return varies(of, Vary::diameters) &&
                        (preset.rod.rectangular() || preset.rod_v.rectangular());
               })
      .refused({"[loads] gravity_m_s2"},
               "a design does not follow how diameters change the weight of rods, expected a list "
               "without \"diameters\", or no gravity",
               [=](const Preset& preset, const I& of) {
                 return varies(of, Vary::diameters) && preset.loads.gravity_m_s2 != 0;
               })
      .refused(
          {"[footprint] kind"},
          "the footprint has no net, so there is no surface to meet, expected an empty list, or "
          "[footprint] kind = \"net\"",
          [](const Preset& preset, const I& of) { return !of.vary.empty() && !preset.on_net(); });
  const auto designed = [&list]() {
    list.unused({"vary"}, "nothing is designed: [inverse] vary is empty",
                [](const I& of) { return of.vary.empty(); });
  };
  list.add<&I::target>(
      "\"surface\": joints on the net's surface; \"net\": each at its own point of the net");
  designed();
  list.add<&I::norm>(between(2, 32),
                     "exponent p of the mean of |distance|^p that is minimised in the last stage; "
                     "in the first it is 2");
  designed();
  list.add<&I::mu>(at_least(0),
                   "weight of the mean square of all changes (mm; rad of a direction; a tenth of a "
                   "diameter) relative to that of the distances (mm)");
  designed();
  list.add<&I::move_limit_mm>(above(0), "largest move of a pin, or change of a leg's length");
  designed();
  list.add<&I::round_mm>(
      at_least(0),
      "step to which a builder measures: the shell must be stable after rounding to it; 0: exact");
  designed();
  list.add<&I::min_stability>(
      between(0, 1), "smallest allowed ratio of the lowest eigenvalue to that before the design");
  designed();
  list.add<&I::max_leg_force_N>(at_least(0),
                                "largest force in a leg, unless it is larger before; 0: any");
  designed();
}

void add_accuracy(FieldList<Accuracy> list) {
  constexpr double net_tolerance = 0.05;
  const char* meshed = "a mesh is given";
  list.add<&Accuracy::tolerance>(
          between(1e-9, 1), "largest joint error allowed, over R_o of a circle or rho of a net")
      .needs_equilibrium(fmt::format("a net deviates by a few hundredths of its radius, expected a "
                                     "tolerance of {} or more",
                                     net_tolerance),
                         [=](const Accuracy& of) { return of.tolerance < net_tolerance; });
  list.add<&Accuracy::edges_per_segment>(
          between(0, 64), "edges between two joints of a rod; 0 chooses them from the tolerance")
      .needs_equilibrium(meshed, [](const Accuracy& of) { return of.edges_per_segment > 0; });
  list.add<&Accuracy::leading_edges>(between(0, 64),
                                     "not used: the path is followed on the finest mesh");
  list.add<&Accuracy::model>(
      "\"net\": the smooth net, nothing is solved; \"bend\": stretching and bending; \"twist\": "
      "torsion too; \"auto\": the simplest that is exact");
  list.add<&Accuracy::memory_GB>(between(0, 1e6),
                                 "memory that the meshes may take; 0: half of the machine's")
      .unused({"model"}, nothing_solved, by_net_alone);
}

void add_jitter(FieldList<SearchSettings> list) {
  using S = SearchSettings;
  constexpr int most_trials = 1000000;
  const auto requested = [&list]() -> FieldList<S>& {
    return list.unused({"trials", "confined"},
                       "no states are looked for: [jitter] trials and confined are 0",
                       [](const S& of) { return !of.requested(); });
  };
  const auto of_mode = [&](SearchMode mode, const char* other, int S::*others) {
    requested().unused({"mode", other}, [=](const S& of) {
      return of.mode == mode || (others && of.*others > 0)
                 ? ""
                 : fmt::format("[jitter] mode = \"{}\" does not use it, only \"{}\"",
                               word_of(of.mode), word_of(mode));
    });
  };
  list.add<&S::mode>(
      "\"gravity\": a partly actuated shell in a random uniform force, which is then removed; "
      "\"random\": every joint is displaced by a random vector; \"poke\": random joints are pushed "
      "and released");
  requested();
  list.add<&S::trials>(
          between(0, most_trials),
          "number of random trials; above 0 the run is a search for states and makes no movie")
      .refused({"[indentation] depth", "[indentation] depth_mm", "confined"},
               "states are searched of a shell that nothing pushes, expected 0, or 0 for the depth "
               "of [indentation]",
               [](const Preset& preset) {
                 return preset.jitter.requested() && preset.indentation.requested();
               });
  list.add<&S::seed>(between(0, 1 << 30),
                     "seed of the trials; the same seed finds the same states");
  requested();
  list.add<&S::levels>({0, 1, true},
                       "progress of the actuation at which trials start, in turn; empty: 0.02 to "
                       "0.5 for \"gravity\", the end for the others");
  requested();
  list.add<&S::field_N_per_mm>(above(0), "largest force per millimetre of rod");
  of_mode(SearchMode::gravity, "mode", nullptr);
  list.add<&S::amplitude>({0, 10, true},
                          "largest random displacement of a joint along each axis, over d");
  of_mode(SearchMode::random, "confined", &S::confined);
  list.add<&S::depth>({0, 50, true}, "largest push of a joint, over d");
  of_mode(SearchMode::poke, "transitions", &S::transitions);
  list.add<&S::confined>(between(0, most_trials),
                         "additional trials that start in forms with each group of symmetries in "
                         "turn; counted separately");
  list.add<&S::tolerance>({0, 1, true},
                          "states whose joints differ by less than this are one state, over d");
  requested();
  list.add<&S::drawn>(between(1, 24), "states in the picture");
  requested();
  list.add<&S::transitions>(
      between(0, 1000),
      "number of states, lowest first, for which it is found out what they become after release "
      "and contraction of the boundary, and after pushes");
  requested();
  list.add<&S::barriers>(
      "whether the barriers between the states in the picture are searched for, on 4 edges per "
      "segment");
  requested();
}

void add_sweep(FieldList<Sweep> list) {
  // a preset without a sweep is written without [sweep]
  list.unused({"over", "seeds"}, "nothing is swept: [sweep] over is empty and seeds is 1",
              [](const Sweep& of) { return !of.requested(); });
  list.add<&Sweep::over>(
      "keys that change from run to run, all combinations; `count` values from `from` to `to`, "
      "both among them, even steps or with `log = true` even factors");
  list.add<&Sweep::seeds>(between(1, 100000),
                          "runs of each combination: with imperfection.seed and those after it");
  list.add<&Sweep::plot>(
      "figures of summary.json that are drawn over the keys, a picture each; empty: height_mm");
  list.add<&Sweep::x>("figure that is the x axis of line charts; empty: the key that is swept");
  list.add<&Sweep::departure>(between(0, 10),
                              "relative deviation of a figure from its value at the right end of a "
                              "line chart at which a mark is drawn; 0: none");
}

}  // namespace

void add_experiment_fields(std::vector<Field>& all) {
  add_imperfection({all, "imperfection", &Preset::imperfection});
  add_indentation({all, "indentation", &Preset::indentation});
  add_hand_fields(all);
  add_dynamics({all, "dynamics", &Preset::dynamics});
  FieldList<Limits>(all, "limits", &Preset::limits)
      .unused({"[accuracy] model"}, nothing_solved, by_net_alone)
      .add<&Limits::max_strain>(
          above(0),
          "axial strain of an edge, bending left out, at which the run stops with limit "
          "\"locking\"")
      .add<&Limits::max_bending_strain>(
          at_least(0),
          "strain of bending (change from the natural curvature) at which the run stops with limit "
          "\"strength\"; 0: no limit, it is reported from 0.01 on")
      .add<&Limits::max_utilisation>(
          at_least(0),
          "largest stress of a fibre (bending and axial) over the strength at which the run stops "
          "with limit \"strength\"; 0: no limit, it is reported")
      .refused({"[rod] strength_MPa", "[rod] yield_strain"},
               "the rods have no strength, expected 0, or [rod] strength_MPa or yield_strain above "
               "0, and of [rod_v] where it differs",
               [](const Preset& preset, const Limits& of) {
                 return of.max_utilisation > 0 && !preset.rods_have_strength();
               })
      .add<&Limits::contact>(
          "what happens if rods overlap away from their joints, joints' cylinders overlap, or a "
          "rod passes the table: \"tell\" reports it, \"stop\" ends the run before, with limit "
          "\"contact\"")
      .add<&Limits::table>(
          "whether the boundary's plane is a table: a rod more than its radius below it is in "
          "contact");
  add_contact({all, "contact", &Preset::contact});
  add_inverse({all, "inverse", &Preset::inverse});
  add_accuracy({all, "accuracy", &Preset::accuracy});
  add_jitter({all, "jitter", &Preset::jitter});
  add_sweep({all, "sweep", &Preset::sweep});
}

}  // namespace gridshell::preset
