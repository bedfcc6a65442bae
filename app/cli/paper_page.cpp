#include "app/cli/paper_page.h"

#include <fmt/format.h>

#include <cmath>

#include "app/cli/console.h"
#include "engine/core/try.h"
#include "render/canvas/legend.h"
#include "render/gl/image.h"
#include "render/movie/run_figures.h"
#include "render/movie/run_plots.h"
#include "render/movie/stage.h"
#include "render/movie/stills.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

using render::Box;
using render::Canvas;

class PageMaker {
 public:
  PageMaker(const Runs& records, render::Renderer& renderer, Watch& watch)
      : records_(records), renderer_(renderer), watch_(watch) {
    style_ = style_of(records.front()->preset, Pictures::stills);
    style_.look.letters = false;
    style_.look.joint_mm *= 0.6;  // rods are thin lines
    style_.scale_bar_mm = 0;
    style_.title.clear();
    // vector graphics, which have no light and shadow
    style_.vector = true;
    if (!records.front()->preset.page.drawn) style_.quality = preset::Quality::draft;
    // the edge of a panel would cut off a floor
    if (records.front()->preset.style.floor == preset::Visibility::automatic)
      style_.look.floor = false;
    for (const Run* one : records) {
      const bool push = one->preset.indentation.requested();
      if (push && push_ == nullptr) push_ = one;
      const preset::Preset& preset = one->preset;
      const std::string name = preset.page.kind == preset::PageKind::fig3
                                   ? fmt::format("*z*^{{*}}/*ρ* = {:g}", preset.net.cut_height)
                                   : render::plain(preset.title);
      (push ? pushes_ : shells_).push_back({&one->trajectory, name, scan_of(preset)});
    }
  }

  Result<Page> make(preset::PageKind kind) {
    switch (kind) {
      case preset::PageKind::none:
        return Page{};
      case preset::PageKind::fig1:
        return fig1();
      case preset::PageKind::fig2:
        return states_page(records_, style_, renderer_, watch_);
      case preset::PageKind::fig3:
        return fig3();
      case preset::PageKind::fig4:
        return fig4();
      case preset::PageKind::fig5:
        return fig5();
      case preset::PageKind::literature:
        return literature();
    }
    return Page{};
  }

 private:
  /// The style of a figure that fills its box: `columns` panels side by side, captions below, and
  /// perhaps a colour bar. Its text then has the size of other text on the page.
  render::MovieStyle filling(const Box& box_mm, int columns, bool colour_bar = false) const {
    constexpr double letter = 3.5, bar = 14, around = 11, between = 1.5;  // mm
    const double width =
        (box_mm.width - letter - (colour_bar ? bar : 0)) / std::max(1, columns) - between;
    render::MovieStyle style = sized(style_, width, box_mm.height - around);
    style.print = {box_mm.width - letter, 0};
    style.scale_bar_mm = records_.front()->preset.figure.scale_bar_mm;
    return style;
  }

  render::MovieStyle sized(render::MovieStyle style, double width_mm, double height_mm) const {
    // no line is thinner than a pixel, so a low resolution of the PNG would thicken those in print
    constexpr double least_dpi = 300;
    return at_size(std::move(style), width_mm, height_mm,
                   std::max(least_dpi, records_.front()->preset.figure.dpi));
  }

  bool has_photo() const { return !records_.front()->preset.page.photo.empty(); }
  Result<void> add_photo(Page& page, const std::string& letter, const Box& box_mm) {
    TRY(photo, as_input(render::read_png(records_.front()->preset.page.photo)));
    page.add_image(letter, "", box_mm, std::move(*photo));
    return {};
  }

