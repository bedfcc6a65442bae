// Axial forces, curvature, reactions and energies of frames: their balance, closed forms, and their
// errors.
#include <cmath>

#include "tests/engine/simulate/run.h"
#include "tests/engine/solve/elastica.h"

using namespace gridshell;

namespace {

preset::Preset four_rods() {
  preset::Preset p = circle(4, 42, 36);
  p.accuracy.edges_per_segment = 4;
  return p;
}

Eigen::Vector3d sum_of(const record::Frame& frame) { return frame.reactions_N.rowwise().sum(); }

/// The integral over the rods' length of a value at every point.
template <class Value>
double over_rods(const record::Trajectory& run, const Value& value) {
  const auto& nodes = run.frames.back().nodes;
  double sum = 0;
  Eigen::Index at = 0;
  for (const auto& rod : run.layout.rods)
    for (std::size_t k = 0; k < rod.size(); ++k, ++at) {
      const auto edge = [&](std::size_t n) {
        return n == 0 || n == rod.size() ? 0.0 : (nodes.col(rod[n]) - nodes.col(rod[n - 1])).norm();
      };
      sum += value(at) * 0.5 * (edge(k) + edge(k + 1));
    }
  CHECK(at == run.frames.back().bending_mJ_per_m.size());
  return sum;
}

}  // namespace

TEST_CASE("reactions carry the loads, and nothing where there are none") {
  preset::Preset p = four_rods();
  const auto unloaded = run(p);
  const record::Frame& free = unloaded.trajectory.frames.back();
  REQUIRE(free.reactions_N.cols() == Eigen::Index(unloaded.trajectory.layout.supports.size()));
  CHECK(sum_of(free).norm() < 1e-9);
  CHECK(free.reactions_N.colwise().norm().maxCoeff() > 1e-3);
  p.loads.points = {{0, 0, 0, 0.01, -0.02}, {-1, 0, 0.003, 0, 0}};
  const auto loaded = run(p);
  const Eigen::Vector3d loads(0.003, 0.01, -0.02);
  CHECK((sum_of(loaded.trajectory.frames.back()) + loads).norm() < 1e-9);
}

TEST_CASE("curvature gives the bending energy, stretch the axial force, as one mesh has them") {
  const auto outcome = run(four_rods());
  const record::Frame& frame = last_frame(outcome);
  const double area = M_PI * 0.127 * 0.127, EA = 83e3 * area, EI = 83e3 * area * 0.127 * 0.127 / 4;
  const auto bending = [&](Eigen::Index at) {
    return 0.5 * EI * std::pow(frame.curvature_per_mm[at], 2);
  };
  CHECK(over_rods(outcome.trajectory, bending) == Approx(frame.energies[Term::bend]).epsilon(1e-4));
  // N^2 l / (2 EA), edge by edge
  double stretch = 0;
  Eigen::Index edge = 0;
  for (const auto& rod : outcome.trajectory.layout.rods)
    for (std::size_t k = 1; k < rod.size(); ++k, ++edge)
      stretch += 0.5 * std::pow(frame.axial_force_N[edge], 2) / EA *
                 (frame.nodes.col(rod[k]) - frame.nodes.col(rod[k - 1])).norm();
  CHECK(edge == frame.axial_force_N.size());
  CHECK(stretch == Approx(frame.energies[Term::stretch]).epsilon(1e-3));
  CHECK(frame.axial_force_N.minCoeff() < 0);
  // at a pinned end the reaction along the rod is its axial force
  edge = 0;
  for (const auto& rod : outcome.trajectory.layout.rods) {
    const Eigen::Vector3d along = (frame.nodes.col(rod[1]) - frame.nodes.col(rod[0])).normalized();
    CHECK(frame.reactions_N.col(rod[0]).dot(along) ==
          Approx(-frame.axial_force_N[edge]).margin(1e-9));
    edge += Eigen::Index(rod.size()) - 1;
  }
}

