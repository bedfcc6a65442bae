// Sheets of A4: what is on which, tables that continue, words that do not overlap.
#include "render/movie/fabrication_sheets.h"

#include "tests/render/canvas/ink.h"

using namespace gridshell;

namespace {

/// The texts of every sheet; canvases too small for a sheet are those on which text is measured.
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

TEST_CASE("a table continues on the next sheets under its head") {
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

TEST_CASE("long text is broken into lines on one sheet") {
  render::Sheets sheets("long");
  std::string text;
  for (int k = 0; k < 200; ++k) text += "word" + std::to_string(k) + " ";
  sheets.text(text);
  const auto words = words_of(sheets);
  REQUIRE(words.size() == 1);
  CHECK(words[0].size() > 10);
}

TEST_CASE("a picture is as wide as the sheet's text and keeps its shape") {
  // the height of the text below the pictures
  const auto below = [](const std::vector<render::Image>& pictures) {
    render::Sheets sheets("pictures");
    sheets.pictures(pictures);
    sheets.text("below");
    double y = 0;
    const test::CanvasObserver observer([&](const render::Canvas& canvas) {
      for (std::size_t k = 0; k < canvas.texts().size(); ++k)
        if (canvas.width() > 100 && canvas.texts()[k] == "below") y = canvas.text_boxes()[k].y;
    });
    CHECK(sheets.pdf().starts_with("%PDF"));
    REQUIRE(y > 0);
    return y;
  };
  const render::Image low(400, 100), middle(400, 200), high(400, 400);
  const double quarter = below({middle}) - below({low});
  CHECK(quarter > 100);
  CHECK(below({high}) - below({middle}) == Approx(2 * quarter));
  // two next to each other are half as large, less half of the gap
  CHECK(below({middle, middle}) - below({low, low}) == Approx(0.5 * quarter).epsilon(0.05));
}

TEST_CASE("an assembly sheet says what is cut, where ends are fixed and how to assemble") {
  exports::FabricationPlan work;
  work.title = "A dome";
  work.spacing_mm = 1000;
  exports::CutRod rod;
  rod.name = "u+0";
  rod.section.diameter_mm = 47.8731;
  rod.length_mm = 4000;
  rod.joint_marks_mm = {1000, 2000, 3000};
  rod.begin = {-2000, 0}, rod.end = {2000, 0};
  rod.leg_begin_mm = rod.leg_end_mm = 1000;
  work.rods = {rod};
  work.joints = {{-1000, 0}, {0, 0}, {1000, 0}};
  work.original_boundary.resize(2, 3);
  work.original_boundary << -2000, 2000, 0, 0, 0, 2000;
  work.actuated_boundary = Eigen::Matrix3Xd::Zero(3, 3);
  work.actuated_boundary.topRows<2>() = work.original_boundary;
  work.pins = {{"u+0 begin", {-1900, 0, 0}}, {"u+0 end", {1900, 0, 0}}};
  const auto text = [&] {
    std::string all;
    const test::CanvasObserver observer([&](const render::Canvas& canvas) {
      if (canvas.width() < 100) return;
      for (const std::string& words : canvas.texts()) all += words + " ";
    });
    CHECK(render::assembly_sheet_pdf(work).starts_with("%PDF"));
    return all;
  };
  CHECK_THAT(text(), Catch::Contains("rods of 47.8731 mm diameter") &&
                         Catch::Contains("Drill the 2 holes"));
  // laths, at different heights, bolted and braced
  work.rods[0].section = {0, 60, 30};
  work.pins[1].at.z() = 700;
  work.hand = {"Tighten the bolts of all 3 joints.", "Brace all 4 cells."};
  const std::string timber = text();
  CHECK_THAT(timber, Catch::Contains("laths of 60 x 30 mm") && !Catch::Contains("47.8731"));
  CHECK_THAT(timber, Catch::Contains("700 mm") && !Catch::Contains("Drill"));
  CHECK_THAT(timber, Catch::Contains("Tighten the bolts of all 3 joints.") &&
                         Catch::Contains("Brace all 4 cells."));
  CHECK_THAT(timber, !Catch::Contains("Print the footprint at full size"));
}

TEST_CASE("names of many equal rods are broken into lines, at their usual size") {
  exports::FabricationPlan work;
  work.title = "A square";
  exports::CutRod rod;
  rod.length_mm = 260;
  for (int k = 0; k < 600; ++k) {
    rod.name = "u" + std::to_string(k);
    work.rods.push_back(rod);
  }
  double least = 100;
  std::size_t sheets = 0;
  const test::CanvasObserver observer([&](const render::Canvas& canvas) {
    if (canvas.width() < 100) return;
    ++sheets;
    for (std::size_t k = 0; k < canvas.texts().size(); ++k)
      if (canvas.texts()[k].starts_with("u"))
        least = std::min(least, canvas.text_boxes()[k].height);
    for (const render::Box& box : canvas.text_boxes()) CHECK(box.bottom() < canvas.height());
  });
  CHECK(render::cut_list_pdf(work).starts_with("%PDF"));
  CHECK(least > 5);
  CHECK(sheets > 1);
}

TEST_CASE("an assembly sheet continues on further pages") {
  exports::FabricationPlan work;
  work.title = "Short legs";
  work.spacing_mm = 20;
  exports::CutRod rod;
  rod.length_mm = 260;
  rod.begin = {-130, 0}, rod.end = {130, 0};
  rod.leg_begin_mm = rod.leg_end_mm = 1;
  for (int k = 0; k < 600; ++k) {
    rod.name = "u" + std::to_string(k);
    work.rods.push_back(rod);
  }
  work.original_boundary.resize(2, 3);
  work.original_boundary << -130, 130, 0, -130, -130, 130;
  work.actuated_boundary = Eigen::Matrix3Xd::Zero(3, 3);
  work.actuated_boundary.topRows<2>() = work.original_boundary;
  std::string all;
  int pages = 0;
  const test::CanvasObserver observer([&](const render::Canvas& canvas) {
    if (canvas.width() < 100) return;
    ++pages;
    for (const std::string& text : canvas.texts()) all += text + " ";
    for (const render::Box& box : canvas.text_boxes()) CHECK(box.bottom() < canvas.height() - 30);
  });
  CHECK(render::assembly_sheet_pdf(work).starts_with("%PDF"));
  CHECK(pages > 1);
  CHECK_THAT(all, Catch::Contains("u599 (1.0 mm). Leave these joints untied"));
}
