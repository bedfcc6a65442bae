#include <catch2/catch.hpp>

#include "engine/core/enum_words.h"
#include "engine/core/text.h"

using namespace gridshell;

TEST_CASE("the edit distance counts letters inserted, left out, changed and swapped") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("rods", "") == 4);
  CHECK(edit_distance("radius", "radius") == 0);
  CHECK(edit_distance("radus", "radius") == 1);
  CHECK(edit_distance("raddius", "radius") == 1);
  CHECK(edit_distance("redius", "radius") == 1);
  CHECK(edit_distance("raduis", "radius") == 1);
  CHECK(edit_distance("Radius", "radius") == 0);
  CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("only a near name is suggested") {
  const std::vector<std::string> known{"radius_mm", "rods", "kind"};
  CHECK(nearest("raduis_mm", known) == "radius_mm");
  CHECK(nearest("rod", known) == "rods");
  CHECK(nearest("radius", known) == "radius_mm");
  CHECK(nearest("elephant", known).empty());
  CHECK(nearest("x", known).empty());
  // a long word must not cost time or memory
  CHECK(nearest(std::string(std::size_t(16) << 20, 'x'), known).empty());
  CHECK(did_you_mean("rdos", known) == "; did you mean 'rods'?");
  CHECK(did_you_mean("elephant", known).empty());
}

namespace {

enum class Fruit { apple, pear_tree };
constexpr auto words(Fruit) { return names_except<Fruit>({{Fruit::pear_tree, "pear tree"}}); }

}  // namespace

// a missing or misplaced enumerator does not compile; this is the condition for it
static_assert(is_enumerator<Fruit::pear_tree>());
static_assert(!is_enumerator<Fruit(2)>());

TEST_CASE("an enumerator has a word, and the word leads back") {
  CHECK(word_of(Fruit::pear_tree) == "pear tree");
  CHECK(find_word<Fruit>("pear tree") == Fruit::pear_tree);
  CHECK_FALSE(find_word<Fruit>("pear_tree"));
  CHECK(all_words<Fruit>() == std::vector<std::string>{"apple", "pear tree"});
}
