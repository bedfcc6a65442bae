#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <set>
#include <string_view>

#include "app/cli/figures.h"
#include "app/cli/paper_page.h"
#include "app/cli/pictures.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/canvas/legend.h"
#include "render/canvas/plot.h"
#include "render/movie/run_figures.h"
#include "render/movie/run_summary.h"
#include "render/movie/stage.h"
#include "render/movie/state_charts.h"
#include "render/movie/stills.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

using record::StateClass;
using record::StateRow;

/// A name for a state that is in none of the classes of the paper: a leaning dome; else empty.
std::string dome_text(const StateRow& row) {
  return row.kind == StateClass::other && row.first_order() ? ", leaning dome" : "";
}

/// Why a state is drawn, as states_to_draw() chooses.
std::string reason_of(std::size_t at, const std::vector<StateRow>& rows) {
  if (at == 0) return "lowest of all, ";
  const auto first = std::ranges::find(rows, rows[at].kind, &StateRow::kind);
  const bool lowest = rows[at].kind != StateClass::other && first == rows.begin() + long(at);
  return lowest ? "lowest of its class, " : "";
}

std::string caption_of(std::size_t at, const record::StateTables& states) {
  const StateRow& row = states.rows[at];
  return fmt::format("state *{}* ({}){}, *E* = {:.2f} mJ\n{}found in {} of {} random trials",
                     row.name(), group_text(row.group), dome_text(row), row.energy_mJ(),
                     reason_of(at, states.rows), row.count, states.search.at_rest);
}

/// "153 states in 900 random trials; Chao1 estimates 214 (95 %: 186 to 262)"
std::string completeness_text(const record::StateTables& states) {
  const RichnessEstimate& all = states.search.completeness;
  return fmt::format(
      "{} states in {} random trials; Chao1 estimates {:.0f} (95 %: {:.0f} to {:.0f})", all.seen,
      states.search.at_rest, all.estimate, all.low, all.high);
}

/// A series for each class, with `value` over the elastic energy, and before them their keys.
template <class Value>
std::vector<render::Series> by_class(const std::vector<StateRow>& rows, const Value& value) {
  std::vector<render::Series> keys, all;
  for (const auto& [kind, word] : gridshell::words_of<StateClass>()) {
    const render::ClassLook look = render::look_of(kind);
    render::Series key = render::mark_series(class_text(kind), look.colour, look.marker);
    key.hollow = kind == StateClass::other;
    render::Series series = key;
    series.name.clear();
    for (const StateRow& row : rows)
      if (row.kind == kind) series.add(row.energy_mJ(), value(row));
    if (series.x.empty()) continue;
    keys.push_back(std::move(key));
    all.push_back(std::move(series));
  }
  // the many others are drawn first, below the few of the paper; the legend has the paper's order
  std::ranges::reverse_copy(all, std::back_inserter(keys));
  return keys;
}

render::Plot energies_plot(const record::StateTables& states) {
  render::Plot plot;
  plot.title = completeness_text(states);
  plot.x = {.label = "elastic energy (mJ)"};
  plot.y = {.label = "times found", .logarithmic = true, .low = 0.8};
  std::vector<StateRow> met;
  std::set<StateClass> left_out;
  for (const StateRow& row : states.rows)
    if (row.count > 0)
      met.push_back(row);
    else
      left_out.insert(row.kind);
  // a count of 0 has no position on a logarithmic axis
  if (const std::size_t others = states.rows.size() - met.size(); others > 0) {
    std::vector<std::string_view> words;
    for (const StateClass kind : left_out) words.push_back(word_of(kind));
    plot.title += fmt::format("\n{} more were found from symmetric starts only ({})", others,
                              fmt::join(words, ", "));
  }
  plot.series = by_class(met, [](const StateRow& row) { return double(row.count); });
  for (const StateRow& row : met) plot.y.high = std::max(plot.y.high.value_or(3), 1.5 * row.count);
  return plot;
}

/// `radius_mm`: radius of the boundary at the end of the path, if it is a circle.
render::Plot lives_plot(const record::StateTables& states, double radius_mm) {
  render::Plot plot;
  plot.title = "Range in which the states exist";
  plot.x = {.label = "elastic energy at the end of the path (mJ)"};
  const bool circle = std::ranges::any_of(
      states.rows, [](const StateRow& row) { return std::isfinite(row.lives_to_radius_mm); });
  plot.y = {.label = circle ? "up to *R*_{a} (mm); actuation ←" : "exists from progress"};
  plot.legend = render::LegendPosition::above;
  const auto end_of = [&](const StateRow& row) {
    return circle ? row.lives_to_radius_mm : row.lives_to;
  };
  std::vector<StateRow> known;
  std::ranges::copy_if(states.rows, std::back_inserter(known),
                       [&](const StateRow& row) { return std::isfinite(end_of(row)); });
  if (known.size() < states.rows.size())
    plot.title += fmt::format("\nthat of {} of the {} states is not known",
                              states.rows.size() - known.size(), states.rows.size());
  // a line over each state's range, down to the end of the path
  render::Series ranges{.name = "", .colour = render::grey(0.6), .line_width = 0.8};
  for (const StateRow& row : known) {
    ranges.add(row.energy_mJ(), end_of(row));
    ranges.add(row.energy_mJ(), circle ? radius_mm : 1);
    ranges.part();
  }
  plot.series = by_class(known, end_of);
  plot.series.insert(plot.series.begin(), std::move(ranges));
  return plot;
}

}  // namespace

