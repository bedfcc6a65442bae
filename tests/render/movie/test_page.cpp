// Sheets that compare pictures.
#include "render/movie/page.h"

#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::render;

TEST_CASE("a sheet of many pairs is drawn smaller, of too many refused") {
  std::vector<PicturePair> pairs(60, {"a", Image(40, 60), Image(40, 60)});
  const Image sheet = value_of(contact_sheet(pairs, 4));
  CHECK(sheet.height <= 32767);
  CHECK(sheet.height > 30000);
  pairs.resize(400, pairs.front());
  CHECK_THAT(refusal(contact_sheet(pairs, 4)), Catch::Contains("--difference: a sheet of 400"));
}
