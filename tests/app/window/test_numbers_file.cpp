#include "app/window/edit_session.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace gridshell::window;

TEST_CASE("numbers put aside come back to the bit, in any order") {
  ScratchFile file;
  Eigen::Matrix3Xd places = Eigen::Matrix3Xd::Random(3, 5);
  places(1, 2) = std::nextafter(1.0, 2.0);
  Eigen::VectorXd none, forces = Eigen::VectorXd::Random(7);
  const Eigen::Matrix3Xd places_before = places;
  const Eigen::VectorXd forces_before = forces;
  SavedArray a, b, c;
  REQUIRE((file.put(places, a) && file.put(none, b) && file.put(forces, c)));
  CHECK(places.size() + forces.size() == 0);
  CHECK(file.bytes() == 8 * (15 + 7));
  REQUIRE((file.take(c, forces) && file.take(b, none) && file.take(a, places)));
  CHECK(places == places_before);
  CHECK(forces == forces_before);
  CHECK(none.size() == 0);
  // and once more
  REQUIRE(file.take(c, forces));
  CHECK(forces == forces_before);
}