TEST_CASE("where joints pass moments, reactions on two meshes are within twice their errors") {
  preset::Preset p = circle(4, 94.56, 65.82, 5);
  p.rod.shear_GPa = 31;
  p.joints.twist_Nmm = 3.278;
  p.accuracy.tolerance = 3.4e-3;
  const auto coarse = run(p);
  p.accuracy.tolerance /= 64;
  const auto fine = run(p);
  for (std::size_t k = 0; k < coarse.trajectory.frames.size(); ++k) {
    const record::Frame &frame = coarse.trajectory.frames[k], &exact = fine.trajectory.frames[k];
    INFO("progress " << frame.progress);
    CHECK(max_column_norm(frame.reactions_N - exact.reactions_N) <=
          2 * frame.force_error_N + exact.force_error_N);
  }
}

TEST_CASE("bending over length adds up to the bending energy, of any section and end") {
  preset::Preset p = four_rods();
  p.accuracy.edges_per_segment = 8;
  SECTION("round rods") {}
  SECTION("strips with natural curvature") {
    p.rod.shear_GPa = 31;
    p.rod.width_mm = 0.4;
    p.rod.thickness_mm = 0.2;
    p.rod.curvature_per_mm = 0.004;
  }
  SECTION("clamped ends") {
    p.rod.shear_GPa = 31;
    p.ends.kind = preset::EndKind::clamped;
  }
  const auto outcome = run(p);
  const record::Frame& frame = last_frame(outcome);
  REQUIRE(frame.energies[Term::bend] > 0.01);
  const auto mJ_per_mm = [&](Eigen::Index at) { return 1e-3 * frame.bending_mJ_per_m[at]; };
  CHECK(over_rods(outcome.trajectory, mJ_per_mm) ==
        Approx(frame.energies[Term::bend]).epsilon(1e-4));
}

TEST_CASE("the reaction of a pushed joint is the force of its push on one mesh") {
  preset::Preset p = on_net(preset::NetKind::sphere, 60);
  p.footprint.placement = Placement::half;
  p.indentation.depth = 0.05;
  p.accuracy.edges_per_segment = 4;
  const auto outcome = run(p);
  const record::Layout& layout = outcome.trajectory.layout;
  const record::Frame& frame = last_frame(outcome);
  REQUIRE(layout.loaded_joints.size() == 1);
  const auto& push = layout.loaded_joints.front();
  const Eigen::Vector3d holds = frame.reactions_N.col(push.joint);
  CHECK(holds.dot(push.direction) == Approx(frame.force_N).epsilon(1e-9));
  CHECK(sum_of(frame).norm() < 1e-8);
}

TEST_CASE("on the model net forces, energies along rods and reactions are unknown") {
  preset::Preset p = on_net(preset::NetKind::sphere, 60);
  p.footprint.placement = Placement::half;
  p.accuracy.model = RodModel::net;
  p.accuracy.tolerance = 0.05;
  const auto outcome = run_stills(p);
  CHECK(last_frame(outcome).axial_force_N.size() == 0);
  CHECK(last_frame(outcome).bending_mJ_per_m.size() == 0);
  CHECK(last_frame(outcome).reactions_N.size() == 0);
}

// Two rods that cross in their middle, where neither bears on the other, are pinned elasticas.

namespace {

constexpr double half_length = 100, radius = 0.127;

struct ExactRod {
  double shortening, force, energy, strain;

