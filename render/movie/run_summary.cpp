#include "render/movie/run_summary.h"

#include <Eigen/Geometry>
#include <limits>
#include <span>

namespace gridshell::render {
namespace {

constexpr double gap_mm = 2.5;  // between joint and arrow
constexpr int many_loads = 25;  // fewer are no load of an area

/// An arrow at a node with the length and direction of `arrow`, outside the shell.
LoadArrow arrow_at(const record::Layout& layout, const record::Frame& frame, int node,
                   const Eigen::Vector3d& arrow, double gap) {
  const Eigen::Vector3d middle = layout.actuated_boundary.rowwise().mean(),
                        at = frame.nodes.col(node);
  const Eigen::Vector3d along = arrow.normalized();
  // with a margin, so that round-off does not decide in a flat shell
  const bool away = along.dot(at - middle) > 0.02 * layout.length_scale_mm;
  const Eigen::Vector3d near = at + (away ? gap : -gap) * along;
  return away ? LoadArrow{node, near, near + arrow} : LoadArrow{node, near - arrow, near};
}

/// Arrows of one length with their tips at the nodes that are nearest to the middles of even
/// squares of the flat footprint, so that a load on an area does not look like point loads.
std::vector<LoadArrow> area_arrows(const record::Layout& layout, const record::Frame& frame,
                                   Eigen::Index known) {
  constexpr int squares = 5;  // per side of the box around the footprint
  const auto nodes = std::span(layout.supports).first(std::size_t(known));
  const Eigen::Matrix3Xd& flat = layout.flat_nodes.cols() > 0 ? layout.flat_nodes : frame.nodes;
  const auto at = [&](int node) { return Eigen::Vector2d(flat.col(node).head<2>()); };
  Eigen::AlignedBox2d box;
  for (const int node : nodes) box.extend(at(node));
  const Eigen::Vector2d side = box.sizes() / squares;
  std::vector<LoadArrow> arrows;
  for (int k = 0; k < squares * squares; ++k) {
    const Eigen::Vector2d middle =
        box.min() + side.cwiseProduct(Eigen::Vector2d(k % squares + 0.5, k / squares + 0.5));
    const auto nearest = std::ranges::min_element(
        nodes, {}, [&](int node) { return (at(node) - middle).squaredNorm(); });
    const Eigen::Vector3d load = frame.loads_N.col(nearest - nodes.begin());
    const Eigen::Vector3d tip = frame.nodes.col(*nearest);
    if (((at(*nearest) - middle).array().abs() < 0.35 * side.array()).all() && !load.isZero(0))
      arrows.push_back({*nearest, tip - longest_force(layout) * load.normalized(), tip});
  }
  return arrows;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

// every n-th element, at most `most` of them
template <class T>
std::vector<T> thinned(const std::vector<T>& all, std::size_t most) {
  const std::size_t stride = std::max<std::size_t>(1, (all.size() + most - 1) / most);
  std::vector<T> some;
  for (std::size_t k = 0; k < all.size(); k += stride) some.push_back(all[k]);
  return some;
}

// adds points that divide a rod into eighths between two joints, or between a joint and an end
void add_rod_points(const std::vector<int>& rod, const std::vector<char>& joint,
                    std::vector<RodSample>& points) {
  constexpr std::size_t parts = 8;
  for (std::size_t from = 0, to = 1; to < rod.size(); ++to) {
    if (!joint[std::size_t(rod[to])] && to + 1 < rod.size()) continue;
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t eighths = (to - from) * part, node = from + eighths / parts;
      points.push_back({rod[node], rod[node + 1], double(eighths % parts) / parts});
    }
    from = to;
  }
  if (!rod.empty()) points.push_back({rod.back(), rod.back(), 0});
}

std::vector<RodSample> rod_points(const record::Layout& layout) {
  std::vector<char> joint(std::size_t(node_count_of(layout)), 0);
  for (const record::Joint& at : layout.joints) joint[std::size_t(at.node)] = 1;
  std::vector<RodSample> points;
  for (const auto& rod : layout.rods) add_rod_points(rod, joint, points);
  return points;
}

// points that represent a frame: of the rods, and of the arrows of loads
Eigen::Matrix3Xd points_of(const record::Layout& layout, const std::vector<RodSample>& rods,
                           const record::Frame& frame, double largest_N) {
  std::vector<Eigen::Vector3d> points;
  const auto add = [&](const Eigen::Vector3d& point) {
    if (point.allFinite()) points.push_back(point);
  };
  for (const RodSample& at : rods)
    if (std::max(at.from, at.to) < frame.nodes.cols())
      add((1 - at.part) * frame.nodes.col(at.from) + at.part * frame.nodes.col(at.to));
  for (const LoadArrow& arrow : load_arrows(layout, frame)) add(arrow.from), add(arrow.to);
  for (const LoadArrow& arrow : force_arrows(layout, frame, largest_N))
    add(arrow.from), add(arrow.to);
  Eigen::Matrix3Xd all(3, points.size());
  for (std::size_t k = 0; k < points.size(); ++k) all.col(long(k)) = points[k];
  return all;
}

double lowest(const Eigen::Matrix3Xd& points) {
  return points.cols() > 0 ? points.row(2).minCoeff() : infinity;
}

MarkKind kind_of(const record::Frame& frame) {
  if (frame.event.starts_with("snap")) return MarkKind::snap;
  if (frame.event.starts_with("locking")) return MarkKind::lock;
  if (std::isfinite(frame.time_s)) return MarkKind::motion;
  return frame.negative_pivots > 0 ? MarkKind::unstable : MarkKind::other;
}

}  // namespace

Eigen::Matrix3Xd boundary_at(const record::Layout& layout, double actuation) {
  return layout.original_boundary +
         actuation * (layout.actuated_boundary - layout.original_boundary);
}

bool load_acts(const record::LoadedJoint& load, const record::Layout& layout,
               const record::Frame& frame) {
  if (!load.at_times || frame.reactions_N.cols() != Eigen::Index(layout.supports.size()))
    return true;
  const int node = layout.joints.at(std::size_t(load.joint)).node;
  const auto support = std::ranges::find(layout.supports, node);
  return support == layout.supports.end() ||
         !frame.reactions_N.col(support - layout.supports.begin()).isZero(0);
}

std::vector<LoadArrow> load_arrows(const record::Layout& layout, const record::Frame& frame) {
  std::vector<LoadArrow> arrows;
  if (layout.loaded_joints.empty() || layout.actuated_boundary.cols() == 0) return arrows;
  const double length = 0.25 * layout.length_scale_mm;
  for (const record::LoadedJoint& load : layout.loaded_joints) {
    const int node = layout.joints.at(std::size_t(load.joint)).node;
    if (node < frame.nodes.cols() && load_acts(load, layout, frame))
      arrows.push_back(arrow_at(layout, frame, node, length * load.direction, gap_mm));
  }
  return arrows;
}

std::vector<LoadArrow> force_arrows(const record::Layout& layout, const record::Frame& frame,
                                    double largest_N) {
  std::vector<LoadArrow> arrows;
  if (!(largest_N > 0) || layout.actuated_boundary.cols() == 0) return arrows;
  const auto known = std::min<Eigen::Index>(frame.loads_N.cols(), long(layout.supports.size()));
  if (loads_all_alike(frame)) return area_arrows(layout, frame, known);
  for (Eigen::Index k = 0; k < known; ++k) {
    const Eigen::Vector3d force = frame.loads_N.col(k) / largest_N;
    const int node = layout.supports[std::size_t(k)];
    if (force.norm() > 0.01 && node < frame.nodes.cols())
      arrows.push_back(arrow_at(layout, frame, node, longest_force(layout) * force, 0));
  }
  return arrows;
}

Eigen::Matrix3Xd small_loads(const record::Frame& frame) {
  const Eigen::RowVectorXd size = frame.loads_N.colwise().norm();
  const double largest = size.size() > 0 ? size.maxCoeff() : 0;
  std::vector<Eigen::Index> small;
  for (Eigen::Index k = 0; k < size.size(); ++k)
    if (size[k] > 0 && size[k] < 0.1 * largest) small.push_back(k);
  if (std::ssize(small) < many_loads) small.clear();
  return frame.loads_N(Eigen::all, small);
}

bool loads_all_alike(const record::Frame& frame) {
  constexpr double least_cosine = 0.98;
  const Eigen::Vector3d sum = frame.loads_N.rowwise().sum();
  int count = 0;
  for (const auto& load : frame.loads_N.colwise()) {
    const double size = load.norm();
    if (size == 0) continue;
    if (load.dot(sum) < least_cosine * size * sum.norm()) return false;
    ++count;
  }
  // a load that is much larger than the others is a point load
  return count >= many_loads && frame.loads_N.colwise().norm().maxCoeff() < 10 * sum.norm() / count;
}

void Interval::take(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

void Interval::take(const Interval& other) {
  take(other.low);
  take(other.high);
}

void ColouredRange::take(const Eigen::VectorXd& values, bool counts) {
  if (values.size() == 0) return;
  for (const double value : values) all.take(value);
  if (!counts) return;
  const Eigen::ArrayXd known = values.array().isFinite().select(values.array(), 0.0);
  // frames on a finer mesh have more values
  const Eigen::Index before = most.size();
  if (before < known.size()) {
    most.conservativeResize(known.size());
    most.tail(known.size() - before).setZero();
  }
  most.head(known.size()) = most.head(known.size()).max(known.abs());
}

FrameSource source_of(const record::Trajectory& run) {
  return {&run.layout, int(run.frames.size()), [&run](int k) -> Result<record::Frame> {
            const record::Frame& frame = run.frames[std::size_t(k)];
            if (run.frames.fault()) return tl::unexpected(*run.frames.fault());
            return frame;
          }};
}

long node_count_of(const record::Layout& layout) {
  int largest = -1;
  for (const std::vector<int>& rod : layout.rods)
    for (int node : rod) largest = std::max(largest, node);
  for (const record::Joint& joint : layout.joints) largest = std::max(largest, joint.node);
  return long(largest) + 1;
}

RunSummary::RunSummary(const record::Layout& layout, const record::Frame* origin)
    : lowest_z_mm(std::min(lowest(layout.original_boundary), lowest(layout.actuated_boundary))),
      support_z_mm(lowest_z_mm),
      layout_(&layout),
      rod_points_(thinned(rod_points(layout), 600)) {
  if (origin) first = *origin;
}

void RunSummary::take(const record::Frame& frame) {
  if (frames == 0 && first.nodes.cols() == 0) first = frame;
  if (frame.loads_N.cols() > 0)
    largest_load_N = std::max(largest_load_N, frame.loads_N.colwise().norm().maxCoeff());
  arrows_to_scale |= frame.loads_N.cols() > 0 && !loads_all_alike(frame);
  any_contacts |= frame.contacts > 0;
  sample_points(frame);
  lowest_z_mm = std::min(lowest_z_mm, lowest(frame.nodes));
  depths_mm_.push_back(frame.depth_mm);
  radii_mm_.push_back(frame.boundary_radius_mm);
  if (frame.depth_mm > depth_mm) depth_mm = frame.depth_mm;
  for (long k = 0; k < frame.K_bins.rows(); ++k)
    for (const double sign : {-1.0, 1.0})
      bins_rad.take(frame.K_bins(k, 0) + sign * frame.K_bins(k, 1));
  if (frame.K_bins.rows() == first.K_bins.rows())
    for (long k = 0; k < frame.K_bins.rows(); ++k)
      bins_change_rad.take(frame.K_bins(k, 0) - first.K_bins(k, 0));
  // a shell is near its net only when its boundary is: earlier frames do not set the scale
  if (frame.actuation > largest_actuation_)
    spreads_[std::size_t(ColourBy::deviation)].most.setZero();
  largest_actuation_ = std::max(largest_actuation_, frame.actuation);
  for (const auto& entry : words_of<ColourBy>()) {
    const bool counts = entry.value != ColourBy::deviation || frame.actuation == largest_actuation_;
    if (entry.value != ColourBy::displacement)
      spreads_[std::size_t(entry.value)].take(
          coloured_values(entry.value, *layout_, frame, {first}), counts);
  }
  if (first.nodes.cols() == frame.nodes.cols())
    for (const record::Joint& joint : layout_->joints)
      if (joint.node < frame.nodes.cols())
        largest_move_mm = std::max(
            largest_move_mm, (frame.nodes.col(joint.node) - first.nodes.col(joint.node)).norm());
  if (frame.reactions_N.cols() == Eigen::Index(layout_->supports.size()))
    for (std::size_t k = 0; k < layout_->supports.size(); ++k)
      if (!frame.reactions_N.col(Eigen::Index(k)).isZero(0)) supported.insert(layout_->supports[k]);
  if (const MarkKind kind = kind_of(frame); kind != MarkKind::other)
    marks.push_back({frames, kind});
  if (frame.contacts > 0) marks.push_back({frames, MarkKind::contact});
  ++frames;
}

ProgressAxis RunSummary::progress() const {
  const auto along = [](const std::vector<double>& values, const char* name) {
    ProgressAxis axis{name, values.front(), values.back(), {}};
    const double range = axis.last - axis.first;
    for (const double value : values) {
      const double position = (value - axis.first) / range;
      // the comparison is also false for NaN
      if (!(position >= (axis.positions.empty() ? 0 : axis.positions.back()) && position <= 1))
        return ProgressAxis{};
      axis.positions.push_back(position);
    }
    return axis;
  };
  ProgressAxis axis;
  if (turn_deg > 0) {
    axis = {"angle", 0, turn_deg, {}, "°"};
  } else if (frames > 1) {
    axis = along(depths_mm_, "*δ*");
    if (axis.positions.empty()) axis = along(radii_mm_, "*R*_{a}");
  }
  while (int(axis.positions.size()) < frames)
    axis.positions.push_back(double(axis.positions.size()) / std::max(1, frames - 1));
  return axis;
}

void RunSummary::sample_points(const record::Frame& frame) {
  last_ = points_of(*layout_, rod_points_, frame, largest_load_N);
  if (frames % sample_stride_ != 0) return;
  sampled_points_.push_back(last_);
  constexpr std::size_t most_frames = 32;
  if (sampled_points_.size() <= most_frames) return;
  // shells move smoothly, so that half of the frames bounds them as well
  for (std::size_t k = 1; 2 * k < sampled_points_.size(); ++k)
    sampled_points_[k] = std::move(sampled_points_[2 * k]);
  sampled_points_.resize((sampled_points_.size() + 1) / 2);
  sample_stride_ *= 2;
}

Eigen::Matrix3Xd RunSummary::bounds() const {
  const bool shown = frames == 0 || original_boundary_shown(first);
  std::vector<const Eigen::Matrix3Xd*> parts{&layout_->actuated_boundary, &last_};
  if (shown) parts.push_back(&layout_->original_boundary);
  for (const Eigen::Matrix3Xd& points : sampled_points_) parts.push_back(&points);
  long count = 0;
  for (const Eigen::Matrix3Xd* part : parts) count += part->cols();
  Eigen::Matrix3Xd all(3, count);
  count = 0;
  for (const Eigen::Matrix3Xd* part : parts) {
    all.middleCols(count, part->cols()) = *part;
    count += part->cols();
  }
  return all;
}

RunSummary summarise_run(const record::Trajectory& run, const record::Frame* origin) {
  RunSummary survey(run.layout, origin);
  for (const record::Frame& frame : run.frames) survey.take(frame);
  return survey;
}

}  // namespace gridshell::render
