#include <catch2/catch.hpp>
#include <cmath>

#include "tests/engine/simulate/run.h"
#include "tests/small_shell.h"

using namespace gridshell;

namespace {

/// Drawn in so far that rods and joints come into contact.
preset::Preset crowded(double radius_mm) {
  preset::Preset preset = small_shell();
  preset.actuation.radius_mm = radius_mm;
  preset.movie.frames = 6;
  return preset;
}

double number_after(const std::string& text, const std::string& words) {
  const auto at = text.find(words);
  REQUIRE(at != std::string::npos);
  return std::stod(text.substr(at + words.size()));
}

}  // namespace

TEST_CASE(
    "a shell that comes into contact says where on its path, whatever frames were asked for") {
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
    CHECK((frame.event.find("rods ") != std::string::npos) ==
          (std::abs(frame.progress - 0.8) < 1e-9));
  }
  auto other = crowded(12);
  other.movie.frames = 2;
  CHECK(run(other).summary.contact == s.contact);
  // told, nothing else: the same states
  other.limits.table = true;
  const auto with_table = run(other);
  CHECK(distance(with_table, six) == 0);
  CHECK(with_table.summary.contacts > s.contacts);
  CHECK(with_table.summary.contact.find(" and the table at ") != std::string::npos);
}

TEST_CASE("a run that is to stop at contact ends in the last state before") {
  const std::string told = run(crowded(12)).summary.contact;
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
  CHECK(s.limit_reason.find(" is the last state without contact: beyond, rods ") !=
        std::string::npos);
  const record::Frame& last = last_frame(stopped);
  CHECK(last.event == "last state without contact");
  CHECK(last.progress == Approx(number_after(told, "touch at progress ")).margin(3e-3));
  CHECK(stopped.trajectory.frames.size() == 5);
}

TEST_CASE("a push stops before contact too, and one that starts in contact does not begin") {
  auto preset = crowded(54);
  preset.limits.contact = preset::OnContact::stop;
  preset.limits.table = true;
  preset.indentation.at = preset::IndentationPlace::highest;
  preset.indentation.depth_mm = 40;
  const auto pushed = run(preset);
  INFO(pushed.summary.limit_reason);
  CHECK(pushed.summary.limit == record::Limit::contact);
  CHECK(last_frame(pushed).contacts == 0);
  CHECK(last_frame(pushed).lowest_mm >= -0.5 * preset.rod.diameter_mm);
  CHECK(last_frame(pushed).lowest_mm < -0.4 * preset.rod.diameter_mm);
  CHECK(pushed.summary.limit_reason.find("and the table at") != std::string::npos);
}

TEST_CASE("shells of the paper do not touch themselves: a rod near its joint is none") {
  auto preset = small_shell();
  const auto outcome = run(preset);
  for (const record::Frame& frame : outcome.trajectory.frames) {
    CHECK(frame.contacts == 0);
    CHECK(std::isnan(frame.rod_gap_mm));
    CHECK(std::isnan(frame.joint_gap_mm));
  }
  CHECK(outcome.summary.contact.empty());
}

TEST_CASE("a barrier keeps rods apart on the whole path, on both models and every mesh") {
  auto preset = crowded(12);
  preset.accuracy.tolerance = 5e-3;
  preset.accuracy.model = GENERATE(RodModel::bend, RodModel::twist);
  preset.rod.shear_GPa = 31;
  const auto through = run(preset);
  CHECK(through.summary.rod_gap_mm < 0);
  CHECK(through.summary.energies[Term::contact] == 0);
  preset.contact.model = preset::ContactModel::barrier;
  const auto apart = run(preset);
  INFO(apart.summary.limit_reason << "; " << apart.summary.contact);
  CHECK(apart.summary.limit == record::Limit::none);
  CHECK(apart.summary.contact.find("rods ") == std::string::npos);
  CHECK(apart.summary.energies[Term::contact] > 0);
  for (const record::Frame& frame : apart.trajectory.frames) {
    INFO(frame.progress);
    CHECK_FALSE(frame.rod_gap_mm < 0);
    CHECK(frame.residual_N < 1e-6);
    CHECK(frame.negative_pivots == 0);
  }
}
