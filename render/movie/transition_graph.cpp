#include "render/movie/state_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "render/canvas/colour_map.h"
#include "render/canvas/plot_frame.h"
#include "render/movie/run_plots.h"

namespace gridshell::render {
namespace {

using record::StateRow;
using record::Transition;

constexpr double width = 400, plot_height = 262, margin = 4, head = figure_title_room,
                 legend_room = 16, thumb = 50, thumb_text = 31, font = 8;
constexpr double disturbed_radius = 3.6, dot_radius = 2.6, foot_room = 14;
using record::Disturbance;

Colour colour_of(Disturbance by) { return series_colour(by == Disturbance::released ? 0 : 1); }

/// A state of the graph on the canvas.
struct Node {
  const StateRow* row = nullptr;
  bool disturbed = false;
  Point at = {};

  double radius() const { return disturbed ? disturbed_radius : dot_radius; }
};

double distance(Point a, Point b) { return std::hypot(b.x - a.x, b.y - a.y); }

Box about(Point middle, double half_width, double half_height) {
  return {middle.x - half_width, middle.y - half_height, 2 * half_width, 2 * half_height};
}

/// A box of this size near `from`, inside the frame, that overlaps no other box; about `from`
/// itself if there is none.
Box free_box(Point from, const Box& size, const std::vector<Box>& taken, const Box& inside) {
  constexpr int directions = 24;
  for (double away = 9; away < 120; away += 3)
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * M_PI * (k + 0.5) / directions;
      const Box box = about({from.x + away * std::cos(angle) + 0.5 * size.width * std::cos(angle),
                             from.y - away * std::sin(angle)},
                            0.5 * size.width, 0.5 * size.height);
      if (inside.contains(box) &&
          std::ranges::none_of(taken, [&](const Box& one) { return one.overlaps(box); }))
        return box;
    }
  return about(from, 0.5 * size.width, 0.5 * size.height);
}

class TransitionGraph {
 public:
  TransitionGraph(const record::StateTables& states, const record::Trajectory& run)
      : states_(states), run_(run) {
    std::set<int> disturbed, met;
    for (const Transition& one : states.transitions) {
      disturbed.insert(one.from);
      met.insert({one.from, one.to});
    }
    met.erase(0);
    for (const int state : met)
      nodes_.push_back({&states.rows.at(std::size_t(state) - 1), disturbed.contains(state)});
    disturbed_.assign(disturbed.begin(), disturbed.end());
  }

  double height() const {
    return 2 * margin + head + legend_room + plot_height + (thumb + thumb_text) * thumb_rows() +
           foot_room;
  }

  void draw(Canvas& canvas) {
    const Box box{margin, margin + head + legend_room, width - 2 * margin, plot_height};
    const PlotFrame frame = axes(canvas, box);
    for (Node& node : nodes_) node.at = frame.point_at(node.row->height_mm, node.row->energy_mJ());
    draw_legend(canvas);
    for (const Transition& one : states_.transitions)
      if (one.to != 0 && one.to != one.from) draw_transition(canvas, one);
    for (const Node& node : nodes_) draw_node(canvas, node);
    draw_names(canvas, frame.inside.inset(2));
    for (std::size_t k = 0; k < disturbed_.size(); ++k) draw_thumb(canvas, k, box.bottom());
    canvas.text(
        "back: returned to itself; new: not in the library (times)",
        {0.5 * width, height() - margin},
        {.size = font - 1, .colour = ink, .align_x = AlignX::centre, .align_y = AlignY::bottom});
  }

 private:
  static constexpr std::size_t in_row = 6;
  double thumb_rows() const { return double((disturbed_.size() + in_row - 1) / in_row); }

  PlotFrame axes(Canvas& canvas, const Box& box) const {
    Plot plot;
    plot.font_size = font;
    plot.legend = LegendPosition::none;
    plot.x = {.label = "height (mm)"};
    plot.y = {.label = "elastic energy (mJ)"};
    Series all;
    for (const Node& node : nodes_) all.add(node.row->height_mm, node.row->energy_mJ());
    // a margin as wide as a node, also if all values are equal
    for (const auto& [values, axis] : {std::pair(&all.x, &plot.x), {&all.y, &plot.y}}) {
      const auto [low, high] = std::ranges::minmax(*values);
      const double room = std::max(0.07 * (high - low), 1e-3 * std::abs(high));
      axis->low = low - room;
      axis->high = high + room;
    }
    plot.series.push_back(std::move(all));
    const PlotFrame frame = lay_out_plot(canvas, box, plot);
    draw_axes(canvas, box, plot, frame);
    return frame;
  }

