// A session: one shell under all commands of a user.
#include "engine/simulate/simulation.h"

#include <pthread.h>

#include <chrono>
#include <thread>

#include "engine/simulate/frames.h"
#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

preset::Preset six_rods(double tolerance, RodModel model = RodModel::bend) {
  preset::Preset p = paper_circle(6, 0.8);
  p.accuracy.model = model;
  if (model == RodModel::twist) p.rod.shear_GPa = 31;
  p.rod.density_kg_m3 = 6450;
  p.accuracy.tolerance = tolerance;
  return p;
}

Simulation open(const std::shared_ptr<const Scene>& scene) {
  return Simulation::open(scene, plan_levels(scene->tolerance)).value();
}

void certified(const Simulation& session, const Report& report) {
  CAPTURE(words_of(report.end).name, report.t, report.certificate.residual_N);
  REQUIRE(report.end == Outcome::reached);
  CHECK(report.certificate.stable());
  CHECK(report.certificate.residual_N < 1e-3);  // of corrections below 1e-4 mm
  CHECK(report.certificate.error_estimate_mm < 1e-2 * session.scene().length_scale_mm);
  CHECK(report.effort.factorizations > 0);
}

/// displacements of a circle's edge points onto an ellipse
Eigen::Matrix3Xd ellipse(const Scene& scene) {
  return Eigen::Vector3d(0.06, -0.04, 0).asDiagonal() * scene.motion.end;
}

double shell_progress(const Scene& scene, double ratio) {
  return scene.progress_of_radius(ratio * scene.radius_begin_mm);
}

}  // namespace

TEST_CASE("a session goes through all that a user does, and back by its checkpoints to the bit") {
  const auto model = GENERATE(RodModel::bend, RodModel::twist);
  CAPTURE(word_of(model));
  const auto shell = shared_scene(six_rods(1e-3, model));
  Simulation session = open(shell);
  std::vector<Checkpoint> kept;
  std::vector<Eigen::Matrix3Xd> nodes;
  std::vector<double> energies;
  const auto keep = [&](const Report& report) {
    certified(session, report);
    kept.push_back(session.save());
    nodes.push_back(session.nodes());
    energies.push_back(session.energies().total());
  };
  keep(session.begin_buckled(0.02, unwatched).value());
  keep(session.move_to(1, unwatched));
  keep(session.move_edge_points(1, ellipse(*shell), unwatched));
  const Eigen::Vector3d down(0, 0, -0.4);
  keep(session.push(7, down, Across::free, unwatched));
  CHECK((session.nodes().col(7) - nodes[2].col(7)).z() == Approx(-0.4).margin(1e-2));
  keep(session.push(12, down, Across::fixed, unwatched));
  CHECK(session.constraints().size() == 2);
  CHECK(std::abs(session.force(0).z()) > 1e-4);
  keep(session.release(7, unwatched));
  CHECK(session.constraints().size() == 1);
  keep(session.release(12, unwatched));
  CHECK(session.constraints().empty());
  // after both releases the shell is as it was before the pushes
  CHECK(max_column_norm(session.nodes() - nodes[2]) < 1e-3);
  std::vector<NodeAction> field;
  for (int joint = 0; joint < 12; ++joint) field.push_back({joint, {0, 2e-5, -1e-4}});
  keep(session.set_field(field, unwatched));
  CHECK(max_column_norm(session.nodes() - nodes[2]) > 1e-2);
  CHECK(session.energies()[Term::load] != 0);
  keep(session.rest(unwatched));
  CHECK(max_column_norm(session.nodes() - nodes[7]) < 1e-4);
  keep(session.set_field({}, unwatched));
  CHECK(max_column_norm(session.nodes() - nodes[2]) < 1e-3);

  for (std::size_t k = kept.size(); k-- > 0;) {
    session.restore(kept[k]);
    CAPTURE(k);
    CHECK(session.nodes() == nodes[k]);
    CHECK(session.energies().total() == energies[k]);
    CHECK(session.save().state.levels[0].x == kept[k].state.levels[0].x);
  }
  // from a restored checkpoint the same command gives the same state
  session.restore(kept[1]);
  certified(session, session.move_edge_points(1, ellipse(*shell), unwatched));
  CHECK(max_column_norm(session.nodes() - nodes[2]) < 1e-6);
}

TEST_CASE("a session refines on request and takes other rods from where it is") {
  Simulation session = formed(six_rods(1e-2));
  const double coarse = session.certificate().error_estimate_mm;
  const Checkpoint before = session.save();
  certified(session, session.refine(1e-2 * coarse, unwatched));
  CHECK(session.certificate().error_estimate_mm <= 1e-2 * coarse);
  session.restore(before);
  CHECK(session.certificate().error_estimate_mm == coarse);
  const double bend = session.energies()[Term::bend];
  const auto thicker = value_of(session.set_rods(circular_section(0.3, 83), unwatched));
  certified(session, thicker);
  CHECK(session.energies()[Term::bend] == Approx(bend * std::pow(0.3 / 0.254, 4)).epsilon(1e-2));
  CHECK_FALSE(session.set_rods(RodSection{-1, 1}, unwatched));
  certified(session, session.move_to(0.95, unwatched));
}

