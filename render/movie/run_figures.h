// Figures of shells in space: over the nets they were designed on [Baek 2018, Figs. 3 and 4A], of
// building blocks [Fig. 5] and under point loads [Fig. 4C-D].
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

/// The style without colours of a quantity, captions, inset and turn of the camera.
MovieStyle uncoloured(MovieStyle style);
/// A figure in a style, without panels.
PanelFigure empty_figure(const MovieStyle& style, int columns);
/// "A", "B", ... for panels 0, 1, ...; empty if the style has no letters.
std::string panel_letter(const MovieStyle& style, std::size_t k);

/// Letter, caption and size of a panel.
struct PanelText {
  bool lettered = false;
  std::string caption = {};  ///< text with markup
  double wider = 1;          ///< factor of the camera's extent over that of the stage
};
/// Adds a panel: the drawing from the stage's camera at its last frame. Without a renderer the
/// panel is lines; with one it is a picture, and lines too if the style has `vector`. Errors: the
/// renderer's; Fault::cancelled.
Result<void> add_panel(PanelFigure& figure, const Stage& stage, Drawing drawing,
                       const PanelText& text, Renderer* renderer, const Watch& watch);

/// A trajectory of the states `which` of a run, without the original boundary. They are no motion,
/// so that `style` shows no ghost of the first one.
record::Trajectory states_alone(const record::Trajectory& run,
                                const std::vector<std::size_t>& which, MovieStyle& style);

/// Distance of every node of the last frame from its position on the net, over the length scale
/// (rho). The layout must have a net.
Eigen::VectorXd last_deviation(const record::Trajectory& run);

/// The unit in which deviations are shown: per cent of rho or, for building blocks, millimetres.
struct DeviationUnit {
  double factor = 100;  ///< from a deviation over the length scale to this unit
  std::string label;    ///< text with markup
};
DeviationUnit deviation_unit(const record::Layout& layout);

/// Whether the net is a part of a sphere about the origin, of radius rho.
bool on_sphere(const record::Layout& layout);

/// Adds measured joints (3 x n, mm, in the drawing's coordinates) in red, and makes the shell dark,
/// without joints of its own.
void show_measured_joints(const Eigen::Matrix3Xd& measured, Drawing& drawing);

/// The colour key of measured joints.
ColourKey scan_key();

/// A figure of shells (dark) over their nets (wider, orange) with measured joints (red), at most
/// `columns` side by side, as lines. Errors: those of check_showable(); Fault::cancelled.
Result<PanelFigure> draw_over_nets(const std::vector<NamedRun>& runs, const MovieStyle& style,
                                   Watch& watch, int columns = 3);

/// A figure of shells coloured by their deviation, with one colour bar, as lines. Errors: those of
/// draw_over_nets(). All runs must have a net.
Result<PanelFigure> draw_deviations(const std::vector<NamedRun>& runs, const MovieStyle& style,
                                    Watch& watch, int columns = 3);

// Building blocks, separate and joined [Baek 2018, Fig. 5].

/// The name of a block without the number that distinguishes it from equal ones: "quarter sphere".
std::string block_kind(const std::string& name);

/// The kinds of blocks of some runs, and their colours in all pictures of these runs.
class BlockKinds {
 public:
  explicit BlockKinds(const std::vector<NamedRun>& runs);
  Colour colour(const std::string& block) const;  ///< `block`: name of a block
  std::vector<ColourKey> keys() const;

 private:
  std::vector<std::string> kinds_;
};

/// A figure of blocks on their nets in one panel of lines: all blocks of a single run, separated,
/// or one block of each kind of several runs. Errors: those of draw_over_nets().
Result<PanelFigure> draw_blocks(const std::vector<NamedRun>& runs, const MovieStyle& style,
                                Watch& watch);

/// Draws the separate footprints of the blocks and below them the joined footprint, with its
/// original and (dashed) actuated boundary, into a box, at `scale` (units per mm); 0: as large as
/// fits.
void draw_block_footprints(Canvas& canvas, const Box& box, const record::Trajectory& run,
                           const BlockKinds& kinds, double scale = 0);
/// The largest scale (units per mm) at which draw_block_footprints() fits into a box.
double block_footprint_scale(const Box& box, const record::Trajectory& run);

/// Writes the drawing of draw_block_footprints() as `<stem>.png`, `.svg` and `.pdf`. Errors:
/// Fault::io.
Result<void> write_block_footprints(const std::filesystem::path& stem,
                                    const record::Trajectory& run, const std::string& title = "",
                                    const Print& print = {});

/// Two plots, of the gap and of the kink of every rod across a seam over its position along the
/// seam, with one marker per seam.
std::vector<Plot> seam_plots(const record::Trajectory& run);

/// Writes plots side by side, as many per row as are readable, as `<stem>.png`, `.svg` and `.pdf`.
/// The legend of the first one is above all, with `title` (plain text; may be empty); `name` is the
/// title in the files. There is at least one plot. Errors: Fault::io.
Result<void> write_plots(const std::filesystem::path& stem, std::vector<Plot> plots,
                         const std::string& title, const std::string& name, const Print& print);

// Shells under point loads [Baek 2018, Fig. 4C-D].

/// A figure of the shells at their last frame from the style's camera, with rods coloured by
/// |u|/delta_0 and one colour bar, as lines. Errors: those of draw_over_nets().
Result<PanelFigure> draw_pushes(const std::vector<NamedRun>& runs, const MovieStyle& style,
                                Watch& watch);

/// Force (N) over depth (mm) of all frames of each run. Dashed lines join the states before and
/// after a snap, dotted lines are unstable states. The largest force is marked if the force then
/// falls.
Plot force_plot(const std::vector<NamedRun>& runs);

/// Writes plots of K□ of the cells in bins of x/L at the last frame over the grey bars of the
/// first, one per run on one scale, with `title` (plain text; may be empty) above, as `<stem>.png`,
/// `.svg` and `.pdf`. Writes nothing if a run has no bins. Errors: Fault::io.
Result<void> write_push_bins(const std::filesystem::path& stem, const std::vector<NamedRun>& runs,
                             const std::string& title, const Print& print = {});

}  // namespace gridshell::render
