// The estimates are computed from the initial meshes of the tolerance and from the measured time of
// one factorisation on this machine.

#include "engine/simulate/expected_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/core/system_info.h"
#include "engine/core/try.h"
#include "engine/elastic/model.h"
#include "engine/simulate/frame_forces.h"
#include "engine/simulate/frames.h"
#include "engine/simulate/mesh_policy.h"
#include "engine/simulate/steps.h"
#include "engine/solve/buckling.h"

namespace gridshell {
namespace {

// for all meshes of a run together; measured on shells of 24 to 150 rods and 100 000 to 1 500 000
// unknowns: 400 to 820 bytes with the bend model, more for larger shells, and 1200 with the twist
// model
constexpr double bytes_an_unknown = 1000, bytes_a_twist_unknown = 2000;
// additional bytes per joint in the factor of a large net, for each doubling of the number of
// joints above this one; measured with 48, 96 and 192 rods per direction (41 MB, 240 MB, 1.2 GB)
constexpr double bytes_a_doubling = 6500, joints_of_a_small_net = 1800;

/// Unknowns of a mesh with `edges_per_segment`, to within a few per cent.
double unknowns_of(const Footprint& footprint, RodModel rod_model, int edges_per_segment) {
  double segments = 0;
  for (const FootprintRod& rod : footprint.rods) segments += double(rod.joints.size()) + 1;
  const double edges = segments * edges_per_segment;
  if (rod_model == RodModel::net) return 0;
  // each edge adds a node, but joints, which belong to two rods, are counted twice
  const double nodes = edges - double(footprint.joints.size());
  return 3 * nodes + (rod_model == RodModel::twist ? edges : 0);
}

}  // namespace

double memory_GB(const Footprint& footprint, RodModel rod_model, const LevelPlan& plan) {
  double unknowns = 0;
  for (const int edges : plan.edges_per_segment)
    unknowns += unknowns_of(footprint, rod_model, edges);
  const double joints = double(footprint.joints.size());
  const double doublings = std::max(0.0, std::log2(joints / joints_of_a_small_net));
  const double meshes = double(plan.edges_per_segment.size());
  return 1e-9 *
         (unknowns * (rod_model == RodModel::twist ? bytes_a_twist_unknown : bytes_an_unknown) +
          meshes * joints * doublings * bytes_a_doubling);
}

Result<void> fits_memory(const Scene& scene, const LevelPlan& plan) {
  const double limit = scene.memory_GB;
  const double given = limit > 0 ? limit : default_memory_GB();
  const double needed = memory_GB(scene.footprint, scene.rod_model, plan);
  if (given == 0 || needed <= given) return {};
  const int edges = plan.edges_per_segment.back();
  // the reason may be a drawing in metres with a spacing for a model
  const auto& rods = scene.footprint.rods;
  const bool many = rods.size() > 400 && rods.front().number < 0;
  return invalid(
      "{} rods of {} edges per segment, {:.3g} unknowns, take about {:.2g} GB, more than the "
      "{:.2g} GB of {}; {}{} needs less",
      rods.size(), edges, unknowns_of(scene.footprint, scene.rod_model, edges), needed, given,
      limit > 0 ? "[accuracy] memory_GB"
                : "half of the machine's memory ([accuracy] "
                  "memory_GB changes that)",
      many ? fmt::format("a [footprint] spacing_mm above {:g} or ", scene.footprint.spacing) : "",
      scene.edges_per_segment > 0 ? "a smaller [accuracy] edges_per_segment"
                                  : "a larger [accuracy] tolerance");
}

}  // namespace gridshell

namespace gridshell::simulate {
namespace {

/// Seconds of one assembly and of one factorisation of the flat shell on a mesh; 0: the rod model
/// does not support the rods.
struct UnitCost {
  double assembly = 0, factorisation = 0;

