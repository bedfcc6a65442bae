// Sheets of A4: what comes on which, tables that go on, words that lie apart.
#include "render/movie/fabrication_sheets.h"

#include "tests/render/canvas/ink.h"

using namespace gridshell;

namespace {

/// The words of every sheet; what is too small for a sheet is the one that text is measured on.
std::vector<std::vector<std::string>> words_of(const render::Sheets& sheets) {
  std::vector<std::vector<std::string>> words;
  const test::CanvasObserver observer([&](const render::Canvas& canvas) {
    if (canvas.width() < 100) return;
    test::check_apart(canvas);
    words.push_back(canvas.texts());
  });
  const std::string pdf = sheets.pdf();
  CHECK(pdf.starts_with("%PDF"));
  return words;
}

}  // namespace

TEST_CASE("a table goes on to the next sheets under its head") {
  render::Sheets sheets("rods");
  sheets.heading("Cut list");
  std::vector<render::TableRow> rows;
  for (int k = 0; k < 150; ++k)
    rows.push_back({{"u" + std::to_string(k), "12.5", "1 2 3"}, k == 7});
  sheets.table({{"rod", 60, render::AlignX::left}, {"length", 60}, {"marks", 0}}, rows);
  const auto words = words_of(sheets);
  REQUIRE(words.size() == 3);
  for (std::size_t n = 0; n < words.size(); ++n) {
    CHECK(test::has(words[n], "rod"));
    CHECK(test::has(words[n], "marks"));
    CHECK(test::has(words[n], std::to_string(n + 1) + " of 3"));
  }
  // each row once
  std::vector<std::string> all;
  for (const auto& page : words) all.insert(all.end(), page.begin(), page.end());
  for (int k = 0; k < 150; ++k) CHECK(std::ranges::count(all, "u" + std::to_string(k)) == 1);
}

TEST_CASE("a heading is never the last of its sheet, and a sheet may be ended") {
  for (int before = 50; before < 64; ++before) {
    render::Sheets sheets("text");
    for (int k = 0; k < before; ++k) sheets.text("a line");
    sheets.heading("What follows");
    sheets.text("the first of it");
    const auto words = words_of(sheets);
    for (const auto& page : words)
      CHECK(test::has(page, "What follows") == test::has(page, "the first of it"));
  }
  render::Sheets sheets("text");
  sheets.next_sheet();
  sheets.text("one");
  sheets.next_sheet();
  sheets.values({{"height", "3 mm"}, {"span", "7 mm"}, {"rods", "12"}});
  sheets.next_sheet();
  CHECK(words_of(sheets).size() == 2);
}

TEST_CASE("long text is broken, a picture keeps its shape") {
  render::Sheets sheets("long");
  std::string text;
  for (int k = 0; k < 200; ++k) text += "word" + std::to_string(k) + " ";
  sheets.text(text);
  sheets.picture(render::Image(400, 200));
  const auto words = words_of(sheets);
  REQUIRE(words.size() == 1);
  CHECK(words[0].size() > 10);
}
