#include "render/movie/frame_overlay.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/record/contacts.h"
#include "engine/record/frame_values.h"
#include "render/canvas/text.h"

namespace gridshell::render {
namespace {

// the title in at most two lines, which are shortened if necessary
std::vector<std::string> lines_of_title(const MovieStyle& style, double width, double font_size) {
  std::vector<std::string> lines;
  (void)draw_picture(1, 1, 1, {}, [&](Canvas& canvas) {
    const TextStyle font = title_style(style, font_size);
    lines = canvas.wrapped(style.title, width, font);
    for (; lines.size() > 2; lines.pop_back()) lines[lines.size() - 2] += " " + lines.back();
    for (std::string& line : lines) line = canvas.shortened(line, width, font);
  });
  return lines;
}

// these cut a strip off one side of `box` and return it
Box cut_top(Box& box, double height) {
  const Box strip{box.x, box.y, box.width, height};
  box.y += height;
  box.height -= height;
  return strip;
}
Box cut_bottom(Box& box, double height) {
  box.height -= height;
  return {box.x, box.bottom(), box.width, height};
}
Box cut_right(Box& box, double width) {
  box.width -= width;
  return {box.right(), box.y, width, box.height};
}

constexpr Colour force_ink{0.0f, 0.56f, 0.30f, 1};

constexpr Colour track{0.84f, 0.84f, 0.86f, 1}, done{0.45f, 0.47f, 0.5f, 1};

struct Sign {
  MarkKind kind;
  const char* word;
  Marker marker;
  Colour colour;
};
constexpr Sign signs[] = {
    {MarkKind::contact, "interpenetration", Marker::square, contact_ink},
    {MarkKind::unstable, "unstable", Marker::square, {0.80f, 0.12f, 0.10f, 1}},
    {MarkKind::motion, "in motion", Marker::square, {0.93f, 0.60f, 0.15f, 1}},
    {MarkKind::snap, "snap", Marker::diamond, {0.10f, 0.32f, 0.62f, 1}},
    {MarkKind::lock, "locked", Marker::triangle, {0.30f, 0.16f, 0.45f, 1}}};

bool reached(const std::vector<Mark>& marks, MarkKind kind, int at) {
  return std::ranges::any_of(marks,
                             [&](const Mark& mark) { return mark.kind == kind && mark.at <= at; });
}

// draws a coloured length for a lasting state and a sign for an event
void draw_marks(Canvas& canvas, const Box& bar, const std::vector<Mark>& marks,
                const std::vector<double>& positions, int at, double size) {
  // position of a frame, also between two frames
  const auto x_of = [&](double frame) {
    const double k = std::clamp(frame, 0.0, double(positions.size() - 1));
    const std::size_t before = std::size_t(k), after = std::min(before + 1, positions.size() - 1);
    return bar.x + bar.width * std::lerp(positions[before], positions[after], k - double(before));
  };
  for (const Sign& sign : signs)
    for (const Mark& mark : marks) {
      if (mark.kind != sign.kind || mark.at > at) continue;
      if (sign.marker == Marker::square) {
        const double from = x_of(mark.at - 0.5), to = x_of(std::min(mark.at + 0.5, double(at)));
        const double width = std::max(to - from, 0.12 * size);
        canvas.rectangle({std::min(from, bar.right() - width), bar.y, width, bar.height},
                         sign.colour);
      } else {
        canvas.marker(sign.marker, {x_of(mark.at), bar.middle().y}, 0.7 * size, sign.colour,
                      {{1, 1, 1, 1}, 0.08 * size});
      }
    }
}

constexpr Colour rod_ink{0.16f, 0.17f, 0.2f, 1}, load_ink{0.05f, 0.05f, 0.06f, 1};

/// A force as text: "950 N", "4.25 kN".
std::string force_text(double N) {
  return N >= 1000 ? fmt::format("{:.3g} kN", 1e-3 * N) : fmt::format("{:.3g} N", N);
}

/// Adds a spring from `from` to `from` + `stretch` as a zigzag, `half_width` to either side.
void add_spring(const Eigen::Vector3d& from, const Eigen::Vector3d& stretch, double half_width,
                GhostRods& springs) {
  constexpr int turns = 4;
  const Eigen::Vector3d side = half_width * stretch.unitOrthogonal();
  std::vector<int>& rod = springs.rods.emplace_back();
  const Eigen::Index first = springs.nodes.cols();
  springs.nodes.conservativeResize(3, first + 2 * turns + 2);
  for (int k = 0; k <= 2 * turns + 1; ++k) {
    const bool end = k == 0 || k == 2 * turns + 1;
    const double along = end ? k > 0 : (k - 0.5) / (2 * turns);
    springs.nodes.col(first + k) = from + along * stretch + (end ? 0 : k % 2 == 0 ? 1 : -1) * side;
    rod.push_back(int(first) + k);
  }
}

}  // namespace

TextStyle title_style(const MovieStyle& style, double font_size) {
  return {.size = (style.captions ? 1.15 : 1) * font_size, .bold = true};
}

FrameLayout lay_out_frame(const MovieStyle& style, const ColourBar* bar, FrameNotes notes) {
  FrameLayout layout;
  const double w = style.width(), h = style.height();
  // readable in small pictures, and not too wide for a tall one
  const double em = layout.font_size =
      style.font_scale * std::max(7.5, 0.024 * std::min(h, 0.72 * w));
  const double margin = std::min(0.9 * em, 0.06 * std::min(w, h)), line = 1.5 * em;
  Box rest = Box{0, 0, w, h}.inset(margin);
  const bool captions = style.captions && rest.height > 10 * line && rest.width > 14 * em;
  const bool wide = w >= 1.15 * h;

  // legends are in a column on the right or a strip below
  const double side = std::min(0.3 * h, 0.28 * w);
  const bool inset = style.inset && side > 4 * em;
  const double bar_wide = bar ? colour_bar_width(*bar, 0.95 * em) : 0;
  const double bar_tall = wide ? std::min(0.42 * h, 20 * em) : side;
  bool with_bar = bar && bar_tall > 5 * line && bar_wide < 0.4 * rest.width;
  if (wide && style.bins && 0.42 * w > 16 * em && rest.height > 16 * em) {
    // the plot is above, the small legends are side by side below it
    Box column = cut_right(rest, 0.42 * w);
    cut_right(rest, margin);
    layout.plot = cut_top(column, 0.62 * column.height);
    cut_top(column, margin);
    if (with_bar) {
      layout.colour_bar = cut_right(column, bar_wide);
      cut_right(column, 2 * margin);
    }
    const double square = std::min({side, column.width, column.height});
    if (inset) layout.inset = {column.right() - square, column.y, square, square};
  } else if (wide && (inset || with_bar)) {
    Box column = cut_right(rest, std::max(inset ? side : 0, with_bar ? bar_wide : 0));
    cut_right(rest, margin);
    if (inset) {
      const Box top = cut_top(column, side);
      layout.inset = {top.right() - side, top.y, side, side};
      cut_top(column, margin);
    }
    with_bar = with_bar && column.height > 5 * line;
    if (with_bar) {
      const double tall = std::min(bar_tall, column.height);
      layout.colour_bar = {column.right() - bar_wide, column.bottom() - tall, bar_wide, tall};
    }
  } else if (inset || with_bar) {
    const Box strip = cut_bottom(rest, side);
    cut_bottom(rest, margin / 2);
    if (inset) layout.inset = {strip.x, strip.y, side, side};
    if (with_bar) layout.colour_bar = {strip.right() - bar_wide, strip.y, bar_wide, side};
  }

  if (captions) {
    layout.title_lines = lines_of_title(style, rest.width, em);
    const double lines = std::max(1.0, double(layout.title_lines.size()));
    layout.title = cut_top(rest, 1.15 * line * lines);
    layout.state = cut_top(rest, line);
  }
  if (!captions && style.heading) {
    // the heading is also above the colour bar, but not above a plot
    const double right = layout.plot.empty() ? w : rest.right(), x = still_margin * em;
    layout.title_lines = lines_of_title(style, right - 2 * x, em);
    const double lines = std::max(1.0, double(layout.title_lines.size()));
    cut_top(rest, (1.2 + lines) * line + 1.3 * em * (notes.loads + notes.contacts));
    layout.heading = {x, x, right - 2 * x, (1 + lines) * line};
  }
  const bool scale_bar = style.scale_bar_mm > 0 && rest.height > 6 * line;
  const bool key = notes.arrow_key && rest.height > 6 * line;
  Box foot = cut_bottom(rest, captions ? 1.9 * line : (scale_bar || key ? 1.7 * line : 0));
  if (scale_bar) {
    Box corner = cut_right(foot, 0.4 * foot.width);
    layout.scale_bar = cut_bottom(corner, 1.7 * line);
  }
  if (key) {
    Box corner = cut_right(foot, 0.3 * foot.width);
    layout.arrow_key = cut_bottom(corner, 1.7 * line);
  }
  if (captions) {
    layout.timeline = cut_bottom(foot, 0.9 * line);
    layout.event = foot;
  }
  layout.view = rest.inset(0.5 * margin);
  return layout;
}

std::vector<std::string> state_captions(const record::Frame& frame) {
  std::vector<std::string> captions;
  const bool pushed = std::isfinite(frame.depth_mm);
  if (pushed) captions.push_back("*δ* = " + fixed(frame.depth_mm, 2) + " mm");
  if (std::isfinite(frame.force_N)) captions.push_back("*F* = " + fixed(frame.force_N, 3) + " N");
  const bool moved = frame.actuation != 1;
  if (std::isfinite(frame.boundary_radius_mm) && (!pushed || moved))
    captions.push_back("*R*_{a} = " + fixed(frame.boundary_radius_mm, 1) + " mm");
  captions.push_back("height " + length_text(frame.height_mm));
  if (std::isfinite(frame.time_s))
    captions.push_back("*t* = " + fixed(1e3 * frame.time_s, 0) + " ms");
  return captions;
}

void put_contacts(const record::Layout& layout, const record::Frame& frame, double thin_mm,
                  Drawing& drawing) {
  if (frame.contacts <= 0) return;
  for (const record::Contact& contact :
       record::ContactSearch(layout).in(frame.nodes).interpenetrations)
    drawing.marks.push_back({contact.at, std::max(4.0, 5 * thin_mm), contact_ink});
}

void put_supports(const record::Layout& layout, const record::Frame& frame,
                  const std::set<int>& supported, const Appearance& look, Drawing& drawing) {
  const double size = 1.3 * drawing.joint_diameter_mm;
  std::set<int> constrained = supported;
  for (const record::LoadedJoint& load : layout.loaded_joints)
    constrained.erase(layout.joints[std::size_t(load.joint)].node);
  // a flat grid has no reactions yet
  if (constrained.empty() && look.rings)
    constrained = {layout.edge_points.begin(), layout.edge_points.end()};
  GhostRods springs{Eigen::Matrix3Xd(3, 0), {}, 0.3 * size, look.ring, -size};
  for (std::size_t k = 0; k < layout.sprung.size(); ++k) {
    const int node = layout.sprung[k];
    const auto at = std::ranges::find(layout.supports, node) - layout.supports.begin();
    constrained.erase(node);
    if (at >= frame.reactions_N.cols()) continue;
    // the stretch of the spring is that at which its force is the reaction
    const Eigen::Array3d stiffness = layout.spring_N_per_mm.col(Eigen::Index(k));
    Eigen::Vector3d stretch =
        (stiffness > 0).select(frame.reactions_N.col(at).array() / stiffness, 0);
    // a shorter spring would be hidden by its ball; one without force has no direction
    if (stretch.norm() > 1e-4 * layout.length_scale_mm) {
      stretch *= std::max(1.0, 3 * size / stretch.norm());
      add_spring(frame.nodes.col(node), stretch, 0.5 * size, springs);
    }
    drawing.marks.push_back({frame.nodes.col(node) + stretch, size, look.ring, false});
  }
  if (!springs.rods.empty()) drawing.ghosts.push_back(std::move(springs));
  for (const int node : constrained)
    drawing.marks.push_back({frame.nodes.col(node), size, look.ring, false});
  if (!look.clamped) return;
  GhostRods sleeves{frame.nodes, {}, size, look.ring, -size};
  const auto add = [&](auto at, const auto end) {
    std::vector<int>& sleeve = sleeves.rods.emplace_back();
    for (const int first = *at; at != end; ++at) {
      sleeve.push_back(*at);
      if ((frame.nodes.col(*at) - frame.nodes.col(first)).norm() > 2.5 * size) break;
    }
  };
  for (const auto& rod : layout.rods) {
    if (constrained.contains(rod.front())) add(rod.begin(), rod.end());
    if (constrained.contains(rod.back())) add(rod.rbegin(), rod.rend());
  }
  drawing.ghosts.push_back(std::move(sleeves));
}

void put_braces(const record::Layout& layout, const record::Frame& frame, double thin_mm,
                Drawing& drawing) {
  GhostRods braces{frame.nodes, {}, std::max(0.6 * layout.rod_diameter_mm, thin_mm), brace_ink};
  for (const auto& [from, to] : record::braces_of(layout, frame)) braces.rods.push_back({from, to});
  if (!braces.rods.empty()) drawing.ghosts.push_back(std::move(braces));
}

void put_loads(const record::Layout& layout, const record::Frame& frame, double largest_N,
               double thin_mm, Drawing& drawing) {
  const bool area = loads_all_alike(frame);
  const double width = std::max((area ? 0.04 : 0.02) * longest_force(layout), 1.5 * thin_mm);
  // shadows of many arrows would look like parts of the shell
  for (const LoadArrow& arrow : force_arrows(layout, frame, largest_N))
    drawing.arrows.push_back({arrow.from, arrow.to, width, force_ink, !area});
}

std::optional<ArrowKey> arrow_key(const record::Layout& layout, double largest_N) {
  if (!(largest_N > 0)) return {};
  const double shown_N = nice_ceiling(0.6 * largest_N);
  return ArrowKey{longest_force(layout) * shown_N / largest_N, force_text(shown_N), force_ink};
}

std::string load_caption(const record::Frame& frame) {
  if (frame.loads_N.cols() == 0) return "";
  constexpr double alike = 0.99;  // of the sum of their magnitudes: of loads in one direction
  const auto sum = [](const Eigen::Matrix3Xd& of) { return force_text(of.rowwise().sum().norm()); };
  const auto magnitudes = [](const Eigen::Matrix3Xd& of) { return of.colwise().norm().sum(); };
  const double all = magnitudes(frame.loads_N);
  const bool in_one_direction = frame.loads_N.rowwise().sum().norm() >= alike * all;
  std::string loads =
      (in_one_direction ? "loads " : "loads with a resultant of ") + sum(frame.loads_N);
  if (loads_all_alike(frame)) return loads + ", distributed (arrows not to scale)";
  if (const Eigen::Matrix3Xd small = small_loads(frame); small.cols() > 0)
    loads += fmt::format(" ({:.0f} % distributed)", 100 * magnitudes(small) / all);
  return frame.reactions_N.cols() == 0 ? loads : loads + ", reactions " + sum(frame.reactions_N);
}

std::string contact_caption(const record::Frame& frame) {
  if (frame.contacts <= 0) return "";
  return std::to_string(frame.contacts) +
         (frame.contacts > 1 ? " interpenetrations" : " interpenetration") +
         (frame.energies[Term::contact] > 0 ? "" : " (contact not modelled)");
}

std::string event_caption(const record::Frame& frame) {
  // the number of negative pivots in "unstable: ..." is only in the table
  const bool counted = frame.event.empty() || frame.event.starts_with("unstable: ");
  if (!counted) return frame.event;
  return frame.negative_pivots > 0 ? "unstable equilibrium" : contact_caption(frame);
}

void draw_timeline(Canvas& canvas, const Box& box, const std::vector<Mark>& marks,
                   const ProgressAxis& axis, int at, double font_size) {
  const int frames = int(axis.positions.size());
  // the bar leaves room for all names of the complete run, so that its length does not change
  const double size = 0.8 * font_size, gap = 0.5 * size;
  const double apart = 6 * gap;  // distance of the names from the bar
  double words = apart - 2 * gap;
  for (const Sign& sign : signs)
    if (reached(marks, sign.kind, frames))
      words += size + gap + canvas.measure(sign.word, {.size = size}).width + 2 * gap;
  const TextStyle text{.size = 0.85 * font_size, .align_y = AlignY::middle};
  const bool named = !axis.name.empty();
  const std::string first = named ? axis.name + " = " + fixed(axis.first, 1) : "",
                    last = named ? fixed(axis.last, 1) + axis.unit : "";
  const double before = named ? canvas.measure(first, text).width + gap : 0,
               after = named ? canvas.measure(last, text).width + gap : 0;
  const double length =
      std::min(box.width - words - before - after, std::max(0.3 * box.width, 16 * font_size));
  if (length < 4 * font_size || frames < 2) return;
  const Box bar{box.x + before, box.middle().y - 0.16 * font_size, length, 0.32 * font_size};
  canvas.text(first, {box.x, box.middle().y}, text);
  canvas.text(last, {bar.right() + gap, box.middle().y}, text);
  canvas.rectangle(bar, track);
  canvas.rectangle({bar.x, bar.y, bar.width * axis.positions[std::size_t(at)], bar.height}, done);
  draw_marks(canvas, bar, marks, axis.positions, at, font_size);
  double x = bar.right() + after + apart;
  for (const Sign& sign : signs) {
    if (!reached(marks, sign.kind, at)) continue;
    canvas.marker(sign.marker, {x + size / 2, box.middle().y}, 0.8 * size, sign.colour, {{}, 0});
    x += size + gap;
    x = canvas
            .text(sign.word, {x, box.middle().y},
                  {.size = size, .colour = pale_ink, .align_y = AlignY::middle})
            .right() +
        2 * gap;
  }
}

void draw_top_view(Canvas& canvas, const Box& box, const record::Layout& layout,
                   const record::Frame& frame, const TopExtent& extent,
                   const std::vector<Colour>& cell_colours, const Appearance& look) {
  const double hair = std::max(0.6, box.width / 260), radius = std::max(0.7, box.width / 130);
  const Box inside = box.inset(radius + hair);
  const PlanView plan{inside.middle(),
                      {extent.x_mm, extent.y_mm},
                      std::min(inside.width, inside.height) / (2 * extent.half_mm)};
  if (look.rings && original_boundary_shown(frame))
    canvas.polyline(plan.line(layout.original_boundary), {{0.6f, 0.6f, 0.62f, 1}, hair}, true);
  if (look.rings)
    canvas.polyline(plan.line(boundary_at(layout, frame.actuation)),
                    {{0.25f, 0.27f, 0.3f, 1}, 1.5 * hair}, true);
  for (std::size_t c = 0; c < std::min(cell_colours.size(), layout.cells.size()); ++c) {
    std::vector<Point> corners;
    for (int joint : layout.cells[c].joints)
      corners.push_back(plan(frame.nodes.col(layout.joints[std::size_t(joint)].node)));
    canvas.polygon(corners, cell_colours[c]);
  }
  for (const std::vector<int>& rod : layout.rods) {
    // nodes nearer than a pixel and a half are left out, which saves time
    std::vector<Point> line;
    for (std::size_t k = 0; k < rod.size(); ++k) {
      const Point p = plan(frame.nodes.col(rod[k]));
      const bool end = k == 0 || k + 1 == rod.size();
      if (end || std::hypot(p.x - line.back().x, p.y - line.back().y) > 1.5) line.push_back(p);
    }
    canvas.polyline(line, {rod_ink, hair});
  }
  for (const record::Joint& joint : layout.joints)
    if (look.joint_mm > 0) canvas.circle(plan(frame.nodes.col(joint.node)), radius, look.joint);
  for (const record::LoadedJoint& load : layout.loaded_joints) {
    if (!load_acts(load, layout, frame)) continue;
    const record::Joint& joint = layout.joints.at(std::size_t(load.joint));
    canvas.circle(plan(frame.nodes.col(joint.node)), 2.6 * radius, {0, 0, 0, 0},
                  {load_ink, 1.2 * radius});
  }
}

}  // namespace gridshell::render
