// Shells beside the nets they were designed on, in space [Baek 2018, Figs. 3 and 4A].
#pragma once

#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/record/snapshot.h"
#include "render/draw/renderer.h"
#include "render/movie/style.h"
#include "render/plot/panels.h"

namespace gridshell::render {

/// A run shown by its last frame, over its net if its layout knows one.
struct NetRun {
  const record::Trajectory* run = nullptr;
  std::string caption;            ///< marked text
  Eigen::Matrix3Xd scanned = {};  ///< joints measured on a real shell, mm, in the net's frame
};

/// Distance of every node of the last frame from its place on the net, over rho.
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
void dress_for_scan(const Eigen::Matrix3Xd& measured, Drawing& drawing);

/// What its red joints stand for.
ColourKey scan_key();

/// The shells, dark, over their nets, blue, with the joints scanned, red, at most `columns` side by
/// side. Progress and errors as write_stills.
Result<PanelFigure> draw_over_nets(const std::vector<NetRun>& runs, const MovieStyle& style,
                                   Renderer& renderer, Watch& watch, int columns = 3);

/// The shells coloured by their deviation, side by side with one colour bar.
Result<PanelFigure> draw_deviations(const std::vector<NetRun>& runs, const MovieStyle& style,
                                    Renderer& renderer, Watch& watch, int columns = 3);

}  // namespace gridshell::render