TEST_CASE("a joint stays where it was pushed to on other meshes, whatever they were used for") {
  Simulation session = formed(six_rods(1e-2));
  const double coarse = session.certificate().error_estimate_mm;
  const Checkpoint unpushed = session.save();
  certified(session, session.refine(0.2 * coarse, unwatched));
  session.restore(unpushed);
  certified(session, session.push(7, {0, 0, -3}, Across::fixed, unwatched));
  const Eigen::Vector3d there = session.nodes().col(7);
  certified(session, session.move_to(0.97, unwatched));
  const double height = session.nodes().row(2).maxCoeff(),
               error = session.certificate().error_estimate_mm;
  certified(session, session.refine(0.2 * coarse, unwatched));
  CHECK((session.nodes().col(7) - there).norm() < 1e-6);
  CHECK(session.nodes().row(2).maxCoeff() == Approx(height).margin(2 * error));
  certified(session, session.move_to(0.95, unwatched));
  CHECK((session.nodes().col(7) - there).norm() < 1e-6);
}

TEST_CASE("a first state has no loads of earlier commands") {
  Simulation session = formed(six_rods(1e-2));
  const State first = session.shell().state().levels.back();
  const double t = session.shell().state().t;
  const Eigen::Matrix3Xd plain = session.nodes();
  certified(session, session.set_field({{3, {0, 0, -0.15}}}, unwatched));
  CHECK(max_column_norm(session.nodes() - plain) > 0.3);
  certified(session, session.begin_at(t, first, unwatched));
  CHECK(session.field().empty());
  CHECK(max_column_norm(session.nodes() - plain) < 1e-4);
}

TEST_CASE("what fails leaves the last certified state, what is cancelled says so") {
  Simulation session = formed(six_rods(1e-3));
  Watch watch;
  const Eigen::Matrix3Xd before = session.nodes();
  watch.cancel();
  CHECK(session.push(7, {0, 0, -5}, Across::free, watch).end == Outcome::cancelled);
  CHECK(max_column_norm(session.nodes() - before) < 1e-6);
  // a push that did not start prescribes nothing
  CHECK(session.constraints().empty());
  CHECK(session.move_to(0.9, watch).end == Outcome::cancelled);
  CHECK(session.load(2, watch).end == Outcome::cancelled);
  CHECK(session.move_to(1, unwatched).end == Outcome::reached);
  CHECK(max_column_norm(session.nodes() - before) < 1e-6);
  // pulled outwards, the rods reach the strain limit, and the push stops there, certified
  const Report pulled = session.push(0, {0, 0, 60}, Across::free, unwatched);
  CHECK(pulled.end == Outcome::locked);
  CHECK(pulled.t < 1);
  CHECK(pulled.certificate.stable());
  CHECK(pulled.certificate.largest_strain < 1.1 * session.scene().max_strain);
}

TEST_CASE("a shell in motion reaches the equilibrium of the static solver") {
  Simulation session = formed(six_rods(1e-3));
  const Eigen::Matrix3Xd before = session.nodes();
  certified(session, session.set_field({{3, {0, 0, -0.15}}}, unwatched));
  CHECK(max_column_norm(session.nodes() - before) > 0.3);
  // the weight is gone, and the shell not yet back
  session.shell().set_fields({}, {});
  int seen = 0;
  double moved = 0;
  certified(session, session.rest_in_time(unwatched, [&](const MovingState& now) {
    ++seen;
    moved = std::max(moved, max_column_norm(now.velocity));
  }));
  CHECK(seen > 10);
  CHECK(moved > 1);
  CHECK(max_column_norm(session.nodes() - before) < 1e-4);
}

TEST_CASE("a session begins flat, on other meshes, fixes a joint where it is and takes more load") {
  preset::Preset p = six_rods(1e-3);
  p.loads.gravity_m_s2 = 9.81;
  preset::Preset heavy = p;
  heavy.loads.gravity_m_s2 *= 40;
  Simulation session = open(shared_scene(p));
  const Report flat = session.begin_flat();
  CHECK(flat.end == Outcome::reached);
  CHECK(session.nodes().row(2).cwiseAbs().maxCoeff() == 0);
  CHECK(session.energies()[Term::bend] == Approx(0).margin(1e-9));

  session = formed(p);
  const Eigen::Matrix3Xd plain = session.nodes();
  certified(session, session.load(40, unwatched));
  CHECK(max_column_norm(session.nodes() - plain) > 1e-2);
  CHECK(max_column_norm(session.nodes() - formed(heavy).nodes()) < 1e-3);
  certified(session, session.load(1, unwatched));
  CHECK(max_column_norm(session.nodes() - plain) < 1e-3);

  // on other meshes the same shell
  const double estimate = session.certificate().error_estimate_mm;
  const auto finer = value_of(session.remesh({{8, 16, 32}, true}, unwatched));
  certified(session, finer);
  CHECK(session.shell().plan().edges_per_segment == std::vector<int>{8, 16, 32});
  const Eigen::Index joints = session.shell().finest().joints;
  CHECK(max_column_norm(session.nodes().leftCols(joints) - plain.leftCols(joints)) < 2 * estimate);

  // a fixed joint stays while the boundary moves, and the shell relaxes when it is released
  const Eigen::Vector3d place = session.nodes().col(5);
  certified(session, session.push(5, {0, 0, 0}, Across::fixed, unwatched));
  CHECK(session.force(0).norm() < 1e-5);
  certified(session, session.move_to(shell_progress(session.scene(), 0.805), unwatched));
  CHECK((session.nodes().col(5) - place).norm() < 1e-6);
  CHECK(session.force(0).norm() > 1e-4);
  certified(session, session.release(5, unwatched));
  certified(session, session.move_to(1, unwatched));
  CHECK(max_column_norm(session.nodes().leftCols(joints) - plain.leftCols(joints)) < 2 * estimate);
}

