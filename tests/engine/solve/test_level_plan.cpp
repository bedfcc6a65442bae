// Which meshes are tried next.
#include <catch2/catch.hpp>

#include "engine/solve/mesh_levels.h"

using gridshell::LevelPlan;
using gridshell::with_finer_leader;
using Edges = std::vector<int>;

TEST_CASE("a finer leader doubles all meshes, or is the second where the finest is fine enough") {
  CHECK(with_finer_leader({{4, 8}, false})->edges_per_segment == Edges{8, 16});
  CHECK(with_finer_leader({{16, 32, 64}, true})->edges_per_segment == Edges{32, 64, 128});
  CHECK(with_finer_leader({{5, 10, 20, 40, 80}, true})->edges_per_segment == Edges{10, 20, 40, 80});
  // what is left knows no error
  CHECK_FALSE(with_finer_leader({{32, 64, 128}, true}));
  CHECK_FALSE(with_finer_leader({{64, 128}, false}));
}
