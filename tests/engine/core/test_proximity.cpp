// Pairs of boxes that are near each other, whatever their sizes.
#include "engine/core/proximity.h"

#include <catch2/catch.hpp>
#include <random>
#include <set>

using namespace gridshell;

namespace {

using Boxes = std::vector<Eigen::AlignedBox3d>;

/// Boxes at points of a cube of 100 mm, most with sides up to `mm`, one in ten up to fifty times
/// that.
Boxes random_boxes(int count, double mm, unsigned seed) {
  std::mt19937 random{seed};
  const auto uniform = [&](double most) { return most * double(random()) / double(random.max()); };
  Boxes boxes;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d at(uniform(100), uniform(100), uniform(100));
    const double size = k % 10 == 3 ? 50 * mm : mm;
    boxes.emplace_back(at, at + Eigen::Vector3d(uniform(size), uniform(size), uniform(size)));
  }
  return boxes;
}

void check_all_pairs(const Boxes& boxes, double mm) {
  std::set<std::pair<int, int>> expected, found;
  for (int i = 0; i < int(boxes.size()); ++i)
    for (int j = i + 1; j < int(boxes.size()); ++j)
      if (are_near(boxes[std::size_t(i)], boxes[std::size_t(j)], mm)) expected.insert({i, j});
  each_near_pair(boxes, mm, [&](int i, int j) {
    CHECK(i < j);
    CHECK(found.insert({i, j}).second);
  });
  CHECK(found == expected);
}

}  // namespace

TEST_CASE("near boxes: every pair once, as by looking at all") {
  for (const unsigned seed : {1u, 2u, 3u})
    for (const double size : {0.0, 2.0, 20.0}) {
      CAPTURE(seed, size);
      check_all_pairs(random_boxes(200, size, seed), 3);
    }
}

TEST_CASE("near boxes: none, one, all at one position, all on a line") {
  check_all_pairs({}, 1);
  check_all_pairs(random_boxes(1, 1, 1), 1);
  const Eigen::Vector3d place(1, 2, 3);
  check_all_pairs(Boxes(20, Eigen::AlignedBox3d(place)), 0);
  Boxes line;
  for (int k = 0; k < 50; ++k) line.emplace_back(Eigen::Vector3d(0, k, 0));
  check_all_pairs(line, 1);
}