  /// Photograph and states of the shell along its path, all at one scale. With a photograph the
  /// states are next to it, one below the other; without one they are side by side.
  Result<Page> fig1() {
    const record::Trajectory& run = records_.front()->trajectory;
    const bool photo = has_photo();
    const int count = int(run.frames.size());
    constexpr double caption = 12 * 25.4 / 72;
    const double width = photo ? 62 : 154.0 / count, height = photo ? 116.0 / count : 34;
    Page page{178, photo ? 120.0 : 38.0, {}};
    if (photo) TRY_DO(add_photo(page, "A", {2, 2, 92, 116}));
    render::MovieStyle style = sized(style_, width, height - caption);
    style.captions = style.inset = style.legends = false;
    style.turn_deg = 0;
    const render::Stage stage(run, style);
    // points on the page per millimetre of the shell, the same for all pictures
    const double units = (height - caption) * 72 / 25.4 * stage.pixels_per_mm() / style.height();
    for (int k = 0; k < count; ++k) {
      const record::Frame& frame = run.frames[std::size_t(k)];
      TRY(picture, stage.draw_views(renderer_, {frame, k}));
      render::Panel panel{std::move(*picture), fmt::format("B{}", k + 1), ""};
      panel.lines = render::shell_lines(stage.drawing(frame), stage.camera(k));
      const Box box =
          photo ? Box{97, 2 + k * height, width, height} : Box{2 + k * width, 2, width, height};
      page.add_panel(render::frame_state_caption(frame), box, std::move(panel));
      watch_.report(double(k + 1) / count);
    }
    if (const auto& bar = stage.colour_bar())
      page.add_colour_bar({157, 3, 19, photo ? 48.0 : 25.0}, *bar);
    page.add_scale_bar({photo ? 158.0 : 157.0, photo ? 106.0 : 28.0, 18, 8},
                       stage.style().scale_bar_mm, units);
    return page;
  }

  /// Panels A: photograph, in a row of its own. B: domains. C: the first shell over its net, and
  /// distances from the centre with scanned joints. D: deviations of the caps. E, F: the shell of
  /// the strainer and its domain.
  Result<Page> fig3() {
    const double top = has_photo() ? 54 : 0;
    Page page{178, 134 + top, {}};
    if (has_photo()) TRY_DO(add_photo(page, "A", {2, 2, 52, 50}));
    const auto strainer = std::ranges::find(records_, "strainer", &Run::name) - records_.begin();
    const std::size_t caps = std::min(shells_.size(), std::size_t(strainer));
    const std::vector<render::NamedRun> of_caps(shells_.begin(), shells_.begin() + long(caps));
    page.add("B", "", {2, 2 + top, 84, 46}, [of_caps](Canvas& canvas, const Box& box) {
      render::draw_footprints(canvas, box, of_caps);
    });
    const Box over_box{87, 2 + top, 44, 46}, below{2, 50 + top, 174, 32};
    TRY(over, render::draw_over_nets({shells_.front()}, filling(over_box, 1), watch_));
    // E has the same keys and more room for them
    if (caps < shells_.size()) over->keys.clear();
    page.add_figure("C1", over_box, std::move(*over));
    page.add_plot("C2", {132, 2 + top, 44, 46}, render::latitude_plot(shells_.front()));
    const int columns = std::min(6, int(caps));
    TRY(deviations,
        render::draw_deviations(of_caps, filling(below, columns, true), watch_, columns));
    page.add_figure("D", below, std::move(*deviations));
    if (caps < shells_.size()) {
      const Box left{2, 84 + top, 70, 43}, right{74, 84 + top, 102, 43};
      TRY(shell, render::draw_over_nets({shells_[caps]}, filling(left, 1), watch_));
      page.add_figure("E", left, std::move(*shell));
      page.add("F", "", right, [one = shells_[caps]](Canvas& canvas, const Box& box) {
        constexpr double room = 6;
        render::draw_footprints(canvas, {box.x + room, box.y, box.width - room, box.height}, {one});
      });
    }
    note_shell(page, 129 + top);
    return page;
  }

