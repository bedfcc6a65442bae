#include <cmath>

#include "tests/engine/simulate/run.h"
#include "tests/number_after.h"

using namespace gridshell;

namespace {

/// A small shell, contracted to a radius at which rods and joints may be in contact.
preset::Preset crowded(double radius_mm) {
  preset::Preset preset = small_shell();
  preset.actuation.radius_mm = radius_mm;
  preset.movie.frames = 6;
  return preset;
}

/// The shell of Fig. 1 with two mirrors, which dips below its boundary's plane.
preset::Preset with_two_mirrors() {
  preset::Preset preset = circle(12, 126, 94.5);
  preset.imperfection.size = 0;
  preset.accuracy.edges_per_segment = 4;
  return preset;
}

}  // namespace

TEST_CASE(
    "a shell that comes into contact says where on its path, whatever frames were requested") {
  const auto six = run(crowded(12));
  const record::Summary& s = six.summary;
  CHECK(s.limit == record::Limit::none);
  CHECK(s.stable);
  CHECK(s.contacts > 10);
  CHECK(s.rod_gap_mm < 0);
  CHECK(s.joint_gap_mm < 0);
  INFO(s.contact);
  const double rods = number_after(s.contact, "mm touch at progress ");
  CHECK(s.contact.starts_with("rods "));
  CHECK(s.contact.find("; joints ") != std::string::npos);
  for (const record::Frame& frame : six.trajectory.frames) {
    INFO(frame.progress);
    CHECK((frame.contacts > 0) == (frame.progress > rods));
    // they separate again and touch once more before 0.9
    CHECK((frame.event.find("rods ") != std::string::npos) == (frame.progress > 0.75));
  }
  auto other = crowded(12);
  other.movie.frames = 2;
  CHECK(run(other).summary.contact == s.contact);
  // contact is reported without any effect on the states
  other.limits.table = true;
  const auto with_table = run(other);
  CHECK(distance(with_table, six) == 0);
  CHECK(with_table.summary.contacts > s.contacts);
  CHECK(with_table.summary.contact.find(" and the table at ") != std::string::npos);
}

TEST_CASE("a run that is to stop at contact ends in the last state before") {
  const std::string reported = run(crowded(12)).summary.contact;
  auto preset = crowded(12);
  preset.limits.contact = preset::OnContact::stop;
  const auto stopped = run(preset);
  const record::Summary& s = stopped.summary;
  CHECK(s.limit == record::Limit::contact);
  CHECK(s.stable);
  CHECK(s.contacts == 0);
  CHECK(s.contact.empty());
  CHECK(s.rod_gap_mm > 0);
  CHECK(s.rod_gap_mm < 0.01);
  CHECK_THAT(s.limit_reason, Catch::Contains(" is the last state without contact: past it rods "));
  const record::Frame& last = last_frame(stopped);
  CHECK(last.event == "last state without contact");
  CHECK(last.progress == Approx(number_after(reported, "touch at progress ")).margin(3e-3));
  CHECK(stopped.trajectory.frames.size() == 5);
}

TEST_CASE("a push stops before contact too, and one that starts in contact does not begin") {
  auto preset = crowded(54);
  preset.limits.contact = preset::OnContact::stop;
  preset.limits.table = true;
  preset.indentation.at = preset::IndentationPosition::highest;
  preset.indentation.depth_mm = 40;
  const auto pushed = run(preset);
  INFO(pushed.summary.limit_reason);
  CHECK(pushed.summary.limit == record::Limit::contact);
  CHECK(last_frame(pushed).contacts == 0);
  CHECK(last_frame(pushed).lowest_mm >= -0.5 * preset.rod.diameter_mm);
  CHECK(last_frame(pushed).lowest_mm < -0.4 * preset.rod.diameter_mm);
  CHECK(pushed.summary.limit_reason.find("and the table at") != std::string::npos);
}