TEST_CASE("a session of 24 rods answers a cancel within 0.2 s on both rod models", "[standard]") {
  const auto model = GENERATE(RodModel::bend, RodModel::twist);
  preset::Preset p = six_rods(1e-3, model);
  p.footprint = paper_circle(24).footprint;
  p.actuation.radius_mm = 0.8 * p.footprint.radius_mm;
  const auto shell = shared_scene(p);
  Simulation session = open(shell);

  REQUIRE(session.begin_buckled(0.02, unwatched).value().end == Outcome::reached);
  const Checkpoint begun = session.save();
  REQUIRE(session.move_to(0.3, unwatched).end == Outcome::reached);
  const Checkpoint formed = session.save();
  clockid_t clock{};
  REQUIRE(pthread_getcpuclockid(pthread_self(), &clock) == 0);
  int stopped = 0;
  // processor time between the cancel and the answer
  const auto answers = [&](const char* what, const Checkpoint& from, const auto& act) {
    for (const int wait_ms : {20, 150}) {
      CAPTURE(word_of(model), what, wait_ms);
      session.restore(from);
      Watch watch;
      double wished = 0;
      std::thread other([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
        wished = cpu_seconds_now(clock);
        watch.cancel();
      });
      const Outcome end = act(watch);
      const double answered = cpu_seconds_now();
      other.join();
      if (end != Outcome::cancelled) continue;
      ++stopped;
      CHECK(answered - wished < 0.2);
    }
  };
  answers("actuate", begun, [&](const Watch& watch) { return session.move_to(1, watch).end; });
  answers("push", formed, [&](const Watch& watch) {
    return session.push(7, {0, 0, -8}, Across::free, watch).end;
  });
  answers("field", formed, [&](const Watch& watch) {
    return session.set_field({{7, {0, 0, -5e-2}}}, watch).end;
  });
  answers("refine", formed, [&](const Watch& watch) { return session.refine(1e-6, watch).end; });
  answers("move in time", formed, [&](const Watch& watch) {
    session.shell().set_fields({{7, {0, 0, -5e-2}}}, {});
    return session.rest_in_time(watch, [](const MovingState&) {}).end;
  });
  CHECK(stopped >= 5);
}

TEST_CASE("dead loads stay as they are while joints are pushed at half the actuation") {
  preset::Preset p = six_rods(1e-3);
  p.loads.gravity_m_s2 = 9.81 * 40;
  Simulation session = open(shared_scene(p));
  certified(session, session.begin_buckled(0.02, unwatched).value());
  certified(session, session.move_to(0.5, unwatched));
  const double load = session.steady_load().begin;
  CHECK(load == Approx(0.5));
  const Eigen::Vector3d down(0, 0, -0.1);
  certified(session, session.push(7, down, Across::free, unwatched));
  CHECK(session.steady_load().begin == load);
  certified(session, session.push(12, down, Across::free, unwatched));
  CHECK(session.shell().outside(session.shell().last()).load == Approx(load));
  certified(session, session.release(7, unwatched));
  certified(session, session.release(12, unwatched));
  // a factor counts for all of the actuation
  certified(session, session.load(2, unwatched));
  CHECK(session.steady_load().begin == Approx(2 * load));
  const double before = session.energies()[Term::load];
  CHECK(session.move_to(0.5, unwatched).end == Outcome::reached);
  CHECK(session.energies()[Term::load] == Approx(before).epsilon(1e-3));
}

TEST_CASE("frames of a motion have the energies under the loads of their path parameter") {
  preset::Preset p = six_rods(1e-3);
  p.loads.gravity_m_s2 = 9.81;
  Simulation session = formed(p);
  const std::vector<TimedState> moments = {{0, session.shell().state().levels.back()}};
  const auto load_at = [&](double progress) {
    return simulate::frames_in_motion(session, parameter_at(progress), moments)
        .front()
        .energies[Term::load];
  };
  CHECK(load_at(0.5) == Approx(0.5 * load_at(1)));
}
