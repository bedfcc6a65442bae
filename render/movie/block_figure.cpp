#include "render/movie/run_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <ranges>
#include <set>

#include "render/canvas/panels.h"
#include "render/movie/run_plots.h"
#include "render/movie/stage.h"

#include "engine/core/try.h"
#include "render/canvas/text.h"

namespace gridshell::render {
namespace {

/// Horizontal displacements that separate the blocks, in proportion to their positions.
std::vector<Eigen::Vector3d> apart(const std::vector<record::Part>& parts,
                                   Eigen::Matrix3Xd record::Part::*where, double fraction) {
  std::vector<Eigen::Vector3d> moves;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const record::Part& part : parts) {
    moves.emplace_back((part.*where).rowwise().mean());
    middle += moves.back() / double(parts.size());
  }
  for (Eigen::Vector3d& move : moves) {
    move = fraction * (move - middle);
    move.z() = 0;
  }
  return moves;
}

/// A block and its displacement in the picture.
struct MovedBlock {
  const record::Part* part = nullptr;
  Eigen::Vector3d move = Eigen::Vector3d::Zero();
};

/// The blocks of a single run, separated from their positions in the assemblage; of several runs
/// one block of each kind, in a row.
std::vector<MovedBlock> moved_blocks(const std::vector<NamedRun>& runs) {
  std::vector<MovedBlock> blocks;
  if (runs.size() == 1) {
    const std::vector<record::Part>& parts = runs.front().run->layout.parts;
    const auto moves = apart(parts, &record::Part::net, 0.3);
    for (std::size_t k = 0; k < parts.size(); ++k) blocks.push_back({&parts[k], moves[k]});
    return blocks;
  }
  constexpr double gap = 0.65;  // of the blocks' mean width
  std::set<std::string> seen;
  double widths = 0, end = 0;
  for (const NamedRun& one : runs)
    for (const record::Part& part : one.run->layout.parts)
      if (seen.insert(block_kind(part.name)).second) {
        blocks.push_back({&part});
        widths += part.net.row(0).maxCoeff() - part.net.row(0).minCoeff();
      }
  for (auto& [part, move] : blocks) {
    move = {end - part->net.row(0).minCoeff(), 0, -part->net.row(2).minCoeff()};
    end += part->net.row(0).maxCoeff() - part->net.row(0).minCoeff() +
           gap * widths / double(blocks.size());
  }
  return blocks;
}

/// The blocks as one trajectory of a single frame; `owner` gets the index of each point's block.
record::Trajectory blocks_apart(const record::Layout& layout, const std::vector<MovedBlock>& moved,
                                std::vector<std::size_t>& owner) {
  record::Trajectory blocks;
  blocks.layout.spacing_mm = layout.spacing_mm;
  blocks.layout.rod_diameter_mm = layout.rod_diameter_mm;
  blocks.layout.length_scale_mm = layout.length_scale_mm;
  record::Frame frame;
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const record::Part& part = *moved[k].part;
    const auto first = frame.nodes.cols();
    frame.nodes.conservativeResize(3, first + part.net.cols());
    frame.nodes.rightCols(part.net.cols()) = part.net.colwise() + moved[k].move;
    owner.resize(std::size_t(frame.nodes.cols()), k);
    for (std::vector<int> rod : part.rods) {
      for (int& point : rod) point += int(first);
      blocks.layout.rods.push_back(std::move(rod));
    }
  }
  blocks.frames.push_back(std::move(frame));
  return blocks;
}

struct Extent {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(INFINITY), high = -low;
  void take(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& move) {
    const Eigen::Matrix2Xd flat = (points.colwise() + move).topRows<2>();
    low = low.cwiseMin(flat.rowwise().minCoeff());
    high = high.cwiseMax(flat.rowwise().maxCoeff());
  }
  Eigen::Vector2d size() const { return high - low; }
};

void draw_rods(Canvas& canvas, const PlanView& plan, const record::Part& part,
               const Eigen::Vector3d& move, const Stroke& stroke) {
  for (const auto& rod : part.rods)
    canvas.line(plan(part.flat.col(rod.front()) + move), plan(part.flat.col(rod.back()) + move),
                stroke);
}

/// The sheet of block footprints: separate ones above, joined ones below.
struct BlockSheet {
  std::vector<Eigen::Vector3d> moves;
  Extent above, below;

  explicit BlockSheet(const record::Layout& layout)
      : moves(apart(layout.parts, &record::Part::flat, 0.25)) {
    for (std::size_t k = 0; k < layout.parts.size(); ++k) {
      above.take(layout.parts[k].flat, moves[k]);
      below.take(layout.parts[k].flat, Eigen::Vector3d::Zero());
    }
    below.take(layout.original_boundary, Eigen::Vector3d::Zero());
    below.take(layout.actuated_boundary, Eigen::Vector3d::Zero());
  }
  double wide() const { return std::max(above.size().x(), below.size().x()); }
  double high() const { return above.size().y() + below.size().y(); }
};