std::string class_text(StateClass kind) {
  return kind == StateClass::other ? "other" : "state *" + std::string(word_of(kind)) + "*";
}

std::string group_text(const std::string& group) {
  const std::string name = group.substr(0, group.find('_'));
  if (name.size() < 2 || name == "flat") return name;
  return fmt::format("*{}*_{{{}}}", name.substr(0, 1), name.substr(1));
}

std::string found_text(const record::StateTables& states) {
  const record::StateSearch& search = states.search;
  const RichnessEstimate& all = search.completeness;
  std::string text = fmt::format(
      "  {} of {} random trials converged, to {} states ({} once, {} twice); Chao1 estimates that "
      "such trials can find {:.0f} (95 %: {:.0f} to {:.0f})\n",
      search.at_rest, search.trials, all.seen, all.once, all.twice, all.estimate, all.low,
      all.high);
  if (search.confined_trials > 0)
    text += fmt::format(
        "  {} of {} trials from symmetric forms converged, to {} states that no random one found: "
        "{} states in all\n",
        search.confined_at_rest, search.confined_trials,
        std::ranges::count(states.rows, 0, &StateRow::count), states.rows.size());
  if (search.states_that_finer_meshes_lose + search.states_that_finer_meshes_merge > 0)
    text +=
        fmt::format("  of {} on {} edges per segment, finer meshes lose {} and merge {}\n",
                    search.states_found, search.judged_edges_per_segment,
                    search.states_that_finer_meshes_lose, search.states_that_finer_meshes_merge);
  for (const auto& [why, count] : search.ended_otherwise)
    text += fmt::format("  {} trials: {}\n", count, why);
  const auto shown = record::states_to_draw(states.rows, 4);
  if (shown.size() < states.rows.size())
    text += fmt::format(
        "  {} of the {}: the lowest of all and of each class, then those found most often:\n",
        shown.size(), states.rows.size());
  for (const std::size_t k : shown) {
    const StateRow& row = states.rows[k];
    text +=
        fmt::format("  state {}: {}{}, {:.3f} mJ of bending, height {:.2f} mm, found in {} of {}\n",
                    row.name(), row.group, dome_text(row), row.energies[Term::bend], row.height_mm,
                    row.count, search.at_rest);
  }
  if (search.paths_followed_for_barriers > 0)
    text += fmt::format("  barriers: {} saddles found on {} paths from state to state\n",
                        search.passes_found, search.paths_followed_for_barriers);
  for (const record::Barrier& one : states.barriers)
    if (one.to != 0)
      text += fmt::format(
          "  from state {} to {}: {:.4g} mJ, back {:.4g} mJ (on {} edges per segment)\n",
          one.from.text(), one.to.text(), one.barrier_mJ, one.back_mJ,
          search.judged_edges_per_segment);
  return text;
}

Result<void> draw_states(const Run& one, render::Renderer& renderer, const fs::path& stem,
                         Watch& watch) {
  const auto style = style_of(one.preset, Pictures::stills);
  const record::StateTables& states = one.states;
  const auto which = record::states_to_draw(states.rows, one.preset.jitter.drawn);
  std::vector<std::string> captions;
  for (const std::size_t k : which) captions.push_back(caption_of(k, states));
  const auto plot_at = [&](const char* suffix, const render::Plot& plot) {
    render::Plot titled = plot;
    titled.title = render::plain(style.title) + (plot.title.empty() ? "" : "\n") + plot.title;
    return render::write_plot(fs::path(stem) += suffix, titled, style.print);
  };
  render::MovieStyle stills = style;
  const record::Trajectory drawn = render::states_alone(one.trajectory, which, stills);
  if (which.size() < states.rows.size() && !style.title.empty())
    stills.title += fmt::format(" ({} of {} states)", which.size(), states.rows.size());
  TRY_DO(render::write_stills(drawn, stills, {}, renderer, stem, watch, captions));
  TRY_DO(plot_at("_energies", energies_plot(states)));
  TRY_DO(plot_at("_lives", lives_plot(states, one.trajectory.frames.back().boundary_radius_mm)));
  if (!states.transitions.empty())
    TRY_DO(render::write_transition_graph(fs::path(stem) += "_transitions", states, one.trajectory,
                                          style.title, style.print));
  const auto passes = render::barrier_plot(states);
  return passes.series.empty() ? Result<void>{} : plot_at("_barriers", passes);
}

}  // namespace gridshell::app
