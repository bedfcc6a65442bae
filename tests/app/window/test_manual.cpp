// The manual as HTML.
#include "app/window/manual.h"
#include "tests/results.h"

using namespace gridshell;

TEST_CASE("what the manual shows as it is typed has no other elements in it") {
  const std::string html = value_of(window::manual_html());
  int blocks = 0;
  for (std::size_t from = 0; (from = html.find("<pre>", from)) != html.npos; ++blocks) {
    const std::size_t end = html.find("</pre>", from);
    REQUIRE(end != html.npos);
    CHECK(html.substr(from, end - from).find("<dd>") == std::string::npos);
    from = end;
  }
  CHECK(blocks > 0);
}
