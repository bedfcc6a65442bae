#include <catch2/catch.hpp>

#include "engine/core/enum_words.h"

using namespace gridshell;

namespace {

enum class Fruit { apple, pear_tree };
constexpr auto words(Fruit) { return names_except<Fruit>({{Fruit::pear_tree, "pear tree"}}); }

}  // namespace

// what is forgotten or out of order does not compile; this is what that stands on
static_assert(is_enumerator<Fruit::pear_tree>());
static_assert(!is_enumerator<Fruit(2)>());

TEST_CASE("an enumerator has a word, and the word leads back") {
  CHECK(word_of(Fruit::pear_tree) == "pear tree");
  CHECK(find_word<Fruit>("pear tree") == Fruit::pear_tree);
  CHECK_FALSE(find_word<Fruit>("pear_tree"));
  CHECK(all_words<Fruit>() == std::vector<std::string>{"apple", "pear tree"});
}