  explicit ExactRod(double m) {
    const PinnedElastica exact(m);
    const double length = 2 * half_length, EI = 83e3 * M_PI * std::pow(radius, 4) / 4;
    shortening = exact.shortening;
    force = exact.thrust * EI / (length * length);
    energy = exact.energy * EI / length;
    strain = radius * exact.curvature / length;
  }
};

preset::Preset crossed_rods(double shortening) {
  preset::Preset p = network(cross(half_length, half_length));
  p.actuation.scale = 1 - shortening;
  return p;
}

/// Largest distance of the reactions of two runs on the same footprint, N.
double off(const record::Frame& a, const record::Frame& b) {
  REQUIRE(a.reactions_N.cols() == b.reactions_N.cols());
  return max_column_norm(a.reactions_N - b.reactions_N);
}

double off_energy(const record::Frame& a, const record::Frame& b) {
  double largest = std::abs(a.energies.total() - b.energies.total());
  for (const TermName& term : energy_terms)
    largest = std::max(largest, std::abs(a.energies[term.term] - b.energies[term.term]));
  return largest;
}

/// Compares a run at one tolerance with a much finer one, by its own estimates.
void check_against_finer(preset::Preset p, double tolerance) {
  p.accuracy.tolerance = 1e-5;
  const auto fine = run(p);
  p.accuracy.tolerance = tolerance;
  const auto requested = run(p);
  REQUIRE(fine.trajectory.frames.size() == requested.trajectory.frames.size());
  for (std::size_t k = 0; k < requested.trajectory.frames.size(); ++k) {
    const record::Frame &truth = fine.trajectory.frames[k], &frame = requested.trajectory.frames[k];
    CAPTURE(k, tolerance, frame.force_error_N, frame.energy_error_mJ);
    CHECK(off(frame, truth) < 2 * frame.force_error_N + 1e-9);
    CHECK(off_energy(frame, truth) < 2 * frame.energy_error_mJ + 1e-9);
  }
}

}  // namespace

TEST_CASE("forces, energies and bending strain of pinned elasticas, as exact as requested") {
  for (const double m : {0.04968353, 0.24165275, 0.46400983})
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6}) {
      const ExactRod exact(m);
      preset::Preset p = crossed_rods(exact.shortening);
      p.accuracy.tolerance = tolerance;
      const auto outcome = run(p);
      const record::Frame& frame = last_frame(outcome);
      CAPTURE(m, tolerance, exact.force, frame.force_error_N, exact.energy, frame.energy_error_mJ);
      // these rods shorten by P L/EA along their length, which the inextensible ones do not
      const double EA = 83e3 * M_PI * radius * radius, stretch = 1e-5,
                   work = 2 * exact.force * exact.force * 2 * half_length / EA;
      const double off_force = std::abs(frame.largest_force_N - exact.force),
                   off_energy = std::abs(frame.energies[Term::bend] - 2 * exact.energy);
      CHECK(off_force < 2 * frame.force_error_N + stretch * exact.force);
      CHECK(off_force < tolerance * exact.force + stretch * exact.force);
      CHECK(off_energy < 2 * frame.energy_error_mJ + work);
      CHECK(off_energy < tolerance * 2 * exact.energy + work);
      // the estimate is of use
      CHECK(frame.force_error_N < (tolerance < 1e-3 ? 5 * tolerance : 0.03) * exact.force);
      CHECK(frame.largest_bending_strain == Approx(exact.strain).epsilon(0.02));
      CHECK_THAT(frame.bending_strain_at, Catch::Contains("100.00 mm from its start, at joint ["));
    }
}

TEST_CASE("a requested mesh reports its own forces, and without coarser ones no error") {
  const ExactRod exact(0.24165275);
  preset::Preset p = crossed_rods(exact.shortening);
  double before = 0;
  for (const int edges : {5, 10, 20}) {
    p.accuracy.edges_per_segment = edges;
    const auto outcome = run(p);
    const record::Frame& frame = last_frame(outcome);
    CAPTURE(edges);
    const double off_force = std::abs(frame.largest_force_N - exact.force);
    if (before > 0) CHECK(before / off_force == Approx(4).epsilon(0.1));
    before = off_force;
    CHECK(std::isnan(frame.force_error_N) == (edges == 5));
    CHECK(std::isnan(frame.energy_error_mJ) == (edges == 5));
    CHECK(std::isnan(outcome.summary.force_error_N) == (edges == 5));
    if (edges == 5) continue;
    CHECK(off_force < frame.force_error_N);
    CHECK(frame.force_error_N < 2 * off_force);
    CHECK(std::abs(frame.energies[Term::bend] - 2 * exact.energy) < frame.energy_error_mJ);
  }
}

