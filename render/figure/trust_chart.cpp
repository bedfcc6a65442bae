#include "render/figure/trust_chart.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/plot/legend.h"
#include "render/plot/text.h"

namespace gridshell::render {
namespace {

using record::TrustClass;
using record::TrustRow;

constexpr double size = 7.5, bar_height = 13, row_height = 18, label_room = 88, title_room = 22,
                 legend_line = 14, width = 504, margin = 6;

std::string label(TrustClass found) { return spaced(std::string(word_of(found))); }

std::vector<std::string> kinds_of(const std::vector<TrustRow>& rows) {
  std::vector<std::string> kinds;
  for (const TrustRow& row : rows)
    if (std::find(kinds.begin(), kinds.end(), row.kind) == kinds.end()) kinds.push_back(row.kind);
  return kinds;
}

int count(const std::vector<TrustRow>& rows, const std::string& kind, TrustClass found) {
  return int(std::count_if(rows.begin(), rows.end(), [&](const TrustRow& row) {
    return row.kind == kind && row.found == found;
  }));
}

void draw_bar(Canvas& canvas, const std::vector<TrustRow>& rows, const std::string& kind,
              const Box& box) {
  int all = 0;
  for (const auto& one : words(TrustClass{})) all += count(rows, kind, one.value);
  double x = box.x;
  for (const auto& one : words(TrustClass{})) {
    const int n = count(rows, kind, one.value);
    if (n == 0) continue;
    const double part = box.width * n / all;
    canvas.rectangle({x, box.y, part, box.height}, trust_colour(one.value), {{1, 1, 1, 1}, 0.8});
    if (part > 10)
      canvas.text(fmt::format("{}", n), {x + part / 2, box.y + box.height / 2},
                  {.size = size - 1, .align_x = AlignX::centre, .align_y = AlignY::middle});
    x += part;
  }
}

void draw_legend(Canvas& canvas, Point at) {
  Patches patches{.row_width = width - 2 * margin, .row_height = legend_line, .font_size = size};
  constexpr auto classes = words(TrustClass{});
  patches.draw = [&](std::size_t k, const Box& box) {
    canvas.rectangle(box, trust_colour(classes[k].value));
  };
  for (const auto& one : classes) patches.names.push_back(label(one.value));
  draw_patches(canvas, {at.x, at.y, 16, 9}, patches);
}

}  // namespace

Colour trust_colour(TrustClass found) {
  switch (found) {
    case TrustClass::right:
      return hex_colour(0x8CC7A1);
    case TrustClass::estimate_small:
      return hex_colour(0xE08A8D);
    case TrustClass::other_branch:
      return hex_colour(0xC0262B);
    case TrustClass::after_snap:
      return hex_colour(0xF0E2A8);
    case TrustClass::doubted:
      return hex_colour(0xE9BE7C);
    case TrustClass::limited:
      return hex_colour(0xC9CDD3);
    case TrustClass::limited_only_default:
      return hex_colour(0xA3A9B3);
    case TrustClass::inner_unphysical:
      return hex_colour(0xB0417C);
    case TrustClass::frame_dependent:
      return hex_colour(0x9A6FB0);
    case TrustClass::refused:
      return hex_colour(0xE3E5E8);
    case TrustClass::too_slow:
      break;
  }
  return hex_colour(0xA9C4E6);
}

Result<void> write_trust_bars(const std::filesystem::path& stem,
                              const std::vector<TrustRow>& rows) {
  const auto kinds = kinds_of(rows);
  const double height =
      title_room + row_height * double(kinds.size()) + 3 * legend_line + 3 * margin;
  const auto title =
      fmt::format("{} random scenes beside finer meshes of another family", rows.size());
  return write_figure(stem, width, height, title, [&](Canvas& canvas) {
    canvas.text(
        title, {width / 2, margin},
        {.size = size + 1.5, .bold = true, .align_x = AlignX::centre, .align_y = AlignY::top});
    double y = title_room;
    for (const std::string& kind : kinds) {
      canvas.text(plain(kind), {margin + label_room - 5, y + bar_height / 2},
                  {.size = size, .align_x = AlignX::right, .align_y = AlignY::middle});
      draw_bar(canvas, rows, kind,
               {margin + label_room, y, width - 2 * margin - label_room, bar_height});
      y += row_height;
    }
    draw_legend(canvas, {margin, y + margin});
  });
}

Plot trust_plot(const std::vector<TrustRow>& rows) {
  Plot plot;
  plot.title = "Errors of joints beside what was estimated";
  plot.x = {.label = "error estimate over the length scale", .logarithmic = true};
  plot.y = {.label = "error over the length scale", .logarithmic = true};
  double low = 1, high = 1e-9;
  for (const auto& one : words(TrustClass{})) {
    Series series;
    series.name = label(one.value);
    series.colour = trust_colour(one.value);
    series.line_width = 0;
    series.marker = Marker::circle;
    for (const TrustRow& row : rows) {
      if (row.found != one.value || !(row.error > 0) || !(row.estimate > 0)) continue;
      series.x.push_back(row.estimate);
      series.y.push_back(row.error);
      low = std::min(low, row.estimate);
      high = std::max(high, row.estimate);
    }
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  }
  if (low < high) {
    Series twice;
    twice.name = "twice the estimate";
    twice.x = {low, high};
    twice.y = {2 * low, 2 * high};
    twice.colour = {0.3f, 0.3f, 0.3f, 1};
    twice.dash = {3, 2};
    plot.series.push_back(std::move(twice));
  }
  return plot;
}

}  // namespace gridshell::render
