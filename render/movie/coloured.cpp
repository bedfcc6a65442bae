#include "render/movie/coloured.h"

#include <fmt/format.h>

#include "engine/record/net_deviation.h"
#include "engine/record/rod_values.h"

namespace gridshell::render {
namespace {

Eigen::VectorXd change_of_K(const record::Frame& first, const record::Frame& frame) {
  if (first.cell_K.size() != frame.cell_K.size()) return {};
  return frame.cell_K - first.cell_K;
}

Eigen::VectorXd move_over_depth(const ColourOrigin& from, const record::Frame& frame) {
  if (from.depth_mm <= 0 || from.first.nodes.cols() != frame.nodes.cols())
    return Eigen::VectorXd::Zero(frame.nodes.cols());
  return (frame.nodes - from.first.nodes).colwise().norm() / from.depth_mm;
}

}  // namespace

bool of_cells(ColourBy by) {
  switch (by) {
    case ColourBy::K:
    case ColourBy::K_change:
    case ColourBy::deviation:
      return true;
    case ColourBy::none:
    case ColourBy::displacement:
    case ColourBy::energy:
    case ColourBy::axial_force:
      return false;
  }
  return false;
}

bool may_lack(ColourBy by) {
  switch (by) {
    case ColourBy::none:
    case ColourBy::K:
    case ColourBy::K_change:
    case ColourBy::displacement:
      return false;
    case ColourBy::deviation:
    case ColourBy::energy:
    case ColourBy::axial_force:
      return true;
  }
  return false;
}

Eigen::VectorXd coloured_values(ColourBy by, const record::Layout& layout,
                                const record::Frame& frame, const ColourOrigin& from) {
  switch (by) {
    case ColourBy::none:
      return {};
    case ColourBy::K:
      return frame.cell_K;
    case ColourBy::K_change:
      return change_of_K(from.first, frame);
    case ColourBy::deviation:
      return record::deviation_of_cells(layout, frame);
    case ColourBy::displacement:
      return move_over_depth(from, frame);
    case ColourBy::energy:
      return record::bending_of_nodes_mJ_per_m(layout, frame);
    case ColourBy::axial_force:
      return record::axial_force_of_nodes_N(layout, frame);
  }
  return {};
}

tl::unexpected<Error> nothing_coloured(ColourBy by) {
  const std::string asked = fmt::format("[movie] colour_by = \"{}\"", word_of(by));
  if (by == ColourBy::deviation)
    return fail(Fault::bad_input, asked + ": the run has no net that its shell could lie off");
  return fail(Fault::bad_input,
              fmt::format("{}: no frame of the run knows the rods' {}, as runs of an older version "
                          "and of a net do not; run it again",
                          asked, by == ColourBy::axial_force ? "axial forces" : "bending energy"));
}

}  // namespace gridshell::render
