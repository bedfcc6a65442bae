#include <catch2/catch.hpp>
#include <clocale>
#include <cmath>
#include <locale>

#include "render/canvas/canvas.h"
#include "render/canvas/text.h"

using namespace gridshell::render;
using Labels = std::vector<std::string>;

TEST_CASE("marks lower, raise and slant, the letters stay") {
  const auto runs = parse_marked("*R*_{a} = 10^{−3} mm");
  REQUIRE(runs.size() == 5);
  CHECK(runs[0].text == "R");
  CHECK(runs[0].slanted);
  CHECK(runs[1].text == "a");
  CHECK(runs[1].level == -1);
  CHECK_FALSE(runs[1].slanted);
  CHECK(runs[2].text == " = 10");
  CHECK(runs[3].level == 1);
  CHECK(runs[4].text == " mm");
  CHECK(without_marks("*K*_{□} (rad)") == "K□ (rad)");
}

TEST_CASE("a mark without its partner is a letter") {
  CHECK(without_marks("2 * 3") == "2 * 3");
  CHECK(without_marks("s1_actuation") == "s1_actuation");
  CHECK(without_marks("R_{a") == "R_{a");
  CHECK(without_marks("end\\") == "end\\");
}

TEST_CASE("plain text is shown as it is") {
  for (const std::string text : {"R_{a}*x*^{2}", "a\\b", "out/s1_actuation", "\\", "*"})
    CHECK(without_marks(plain(text)) == text);
}

namespace {

std::vector<std::string> labels(const std::vector<Tick>& ticks) {
  std::vector<std::string> result;
  for (const Tick& tick : ticks)
    if (tick.major) result.push_back(tick.label);
  return result;
}

// numbers as much of Europe writes them, whatever locales this machine has
struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  std::string do_grouping() const override { return "\3"; }
  char do_thousands_sep() const override { return '.'; }
};

}  // namespace

TEST_CASE("numbers have a true minus and no negative zero") {
  CHECK(fixed(-0.05, 2) == "−0.05");
  CHECK(fixed(-0.001, 2) == "0.00");
  CHECK(fixed(115.9, 1) == "115.9");
  CHECK(length_text(45.67) == "45.7 mm");
  CHECK(length_text(1755.5) == "1.756 m");
  CHECK(fixed(NAN, 1) == "–");
  CHECK(scientific(3.2e-9, 2) == "3.2 × 10^{−9}");
  CHECK(scientific(-1.25e7, 3) == "−1.25 × 10^{7}");
  CHECK(scientific(0.0123, 3) == "0.0123");
  CHECK(scientific(9.99, 2) == "10");
  CHECK(scientific(99999, 2) == "1.0 × 10^{5}");
  CHECK(scientific(0, 2) == "0");
}

TEST_CASE("numbers in pictures do not follow the locale") {
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  const std::string number = fixed(1234.5, 1), tick = labels(linear_ticks(0, 0.5, 5)).at(1);
  std::locale::global(before);
  CHECK(number == "1234.5");
  CHECK(tick == "0.1");
}

TEST_CASE("linear ticks are round numbers with their minor ticks") {
  CHECK(labels(linear_ticks(0, 40, 5)) == Labels{"0", "10", "20", "30", "40"});
  CHECK(labels(linear_ticks(-0.12, 0.12, 6)) == Labels{"−0.10", "−0.05", "0.00", "0.05", "0.10"});
  CHECK(labels(linear_ticks(94.5, 126, 4)) == Labels{"100", "110", "120"});
  int minor = 0;
  for (const Tick& tick : linear_ticks(0, 40, 4)) {
    minor += !tick.major;
    CHECK(tick.value >= -1e-9);
    CHECK(tick.value <= 40 + 1e-9);
  }
  CHECK(minor == 16);
}

TEST_CASE("there are at least two labels, also where a range is awkward") {
  for (double low : {0.0, 0.03, 0.97, 7.1, 123.4, -5.0})
    for (double width : {1e-3, 0.07, 0.3, 1.0, 11.0, 950.0})
      for (int count : {2, 4, 6}) {
        const auto found = labels(linear_ticks(low, low + width, count));
        INFO(low << " + " << width << ", " << count);
        CHECK(found.size() >= 2);
        CHECK(found.size() <= std::size_t(3 * count));
        // no two labels read the same
        CHECK(std::adjacent_find(found.begin(), found.end()) == found.end());
      }
}

TEST_CASE("small and large numbers share a power of ten") {
  CHECK(labels(linear_ticks(0, 4e-6, 2)) == Labels{"0", "2 × 10^{−6}", "4 × 10^{−6}"});
  CHECK(labels(linear_ticks(0, 2e6, 2)) == Labels{"0", "1 × 10^{6}", "2 × 10^{6}"});
}

TEST_CASE("logarithmic ticks are at powers of ten with eight minor ones between") {
  const auto ticks = log_ticks(1e-4, 1e-1, 6);
  CHECK(labels(ticks) == Labels{"10^{−4}", "10^{−3}", "10^{−2}", "10^{−1}"});
  CHECK(ticks.size() == 4 + 3 * 8);
  CHECK(labels(log_ticks(1e-12, 1, 5)) ==
        Labels{"10^{−12}", "10^{−9}", "10^{−6}", "10^{−3}", "10^{0}"});
  CHECK(labels(log_ticks(0.8, 6, 5)) == Labels{"1", "2", "5"});
  CHECK(labels(log_ticks(2.2, 4.4, 5)).size() >= 2);
}

TEST_CASE("an impossible range has no ticks") {
  CHECK(linear_ticks(1, 1, 5).empty());
  CHECK(linear_ticks(2, 1, 5).empty());
  CHECK(linear_ticks(0, INFINITY, 5).empty());
  CHECK(log_ticks(0, 1, 5).empty());
  CHECK(log_ticks(-1, 1, 5).empty());
}

TEST_CASE("a range is rounded up to a nice number") {
  CHECK(nice_ceiling(0.0371) == Approx(0.04));
  CHECK(nice_ceiling(0.04) == Approx(0.04));
  CHECK(nice_ceiling(9.1) == Approx(10));
  CHECK(nice_ceiling(1.2e-7) == Approx(1.5e-7));
}