  /// A note on the hemisphere of the page: its deviation depends on the position of the rods.
  void note_shell(Page& page, double y) const {
    const Run& one = *records_.front();
    if (one.preset.net.cut_height != 0 || !render::on_sphere(one.trajectory.layout)) return;
    const bool axis = one.preset.footprint.placement == Placement::on_axis;
    page.add_note(
        {2, y, 174, 4},
        fmt::format(
            "Hemisphere: *ρ* = {:g} mm (our choice), rods {}; {} joints, maximum deviation Δ/*ρ* = "
            "{:.1f} %.",
            one.preset.net.radius_mm,
            axis ? "on the axes, so that one joint is the pole" : "offset by *d*/2 from the axes",
            one.trajectory.layout.joints.size(), 100 * one.summary.max_deviation));
  }

  /// A note on why the sum of K□ over all cells changes under load.
  static std::string total_text(const record::Trajectory& run) {
    return fmt::format(
        "D: Σ*K*_{{□}} = 2*π* minus the integrated geodesic curvature ({:.3f} rad unloaded) of the "
        "boundary of all complete cells (Gauss–Bonnet).",
        2 * M_PI - run.frames.front().total_K);
  }

  /// Panels A: shells over their nets. B: K□ of the cells. C, D: the same for pushed shells.
  Result<Page> fig4() {
    Page page{178, 199, {}};
    const Box above{2, 2, 174, 44}, middle{2, 93, 174, 52};
    // the axis along which B and D are plotted
    shells_.front().half_span = true;
    TRY(over,
        render::draw_over_nets(shells_, filling(above, std::min(3, int(shells_.size()))), watch_));
    page.add_figure("A", above, std::move(*over));
    page.add_plot("B", {2, 48, 174, 44}, render::curvature_plot(shells_));
    // narrower, since the colour bar has words, which would be too small if the figure were scaled
    render::MovieStyle push_style =
        filling({2, 94, 160, 50}, std::min(3, int(pushes_.size())), true);
    if (push_ != nullptr) {
      push_style.azimuth_deg = push_->preset.movie.azimuth_deg;
      push_style.elevation_deg = push_->preset.movie.elevation_deg;
      push_style.look.ghost = false;
    }
    TRY(pushes, render::draw_pushes(pushes_, push_style, watch_));
    page.add_figure("C", middle, std::move(*pushes));
    for (std::size_t k = 0; k < pushes_.size(); ++k) {
      const record::Trajectory& run = *pushes_[k].run;
      render::Plot plot =
          render::bins_plot(render::summarise_run(run), long(run.layout.cells.size()),
                            run.frames.back(), {-0.01, 0.07}, page_font);
      plot.title = pushes_[k].name + "\n" + plot.title;
      if (k == 0) page.add_legend({5, 145.5, 171, 5}, plot);
      plot.legend = render::LegendPosition::none;
      const double width = 174.0 / double(pushes_.size());
      page.add_plot(k == 0 ? "D" : "", {2 + width * double(k), 151, width - 1, 38}, plot);
    }
    if (!pushes_.empty()) page.add_note({2, 189, 174, 4}, total_text(*pushes_.front().run));
    note_shell(page, 193.5);
    return page;
  }

