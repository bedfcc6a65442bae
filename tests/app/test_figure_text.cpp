// Texts of pictures: their size, contrast and position; every number in them is in a file of the
// run.
#include <cmath>
#include <regex>
#include <set>

#include "app/cli/paper_page.h"
#include "app/cli/produce.h"
#include "render/canvas/colour_map.h"
#include "render/gl/image.h"
#include "render/movie/run_figures.h"
#include "tests/app/bench.h"
#include "tests/number_after.h"
#include "tests/render/canvas/ink.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

constexpr double page_mm = 178;

/// A line of text of an SVG.
struct TextLine {
  std::string text;     ///< with a space instead of superscripts and subscripts
  std::string fill;     ///< "#1a1a1f"
  double size = 0;      ///< of its largest letters, in units of the picture
  double x = 0, y = 0;  ///< where the text starts
  bool raised = false;  ///< whether it has a superscript or a subscript
};

std::string unescaped(std::string text) {
  for (const auto& [code, sign] :
       {std::pair("&lt;", "<"), {"&gt;", ">"}, {"&quot;", "\""}, {"&apos;", "'"}, {"&amp;", "&"}})
    for (std::size_t at = 0; (at = text.find(code, at)) != text.npos; ++at)
      text.replace(at, std::strlen(code), sign);
  return text;
}

std::vector<TextLine> text_lines_of_svg(const std::string& svg) {
  std::vector<TextLine> all;
  for (std::size_t at = svg.find("<text "); at != svg.npos; at = svg.find("<text ", at + 1)) {
    const std::string one = svg.substr(at, svg.find("</text>", at) - at);
    TextLine line;
    const double scale = number_after(one, "scale(");
    line.x = scale * number_after(one, "translate(");
    const std::size_t position = one.find("translate(");
    line.y = scale * number_after(one.substr(one.find(' ', position)), " ");
    const std::size_t fill = one.find("fill=\"");
    line.fill = one.substr(fill + 6, 7);
    std::vector<std::pair<double, std::string>> pieces;
    for (std::size_t k = one.find("<tspan"); k != one.npos; k = one.find("<tspan", k + 1)) {
      const std::size_t begin = one.find('>', k) + 1;
      pieces.emplace_back(number_after(one.substr(k, begin - k), "font-size=\""),
                          unescaped(one.substr(begin, one.find("</tspan>", k) - begin)));
      line.size = std::max(line.size, pieces.back().first);
    }
    for (const auto& [size, text] : pieces) {
      const bool small = size < 0.9 * line.size;
      line.raised = line.raised || small;
      line.text += small ? " " : text;
    }
    line.size *= scale;
    if (!line.text.empty()) all.push_back(std::move(line));
  }
  return all;
}

double width_of_svg(const std::string& svg) { return number_after(svg, " width=\""); }

/// The shared runs of all presets.
std::vector<fs::path> all_runs() {
  std::vector<fs::path> runs;
  for (const auto& entry : fs::directory_iterator(GRIDSHELL_SHARED_RUNS))
    if (entry.is_directory() && entry.path().filename() != "window") runs.push_back(entry.path());
  REQUIRE(runs.size() > 40);
  return runs;
}

std::string page_of(int figure) { return "page_fig" + std::to_string(figure); }

}  // namespace

TEST_CASE("no text of a page is below 6 points at its print width", "[shared]") {
  for (int k = 1; k <= 5; ++k) {
    const std::string svg = text_of(shared_run(page_of(k)) / (page_of(k) + "_page.svg"));
    const std::vector<TextLine> all = text_lines_of_svg(svg);
    REQUIRE(all.size() > 3);
    for (const TextLine& line : all) {
      INFO(page_of(k) << ": " << line.text);
      CHECK(line.size * page_mm / 25.4 * 72 / width_of_svg(svg) >= 5.99);
    }
  }
}

TEST_CASE("all words of all figures have a contrast of 4.5 to 1 with white", "[shared]") {
  std::set<std::string> fills;
  for (const fs::path& run : all_runs())
    for (const fs::path& file : files_under(run, ".svg"))
      for (const TextLine& line : text_lines_of_svg(text_of(file))) fills.insert(line.fill);
  CHECK(fills.size() > 2);
  for (const std::string& fill : fills) {
    INFO(fill);
    REQUIRE(fill.size() == 7);
    CHECK(render::contrast_to_white(
              render::hex_colour(std::strtol(fill.c_str() + 1, nullptr, 16))) >= 4.45);
  }
}

// Numbers.