TEST_CASE("forces and energies are as exact as they say where loads act and rods are curved",
          "[standard]") {
  preset::Preset p = circle(4, 42, 36);
  p.loads.points = {{0, 0, 0, 0.01, -0.02}, {-1, 0, 0.003, 0, 0}};
  SECTION("point loads") {}
  SECTION("own weight") {
    p.loads.gravity_m_s2 = 9.81;
    p.rod.density_kg_m3 = 6450;
  }
  SECTION("strips with natural curvature") {
    p.rod.shear_GPa = 31;
    p.rod.width_mm = 0.4;
    p.rod.thickness_mm = 0.2;
    p.rod.curvature_per_mm = 0.004;
  }
  check_against_finer(p, 1e-3);
  check_against_finer(p, 1e-4);
}

TEST_CASE("energies are as exact as they say where ends are clamped") {
  preset::Preset p = circle(4, 42.2, 0.655 * 42.2, 4);
  p.ends.kind = preset::EndKind::tangent;
  const auto frames_to = [&](double tolerance) {
    p.accuracy.tolerance = tolerance;
    return run_to_end(p).trajectory.frames;
  };
  const auto rough = frames_to(1e-3), fine = frames_to(1e-5);
  for (std::size_t k = 1; k < rough.size(); ++k)
    CHECK(std::abs(rough[k].energies.total() - fine[k].energies.total()) <
          rough[k].energy_error_mJ + fine[k].energy_error_mJ);
}

TEST_CASE("the curve of a push lies within its error, and its stiffness is its slope",
          "[standard]") {
  preset::Preset p = on_net(preset::NetKind::sphere, 60);
  p.footprint.placement = Placement::half;
  p.indentation.depth = 0.1;
  p.movie.frames = 9;
  p.accuracy.tolerance = 1e-6;
  const auto fine = run(p);
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    p.accuracy.tolerance = tolerance;
    const auto requested = run(p);
    for (std::size_t k = 0; k < 9; ++k) {
      const record::Frame &truth = fine.trajectory.frames[k],
                          &frame = requested.trajectory.frames[k];
      CAPTURE(k, tolerance, truth.force_N, frame.force_N, frame.push_error_N,
              truth.stiffness_N_per_mm, frame.stiffness_N_per_mm, frame.stiffness_error_N_per_mm);
      CHECK(std::abs(frame.force_N - truth.force_N) < 2 * frame.push_error_N + 1e-7);
      CHECK(frame.push_error_N <= frame.force_error_N * 1.0001);
      CHECK(std::abs(frame.stiffness_N_per_mm - truth.stiffness_N_per_mm) <
            2 * frame.stiffness_error_N_per_mm + 1e-6);
    }
  }
  const auto& frames = fine.trajectory.frames;
  for (std::size_t k = 1; k + 1 < frames.size(); ++k) {
    CAPTURE(k);
    const double slope = (frames[k + 1].force_N - frames[k - 1].force_N) /
                         (frames[k + 1].depth_mm - frames[k - 1].depth_mm);
    CHECK(frames[k].stiffness_N_per_mm == Approx(slope).epsilon(0.05));
  }
}

TEST_CASE(
    "bending strain and utilisation end a path, and of two limits the first met is reported") {
  const ExactRod exact(0.46400983), limit(0.24165275);
  const auto ended = [&](double most_bending, double most_utilisation, const char* why) {
    preset::Preset p = crossed_rods(exact.shortening);
    p.movie.frames = 4;
    p.accuracy.tolerance = 1e-4;
    p.rod.yield_strain = 2 * limit.strain;
    p.limits.max_bending_strain = most_bending * limit.strain;
    p.limits.max_utilisation = most_utilisation;
    auto outcome = run(p);
    CHECK(outcome.summary.limit == record::Limit::strength);
    CHECK_THAT(outcome.summary.limit_reason, Catch::Contains(why));
    return outcome;
  };
  const auto bent = ended(1, 0, "[limits] max_bending_strain = "),
             used = ended(1.2, 0.5, "[limits] max_utilisation = 0.5 allows"),
             first = ended(0.8, 0.5, "[limits] max_bending_strain = ");
  for (const auto* outcome : {&bent, &used}) {
    // the limit is met at the shortening of the elastica
    double progress = 0;
    REQUIRE(std::sscanf(outcome->summary.limit_reason.c_str(), "at progress %lf", &progress) == 1);
    CHECK(progress == Approx(limit.shortening / exact.shortening).epsilon(0.01));
    // the state at the limit has its frame
    const record::Frame& last = last_frame(*outcome);
    CHECK(outcome->trajectory.frames.size() == 3);
    CHECK(last.event == "strength");
    CHECK(last.progress == Approx(progress).margin(1e-3));
    CHECK(last.largest_bending_strain <= 1.001 * limit.strain);
    CHECK(last.largest_bending_strain > 0.99 * limit.strain);
  }
  CHECK(last_frame(bent).largest_bending_strain <= limit.strain);
  CHECK(last_frame(used).utilisation <= 0.5);
  CHECK(last_frame(used).utilisation > 0.495);
  CHECK(last_frame(first).utilisation == Approx(0.4).epsilon(0.02));
}