  /// Panels A: blocks. B: their footprints. C: the assembled shells over their nets. D and E, if
  /// the preset has them: photograph and measured joints.
  Result<Page> fig5() {
    Page page{178, 107, {}};
    const Box left{2, 2, 86, 54}, below{2, 58, 112, 48};
    const render::BlockKinds kinds(shells_);
    TRY(blocks, render::draw_blocks(shells_, filling(left, 1), watch_));
    for (std::size_t k = 0; k < blocks->keys.size(); ++k)
      blocks->keys[k].name.insert(0, fmt::format("A{}: ", k + 1));
    page.add_figure("A", left, std::move(*blocks));
    const int count = int(shells_.size());
    const auto inner = [](const Box& box) {
      constexpr double room = 6;  // "B1" is wider than the space next to it
      return Box{box.x + room, box.y, box.width - room, box.height};
    };
    for (int k = 0; k < count; ++k)
      page.add(numbered("B", k, count), "", {92 + k * 84.0 / count, 2, 84.0 / count, 49},
               [=, runs = shells_](Canvas& canvas, const Box& box) {
                 // one scale for all, that of the largest
                 double scale = INFINITY;
                 for (const render::NamedRun& one : runs)
                   scale = std::min(scale, render::block_footprint_scale(inner(box), *one.run));
                 render::draw_block_footprints(canvas, inner(box), *runs[std::size_t(k)].run, kinds,
                                               scale);
               });
    page.add_note({92, 52, 84, 4},
                  "B: footprints of the blocks, joined; dashed: actuated boundary");
    TRY(over, render::draw_over_nets(shells_, filling(below, std::min(2, count)), watch_, 2));
    for (int k = 0; k < count && count > 1; ++k)
      over->panels[std::size_t(k)].letter = numbered("C", k, count);
    // panel A has the colours of the blocks
    over->keys = {{over->keys.front().colour, "equilibrium, over the Chebyshev nets of A"}};
    page.add_figure(count > 1 ? "" : "C", below, std::move(*over));
    TRY_DO(add_experiment(page));
    page.add_plot("F", {116, 58, 60, 48}, render::curvature_plot(shells_));
    page.add_note({2, page.height_mm - 1, 174, 4},
                  "F: cells of C. D and E of the paper are a photograph and measured joints.");
    page.height_mm += 4;
    return page;
  }

  /// Shells in equilibrium, three per row. Each fills its box and has scale bar, name and author.
  Result<Page> literature() {
    constexpr int columns = 3;
    constexpr double width = 57, high = 36, pitch = 51;  // mm
    const int count = int(records_.size()), rows = (count + columns - 1) / columns;
    Page page{178, 7 + pitch * rows, {}};
    for (int k = 0; k < count; ++k) {
      const Run& run = *records_[std::size_t(k)];
      const record::Frame frame = run.trajectory.frames.back();
      record::Trajectory last{run.trajectory.layout, {frame}};
      render::MovieStyle style = style_of(run.preset, Pictures::stills);
      style.look.floor = style.look.loads = style.look.cells = false;
      // without boundary and unloaded shape a pushed shell would look like a tangle
      style.look.rings = run.preset.indentation.requested();
      if (style.look.rings)
        last.frames = {run.trajectory.frames.front(), frame};
      else  // a point instead of the boundaries, so that the shell alone fills its box
        last.layout.original_boundary = last.layout.actuated_boundary = frame.nodes.leftCols(1);
      style.colour_by = preset::ColourBy::none;
      style.quality = style_.quality;
      style = sized(std::move(style), width - 4, high);
      style.captions = style.heading = style.inset = style.legends = false;
      style.turn_deg = 0;
      const render::Stage stage(last, style);
      TRY(picture, stage.draw_views(renderer_, {frame, 0}));
      render::Panel panel{std::move(*picture), panel_letter(k), ""};
      panel.lines = render::shell_lines(stage.drawing(frame), stage.camera(0));
      const int row = k / columns, column = k % columns;
      const Box box{2 + column * (width + 1.5), 3 + row * pitch, width, high};
      page.add_panel("", box, std::move(panel));
      const double units = high * 72 / 25.4 * stage.pixels_per_mm() / style.height();
      page.add_scale_bar({box.x + 3, box.bottom(), width - 3, 6}, round_length(34 / units), units);
      page.add_note({box.x + 3, box.bottom() + 6, width - 3, 4}, render::plain(run.preset.title));
      page.add_note({box.x + 3, box.bottom() + 9.5, width - 3, 4},
                    render::plain(run.preset.source));
      const std::string overlaps = render::contact_caption(frame);
      page.add_note({box.x + 3, box.bottom() + 13, width - 3, 4},
                    overlaps.empty() ? stage.ghost_caption(frame) : "violet: " + overlaps);
      watch_.report(double(k + 1) / count);
    }
    return page;
  }