  const Node& node_of(int state) const {
    return *std::ranges::find_if(nodes_,
                                 [&](const Node& node) { return node.row->state == state; });
  }

  void draw_legend(Canvas& canvas) const {
    double x = margin;
    const double y = margin + head + 0.5 * legend_room;
    const auto entry = [&](Disturbance by, const std::string& text) {
      arrow(canvas, {x, y}, {x + 11, y}, {x + 22, y}, by);
      x = canvas.text(text, {x + 27, y}, {.size = font, .align_y = AlignY::middle}).right() + 14;
    };
    entry(Disturbance::released, "boundary released and contracted again");
    // only transitions that occurred more than once have a number
    const bool numbers = std::ranges::any_of(states_.transitions, [](const Transition& one) {
      return one.by == Disturbance::pushed && one.to != 0 && one.to != one.from && one.count > 1;
    });
    entry(Disturbance::pushed, numbers ? "a joint pushed (number: times)" : "a joint pushed");
  }

  /// Draws a quadratic curve from a to b with control point c and a head at b.
  static void arrow(Canvas& canvas, Point a, Point c, Point b, Disturbance by) {
    constexpr int pieces = 24;
    constexpr double head = 5;
    std::vector<Point> curve;
    const auto at = [&](double s) {
      const double p = (1 - s) * (1 - s), q = 2 * s * (1 - s), r = s * s;
      return Point{p * a.x + q * c.x + r * b.x, p * a.y + q * c.y + r * b.y};
    };
    for (int k = 0; k <= pieces; ++k) curve.push_back(at(double(k) / pieces));
    const double length = std::max(1e-9, distance(c, b));
    const Point along{(b.x - c.x) / length, (b.y - c.y) / length};
    const Colour colour = colour_of(by);
    curve.back() = {b.x - 0.8 * head * along.x, b.y - 0.8 * head * along.y};
    canvas.polyline(curve, {colour, by == Disturbance::released ? 1.2 : 0.9});
    const Point back{b.x - head * along.x, b.y - head * along.y};
    canvas.polygon({b,
                    {back.x - 0.38 * head * along.y, back.y + 0.38 * head * along.x},
                    {back.x + 0.38 * head * along.y, back.y - 0.38 * head * along.x}},
                   colour);
  }

  void draw_transition(Canvas& canvas, const Transition& one) {
    const Node &from = node_of(one.from), &to = node_of(one.to);
    const double length = std::max(1e-9, distance(from.at, to.at));
    const Point along{(to.at.x - from.at.x) / length, (to.at.y - from.at.y) / length};
    const bool released = one.by == Disturbance::released;
    // transitions in both directions, and by both perturbations, are bent differently
    const double bend = (released ? 0.24 : 0.12) * length;
    const Point middle{0.5 * (from.at.x + to.at.x) + bend * along.y,
                       0.5 * (from.at.y + to.at.y) - bend * along.x};
    const auto off = [&](Point p, double r) {
      const double d = std::max(1e-9, distance(p, middle));
      return Point{p.x + r * (middle.x - p.x) / d, p.y + r * (middle.y - p.y) / d};
    };
    arrow(canvas, off(from.at, from.radius()), middle, off(to.at, to.radius() + 0.8), one.by);
    if (released || one.count < 2) return;
    const Point label{0.25 * from.at.x + 0.5 * middle.x + 0.25 * to.at.x,
                      0.25 * from.at.y + 0.5 * middle.y + 0.25 * to.at.y};
    const TextStyle style{.size = font - 1,
                          .colour = readable(colour_of(one.by)),
                          .bold = true,
                          .align_x = AlignX::centre,
                          .align_y = AlignY::middle,
                          .halo = {1, 1, 1, 1}};
    taken_.push_back(canvas.text(fmt::format("{}", one.count), label, style));
  }

  void draw_node(Canvas& canvas, const Node& node) {
    const ClassLook look = look_of(node.row->kind);
    canvas.marker(look.marker, node.at, 2 * node.radius(), node.disturbed ? white : look.colour,
                  {look.colour, node.disturbed ? 1.6 : 0});
    taken_.push_back(about(node.at, node.radius(), node.radius()));
  }

