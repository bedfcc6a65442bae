#include "engine/record/trajectory.h"

#include <cmath>

#include "engine/core/try.h"
#include "engine/record/frame_columns.h"

namespace gridshell::record {
namespace {

// a list with a source caches recently used frames until there are more than both limits
constexpr std::size_t kept_bytes = std::size_t(64) << 20, kept_frames = 8;

std::size_t bytes_of(const Frame& frame) {
  std::size_t bytes = sizeof(Frame);
  visit_matrices(frame,
                 [&](const auto& values) { bytes += sizeof(double) * std::size_t(values.size()); });
  return bytes;
}

Result<void> check_indices(const Layout& layout, Eigen::Index nodes) {
  const auto joints = static_cast<Eigen::Index>(layout.joints.size());
  const auto itself = [](int index) { return std::array{index}; };
  const auto all = [](const auto& indices) -> const auto& { return indices; };
  // checks the indices of each owner, which refer to `count` parts of a kind
  const auto check = [](const char* owner, const auto& owners, const auto& named, const char* kind,
                        Eigen::Index count) -> Result<void> {
    for (std::size_t k = 0; k < owners.size(); ++k)
      for (const int index : named(owners[k]))
        if (index < 0 || index >= count)
          return invalid("{} {}: got {} {}, expected 0 to {}", owner, k, kind, index, count - 1);
    return {};
  };
  const auto node = [](const Joint& joint) { return std::array{joint.node}; };
  const auto corners = [](const Cell& cell) { return cell.joints; };
  const auto pushed = [](const LoadedJoint& loaded) { return std::array{loaded.joint}; };
  TRY_DO(check("rod", layout.rods, all, "node", nodes));
  TRY_DO(check("joint", layout.joints, node, "node", nodes));
  TRY_DO(check("edge point", layout.edge_points, itself, "node", nodes));
  TRY_DO(check("support", layout.supports, itself, "node", nodes));
  TRY_DO(check("spring", layout.sprung, itself, "node", nodes));
  TRY_DO(check("joint's second rod", layout.above, itself, "node", nodes));
  TRY_DO(check("cell", layout.cells, corners, "joint", joints));
  TRY_DO(check("loaded joint", layout.loaded_joints, pushed, "joint", joints));
  for (const Part& part : layout.parts) {
    if (part.net.cols() != part.flat.cols())
      return invalid("block \"{}\" has {} points on its net and {} in the flat", part.name,
                     part.net.cols(), part.flat.cols());
    TRY_DO(check("rod", part.rods, all, "point", part.net.cols()));
  }
  return {};
}

// largest coordinate: products of coordinates must stay finite
constexpr double largest_mm = 1e9;

bool computable(const Eigen::Matrix3Xd& points) {
  return points.size() == 0 || points.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= largest_mm;
}

Result<void> check_numbers(const Layout& layout) {
  const auto refuse = [](const char* what) {
    return invalid("{}: got a number that is no length in mm", what);
  };
  for (const double length : {layout.spacing_mm, layout.rod_diameter_mm, layout.length_scale_mm})
    if (!(length >= 0 && length <= largest_mm)) return refuse("/layout");
  for (const double diameter : layout.diameters_mm)
    if (!(diameter >= 0 && diameter <= largest_mm)) return refuse("a rod's diameter");
  for (const double side : layout.laths_mm)
    if (!(side >= 0 && side <= largest_mm)) return refuse("a lath's side");
  if (!computable(layout.original_boundary) || !computable(layout.actuated_boundary))
    return refuse("a boundary");
  if (!computable(layout.net_nodes) || !computable(layout.flat_nodes)) return refuse("the net");
  for (const Part& part : layout.parts)
    if (!computable(part.net) || !computable(part.flat)) return refuse("a block");
  if (!(layout.spring_N_per_mm.array() >= 0).all() || !layout.spring_N_per_mm.allFinite())
    return invalid("a spring's stiffness: got a number that is none");
  for (const Joint& joint : layout.joints)
    if (!(std::max(std::abs(joint.u_mm), std::abs(joint.v_mm)) <= largest_mm))
      return refuse("a joint");
  for (const LoadedJoint& load : layout.loaded_joints)
    if (!(std::abs(load.direction.norm() - 1) <= 1e-6))
      return invalid("the direction of a loaded joint is no unit vector");
  return {};
}

// rods are paths over the nodes, and most nodes are on one or two rods: longer lists are refused
Result<void> check_sizes(const Layout& layout, Eigen::Index nodes) {
  Eigen::Index named = 0, most = 0;
  for (std::size_t k = 0; k < layout.rods.size(); ++k) {
    const std::vector<int>& rod = layout.rods[k];
    if (rod.size() < 2) return invalid("rod {}: got {} nodes, expected at least 2", k, rod.size());
    named += Eigen::Index(rod.size());
    for (const int node : rod) most = std::max<Eigen::Index>(most, node + 1);
  }
  if (named > 4 * nodes) return invalid("the rods name {} nodes of {}", named, nodes);
  most = std::max<Eigen::Index>(most, Eigen::Index(layout.joints.size()));
  const auto fits = [](std::size_t given, const char* named, const auto& owners, const char* of,
                       std::size_t each = 1) -> Result<void> {
    if (given == 0 || given == each * owners.size()) return {};
    return invalid("{} {} for {} {}", given, named, owners.size(), of);
  };
  TRY_DO(fits(layout.families.size(), "families are named", layout.rods, "rods"));
  TRY_DO(fits(layout.strength_MPa.size(), "strengths are given", layout.rods, "rods"));
  TRY_DO(fits(layout.diameters_mm.size(), "diameters are given", layout.rods, "rods"));
  TRY_DO(fits(layout.laths_mm.size(), "widths and thicknesses are given", layout.rods, "rods", 2));
  TRY_DO(fits(layout.above.size(), "second nodes are named", layout.joints, "joints"));
  TRY_DO(fits(std::size_t(layout.spring_N_per_mm.cols()), "stiffnesses are given", layout.sprung,
              "springs"));
  for (const auto* net : {&layout.net_nodes, &layout.flat_nodes})
    if (net->cols() > 0 && net->cols() < most)
      return invalid("the net: got {} nodes, expected {} as in the shell", net->cols(), most);
  return {};
}

}  // namespace

Frame without_nodes(const Frame& frame) {
  Frame head = frame;
  visit_matrices(head, []<class Matrix>(Matrix& values) { values = Matrix(); });
  head.K_bins = frame.K_bins;
  return head;
}

FrameList::FrameList(std::initializer_list<Frame> frames) : frames_(frames) {}
FrameList::FrameList(std::vector<Frame> frames) : frames_(std::move(frames)) {}

void FrameList::push_back(Frame frame) { edit().push_back(std::move(frame)); }

Result<void> MemorySink::begin(Layout layout) {
  trajectory_ = {std::move(layout), {}};
  return {};
}

Result<void> MemorySink::take(Frame frame) {
  auto& frames = trajectory_.frames.edit();
  const auto after = std::ranges::upper_bound(frames, frame.index, {}, &Frame::index);
  frames.insert(after, std::move(frame));
  return {};
}

FrameList::FrameList(std::shared_ptr<const FrameSource> source) : source_(std::move(source)) {}

const Frame& FrameList::operator[](std::size_t k) const {
  if (!source_) return frames_[k];
  if (k == 0) {
    if (!first_) first_ = fetch(k);
    return *first_;
  }
  if (k + 1 == source_->size()) {
    if (!last_) last_ = fetch(k);
    return *last_;
  }
  for (auto at = recent_.begin(); at != recent_.end(); ++at)
    if (at->k == k) {
      recent_.splice(recent_.begin(), recent_, at);
      return *recent_.front().frame;
    }
  auto frame = fetch(k);
  recent_.push_front({k, bytes_of(*frame), frame});
  bytes_ += recent_.front().bytes;
  while (recent_.size() > kept_frames && bytes_ > kept_bytes) {
    bytes_ -= recent_.back().bytes;
    recent_.pop_back();
  }
  return *recent_.front().frame;
}

std::shared_ptr<const Frame> FrameList::fetch(std::size_t k) const {
  auto frame = source_->read(k);
  if (frame) return std::make_shared<const Frame>(std::move(*frame));
  if (!fault_) fault_ = frame.error();
  return std::make_shared<const Frame>();
}

std::vector<Frame>& FrameList::edit() {
  if (!source_) return frames_;
  std::vector<Frame> all;
  for (std::size_t k = 0; k < size(); ++k) all.push_back((*this)[k]);
  auto fault = std::move(fault_);
  *this = FrameList(std::move(all));
  fault_ = std::move(fault);
  return frames_;
}

Result<void> check_layout(const Layout& layout, Eigen::Index nodes) {
  if (layout.original_boundary.cols() != layout.actuated_boundary.cols())
    return invalid(
        "boundaries: got {} points of the original and {} of the actuated one, expected equal "
        "numbers",
        layout.original_boundary.cols(), layout.actuated_boundary.cols());
  TRY_DO(check_indices(layout, nodes));
  TRY_DO(check_sizes(layout, nodes));
  return check_numbers(layout);
}

Result<void> check_frame(const Layout& layout, const Frame& frame, std::size_t k,
                         Eigen::Index nodes) {
  const auto cells = static_cast<Eigen::Index>(layout.cells.size());
  if (frame.nodes.cols() != nodes)
    return invalid("frame {}: got {} nodes, expected {} as in the first one", k, frame.nodes.cols(),
                   nodes);
  if (frame.cell_K.size() != cells)
    return invalid("frame {}: got {} values of cell_K, expected {}", k, frame.cell_K.size(), cells);
  Result<void> fits;
  each_rod_field([&]<class Values>(const char* name, const char*, SizeOf size_of, const char*,
                                   Values Frame::*field) {
    const Eigen::Index values =
        Values::RowsAtCompileTime == 3 ? (frame.*field).cols() : (frame.*field).size();
    if (const Eigen::Index requested = size_of(layout); fits && values != 0 && values != requested)
      fits =
          invalid("{2} of frame {0}: got {1} values, expected {3}", k, values, name + 1, requested);
  });
  return fits;
}

Result<void> check_consistency(const Trajectory& trajectory) {
  const Layout& layout = trajectory.layout;
  const FrameList& frames = trajectory.frames;
  // without a frame the number of nodes is not known
  const Eigen::Index nodes = frames.empty() ? 0 : frames.front().nodes.cols();
  if (!frames.empty() || layout.original_boundary.cols() != layout.actuated_boundary.cols())
    TRY_DO(check_layout(layout, nodes));
  for (std::size_t k = 0; k < frames.size() && !frames.has_source(); ++k)
    TRY_DO(check_frame(layout, frames[k], k, nodes));
  return {};
}

}  // namespace gridshell::record