  double both() const { return assembly + factorisation; }
};

UnitCost measured_cost(const Scene& scene, int edges) {
  constexpr int trials = 3;
  MeshLevel level;
  if (!level.build(scene.footprint, scene.rods, scene.solved_model(), scene.motion, edges))
    return {};
  const State flat = flat_state(level.model, level.mesh, level.motion, scene.flat);
  std::vector<double> both, factorisation;
  for (int k = 0; k < trials; ++k) {
    const double begin = cpu_seconds_now();
    level.system->at(flat, false);
    const double assembled = cpu_seconds_now();
    level.system->shifted(0);
    both.push_back(assembled - begin);
    factorisation.push_back(cpu_seconds_now() - assembled);
  }
  // the first trial also plans the factorisation, and other programs only add time
  const double factor = std::ranges::min(factorisation);
  return {std::max(0.0, std::ranges::min(both) - factor), factor};
}

/// The costs of the coarsest mesh and of one of `edges`, from those of the coarsest one and of
/// twice its edges: a part for the joints, which all meshes have, and a part in proportion to the
/// edges.
std::pair<UnitCost, UnitCost> unit_costs(const Scene& scene, int coarsest, int edges) {
  // a mesh too large to be measured takes as long as 96 and 192 rods per direction with version 0.2
  constexpr double large = 1e5, of_large = 4e-9, power = 1.45, an_unknown = 4e-8;
  const auto unknowns = [&](int of) { return unknowns_of(scene.footprint, scene.rod_model, of); };
  const auto of_large_mesh = [&](int of) -> UnitCost {
    return {an_unknown * unknowns(of), of_large * std::pow(unknowns(of), power)};
  };
  if (unknowns(coarsest) > large) return {of_large_mesh(coarsest), of_large_mesh(edges)};
  const UnitCost one = measured_cost(scene, coarsest);
  if (edges == coarsest) return {one, one};
  const UnitCost two = measured_cost(scene, 2 * coarsest);
  const double times = double(edges) / coarsest - 1;
  return {one,
          {one.assembly + times * std::max(0.0, two.assembly - one.assembly),
           one.factorisation + times * std::max(0.0, two.factorisation - one.factorisation)}};
}

/// Time of a path in factorisations of its finest mesh, as measured on the shipped presets: from a
/// net; from the flat state on branches that symmetry chooses; and on branches that the
/// imperfection chooses, of which curves and nets have several.
double factorisations_of(const Scene& scene, const preset::Footprint& footprint) {
  constexpr double from_net = 200, from_flat = 450, chosen = 135, curves = 600, nets = 900;
  if (scene.from_net) return from_net;
  if (!scene.imperfection.chooses()) return from_flat;
  using Kind = preset::FootprintKind;
  if (footprint.kind == Kind::net) return nets;
  return footprint.kind == Kind::curve ? curves : chosen;
}

}  // namespace

int dof_of(const Scene& scene, int edges_per_segment) {
  if (scene.rod_model == RodModel::net) return 0;
  const auto model =
      build_model(mesh_rods(scene.footprint, edges_per_segment), scene.rods, scene.solved_model());
  return model ? model->dof() : 0;
}

double expected_seconds(const Scene& scene, const preset::Preset& preset) {
  if (scene.rod_model == RodModel::net) return 0.01;
  // seconds per unknown on a mesh of 4 edges per segment; measured with 8 to 20 rods
  constexpr double a_trial = 2.6e-5, a_barrier = 3.4e-4, ways_of_a_state = 7e-4;
  if (const preset::SearchSettings& jitter = preset.jitter; jitter.requested()) {
    const int barriers = jitter.barriers ? jitter.drawn * (jitter.drawn - 1) / 2 : 0;
    return dof_of(scene, 4) * (a_trial * (jitter.trials + jitter.confined) + a_barrier * barriers +
                               ways_of_a_state * jitter.transitions);
  }
  // per frame: corrections on the coarsest mesh; the report of the finest one takes as long as some
  // assemblies there
  constexpr double corrections = 1.3, tellings = 4.9, start_s = 0.04;
  const std::vector<int> edges = initial_levels(scene).edges_per_segment;
  const auto [coarse, fine] = unit_costs(scene, edges.front(), edges.back());
  const double frame = tellings * fine.assembly + corrections * coarse.both();
  // a chosen branch is confirmed on meshes of twice the edges; bolts and braces are added in
  // equilibrium, on new meshes
  constexpr double build = 15;  // takes as long as so many factorisations
  using Do = preset::StepKind;
  const auto builds = std::ranges::count_if(preset.step, [](const preset::Step& step) {
    return step.kind == Do::tighten || step.kind == Do::brace;
  });
  const auto moves = std::ssize(preset.step) - builds -
                     std::ranges::count(preset.step, Do::hold, &preset::Step::kind);
  // on a path without a choice of branch, three states are searched for there; only frames between
  // the net and the flat need the path back to it
  const bool network = preset.footprint.kind == preset::FootprintKind::network;
  double to_begin = 0.7;
  if (scene.from_net)
    to_begin = preset.step.empty() ? 1 : 0.5;
  else if (scene.imperfection.chooses())
    to_begin = network ? 1.6 : 3;
  const double paths = to_begin + 3 * double(moves);
  const std::vector<int> shares = frames_of_steps(preset.step, preset.movie.frames);
  const int frames =
      shares.empty() ? preset.movie.frames : std::accumulate(shares.begin(), shares.end(), 1);
  return start_s + frame * frames +
         (paths * factorisations_of(scene, preset.footprint) + build * double(builds)) *
             fine.both();
}

double expected_GB(double meshes_GB, const preset::Preset& preset) {
  constexpr double program = 0.03, a_frame = 1.7e-4;
  return program + meshes_GB + (preset.jitter.requested() ? 0 : a_frame * preset.movie.frames);
}

namespace {

/// Largest curvature of an elastica of this length with hinges at distance `chord`: its modulus m
/// by 2 E(m)/K(m) - 1 = chord/length, then 4 sqrt(m) K(m)/length.
double elastica_curvature(double length, double chord) {
  double low = 0, high = 0.999999;  // square root of the modulus
  for (int round = 0; round < 60; ++round) {
    const double k = 0.5 * (low + high);
    (2 * std::comp_ellint_2(k) / std::comp_ellint_1(k) - 1 > chord / length ? low : high) = k;
  }
  return 4 * low * std::comp_ellint_1(low) / length;
}

/// Largest strain of a rod's fibres on the net, by second differences of adjacent points.
Result<double> strain_on_net(const Scene& scene, std::size_t r) {
  constexpr int parts = 64;
  const FootprintRod& rod = scene.footprint.rods[r];
  const FibreReach& fibres = scene.rods.material(r).fibres;
  const double h = (rod.span.end - rod.span.begin) / parts;
  double most = 0;
  std::optional<NetPoint> before[2];
  for (int k = 0; k <= parts; ++k) {
    const Eigen::Vector2d at = rod.at(rod.span.begin + k * h);
    TRY(here, scene.net->at(at.x(), at.y()));
    if (before[0] && before[1]) {
      const Eigen::Vector3d curvature =
          (here->position - 2 * before[1]->position + before[0]->position) / (h * h);
      const double upright = curvature.dot(before[1]->normal()),
                   sideways = std::sqrt(std::max(0.0, curvature.squaredNorm() - upright * upright));
      most = std::max(most, fibres.strain(Eigen::Vector2d(sideways, upright)));
    }
    before[0] = before[1];
    before[1] = *here;
  }
  return most;
}

/// Strain of a single rod between its prescribed ends, bent in its least stiff direction; 0 if its
/// ends do not bend it.
double strain_by_ends(const Scene& scene, std::size_t r) {
  const FootprintRod& rod = scene.footprint.rods[r];
  const auto fixed = [](RodEnd end) { return is_fixed(end) && end != RodEnd::sprung; };
  if (rod.closed() || !fixed(rod.begin) || !fixed(rod.end)) return 0;
  const auto ends = scene.motion.end.middleCols<2>(2 * Eigen::Index(r));
  const double chord = (ends.col(1) - ends.col(0)).norm(), length = (rod.span.end - rod.span.begin);
  if (!(chord < length)) return 0;
  const FibreReach& fibres = scene.rods.material(r).fibres;
  return std::min(fibres.about_1, fibres.about_2) * elastica_curvature(length, chord);
}

}  // namespace

std::string expected_bending(const Scene& scene) {
  double most = 0, used = 0;
  std::size_t where = 0;
  for (std::size_t r = 0; r < scene.footprint.rods.size(); ++r) {
    const RodMaterial& material = scene.rods.material(r);
    if (!material.curvature.isZero(0) || material.as_drawn) return "";
    double strain = 0;
    if (scene.net) {
      const auto on_net = strain_on_net(scene, r);
      if (!on_net) return "";
      strain = *on_net;
    } else {
      strain = strain_by_ends(scene, r);
    }
    const double young = material.EA / area_of(material.fibres);
    if (!scene.strength_MPa.empty()) used = std::max(used, young * strain / scene.strength_MPa[r]);
    if (strain > most) where = r;
    most = std::max(most, strain);
  }
  if (most == 0) return "";
  std::string text =
      fmt::format("strain {} {:.2g} %", scene.net ? "about" : "at least", 100 * most);
  if (used > 0) text += fmt::format(", {:.2g} of the rods' strength", used);
  return text + fmt::format(", of {}, {}", name_of(scene.footprint.rods[where]),
                            scene.net
                                ? "as the net is curved"
                                : "if it is one arc between its ends; a wavy rod bends several "
                                  "times as much");
}

}  // namespace gridshell::simulate