TEST_CASE("stress of a fibre: bending and axial force of an elastica, over the strength") {
  const ExactRod exact(0.24165275);
  preset::Preset p = crossed_rods(exact.shortening);
  p.accuracy.tolerance = 1e-5;
  const auto reported = run(p);
  // in the middle, where the rod lies level, all of the thrust is along it
  const double stress = 83e3 * exact.strain + exact.force / (M_PI * radius * radius);
  CHECK(last_frame(reported).largest_stress_MPa == Approx(stress).epsilon(1e-3));
  CHECK(last_frame(reported).stress_at.find("at joint [") != std::string::npos);
  CHECK(std::isnan(reported.summary.utilisation));
  CHECK(reported.trajectory.frames.front().largest_stress_MPa == 0);
  const record::Layout& layout = reported.trajectory.layout;
  const Eigen::VectorXd of_nodes = record::stress_of_nodes_MPa(layout, last_frame(reported));
  CHECK(of_nodes.maxCoeff() == last_frame(reported).largest_stress_MPa);
  CHECK(of_nodes[layout.joints[0].node] == of_nodes.maxCoeff());
  CHECK(record::stress_of_nodes_MPa(layout, last_frame(reported), true).size() == 0);
  p.rod.strength_MPa = 4 * stress;
  const auto by_stress = run(p);
  CHECK(by_stress.summary.utilisation == Approx(0.25).epsilon(1e-3));
  p.rod.strength_MPa = 0;
  p.rod.yield_strain = 4 * stress / 83e3;
  const auto by_strain = run(p);
  CHECK(by_strain.summary.utilisation == Approx(by_stress.summary.utilisation).epsilon(1e-12));
  CHECK(record::stress_of_nodes_MPa(by_strain.trajectory.layout, last_frame(by_strain), true)
            .maxCoeff() == Approx(by_strain.summary.utilisation));
}

TEST_CASE("stress of a fibre: axial force over area, and E r times the curvature") {
  const auto outcome = run(four_rods());
  const record::Frame& frame = last_frame(outcome);
  const double area = M_PI * 0.127 * 0.127;
  REQUIRE(frame.stress_MPa.size() == frame.curvature_per_mm.size());
  Eigen::Index point = 0, edge = 0;
  for (const auto& rod : outcome.trajectory.layout.rods) {
    const auto last = Eigen::Index(rod.size()) - 1;
    for (Eigen::Index k = 0; k <= last; ++k, ++point) {
      const double before = k > 0 ? std::abs(frame.axial_force_N[edge + k - 1]) : 0,
                   after = k < last ? std::abs(frame.axial_force_N[edge + k]) : 0;
      CHECK(frame.stress_MPa[point] ==
            Approx(std::max(before, after) / area + 83e3 * 0.127 * frame.curvature_per_mm[point]));
    }
    edge += last;
  }
  CHECK(frame.largest_stress_MPa == frame.stress_MPa.maxCoeff());
}

TEST_CASE("a shell bent further than is allowed is not pushed") {
  preset::Preset p = crossed_rods(0.25);
  p.limits.max_bending_strain = 0.5 * ExactRod(0.24165275).strain;
  p.indentation.at = preset::IndentationPosition::highest;
  p.indentation.depth_mm = 5;
  CHECK_THAT(refused_run(p, Fault::no_equilibrium), Catch::Contains("[limits] max_bending_strain"));
}
