// Shells next to the nets they were designed on, in space [Baek 2018, Figs. 3 and 4A].
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/record/trajectory.h"
#include "render/canvas/legend.h"
#include "render/canvas/panels.h"
#include "render/canvas/plot.h"
#include "render/gl/renderer.h"
#include "render/movie/movie_style.h"
#include "render/movie/run_plots.h"
#include "render/movie/stage.h"

namespace gridshell::render {

// What figures of shells share.

/// A style of panels that are not coloured by a quantity: no captions, no turn.
MovieStyle uncoloured(MovieStyle style);
/// A figure in a style, without panels.
PanelFigure empty_figure(const MovieStyle& style, int columns);
/// "A", "B", ... where the style wants letters.
std::string panel_letter(const MovieStyle& style, std::size_t k);

struct PanelText {
  bool lettered = false;
  std::string caption = {};  ///< marked text
  double wider = 1;          ///< how many times as much is seen as the stage frames
};
/// Adds a panel: a drawing as the stage's camera sees its last frame. Without a renderer it is
/// lines; with one a picture, and lines too if the style has vectors. Errors: the renderer's;
/// Fault::cancelled.
Result<void> add_panel(PanelFigure& figure, const Stage& stage, Drawing drawing,
                       const PanelText& text, Renderer* renderer, const Watch& watch);

/// A run shown by its last frame, over its net if its layout knows one.
struct NetRun {
  const record::Trajectory* run = nullptr;
  std::string caption;            ///< marked text
  Eigen::Matrix3Xd scanned = {};  ///< joints measured on a real shell, mm, in the net's frame
  bool half_span = false;         ///< with the axis x and the half-span L next to it
};

/// Distance of every node of the last frame from its position on the net, over rho.
Eigen::VectorXd last_deviation(const record::Trajectory& run);

/// What deviations over the length scale are multiplied by to be shown, and what they are then:
/// per cent of rho, or for building blocks millimetres.
struct DeviationUnit {
  double factor = 100;
  std::string label;  ///< marked text
};
DeviationUnit deviation_unit(const record::Layout& layout);

/// Whether the net is a part of a sphere about the origin, of radius rho.
bool on_sphere(const record::Layout& layout);

/// A drawing with the joints measured on it, red, over a dark shell without joints of its own;
/// `measured` in mm, in the drawing's frame.
void show_measured_joints(const Eigen::Matrix3Xd& measured, Drawing& drawing);

/// What its red joints mean.
ColourKey scan_key();

/// The shells, dark, over their nets, wider and orange, with the joints scanned, red, at most
/// `columns` side by side, as lines. Progress and errors as write_stills.
Result<PanelFigure> draw_over_nets(const std::vector<NetRun>& runs, const MovieStyle& style,
                                   Watch& watch, int columns = 3);

/// The shells coloured by their deviation, side by side with one colour bar, as lines.
Result<PanelFigure> draw_deviations(const std::vector<NetRun>& runs, const MovieStyle& style,
                                    Watch& watch, int columns = 3);

// Building blocks, apart and joined [Baek 2018, Fig. 5].

/// A block's name without the number that distinguishes it from equal ones: "quarter sphere".
std::string block_kind(const std::string& name);

/// The kinds of blocks of some runs, and their colours in all pictures of these.
class BlockKinds {
 public:
  explicit BlockKinds(const std::vector<NetRun>& runs);
  Colour colour(const std::string& block) const;  ///< by its name
  std::vector<ColourKey> keys() const;

 private:
  std::vector<std::string> kinds_;
};

/// Blocks on their nets in one picture of lines: all of one run, apart, or of several runs one of
/// each kind. Errors as write_stills.
Result<PanelFigure> draw_blocks(const std::vector<NetRun>& runs, const MovieStyle& style,
                                Watch& watch);

/// What write_block_footprints draws into a box, at a scale (units per mm) or, if that is 0, as
/// large as fits.
void draw_block_footprints(Canvas& canvas, const Box& box, const record::Trajectory& run,
                           const BlockKinds& kinds, double scale = 0);
double block_footprint_scale(const Box& box, const record::Trajectory& run);

/// The blocks' footprints apart, and below them the joined footprint with its original boundary
/// and, dashed, the actuated one, to scale. Writes `<stem>.png` and `<stem>.svg`.
Result<void> write_block_footprints(const std::filesystem::path& stem,
                                    const record::Trajectory& run, const std::string& title = "",
                                    const Print& print = {});

/// Gap, and kink, of every rod across a seam against its position along the seam, one marker per
/// seam.
std::vector<Plot> seam_plots(const record::Trajectory& run);

/// Plots next to one another, as many as stay readable, with the legend of the first above them
/// all; `title` (plain text; may be empty) above, `name` of the file. Writes `<stem>.png`, `.svg`
/// and
/// `.pdf`.
Result<void> write_plots(const std::filesystem::path& stem, std::vector<Plot> plots,
                         const std::string& title, const std::string& name, const Print& print);

// Shells under point loads, next to one another [Baek 2018, Fig. 4C-D].

/// The shells at their last frame, seen from the style's camera, rods coloured by |u|/delta_0 under
/// one colour bar, as lines. Progress and errors as write_stills.
Result<PanelFigure> draw_pushes(const std::vector<NetRun>& runs, const MovieStyle& style,
                                Watch& watch);

/// Force against depth over all frames, N and mm: how each shell resists. Where one snapped, the
/// states before and after are joined by a dashed line.
Plot force_plot(const std::vector<NamedRun>& runs);

/// K of the cells in bins of x/L at the last frame over the grey ones of the first, a plot a run on
/// one scale, `title` (plain text; may be empty) above. Writes `<stem>.png` and `<stem>.svg`.
Result<void> write_push_bins(const std::filesystem::path& stem, const std::vector<NamedRun>& runs,
                             const std::string& title, const Print& print = {});

}  // namespace gridshell::render
