#include <algorithm>
#include <cmath>

#include "engine/preset/field_list.h"

namespace gridshell::preset {
namespace {

/// Adds the rules of a range: a list [low, high] with low < high, or empty.
template <class Struct>
void rises(FieldList<Struct>& list, std::vector<double> Struct::*range) {
  list.shape("[low, high]")
      .refused({}, "expected [low, high] with low < high, or empty", [=](const Struct& of) {
        const auto& pair = of.*range;
        return pair.size() == 2 && pair[0] >= pair[1];
      });
}

void add_movie(FieldList<Movie> list) {
  using M = Movie;
  list.add<&M::frames>(between(2, 100000),
                       "frames from the original to the final state; they only sample the path");
  list.add<&M::size>(between(16, 16384), "width and height of a frame").unit("px");
  list.add<&M::fps>(between(1, 240), "frames a second of movie.mp4").unit("1/s");
  list.add<&M::quality>(
      "draft: no shadow; movie: a soft shadow; figure: many passes with jittered light");
  list.add<&M::colour_by>(
          "cells by K, its change or their deviation over rho; rods by "
          "displacement over depth, bending energy over length, axial force, stress, utilisation "
          "or "
          "the angle of their joints")
      .refused({"[footprint] kind"},
               "\"deviation\" is measured from the net of a footprint, expected another value, or "
               "[footprint] kind = \"net\" or \"blocks\"",
               [](const Preset& preset, const M& of) {
                 return of.colour_by == ColourBy::deviation && !preset.on_net();
               })
      .refused({"[indentation] depth", "[indentation] depth_mm"},
               "\"displacement\" is over the depth of a push, expected another value, "
               "[indentation] depth above 0 or a [[step]] that pushes",
               [](const Preset& preset, const M& of) {
                 return of.colour_by == ColourBy::displacement && !preset.indentation.requested() &&
                        std::ranges::none_of(preset.step, [](const Step& step) {
                          return step.kind == StepKind::push;
                        });
               })
      .needs_equilibrium("a net's rods bear no forces",
                         [](const M& of) { return needs_equilibrium(of.colour_by); })
      .refused({"[rod] strength_MPa", "[rod] yield_strain"},
               "\"utilisation\" is of a strength, expected another value, or [rod] strength_MPa or "
               "yield_strain above 0, and of [rod_v] where it differs",
               [](const Preset& preset, const M& of) {
                 return of.colour_by == ColourBy::utilisation && !preset.rods_have_strength();
               });
  const auto free_view = [&list] {
    list.unused({"view"}, "[movie] view replaces it",
                [](const M& of) { return of.view != View::free; });
  };
  list.add<&M::azimuth_deg>(between(-360, 360),
                            "direction of the camera at the first frame, from +x towards +y");
  free_view();
  list.add<&M::elevation_deg>(between(-90, 90), "height of the camera above the boundary's plane");
  free_view();
  list.add<&M::turn_deg>(between(-3600, 3600), "turn of the camera over the whole movie");
  list.add<&M::zoom>({0, 100, true}, "1 fits the whole run into the picture");
  list.add<&M::inset>("whether to draw the small top view");
  list.add<&M::bins>(
      "whether to plot K of the cells in bins along x next to the shell, in wide pictures");
  list.add<&M::captions>("whether to write radius, depth and height");
  list.add<&M::beside>(
      "whether a movie shows the cases of a preset next to each other; else each has its own "
      "movie");
  list.add<&M::view>(
      "a standard view, instead of azimuth_deg and elevation_deg; push: from the side, with the "
      "direction of the push in the plane of the picture");
  list.add<&M::target_mm>(
          "point in the middle of the shell's panel; empty: the middle of all that moves")
      .shape("[x, y, z]");
  list.add<&M::orthographic>("whether the projection is parallel, without perspective");
  list.add<&M::bins_range>(
          "range of the axis of the plot of bins, so that movies can be compared; empty: from the "
          "run")
      .unit("rad")
      .unused({"bins"}, "no bins are drawn: [movie] bins is false",
              [](const M& of) { return !of.bins; });
  rises(list, &M::bins_range);
  list.add<&M::views>("more views in each frame of a movie, next to each other, degrees")
      .points({"azimuth", "elevation"})
      .refused({}, "expected elevations between -90 and 90", [](const M& of) {
        return std::ranges::any_of(of.views, [](const auto& row) { return std::abs(row[1]) > 90; });
      });
  list.add<&M::seconds>(
          between(0, 3600),
          "duration of the movie without title and final still; 0: frames / fps, of few "
          "frames a quarter of a second each, up to 4 s")
      .unit("s");
  list.add<&M::hold_first_s>(between(0, 60), "duration for which the first frame is shown");
  list.add<&M::hold_s>(between(0, 60), "duration for which the last frame is shown");
  list.add<&M::title_s>(between(0, 60),
                        "duration of a card with title and source at the start; 0: none");
  list.add<&M::pace>(
      "eased: slow at both ends; height: frames in equal steps of the square root of the progress, "
      "as a flat grid rises");
  list.add<&M::webm>("whether movie.webm is made too");
  list.add<&M::gif>("whether movie.gif is made too");
  list.add<&M::poster>("whether the last frame is saved as poster.png");
}

void add_style(FieldList<Style> list) {
  using S = Style;
  list.add<&S::theme>(
      "screen: coloured cells, floor and shadow; paper: black rods on white, as in the paper's "
      "figures; dark: as screen, light on a dark background");
  list.add<&S::rod_width_mm>(at_least(0),
                             "width of rods as drawn, no less than a pixel; 0: the theme's");
  list.add<&S::joint_width_mm>(at_least(0), "width of joints; 0: the theme's");
  list.add<&S::ring_width_mm>(at_least(0), "width of the boundary; 0: the theme's");
  list.add<&S::rod_colour>("colour of rods; empty: the theme's").colour();
  list.add<&S::joint_colour>("colour of joints; empty: the theme's").colour();
  list.add<&S::ring_colour>("colour of the boundary; empty: the theme's").colour();
  list.add<&S::background>("colour behind the shell; \"transparent\" leaves it out of the PNG")
      .colour();
  list.add<&S::colour_map>(
      "auto: sequential for quantities without a sign, else diverging about zero; print: "
      "diverging, "
      "and "
      "negative values darker in grey too");
  list.add<&S::range>(
      "range of the colours, in the unit of the colour bar; empty: nine tenths of the values of "
      "all cases, for stress and utilisation all values");
  rises(list, &S::range);
  list.add<&S::cells>("whether cells are shown");
  list.add<&S::joints>("whether joints are shown");
  list.add<&S::rings>("whether the boundary is shown");
  list.add<&S::floor>("whether there is a floor");
  list.add<&S::shadow>("whether shadows are cast");
  list.add<&S::loads>(
      "whether loads are shown as arrows to one scale, each at its joint; a push has its own "
      "arrow");
  list.add<&S::braces>("whether braces are shown");
  list.add<&S::ghost>(
      "whether the first state is drawn in grey behind a shell that is pushed, loaded or has "
      "snapped");
  list.add<&S::far_fade>(between(0, 1), "how far the far side fades into the background");
  list.add<&S::letters>("whether the panels of a figure have letters");
  list.add<&S::font>("font of all text, in all cases; empty: DejaVu Sans, which has every sign");
  list.add<&S::font_size>(between(0.5, 2), "size of all text, over its usual size");
}

/// The error of [figure] radii_mm, which must fall from R_o to R_a; empty: there is none.
std::string radii_error(const Preset& preset) {
  if (preset.figure.radii_mm.empty()) return "";
  if (preset.indentation.requested() || !preset.step.empty())
    return "stills of a push or of steps show its states, expected []";
  if (preset.footprint.kind != FootprintKind::circle)
    return "only a circle's boundary has a radius on all of its path, expected [] for any other "
           "[footprint] kind";
  const double from = preset.original_radius_mm(), to = preset.actuated_radius_mm();
  double last = from;
  for (const double radius : preset.figure.radii_mm) {
    if (radius > last || radius < to * (1 - 1e-9))
      return fmt::format(
          "{} is not on the path, expected values that fall from at most R_o = {} to at least R_a "
          "= {}",
          radius, from, to);
    last = radius;
  }
  return "";
}

/// The error of a [figure] width_mm that has too many pixels; empty: there is none.
std::string width_error(const Preset& preset) {
  constexpr double most_pixels = 32767;  // of a side of a picture
  const double pixels = preset.figure.width_mm / 25.4 * preset.figure.dpi;
  if (pixels <= most_pixels) return "";
  return fmt::format("{} at {} dpi are {:.0f} pixels, expected at most {:.0f}",
                     preset.figure.width_mm, preset.figure.dpi, pixels, most_pixels);
}

void add_figure(FieldList<Figure> list) {
  list.add<&Figure::radii_mm>(
          above(0),
          "boundary radii of the stills, falling from R_o to R_a; empty: the final state alone")
      .refused({"[footprint] kind", "[footprint] radius_mm", "[footprint] longest_leg",
                "[actuation] radius_mm", "[actuation] ratio", "[indentation] depth",
                "[indentation] depth_mm"},
               radii_error);
  list.add<&Figure::scale_bar_mm>(at_least(0),
                                  "length of the scale bar; a round length instead if it would be "
                                  "a dot or longer than the shell; 0: none");
  list.add<&Figure::scan>(
          "joints measured by others, mm, in the frame of the net: red over shells on their nets, "
          "and in the latitude plot")
      .points({"x", "y", "z"});
  list.add<&Figure::title>("whether stills, figures and plots have their title above them");
  list.add<&Figure::quality>("quality of stills, as [movie] quality");
  list.add<&Figure::width_mm>(
          at_least(0), "width of a complete figure as printed; 0: the pixels of [movie] size")
      .refused({"[figure] dpi"}, width_error);
  list.add<&Figure::dpi>(between(30, 2400), "pixels per inch, if a width is given").unit("1/inch");
  list.add<&Figure::cut_step_mm>(
      between(0, 10), "lengths and marks of exported cut lists are multiples of it; 0: all digits");
  list.add<&Figure::stock_mm>(
      at_least(0),
      "length in which rods are sold: cut lists splice longer ones, in the middle between joints; "
      "0: rods of any length");
  list.add<&Figure::vector>(
      "whether stills are also drawn as lines, as SVG and PDF, hidden lines faded");
}

void add_page(FieldList<Page> list) {
  list.unused({"kind"}, "no page is made: [page] kind is \"none\"",
              [](const Page& of) { return of.kind == PageKind::none; });
  list.add<&Page::kind>(
      "figure of the paper that `figure` lays out on one page; \"literature\": all cases in one "
      "style");
  list.add<&Page::photo>("a PNG of the photograph; empty: the page has none");
  list.add<&Page::drawn>(
      "whether the page is also made with rendered pictures of the shells, NAME_page_drawn");
  list.add<&Page::sweep>(
          "finished sweep over legs and rods for the phase diagram: its folder, its sweep.csv, or "
          "fig2_phase_diagram.csv, which comes with the presets; empty: an empty frame")
      .unused({"kind"}, "[page] kind is not \"fig2\"",
              [](const Page& of) { return of.kind != PageKind::fig2; });
}

}  // namespace

void add_picture_fields(std::vector<Field>& all) {
  add_movie({all, "movie", &Preset::movie});
  add_style({all, "style", &Preset::style});
  add_figure({all, "figure", &Preset::figure});
  add_page({all, "page", &Preset::page});
}

}  // namespace gridshell::preset