/// The name of a seam in a picture: "quarter sphere 1 east – saddle west" for "quarter
/// sphere 1.east
/// - saddle.west".
std::string seam_text(std::string seam) {
  std::ranges::replace(seam, '.', ' ');
  if (const auto at = seam.find(" - "); at != seam.npos) seam.replace(at, 3, " – ");
  return seam;
}

/// Whether two series have the same points, in any order.
bool equal(const Series& a, const Series& b) {
  constexpr double near = 1e-3;  // mm or degrees
  return a.x.size() == b.x.size() &&
         std::ranges::all_of(std::views::iota(0, int(a.x.size())), [&](int k) {
           return std::ranges::any_of(std::views::iota(0, int(b.x.size())), [&](int m) {
             return std::hypot(a.x[k] - b.x[m], a.y[k] - b.y[m]) < near;
           });
         });
}

constexpr double between = 14, bar_height = 20;  // points
constexpr const char* rim_text = "dashed: actuated boundary";

}  // namespace

std::string block_kind(const std::string& name) {
  const std::size_t end = name.find_last_not_of("0123456789");
  return end == name.npos || name[end] != ' ' ? name : name.substr(0, end);
}

BlockKinds::BlockKinds(const std::vector<NamedRun>& runs) {
  for (const NamedRun& one : runs)
    for (const record::Part& part : one.run->layout.parts)
      if (const std::string kind = block_kind(part.name);
          std::ranges::find(kinds_, kind) == kinds_.end())
        kinds_.push_back(kind);
}

Colour BlockKinds::colour(const std::string& block) const {
  // these kinds have one colour in all pictures
  static const std::map<std::string, Colour> known{{"quarter sphere", {0.85f, 0.45f, 0.10f, 1}},
                                                   {"half cylinder", {0.10f, 0.55f, 0.40f, 1}},
                                                   {"saddle", {0.62f, 0.25f, 0.62f, 1}}};
  constexpr Colour others[] = {{0.16f, 0.42f, 0.78f, 1},
                               {0.50f, 0.33f, 0.18f, 1},
                               {0.85f, 0.40f, 0.55f, 1},
                               {0.52f, 0.54f, 0.12f, 1}};
  const std::string kind = block_kind(block);
  if (const auto fixed = known.find(kind); fixed != known.end()) return fixed->second;
  const auto before =
      std::ranges::count_if(kinds_.begin(), std::ranges::find(kinds_, kind),
                            [&](const std::string& other) { return !known.contains(other); });
  return others[std::size_t(before) % std::size(others)];
}

std::vector<ColourKey> BlockKinds::keys() const {
  std::vector<ColourKey> keys;
  for (const std::string& kind : kinds_) keys.push_back({colour(kind), plain(kind)});
  return keys;
}

Result<PanelFigure> draw_blocks(const std::vector<NamedRun>& runs, const MovieStyle& movie_style,
                                Watch& watch) {
  const MovieStyle style = uncoloured(movie_style);
  const BlockKinds kinds(runs);
  const auto moved = moved_blocks(runs);
  std::vector<std::size_t> owner;
  const record::Trajectory blocks = blocks_apart(runs.front().run->layout, moved, owner);
  TRY_DO(check_showable(blocks, style));
  const Stage stage(blocks, style);
  Drawing drawing = stage.drawing(blocks.frames.front());
  drawing.ground = false;
  drawing.joint_diameter_mm = 0;
  drawing.rod_diameter_mm *= 1.5;
  for (const std::size_t block : owner)
    drawing.node_colours.push_back(kinds.colour(moved[block].part->name));
  // with one block of each kind, letters are in front of the blocks
  for (std::size_t k = 0; k < moved.size() && runs.size() > 1; ++k) {
    const auto& [part, move] = moved[k];
    const Eigen::Vector3d low = part->net.rowwise().minCoeff(),
                          high = part->net.rowwise().maxCoeff();
    const Eigen::Vector3d before(0.5 * (low.x() + high.x()),
                                 low.y() - 0.1 * blocks.layout.length_scale_mm, low.z());
    drawing.labels.push_back({before + move, fmt::format("A{}", k + 1), true});
  }
  PanelFigure figure = empty_figure(style, 1);
  TRY_DO(add_panel(figure, stage, std::move(drawing), {}, nullptr, watch));
  figure.keys = kinds.keys();
  figure.scale_bar_mm = stage.style().scale_bar_mm;
  figure.pixels_per_mm = stage.pixels_per_mm();
  return figure;
}

