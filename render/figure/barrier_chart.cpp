#include "render/figure/barrier_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "render/plot/ticks.h"

namespace gridshell::render {
namespace {

constexpr double half_bar = 0.22;  // of the distance between states
constexpr int pieces = 40;

/// Half a cosine wave from one height to the other.
void add_flank(Series& curve, double from_x, double from, double to_x, double to) {
  for (int k = 0; k <= pieces; ++k) {
    const double s = double(k) / pieces;
    curve.x.push_back(from_x + s * (to_x - from_x));
    curve.y.push_back(from + (to - from) * 0.5 * (1 - std::cos(M_PI * s)));
  }
}

}  // namespace

Plot barrier_plot(const record::StateTables& states) {
  Plot plot;
  plot.title = "Barriers between states";
  plot.y = {.label = "energy (mJ)"};
  plot.legend = LegendPlace::none;
  std::map<int, double> energy;  // of the states, on the mesh of the passes
  for (const record::Barrier& one : states.barriers)
    if (one.to != 0 && one.from != one.to) {
      energy[one.from] = one.energy_mJ - one.barrier_mJ;
      energy[one.to] = one.energy_mJ - one.back_mJ;
    }
  std::map<int, double> place;
  for (const auto& [state, level] : energy) place.emplace(state, double(place.size() + 1));
  std::size_t colour = 0;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const record::Barrier& one : states.barriers) {
    if (one.to == 0 || one.from == one.to) continue;
    Series curve;
    curve.colour = series_colour(colour++);
    lowest = std::min({lowest, energy.at(one.from), energy.at(one.to)});
    highest = std::max(highest, one.energy_mJ);
    const double a = place.at(one.from), b = place.at(one.to), middle = 0.5 * (a + b);
    const double from = a + std::copysign(half_bar, b - a), to = b - std::copysign(half_bar, b - a);
    add_flank(curve, from, energy.at(one.from), middle, one.energy_mJ);
    add_flank(curve, middle, one.energy_mJ, to, energy.at(one.to));
    plot.series.push_back(std::move(curve));
    plot.notes.push_back({middle, one.energy_mJ,
                          scientific(std::max(one.barrier_mJ, one.back_mJ), 3), AlignX::centre,
                          AlignY::bottom, plot.series.back().colour});
  }
  for (const auto& [state, level] : energy) {
    Series bar;
    bar.colour = {0.1f, 0.1f, 0.12f, 1};
    bar.line_width = 2.2;
    bar.x = {place.at(state) - half_bar, place.at(state) + half_bar};
    bar.y = {level, level};
    plot.series.push_back(std::move(bar));
    const auto& row = states.rows.at(std::size_t(state) - 1);
    const bool named = row.kind != record::StateClass::other;
    plot.notes.push_back(
        {place.at(state), level,
         fmt::format("state {}{}", state, named ? fmt::format(" (*{}*)", word_of(row.kind)) : ""),
         AlignX::centre, AlignY::top});
  }
  plot.x.label = "place in the order of energy";
  plot.x.low = 0.5;
  plot.x.high = double(place.size()) + 0.5;
  if (lowest <= highest) {
    // room for what stands above passes and below states
    plot.y.low = lowest - 0.16 * (highest - lowest);
    plot.y.high = highest + 0.12 * (highest - lowest);
  }
  return plot;
}

}  // namespace gridshell::render
