// Contents of a journal page: panels at their positions, and the data that they draw.
#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/pictures.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "render/canvas/panels.h"
#include "render/canvas/plot.h"
#include "render/gl/renderer.h"
#include "render/movie/movie_style.h"
#include "render/movie/page.h"

namespace gridshell::app {

inline constexpr double page_font = 7;  // points, of plots and legends on a page

/// A style whose pictures have as many pixels as a box of this size has at `dpi`.
inline render::MovieStyle at_size(render::MovieStyle style, double width_mm, double height_mm,
                                  double dpi) {
  style.size[0] = std::max(16, int(width_mm * dpi / 25.4));
  style.size[1] = std::max(16, int(style.width() * height_mm / width_mm));
  return style;
}

/// The panels of a page. Each owns the pictures and plots that it draws, but runs that they point
/// to must outlive the page.
struct Page {
  double width_mm = 178, height_mm = 100;
  std::vector<render::PagePanel> panels = {};

  void add(const std::string& letter, const std::string& caption, const render::Box& box_mm,
           std::function<void(render::Canvas&, const render::Box&)> draw) {
    panels.push_back({letter, caption, box_mm, std::move(draw)});
  }
  /// Adds a frame with a text about what is missing.
  void add_empty(const std::string& letter, const render::Box& box_mm, const std::string& text) {
    add(letter, "", box_mm, [text](render::Canvas& canvas, const render::Box& box) {
      render::draw_empty_frame(canvas, box, text);
    });
  }
  /// Adds a line of text, aligned left.
  void add_note(const render::Box& box_mm, const std::string& text) {
    add("", "", box_mm, [text](render::Canvas& canvas, const render::Box& box) {
      canvas.text(text, {box.x, box.middle().y},
                  {.size = page_font, .align_y = render::AlignY::middle});
    });
  }
  /// Adds the common legend of several plots.
  void add_legend(const render::Box& box_mm, render::Plot plot) {
    plot.font_size = page_font;
    add("", "", box_mm, [plot = std::move(plot)](render::Canvas& canvas, const render::Box& box) {
      render::draw_legend(canvas, box, plot);
    });
  }
  void add_keys(const render::Box& box_mm, std::vector<render::ColourKey> keys) {
    add("", "", box_mm, [keys = std::move(keys)](render::Canvas& canvas, const render::Box& box) {
      render::draw_colour_keys(canvas, box, keys, page_font);
    });
  }
  /// Adds a scale bar; `units`: points on the page per millimetre of the shell.
  void add_scale_bar(const render::Box& box_mm, double length_mm, double units) {
    add("", "", box_mm, [=](render::Canvas& canvas, const render::Box& box) {
      render::draw_scale_bar(canvas, box, length_mm, units, page_font);
    });
  }
  void add_image(const std::string& letter, const std::string& caption, const render::Box& box_mm,
                 render::Image image) {
    add(letter, caption, box_mm,
        [image = std::move(image)](render::Canvas& canvas, const render::Box& box) {
          render::draw_fitted(canvas, box, image);
        });
  }
  /// Adds a picture, which the lines of the panel replace in vector graphics if it has any.
  void add_panel(const std::string& caption, const render::Box& box_mm, render::Panel panel) {
    const double aspect = double(panel.picture.width) / panel.picture.height;
    add_image(panel.letter, caption, box_mm, std::move(panel.picture));
    if (panel.lines)
      panels.back().draw_lines = [lines = std::move(panel.lines), aspect](render::Canvas& canvas,
                                                                          const render::Box& box) {
        lines(canvas, render::fitted(box, aspect));
      };
  }
  void add_figure(const std::string& letter, const render::Box& box_mm,
                  render::PanelFigure figure) {
    const bool has_lines = !figure.panels.empty() && figure.panels.front().lines;
    const auto shared = std::make_shared<const render::PanelFigure>(std::move(figure));
    const auto with = [&](bool lines) {
      return [shared, lines](render::Canvas& canvas, const render::Box& box) {
        render::draw_panels_on(canvas, box, *shared, lines);
      };
    };
    add(letter, "", box_mm, with(false));
    if (has_lines) panels.back().draw_lines = with(true);
  }
  /// Adds the colour bar of pictures and lines.
  void add_colour_bar(const render::Box& box_mm, const render::ColourBar& bar) {
    add("", "", box_mm, [bar](render::Canvas& canvas, const render::Box& box) {
      render::draw_colour_bar(canvas, box, bar, page_font);
    });
  }
  void add_plot(const std::string& letter, const render::Box& box_mm, render::Plot plot) {
    plot.font_size = page_font;
    add(letter, "", box_mm,
        [plot = std::move(plot)](render::Canvas& canvas, const render::Box& box) {
          render::draw_plot(canvas, box, plot);
        });
  }
};

// Fig. 2 of [Baek 2018] on one page: states of one footprint, the phase diagram, and a state of
// each class from above.

/// Panels A: the states ii, iii and iv of the first record, and a dome (state i), which the paper
/// shows within B. B: the phase diagram of the sweep that the preset names, or an empty frame. C: a
/// state of each class, or an empty frame. A state is the one of lowest energy of its class in the
/// first record that has any. Errors: bad_input if the sweep cannot be read; those of the renderer;
/// cancelled.
Result<Page> states_page(const Runs& records, const render::MovieStyle& style,
                         render::Renderer& renderer, Watch& watch);

// The figures of the paper, each on one page.

/// The letter of panel k >= 0: A to Z, then AA, AB ...
inline std::string panel_letter(int k) {
  return (k < 26 ? "" : panel_letter(k / 26 - 1)) + char('A' + k % 26);
}

/// Checks that the cases of a preset are what its [page] kind shows. Errors (bad_input): they are
/// not.
Result<void> check_page(const std::vector<const preset::Preset*>& cases);
inline Result<void> check_page(const std::vector<preset::Case>& cases) {
  std::vector<const preset::Preset*> presets;
  for (const preset::Case& one : cases) presets.push_back(&one.preset);
  return check_page(presets);
}

/// Writes `<stem>_page.png`, `.svg` and `.pdf` of the preset's [page] kind, from its finished
/// cases; none if the kind is "none". Errors: io, cancelled, bad_input for a photograph that cannot
/// be read, and those of check_page().
Result<void> draw_page(const Runs& records, render::Renderer& renderer,
                       const std::filesystem::path& stem, Watch& watch);

}  // namespace gridshell::app
