#include "app/state_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/pictures.h"
#include "render/figure/barrier_chart.h"
#include "render/figure/ways_graph.h"
#include "render/movie/stills.h"
#include "render/plot/plot.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

using record::StateClass;
using record::StateRow;

constexpr double plot_height = 62.0 / 88;  // of a plot, over its width

std::string class_text(StateClass kind) {
  return kind == StateClass::other ? "other" : "state *" + std::string(word_of(kind)) + "*";
}

std::string caption_of(const StateRow& row, const record::StateSearch& search) {
  return fmt::format("{}, {}: {:.2f} mJ, met {} in {}", class_text(row.kind), group_text(row.group),
                     row.energy_mJ(), row.count, search.at_rest);
}

/// "153 states in 900 trials; about 214 in all (186 to 262)"
std::string completeness_text(const record::StateTables& states) {
  const record::Completeness& all = states.search.completeness;
  return fmt::format("{} states in {} trials; Chao1: {:.0f} in all (95 %: {:.0f} to {:.0f})",
                     all.seen, states.search.at_rest, all.chao1, all.low, all.high);
}

/// One series a class, in the order of the paper.
template <class Value>
std::vector<render::Series> by_class(const std::vector<StateRow>& rows, const Value& value) {
  constexpr render::Marker markers[] = {render::Marker::square, render::Marker::triangle,
                                        render::Marker::diamond, render::Marker::square,
                                        render::Marker::circle};
  std::vector<render::Series> all;
  for (const auto& [kind, word] : words(StateClass{})) {
    render::Series series;
    series.name = class_text(kind);
    series.colour = render::series_colour(std::size_t(kind));
    series.marker = markers[std::size_t(kind)];
    series.line_width = 0;
    series.hollow = kind == StateClass::other;
    for (const StateRow& row : rows) {
      if (row.kind != kind) continue;
      series.x.push_back(row.energy_mJ());
      series.y.push_back(value(row));
    }
    if (!series.x.empty()) all.push_back(std::move(series));
  }
  // the many others lie below the paper's few
  std::ranges::reverse(all);
  return all;
}

render::Plot energies_plot(const record::StateTables& states) {
  render::Plot plot;
  plot.title = completeness_text(states);
  plot.x = {.label = "energy (mJ)"};
  plot.y = {.label = "times met", .logarithmic = true, .low = 0.5};
  std::vector<StateRow> met;
  std::ranges::copy_if(states.rows, std::back_inserter(met),
                       [](const StateRow& row) { return row.count > 0; });
  plot.series = by_class(met, [](const StateRow& row) { return double(row.count); });
  return plot;
}

render::Plot lives_plot(const record::StateTables& states) {
  render::Plot plot;
  plot.title = "How far back along the path the states live";
  plot.x = {.label = "energy at the end (mJ)"};
  const bool circle = std::ranges::none_of(
      states.rows, [](const StateRow& row) { return std::isnan(row.lives_to_radius_mm); });
  plot.y = {.label = circle ? "largest *R*_{a} (mm)" : "least progress"};
  plot.legend = render::LegendPlace::above;
  plot.series = by_class(states.rows, [&](const StateRow& row) {
    return circle ? row.lives_to_radius_mm : row.lives_to;
  });
  return plot;
}

}  // namespace

std::string group_text(const std::string& group) {
  const std::string name = group.substr(0, group.find('_'));
  if (name.size() < 2 || name == "flat") return name;
  return fmt::format("*{}*_{{{}}}", name.substr(0, 1), name.substr(1));
}

record::Trajectory states_alone(const record::Trajectory& run,
                                const std::vector<std::size_t>& which) {
  record::Trajectory few;
  few.layout = run.layout;
  few.layout.original_boundary = run.layout.actuated_boundary;
  for (const std::size_t k : which) few.frames.push_back(run.frames[k]);
  return few;
}

std::string found_text(const record::StateTables& states) {
  const record::StateSearch& search = states.search;
  const record::Completeness& all = search.completeness;
  std::string text = fmt::format(
      "  {} of {} trials came to rest, in {} states ({} once, {} twice); Chao1: {:.0f} in all, 95 "
      "%: "
      "{:.0f} to {:.0f}\n",
      search.at_rest, search.trials, all.seen, all.once, all.twice, all.chao1, all.low, all.high);
  if (search.confined_trials > 0)
    text += fmt::format("  {} of {} begun in symmetric forms; {} states in all\n",
                        search.confined_at_rest, search.confined_trials, states.rows.size());
  if (search.finer_lost + search.finer_merged > 0)
    text += fmt::format("  of {} on {} edges a segment, finer meshes lose {} and merge {}\n",
                        search.found, search.judged_edges, search.finer_lost, search.finer_merged);
  for (const auto& [why, count] : search.ended_otherwise)
    text += fmt::format("  {} trials: {}\n", count, why);
  for (const std::size_t k : record::states_to_draw(states.rows, 4)) {
    const StateRow& row = states.rows[k];
    text += fmt::format(
        "  state {}: {}, class {}, {:.3f} mJ of bending, height {:.2f} mm, met {}\n", row.state,
        row.group, word_of(row.kind), row.energies[Term::bend], row.height_mm, row.count);
  }
  if (search.ways_followed > 0)
    text += fmt::format("  barriers: {} passes found on {} ways\n", search.passes_found,
                        search.ways_followed);
  for (const record::Barrier& one : states.barriers)
    if (one.to != 0)
      text +=
          fmt::format("  from state {} to {}: {:.4g} mJ, back {:.4g} mJ (on {} edges a segment)\n",
                      one.from, one.to, one.barrier_mJ, one.back_mJ, search.judged_edges);
  return text;
}

Result<void> draw_states(const CaseRecord& one, render::Renderer& renderer, const fs::path& stem,
                         Watch& watch) {
  const auto style = style_of(one.preset, Pictures::stills);
  const record::StateTables& states = one.states;
  const auto which = record::states_to_draw(states.rows, one.preset.jitter.drawn);
  std::vector<std::string> captions;
  for (const std::size_t k : which) captions.push_back(caption_of(states.rows[k], states.search));
  const auto plot_at = [&](const char* suffix, const render::Plot& plot) {
    render::Plot titled = plot;
    titled.title = render::plain(style.title) + (plot.title.empty() ? "" : "\n") + plot.title;
    return render::write_plot(fs::path(stem) += suffix, titled, style.print, plot_height);
  };
  return render::write_stills(states_alone(one.run, which), style, {}, renderer, stem, watch,
                              captions)
      .map([](const auto&) {})
      .and_then([&] { return plot_at("_energies", energies_plot(states)); })
      .and_then([&] { return plot_at("_lives", lives_plot(states)); })
      .and_then([&]() -> Result<void> {
        if (states.transitions.empty()) return {};
        return render::write_ways_graph(fs::path(stem) += "_ways", states, one.run, style.title,
                                        style.print);
      })
      .and_then([&]() -> Result<void> {
        const auto passes = render::barrier_plot(states);
        return passes.series.empty() ? Result<void>{} : plot_at("_barriers", passes);
      });
}

}  // namespace gridshell::app
