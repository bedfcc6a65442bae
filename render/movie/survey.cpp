#include "render/movie/survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/movie/boundary.h"
#include "render/movie/load_marks.h"

namespace gridshell::render {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// evenly spread directions (a Fibonacci lattice on the sphere), one a row
Eigen::MatrixX3d even_directions(int count) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  Eigen::MatrixX3d directions(count, 3);
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, r = std::sqrt(1 - z * z);
    directions.row(k) << r * std::cos(golden * k), r * std::sin(golden * k), z;
  }
  return directions;
}

double lowest(const Eigen::Matrix3Xd& points) {
  return points.cols() > 0 ? points.row(2).minCoeff() : infinity;
}

// the largest size of each value so far, and the extent of all
void take_values(const Eigen::ArrayXd& values, Eigen::ArrayXd& most, Interval& extent) {
  const Eigen::ArrayXd known = values.isFinite().select(values, 0.0);
  if (most.size() != known.size()) most = Eigen::ArrayXd::Zero(known.size());
  most = most.max(known.abs());
  for (double value : known) extent.take(value);
}

MarkKind kind_of(const record::Frame& frame) {
  if (frame.event.starts_with("snap")) return MarkKind::snap;
  if (frame.event.starts_with("locking")) return MarkKind::lock;
  if (std::isfinite(frame.time_s)) return MarkKind::motion;
  return frame.negative_pivots > 0 ? MarkKind::unstable : MarkKind::other;
}

}  // namespace

void Interval::take(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

void Interval::take(const Interval& other) {
  take(other.low);
  take(other.high);
}

FrameSource source_of(const record::Trajectory& run) {
  return {&run.layout, int(run.frames.size()), [&run](int k) -> Result<record::Frame> {
            const record::Frame& frame = run.frames[std::size_t(k)];
            if (run.frames.fault()) return tl::unexpected(*run.frames.fault());
            return frame;
          }};
}

Survey::Survey(const record::Layout& layout)
    : lowest_z_mm(std::min(lowest(layout.original_boundary), lowest(layout.actuated_boundary))),
      layout_(&layout),
      directions_(even_directions(128)),
      farthest_(Eigen::VectorXd::Constant(directions_.rows(), -infinity)),
      extremes_(Eigen::Matrix3Xd::Zero(3, directions_.rows())) {}

void Survey::take(const record::Frame& frame) {
  if (frames == 0) first = frame;
  // rods are smooth: every few nodes bound them well enough
  const long stride = std::max<long>(1, frame.nodes.cols() / 600);
  for (long n = 0; n < frame.nodes.cols(); n += stride) take_point(frame.nodes.col(n));
  for (const LoadArrow& arrow : load_arrows(*layout_, frame)) {
    take_point(arrow.from);
    take_point(arrow.to);
  }
  lowest_z_mm = std::min(lowest_z_mm, lowest(frame.nodes));
  if (frame.depth_mm > depth_mm) depth_mm = frame.depth_mm;
  for (long k = 0; k < frame.K_bins.rows(); ++k)
    for (const double sign : {-1.0, 1.0})
      bins_rad.take(frame.K_bins(k, 0) + sign * frame.K_bins(k, 1));
  take_values(frame.cell_K, most_K, K);
  if (first.cell_K.size() == frame.cell_K.size())
    take_values(frame.cell_K - first.cell_K, most_K_change, K_change);
  if (first.nodes.cols() == frame.nodes.cols())
    for (const record::Joint& joint : layout_->joints)
      if (joint.node < frame.nodes.cols())
        largest_move_mm = std::max(
            largest_move_mm, (frame.nodes.col(joint.node) - first.nodes.col(joint.node)).norm());
  if (const MarkKind kind = kind_of(frame); kind != MarkKind::other)
    marks.push_back({frames, kind});
  ++frames;
}

void Survey::take_point(const Eigen::Vector3d& point) {
  if (!point.allFinite()) return;
  const Eigen::VectorXd reach = directions_ * point;
  for (long d = 0; d < reach.size(); ++d)
    if (reach[d] > farthest_[d]) farthest_[d] = reach[d], extremes_.col(d) = point;
}

Eigen::Matrix3Xd Survey::bounds() const {
  const bool shown = frames == 0 || shows_original(first);
  const Eigen::Matrix3Xd& original =
      shown ? layout_->original_boundary : layout_->actuated_boundary;
  Eigen::Matrix3Xd all(3, extremes_.cols() + original.cols() + layout_->actuated_boundary.cols());
  all << extremes_, original, layout_->actuated_boundary;
  return all;
}

Result<Survey> survey_of(const FrameSource& source) {
  Survey survey(*source.layout);
  for (int k = 0; k < source.count; ++k) {
    const auto frame = source.at(k);
    if (!frame) return tl::unexpected(frame.error());
    survey.take(*frame);
  }
  return survey;
}

Survey survey_of(const record::Trajectory& run) {
  Survey survey(run.layout);
  for (const record::Frame& frame : run.frames) survey.take(frame);
  return survey;
}

}  // namespace gridshell::render
