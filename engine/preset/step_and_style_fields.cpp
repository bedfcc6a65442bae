#include <fmt/format.h>
#include <map>

#include "engine/preset/field_groups.h"

namespace gridshell::preset {

std::vector<Field> step_fields() {
  using P = Preset;
  return {
      {"step", "do", "", word<&P::step, &Step::kind>(),
       "\"move\" the boundary; \"push\" a joint, which is held from then on; \"hold\" one where it "
       "is; \"release\" one; \"load\": more or less of what [loads] says; \"rest\": down the "
       "energy; \"jitter\": random forces on all joints come on and go away again"},
      {"step", "progress", "", real<&P::step, &Step::progress>(between(0, 10)),
       "of a move: 0 the original boundary, 1 the actuated one, beyond it further on"},
      {"step", "radius_mm", "mm", real<&P::step, &Step::radius_mm>(at_least(0)),
       "of a move of a circle, in the place of `progress`; 0: not given"},
      {"step", "edge_points", "",
       points<&P::step, &Step::edge_points>({"edge_point", "x_mm", "y_mm", "z_mm"}),
       "of a move: by how much edge points, counted from 0, lie off the boundary's motion; others "
       "lie on it"},
      {"step", "joint", "", integers<&P::step, &Step::joint>(between(-500, 500)),
       "[i, j] of the joint; of a release that names none: all that are held"},
      {"step", "to_mm", "mm", list<&P::step, &Step::to_mm>({}),
       "[x, y, z] to which a push brings the joint; empty: `depth_mm` says how far"},
      {"step", "depth_mm", "mm", real<&P::step, &Step::depth_mm>({}),
       "by how much a push moves the joint against the shell's normal, inward, from where it is; "
       "below 0 outward"},
      {"step", "along", "", list<&P::step, &Step::along>({}),
       "[x, y, z] of the direction in which a joint is held that may move across it; empty: the "
       "way of the push, of a hold all directions"},
      {"step", "lateral", "", word<&P::step, &Step::lateral>(),
       "whether the joint pushed may move across the push"},
      {"step", "factor", "", real<&P::step, &Step::factor>(between(-1000, 1000)),
       "how many times what [loads] says counts from then on; 0: not at all"},
      {"step", "side", "", word<&P::step, &Step::side>(),
       "of a rest from a state that is not stable: where the energy ends lower, or along or "
       "against its soft mode"},
      {"step", "seed", "", integer<&P::step, &Step::seed>(between(0, 1 << 30)),
       "of a jitter: another one shakes otherwise"},
      {"step", "force_N", "N", real<&P::step, &Step::force_N>(above(0)),
       "of a jitter: largest force on a joint along each axis"},
  };
}

std::vector<StepKind> step_kinds_of_key(const std::string& key) {
  static const std::map<std::string, std::vector<StepKind>> deeds{
      {"progress", {StepKind::move}},
      {"radius_mm", {StepKind::move}},
      {"edge_points", {StepKind::move}},
      {"joint", {StepKind::push, StepKind::hold, StepKind::release}},
      {"to_mm", {StepKind::push}},
      {"depth_mm", {StepKind::push}},
      {"along", {StepKind::push, StepKind::hold}},
      {"lateral", {StepKind::push}},
      {"factor", {StepKind::load}},
      {"side", {StepKind::rest}},
      {"seed", {StepKind::jitter}},
      {"force_N", {StepKind::jitter}},
  };
  const auto found = deeds.find(key);
  return found == deeds.end() ? std::vector<StepKind>{} : found->second;
}

namespace {

void check_step(const Preset& preset, int item, std::vector<Conflict>& found) {
  const Step& step = preset.step[std::size_t(item)];
  const auto wrong = [&](const char* key, std::string what) {
    found.push_back({"step", key, {}, std::move(what), item});
  };
  const bool names_joint = step.kind == StepKind::push || step.kind == StepKind::hold;
  if (step.joint.size() != 2 && (names_joint || !step.joint.empty()))
    wrong("joint", names_joint ? "must be [i, j]" : "must be [i, j], or empty for all");
  for (const auto& [key, list] : {std::pair("to_mm", &step.to_mm), {"along", &step.along}})
    if (!list->empty() && list->size() != 3)
      wrong(key, fmt::format("a list of {}, must be [x, y, z] or empty", list->size()));
  if (step.along.size() == 3 && step.along == std::vector<double>{0, 0, 0})
    wrong("along", "is no direction, must have a length");
  if (step.kind == StepKind::push && step.to_mm.empty() == (step.depth_mm == 0))
    wrong("depth_mm", "a push goes to `to_mm` or by `depth_mm`, must be one of the two");
  if (step.kind == StepKind::push && step.lateral == Lateral::held && !step.along.empty())
    wrong("along",
          "a joint that is held across the push has no direction of its own, must be "
          "empty, or lateral = \"free\"");
  if (step.radius_mm > 0 && preset.footprint.kind != FootprintKind::circle)
    wrong("radius_mm", "only a circle's boundary has a radius, must be 0: `progress` serves all");
  if (step.radius_mm > preset.original_radius_mm())
    wrong("radius_mm", fmt::format("larger than the footprint, must be at most R_o = {}",
                                   preset.original_radius_mm()));
  for (const auto& row : step.edge_points)
    if (row[0] < 0 || row[0] != double(int(row[0])))
      wrong("edge_points", "names an edge point that is no whole number from 0 on");
}

}  // namespace

std::vector<Conflict> step_conflicts(const Preset& preset) {
  std::vector<Conflict> found;
  if (preset.step.empty()) return found;
  for (int k = 0; k < int(preset.step.size()); ++k) check_step(preset, k, found);
  const auto alone = [&](std::vector<std::string> others, const char* what) {
    others.push_back("[[step]] 1 ");
    found.push_back({"step", "do", std::move(others), what, 0});
  };
  if (preset.indentation.wanted())
    alone({"[indentation] depth", "[indentation] depth_mm"},
          "[indentation] pushes already, must be a step \"push\" in its place");
  if (preset.jitter.wanted())
    alone({"[jitter] trials", "[jitter] confined"},
          "states are looked for of a shell that no hand touches, must be without [[step]], or "
          "[jitter] trials and confined 0");
  if (preset.accuracy.model == RodModel::net)
    alone({"[accuracy] model"},
          "the rung \"net\" is geometry alone, must be another [accuracy] model");
  return found;
}

std::vector<Field> jitter_fields() {
  using P = Preset;
  constexpr int most_trials = 1000000;
  return {
      {"jitter", "mode", "", word<&P::jitter, &SearchSettings::mode>(),
       "\"gravity\": a partly actuated shell is put into a field of random direction and size, the "
       "field is taken away and the actuation finished; \"random\": every joint is thrown by a "
       "random vector; \"poke\": random joints are pushed and let go"},
      {"jitter", "trials", "",
       integer<&P::jitter, &SearchSettings::trials>(between(0, most_trials)),
       "times that the shell is shaken; above 0 the run looks for states and makes no movie"},
      {"jitter", "seed", "", integer<&P::jitter, &SearchSettings::seed>(between(0, 1 << 30)),
       "another seed shakes otherwise; the same finds the same"},
      {"jitter", "levels", "", list<&P::jitter, &SearchSettings::levels>({0, 1, true}),
       "progress of the actuation at which the shell is shaken, taken in turn; empty: from 0.02 to "
       "0.5 for \"gravity\", at the end for the others"},
      {"jitter", "field_N_per_mm", "N/mm",
       real<&P::jitter, &SearchSettings::field_N_per_mm>(above(0)),
       "largest force of the field on a millimetre of rod"},
      {"jitter", "amplitude", "", real<&P::jitter, &SearchSettings::amplitude>({0, 10, true}),
       "how far a random field throws a joint at most along each axis, of d"},
      {"jitter", "depth", "", real<&P::jitter, &SearchSettings::depth>({0, 50, true}),
       "how far a joint is pushed at most, of d"},
      {"jitter", "confined", "",
       integer<&P::jitter, &SearchSettings::confined>(between(0, most_trials)),
       "trials more that begin in forms confined to each group of symmetries in turn, then "
       "released; counted apart"},
      {"jitter", "tolerance", "", real<&P::jitter, &SearchSettings::tolerance>({0, 1, true}),
       "states whose joints lie nearer to one another are one, of d"},
      {"jitter", "drawn", "", integer<&P::jitter, &SearchSettings::drawn>(between(1, 24)),
       "states in the picture"},
      {"jitter", "transitions", "",
       integer<&P::jitter, &SearchSettings::transitions>(between(0, 1000)),
       "states, from the lowest in energy on, of which is found out where they go when the "
       "boundary is let out and drawn in again and when they are poked"},
      {"jitter", "barriers", "", flag<&P::jitter, &SearchSettings::barriers>(),
       "whether the heights of the barriers between the states in the picture are looked for, on a "
       "mesh of 4 edges"},
  };
}

namespace {

using P = Preset;
using M = Movie;
using S = Style;

std::vector<Field> more_movie_fields() {
  return {
      {"movie", "view", "", word<&P::movie, &M::view>(),
       "a standard view, in the place of azimuth_deg and elevation_deg"},
      {"movie", "target_mm", "mm", list<&P::movie, &M::target_mm>({}),
       "[x, y, z] that stands in the middle of the shell's panel; empty: the middle of all that "
       "moves"},
      {"movie", "orthographic", "", flag<&P::movie, &M::orthographic>(),
       "whether what is far is as large as what is near"},
      {"movie", "bins_range", "rad", list<&P::movie, &M::bins_range>({}),
       "[low, high] of the axis of the plot of bins, so that movies compare; empty: the run's own"},
      {"movie", "views", "", points<&P::movie, &M::views>({"azimuth", "elevation"}),
       "more views in each frame, beside one another, degrees"},
      {"movie", "seconds", "s", real<&P::movie, &M::seconds>(at_least(0)),
       "how long the movie is without hold and title card; 0: frames / fps"},
      {"movie", "hold_s", "s", real<&P::movie, &M::hold_s>(between(0, 60)),
       "how long the last frame stands"},
      {"movie", "title_s", "s", real<&P::movie, &M::title_s>(between(0, 60)),
       "how long a card with title and source stands at the begin; 0: none"},
      {"movie", "pace", "", word<&P::movie, &M::pace>(), "eased: slow at both ends"},
      {"movie", "webm", "", flag<&P::movie, &M::webm>(), "whether movie.webm is made too"},
      {"movie", "gif", "", flag<&P::movie, &M::gif>(), "whether movie.gif is made too"},
      {"movie", "poster", "", flag<&P::movie, &M::poster>(),
       "whether the last frame is kept as poster.png"},
  };
}

std::vector<Field> look_fields() {
  return {
      {"style", "theme", "", word<&P::style, &S::theme>(),
       "screen: coloured cells, floor and shadow; paper: black rods on white, as in the paper's "
       "figures"},
      {"style", "rod_width_mm", "mm", real<&P::style, &S::rod_width_mm>(at_least(0)),
       "width of rods as drawn, no less than a pixel; 0: the theme's"},
      {"style", "joint_width_mm", "mm", real<&P::style, &S::joint_width_mm>(at_least(0)),
       "of joints; 0: the theme's"},
      {"style", "ring_width_mm", "mm", real<&P::style, &S::ring_width_mm>(at_least(0)),
       "of the boundary; 0: the theme's"},
      {"style", "rod_colour", "", colour<&P::style, &S::rod_colour>(),
       "of rods; empty: the theme's"},
      {"style", "joint_colour", "", colour<&P::style, &S::joint_colour>(), "of joints"},
      {"style", "ring_colour", "", colour<&P::style, &S::ring_colour>(), "of the boundary"},
      {"style", "background", "", colour<&P::style, &S::background>(),
       "behind the shell; \"transparent\" leaves it out of the PNG"},
      {"style", "colour_map", "", word<&P::style, &S::colour_map>(),
       "auto: sequential where the values have one sign, else diverging about zero"},
      {"style", "range", "", list<&P::style, &S::range>({}),
       "[low, high] of the colours, in the unit of the colour bar; empty: of all cases together"},
      {"style", "cells", "", word<&P::style, &S::cells>(), "whether cells are shown"},
      {"style", "joints", "", word<&P::style, &S::joints>(), "whether joints are shown"},
      {"style", "rings", "", word<&P::style, &S::rings>(), "whether the boundary is shown"},
      {"style", "floor", "", word<&P::style, &S::floor>(), "whether there is a floor"},
      {"style", "shadow", "", word<&P::style, &S::shadow>(), "whether shadows are cast"},
      {"style", "far_fade", "", real<&P::style, &S::far_fade>(between(0, 1)),
       "by how much the far side pales into the background"},
      {"style", "letters", "", flag<&P::style, &S::letters>(),
       "whether the panels of a figure bear letters"},
      {"style", "font", "", text<&P::style, &S::font>(),
       "family of all text, in all cases; empty: DejaVu Sans, which has every sign"},
      {"style", "font_size", "", real<&P::style, &S::font_size>(between(0.5, 2)),
       "of all text, over its usual size"},
  };
}

std::vector<Field> print_fields() {
  return {
      {"figure", "quality", "", word<&P::figure, &Figure::quality>(),
       "of stills, as [movie] quality"},
      {"figure", "width_mm", "mm", real<&P::figure, &Figure::width_mm>(at_least(0)),
       "width of a whole figure as printed; 0: as many pixels as [movie] size says"},
      {"figure", "dpi", "1/inch", real<&P::figure, &Figure::dpi>(between(30, 2400)),
       "pixels of an inch, where a width is given"},
      {"figure", "vector", "", flag<&P::figure, &Figure::vector>(),
       "whether stills are also drawn as lines, as SVG and PDF, hidden ones faded"},
      {"page", "kind", "", word<&P::page, &Page::kind>(),
       "figure of the paper that `figure` lays out on one page"},
      {"page", "photo", "", text<&P::page, &Page::photo>(),
       "a PNG in the photograph's place; empty: an empty frame"},
      {"page", "sweep", "", text<&P::page, &Page::sweep>(),
       "folder of a finished sweep over legs and rods in the phase diagram's place; empty: an "
       "empty "
       "frame"},
  };
}

}  // namespace

std::vector<Field> style_fields() {
  auto fields = more_movie_fields();
  for (const auto& more : {look_fields(), print_fields()})
    fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

}  // namespace gridshell::preset