  /// The largest of 1, 2 and 5 times a power of ten that is no larger.
  static double round_length(double length_mm) {
    const double ten = std::pow(10, std::floor(std::log10(length_mm)));
    return (length_mm >= 5 * ten ? 5 : length_mm >= 2 * ten ? 2 : 1) * ten;
  }

  static std::string numbered(const char* letter, int k, int count) {
    return count > 1 ? fmt::format("{}{}", letter, k + 1) : letter;
  }

  /// Adds a row with D, the photograph, and E, the shell whose joints were measured, if the preset
  /// has them.
  Result<void> add_experiment(Page& page) {
    const auto measured =
        std::ranges::find_if(shells_, [](const auto& one) { return one.scanned.cols() > 0; });
    const Box left{2, 109, 86, 50}, right{90, 109, 86, 50};
    if (has_photo()) TRY_DO(add_photo(page, "D", left));
    if (measured != shells_.end()) {
      record::Trajectory alone;
      alone.layout = measured->run->layout;
      alone.layout.parts.clear();
      alone.layout.net_nodes.resize(3, 0);
      alone.frames = {measured->run->frames.back()};
      TRY(shell, render::draw_over_nets({{&alone, measured->name, measured->scanned}},
                                        filling(right, 1), watch_));
      page.add_figure("E", right, std::move(*shell));
    }
    if (has_photo() || measured != shells_.end()) page.height_mm = 161;
    return {};
  }

  const Runs& records_;
  render::Renderer& renderer_;
  Watch& watch_;
  render::MovieStyle style_;
  const Run* push_ = nullptr;  // the first run with a push
  std::vector<render::NamedRun> shells_, pushes_;
};

}  // namespace

Result<void> check_page(const std::vector<const preset::Preset*>& cases) {
  using preset::PageKind;
  const auto pushed = [](const preset::Preset* one) { return one->indentation.requested(); };
  const auto pushes = std::size_t(std::ranges::count_if(cases, pushed));
  const bool formed = pushes < cases.size(),
             on_nets = formed && std::ranges::all_of(cases, [&](const preset::Preset*one) {
                         return pushed(one) || one->on_net();
                       });
  const PageKind kind = cases.front()->page.kind;
  const auto check = [&](bool fits, const char* expected) -> Result<void> {
    if (fits) return {};
    return invalid("[page] kind: got \"{}\", expected {}", word_of(kind), expected);
  };
  switch (kind) {
    case PageKind::none:
    case PageKind::fig1:
    case PageKind::literature:
      return {};
    case PageKind::fig2:
      return check(cases.front()->jitter.requested(),
                   "a search for states: [jitter] trials or confined above 0");
    case PageKind::fig3:
      return check(on_nets, "a case without [indentation], and all such cases on nets");
    case PageKind::fig4:
      return check(on_nets && pushes > 0,
                   "cases with [indentation] and cases without, the latter on nets");
    case PageKind::fig5:
      return check(formed, "a case without [indentation]");
  }
  return {};
}

Result<void> draw_page(const Runs& records, render::Renderer& renderer, const fs::path& stem,
                       Watch& watch) {
  const preset::Preset& preset = records.front()->preset;
  if (preset.page.kind == preset::PageKind::none) return {};
  std::vector<const preset::Preset*> cases;
  for (const Run* one : records) cases.push_back(&one->preset);
  TRY_DO(check_page(cases));
  TRY(page, PageMaker(records, renderer, watch).make(preset.page.kind));
  const render::Print print{preset.figure.width_mm, preset.figure.dpi,
                            style_of(preset, Pictures::stills).look.background};
  return render::write_page(fs::path(stem) += "_page", preset.source, page->width_mm,
                            page->height_mm, page->panels, print, preset.page.drawn);
}

}  // namespace gridshell::app