  /// Writes the names of perturbed states next to them.
  void draw_names(Canvas& canvas, const Box& inside) {
    const TextStyle style{.size = font,
                          .bold = true,
                          .align_x = AlignX::centre,
                          .align_y = AlignY::middle,
                          .halo = {1, 1, 1, 1}};
    for (const Node& node : nodes_) {
      if (!node.disturbed) continue;
      const std::string name = fmt::format("*{}*", node.row->name());
      const Box box = free_box(node.at, canvas.measure(name, style), taken_, inside);
      const Point near{std::clamp(node.at.x, box.x, box.right()),
                       std::clamp(node.at.y, box.y, box.bottom())};
      const double fraction = node.radius() / std::max(node.radius(), distance(near, node.at));
      canvas.line(near,
                  {node.at.x + fraction * (near.x - node.at.x),
                   node.at.y + fraction * (near.y - node.at.y)},
                  {ink, 0.5});
      canvas.text(name, box.middle(), style);
      taken_.push_back(box);
    }
  }

  /// How often a perturbed state returned to itself or became one that is not in the library.
  std::string fate_of(int state) const {
    int back = 0, lost = 0;
    for (const Transition& one : states_.transitions) {
      if (one.from != state) continue;
      back += one.to == state ? one.count : 0;
      lost += one.to == 0 ? one.count : 0;
    }
    std::string text = fmt::format("back {}", back);
    if (lost > 0) text += fmt::format(", new {}", lost);
    return text;
  }

  void draw_thumb(Canvas& canvas, std::size_t k, double top) const {
    const double step = (width - 2 * margin) / double(std::min(in_row, disturbed_.size()));
    const StateRow& row = states_.rows.at(std::size_t(disturbed_[k]) - 1);
    const Point middle{margin + step * (double(k % in_row) + 0.5),
                       top + 4 + 0.5 * thumb + double(k / in_row) * (thumb + thumb_text)};
    draw_shell(canvas, row, middle);
    const auto line = [&](const std::string& text, double below, bool bold) {
      canvas.text(
          text, {middle.x, middle.y + 0.5 * thumb + below},
          {.size = font - 0.5, .bold = bold, .align_x = AlignX::centre, .align_y = AlignY::top});
    };
    line(fmt::format("*{}*", row.name()), 2, true);
    line(fate_of(row.state), 12, false);
  }

  /// Draws the rods of a state from above, higher ones darker.
  void draw_shell(Canvas& canvas, const StateRow& row, Point middle) const {
    const auto frame = run_.frames[std::size_t(row.state) - 1];
    const Eigen::Matrix3Xd& ring = run_.layout.actuated_boundary;
    const double reach = ring.topRows(2).colwise().norm().maxCoeff();
    const double scale = 0.5 * thumb / reach;
    const double low = frame.nodes.row(2).minCoeff(),
                 span = std::max(1e-9, frame.nodes.row(2).maxCoeff() - low);
    const PlanView plan{middle, {0, 0}, scale};
    for (const auto& rod : run_.layout.rods)
      for (std::size_t n = 1; n < rod.size(); ++n) {
        const Eigen::Vector3d a = frame.nodes.col(rod[n - 1]), b = frame.nodes.col(rod[n]);
        const float pale = float(0.78 - 0.7 * ((a.z() + b.z()) / 2 - low) / span);
        canvas.line(plan(a), plan(b), {{pale, pale, pale + 0.03f, 1}, 0.55});
      }
    canvas.polyline(plan.line(ring), {ink, 0.6}, true);
  }

  const record::StateTables& states_;
  const record::Trajectory& run_;
  std::vector<Node> nodes_;
  std::vector<int> disturbed_;
  std::vector<Box> taken_;  // boxes that names must not overlap
};

}  // namespace

Result<void> write_transition_graph(const std::filesystem::path& stem,
                                    const record::StateTables& states,
                                    const record::Trajectory& run, const std::string& title,
                                    const Print& print) {
  TransitionGraph graph(states, run);
  const std::string of_what = "which state goes to which when it is disturbed";
  return write_figure(
      stem, width, graph.height(), title,
      [&](Canvas& canvas) {
        draw_figure_title(canvas, title.empty() ? of_what : title + ": " + of_what);
        graph.draw(canvas);
      },
      print);
}

}  // namespace gridshell::render