double block_footprint_scale(const Box& box, const record::Trajectory& run) {
  const BlockSheet sheet(run.layout);
  return std::min(box.width / sheet.wide(), (box.height - between - bar_height) / sheet.high());
}

void draw_block_footprints(Canvas& canvas, const Box& box, const record::Trajectory& run,
                           const BlockKinds& kinds, double scale) {
  const record::Layout& layout = run.layout;
  const BlockSheet sheet(layout);
  if (scale == 0) scale = block_footprint_scale(box, run);
  const auto centred = [&](const Extent& extent, double y) {
    return PlanView{{box.middle().x - scale * extent.size().x() / 2, y},
                    {extent.low.x(), extent.high.y()},
                    scale};
  };
  const PlanView up = centred(sheet.above, box.y),
                 down = centred(sheet.below, box.y + scale * sheet.above.size().y() + between);
  for (std::size_t k = 0; k < layout.parts.size(); ++k) {
    const Stroke stroke{kinds.colour(layout.parts[k].name), 0.8};
    draw_rods(canvas, up, layout.parts[k], sheet.moves[k], stroke);
    draw_rods(canvas, down, layout.parts[k], Eigen::Vector3d::Zero(), stroke);
  }
  canvas.polyline(down.line(layout.original_boundary), {ink, 1.2}, true);
  canvas.polyline(down.line(layout.actuated_boundary), {ink, 0.9, {3, 2}}, true);
  const double below = down.at.y + scale * sheet.below.size().y();
  const Point left{box.x, below + 0.6 * bar_height};
  const Box length = draw_spacing(canvas, left, layout, scale);
  const TextStyle style{.size = 7, .align_y = AlignY::middle};
  const Point after{length.right() + 8, left.y};
  // the boundary is explained only where there is room, which is once on a page
  if (after.x + canvas.measure(rim_text, style).width <= box.right())
    canvas.text(rim_text, after, style);
}

Result<void> write_block_footprints(const std::filesystem::path& stem,
                                    const record::Trajectory& run, const std::string& title,
                                    const Print& print) {
  // the size of text does not depend on the printed width
  const double width = print.width_pt(340);
  constexpr double margin = 12;
  const BlockSheet sheet(run.layout);
  const double scale = (width - 2 * margin) / sheet.wide();
  const double height = 2 * margin + scale * sheet.high() + between + bar_height;
  return write_figure(
      stem, width, height + figure_title_room, "Footprints of the blocks",
      [&](Canvas& canvas) {
        draw_figure_title(canvas, title);
        draw_block_footprints(canvas, Box{0, figure_title_room, width, height}.inset(margin), run,
                              BlockKinds({{&run, ""}}));
      },
      print);
}

std::vector<Plot> seam_plots(const record::Trajectory& run) {
  std::vector<Plot> plots(2);
  for (Plot& plot : plots) {
    plot.x.label = "position along the seam (mm)";
    plot.y.low = 0;
  }
  plots[0].y.label = "gap (mm)";
  plots[1].y.label = "angle between tangents (°)";
  std::map<std::string, std::array<Series, 2>> seams;
  // a seam crosses rods of both families; its middle is at the mean of each family's lines
  std::map<std::pair<std::string, char>, std::pair<double, int>> lines;
  for (const record::SeamRod& rod : run.layout.seam_rods) {
    auto& [sum, count] = lines[{rod.seam, rod.family}];
    sum += rod.line_mm;
    ++count;
  }
  for (const record::SeamRod& rod : run.layout.seam_rods) {
    auto& [gap, kink] = seams[rod.seam];
    const auto& [sum, count] = lines[{rod.seam, rod.family}];
    const double side = rod.family == 'v' ? std::numbers::sqrt2 : -std::numbers::sqrt2;
    for (Series* series : {&gap, &kink}) series->x.push_back(side * (rod.line_mm - sum / count));
    gap.y.push_back(rod.gap_mm);
    kink.y.push_back(rod.kink_deg);
  }
  std::size_t index = 0;
  for (auto& [name, pair] : seams) {
    for (std::size_t k = 0; k < 2; ++k) {
      // seams may be mirror images: later markers are smaller, inside the earlier ones
      Series marks = mark_series(plain(seam_text(name)), series_colour(index), series_marker(index),
                                 std::max(2.2, 5.4 - 2.0 * double(index)));
      marks.x = std::move(pair[k].x);
      marks.y = std::move(pair[k].y);
      // equal ones are on the first one's marks
      if (index > 0 && equal(marks, plots[k].series.front())) marks.name += " (equal)";
      plots[k].add(std::move(marks));
    }
    ++index;
  }
  return plots;
}

}  // namespace gridshell::render