TEST_CASE("a contact inside the load step in which the equilibrium is lost is found") {
  auto preset = with_two_mirrors();
  preset.limits.contact = preset::OnContact::stop;
  preset.indentation.at = preset::IndentationPosition::highest;
  std::vector<double> depths;
  // steps end at 33.6, before the limit point at 33.64, and at 32.5 and 35
  for (const double depth_mm : {36.0, 40.0}) {
    preset.indentation.depth_mm = depth_mm;
    const auto pushed = run(preset);
    INFO(pushed.summary.limit_reason);
    CHECK(pushed.summary.limit == record::Limit::contact);
    CHECK(last_frame(pushed).contacts == 0);
    depths.push_back(last_frame(pushed).depth_mm);
  }
  CHECK(depths[0] > 33);
  CHECK(depths[1] == Approx(depths[0]).margin(0.01));
}

TEST_CASE("a shell that begins in contact goes no deeper into it, and may leave it") {
  auto preset = with_two_mirrors();
  preset.limits.table = true;
  const auto reported = run(preset);
  INFO(reported.summary.contact);
  preset.limits.contact = preset::OnContact::stop;
  const auto stopped = run(preset);
  INFO(stopped.summary.limit_reason);
  CHECK(stopped.summary.limit == record::Limit::contact);
  // the run stops at the first contact, not where the first buckled state was computed
  CHECK(last_frame(stopped).progress ==
        Approx(number_after(reported.summary.contact, "at progress ")).margin(1e-3));
  CHECK(last_frame(stopped).contacts == 0);

  const auto scene = value_of(shared_scene_of(preset));
  Simulation shell = value_of(Simulation::open(scene, {{4}, false}));
  REQUIRE(value_of(shell.begin_buckled(0.05, unwatched)).end == Outcome::reached);
  REQUIRE(!shell.contacts().interpenetrations.empty());
  const double begun = shell.progress();
  CHECK(shell.move_to(begun + 0.1, unwatched).end == Outcome::contact);
  CHECK(shell.progress() == Approx(begun).margin(1e-3));
  CHECK(shell.move_to(0.5 * begun, unwatched).end == Outcome::reached);
}

TEST_CASE("a small shell has no contact: rods that meet in a joint are none") {
  auto preset = small_shell();
  const auto outcome = run(preset);
  for (const record::Frame& frame : outcome.trajectory.frames) {
    CHECK(frame.contacts == 0);
    CHECK(std::isnan(frame.rod_gap_mm));
    CHECK(std::isnan(frame.joint_gap_mm));
  }
  CHECK(outcome.summary.contact.empty());
}

TEST_CASE("a barrier separates rods on the whole path, of wires and of rods that twist", "[full]") {
  // further in, at 12 mm, meshes that the tolerance chooses continue for minutes
  auto preset = crowded(17);
  preset.accuracy.tolerance = 5e-3;
  preset.imperfection.size = 1e-4;  // the symmetric branch ends unstable
  preset.accuracy.model = GENERATE(RodModel::bend, RodModel::twist);
  preset.rod.shear_GPa = 31;
  const auto through = run(preset);
  CHECK(through.summary.rod_gap_mm < 0);
  CHECK(through.summary.energies[Term::contact] == 0);
  preset.contact.model = preset::ContactModel::barrier;
  const auto apart = run(preset);
  INFO(apart.summary.limit_reason << "; " << apart.summary.contact);
  // it snaps on its path, as reported
  CHECK(apart.summary.limit == record::Limit::snap);
  CHECK(apart.trajectory.frames.back().progress == 1);
  CHECK(apart.summary.stable);
  CHECK(apart.summary.contact.find("rods ") == std::string::npos);
  CHECK(apart.summary.energies[Term::contact] > 0);
  for (const record::Frame& frame : apart.trajectory.frames) {
    INFO(frame.progress);
    CHECK_FALSE(frame.rod_gap_mm < 0);
    // 1e-7 mm on rods that press with some 10 N/mm
    CHECK(frame.residual_N < 1e-5);
    CHECK(frame.negative_pivots == 0);
  }
}