namespace {

/// A number as it is printed: its value, and half of its last digit.
struct Printed {
  std::string text;
  double value = 0, half = 0;
};

std::vector<Printed> numbers_of(std::string text) {
  for (std::size_t at; (at = text.find("−")) != text.npos;) text.replace(at, 3, "-");
  static const std::regex number(R"((^|[^\w.])([0-9]+(\.[0-9]+)?)(?![\w.]*[A-Za-z_]))");
  std::vector<Printed> found;
  for (std::sregex_iterator k(text.begin(), text.end(), number), end; k != end; ++k) {
    const std::string digits = (*k)[2];
    const int decimals = (*k)[3].matched ? int((*k)[3].length()) - 1 : 0;
    found.push_back({digits, std::stod(digits), 0.5 * std::pow(10, -decimals)});
  }
  return found;
}

/// Absolute values of all numbers in a run's files, except joints.csv and cells.csv, whose numbers
/// are so many that any number would be found.
std::set<double> numbers_in_files(const fs::path& run) {
  std::set<double> all;
  for (const char* kind : {".csv", ".json", ".toml"})
    for (const fs::path& file : files_under(run, kind)) {
      if (file.filename() == "joints.csv" || file.filename() == "cells.csv") continue;
      const std::string text = text_of(file);
      for (const char* at = text.c_str(); *at != 0;) {
        char* end = nullptr;
        const double value = std::isdigit((unsigned char)*at) ? std::strtod(at, &end) : 0;
        if (end == nullptr || end == at) {
          ++at;
          continue;
        }
        all.insert(value);
        at = end;
      }
    }
  return all;
}

/// Numbers that pictures compute from total_K in frames.csv: its change since the first frame in
/// per cent, and how much its first value differs from 2 pi.
std::set<double> changes_of_K(const fs::path& run) {
  std::set<double> all;
  for (const fs::path& file : files_under(run, ".csv")) {
    if (file.filename() != "frames.csv") continue;
    const auto rows = record::csv_cells(text_of(file));
    const auto column = std::ranges::find(rows[0], "total_K") - rows[0].begin();
    const auto total = [&](std::size_t row) {
      return std::strtod(rows[row][std::size_t(column)].c_str(), nullptr);
    };
    if (!(std::abs(total(1)) > 0.1)) continue;
    all.insert(std::abs(2 * M_PI - total(1)));
    for (std::size_t k = 1; k < rows.size(); ++k)
      all.insert(100 * std::abs(total(k) / total(1) - 1));
  }
  return all;
}

/// Largest deviations from the net, of all nodes and of the joints alone, in the unit of the
/// picture, computed from trajectory.h5.
std::set<double> deviations(const fs::path& run) {
  std::set<double> all;
  for (const fs::path& file : files_under(run, ".h5")) {
    const auto trajectory = value_of(record::read_trajectory(file));
    if (trajectory.layout.net_nodes.size() == 0) continue;
    const Eigen::VectorXd deviation =
        render::deviation_unit(trajectory.layout).factor * render::last_deviation(trajectory);
    all.insert(deviation.maxCoeff());
    all.insert(deviation.head(long(trajectory.layout.joints.size())).maxCoeff());
  }
  return all;
}

bool holds(const std::set<double>& all, double value, double half) {
  const double slack = 1e-9 * std::max(1.0, value);
  const auto at = all.lower_bound(value - half - slack);
  return at != all.end() && *at <= value + half + slack;
}

bool is_bare(const TextLine& line) {
  static const std::regex bare("(−|-)?[0-9]+([.][0-9]+)?");
  return !line.raised && std::regex_match(line.text, bare);
}

bool is_round_step(double step) {
  const double leading =
      std::abs(step) / std::pow(10, std::floor(std::log10(std::abs(step)) + 1e-9));
  return std::ranges::any_of(std::array{1.0, 2.0, 2.5, 5.0},
                             [&](double one) { return std::abs(leading - one) < 1e-6; });
}

/// Whether a bare number is the label of a tick: for two other numbers in its row or column,
/// distance and difference of the values are in proportion, or one other is a round step away.
bool is_tick(const TextLine& one, const std::vector<TextLine>& bare) {
  const auto value = [](const TextLine& line) {
    const double size = numbers_of(line.text).front().value;
    return std::isdigit((unsigned char)line.text.front()) ? size : -size;
  };
  for (const bool row : {true, false}) {
    std::vector<double> units;  // lengths in the picture per unit of the axis
    for (const TextLine& other : bare) {
      const bool aligned = row ? std::abs(other.y - one.y) < 0.5 : std::abs(other.x - one.x) < 30;
      const double step = value(other) - value(one);
      if (!aligned || step == 0) continue;
      units.push_back((row ? other.x - one.x : one.y - other.y) / step);
      const bool exactly = std::abs(row ? other.y - one.y : other.x - one.x) < 0.5;
      if (exactly && units.back() > 0 && is_round_step(step)) return true;
    }
    for (std::size_t a = 0; a < units.size(); ++a)
      for (std::size_t b = a + 1; b < units.size(); ++b)
        if (units[a] > 0 && std::abs(units[a] / units[b] - 1) < (row ? 0.2 : 0.05)) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("every number in a figure is in a file of its run, to the digits printed", "[shared]") {
  int looked_up = 0;
  for (const fs::path& run : all_runs()) {
    const std::set<double> files = numbers_in_files(run), changes = changes_of_K(run),
                           off = deviations(run);
    for (const fs::path& file : files_under(run, ".svg")) {
      const std::vector<TextLine> all = text_lines_of_svg(text_of(file));
      std::vector<TextLine> bare;
      std::ranges::copy_if(all, std::back_inserter(bare), is_bare);
      for (const TextLine& line : all) {
        // a power of ten
        if (line.raised && line.text.find("10 ") != std::string::npos) continue;
        for (const Printed& number : numbers_of(line.text)) {
          INFO(file.filename() << ": " << line.text << ": " << number.text);
          const auto [value, half] = std::pair(number.value, number.half);
          // a fraction in a file may be shown in per cent
          const bool found = holds(files, value, half) || holds(files, value / 100, half / 100) ||
                             holds(changes, value, half) || holds(off, value, half);
          CHECK((found || (is_bare(line) && is_tick(line, bare))));
          ++looked_up;
        }
      }
    }
  }
  CHECK(looked_up > 150);
}

TEST_CASE("a number that no file has is not found") {
  const std::set<double> files{0.0291, 39.9876, 12};
  const auto found = [&](const char* text) {
    const Printed one = numbers_of(text).front();
    return holds(files, one.value, one.half) || holds(files, one.value / 100, one.half / 100);
  };
  CHECK(found("39.99 mJ"));
  CHECK(found("at most 2.91 %"));
  CHECK_FALSE(found("39.98 mJ"));
  CHECK_FALSE(found("at most 2.92 %"));
  CHECK(numbers_of("u12 and E4").empty());
}

// Pages.

namespace {

/// Fraction of the pixels on the outline of a box that are darker than paper.
double ink_around(const render::Image& picture, const render::Box& box) {
  int inked = 0, all = 0;
  const auto look = [&](double x, double y) {
    const int px = int(std::lround(x)), py = int(std::lround(y));
    if (px < 0 || py < 0 || px >= picture.width || py >= picture.height) return;
    const std::uint8_t* p = picture.pixel(px, py);
    ++all;
    inked += std::min({p[0], p[1], p[2]}) < 200;
  };
  for (double x = box.x; x <= box.right(); ++x) look(x, box.y), look(x, box.bottom());
  for (double y = box.y; y <= box.bottom(); ++y) look(box.x, y), look(box.right(), y);
  return all == 0 ? 0 : double(inked) / all;
}

}  // namespace

TEST_CASE("on a page texts overlap neither one another nor what is drawn", "[shared]") {
  auto maker = value_of(app::PictureMaker::create("auto", ""));
  for (int k = 1; k <= 5; ++k) {
    const TemporaryFolder folder;
    const fs::path stem = folder / page_of(k);
    // the page at its print size
    const std::vector<preset::Override> print{{"--width", "figure.width_mm", "178"},
                                              {"--dpi", "figure.dpi", "200"}};
    auto records = value_of(app::read_runs(shared_run(page_of(k)), print, false));
    app::Runs runs;
    for (const app::Run& run : records) runs.push_back(&run);
    std::vector<std::string> texts;
    std::vector<render::Box> boxes;
    double width = 1;
    Watch watch;
    {
      const test::CanvasObserver observer([&](const render::Canvas& canvas) {
        test::check_apart(canvas);
        texts = canvas.texts();
        boxes = canvas.text_boxes();
        width = canvas.width();
      });
      REQUIRE(app::draw_page(runs, maker.renderer(), stem, watch));
    }
    REQUIRE(boxes.size() > 3);
    // a push is named by its shell and by its plot
    for (const app::Run& run : records)
      if (k == 4 && run.preset.indentation.requested())
        CHECK(std::ranges::count_if(texts, [&](const std::string& text) {
                return text.starts_with(render::plain(run.preset.title));
              }) >= 2);
    const auto picture = value_of(render::read_png(fs::path(stem) += "_page.png"));
    const double scale = picture.width / width;
    for (std::size_t n = 0; n < boxes.size(); ++n) {
      const render::Box box{scale * boxes[n].x, scale * boxes[n].y, scale * boxes[n].width,
                            scale * boxes[n].height};
      if (box.empty()) continue;
      INFO(page_of(k) << ": " << texts[n]);
      CHECK(ink_around(picture, box.inset(-2)) < 0.06);
    }
  }
}

TEST_CASE("a page's PDF has its words as text and is small", "[shared]") {
  for (int k = 1; k <= 5; ++k) {
    const fs::path pdf = shared_run(page_of(k)) / (page_of(k) + "_page.pdf");
    INFO(pdf);
    CHECK(fs::file_size(pdf) < 5e6);
    CHECK_THAT(text_of(pdf), Contains("/FontFile"));
  }
  if (std::system("pdftotext -v >/dev/null 2>&1") != 0) {
    WARN("no pdftotext on the PATH (Debian's poppler-utils): its text was not read");
    return;
  }
  const std::array<const char*, 5> words{"126.0 mm", "longest leg", "latitude", "hemisphere",
                                         "peanut"};
  for (int k = 1; k <= 5; ++k) {
    const TemporaryFolder folder;
    const fs::path text = folder / "page.txt";
    const fs::path pdf = shared_run(page_of(k)) / (page_of(k) + "_page.pdf");
    REQUIRE(std::system(("pdftotext '" + pdf.string() + "' '" + text.string() + "'").c_str()) == 0);
    CHECK_THAT(text_of(text), Contains(words[std::size_t(k - 1)]));
  }
}
