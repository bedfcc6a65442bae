#include "engine/record/trajectory.h"

#include <cmath>

#include "engine/core/try.h"

namespace gridshell::record {
namespace {

// what a list with a source keeps of the frames asked for last
constexpr std::size_t kept_bytes = std::size_t(64) << 20, kept_frames = 8;

std::size_t bytes_of(const Frame& frame) {
  std::size_t bytes = sizeof(Frame);
  visit_matrices(frame,
                 [&](const auto& values) { bytes += sizeof(double) * std::size_t(values.size()); });
  return bytes;
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
  const auto after =
      std::upper_bound(frames.begin(), frames.end(), frame.index,
                       [](int index, const Frame& other) { return index < other.index; });
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

namespace {

Result<void> check_indices(const Layout& layout, Eigen::Index nodes) {
  const auto joints = static_cast<Eigen::Index>(layout.joints.size());
  const auto itself = [](int index) { return std::array{index}; };
  const auto all = [](const auto& indices) -> const auto& { return indices; };
  // the indices that each owner names, of `count` things of that kind
  const auto check = [](const char* owner, const auto& owners, const auto& named, const char* kind,
                        Eigen::Index count) -> Result<void> {
    for (std::size_t k = 0; k < owners.size(); ++k)
      for (const int index : named(owners[k]))
        if (index < 0 || index >= count)
          return fail(Fault::bad_input, "{} {} names {} {} of {}", owner, k, kind, index, count);
    return {};
  };
  const auto node = [](const Joint& joint) { return std::array{joint.node}; };
  const auto corners = [](const Cell& cell) { return cell.joints; };
  const auto pushed = [](const LoadedJoint& loaded) { return std::array{loaded.joint}; };
  TRY_DO(check("rod", layout.rods, all, "node", nodes));
  TRY_DO(check("joint", layout.joints, node, "node", nodes));
  TRY_DO(check("edge point", layout.edge_points, itself, "node", nodes));
  TRY_DO(check("support", layout.supports, itself, "node", nodes));
  TRY_DO(check("joint's second rod", layout.above, itself, "node", nodes));
  TRY_DO(check("cell", layout.cells, corners, "joint", joints));
  TRY_DO(check("loaded joint", layout.loaded_joints, pushed, "joint", joints));
  for (const Part& part : layout.parts) {
    if (part.net.cols() != part.flat.cols())
      return fail(Fault::bad_input, "block \"{}\" has {} points on its net and {} in the flat",
                  part.name, part.net.cols(), part.flat.cols());
    TRY_DO(check("rod", part.rods, all, "point", part.net.cols()));
  }
  return {};
}

// what coordinates may come to: their products must stay numbers
constexpr double largest_mm = 1e9;

bool computable(const Eigen::Matrix3Xd& points) {
  return points.size() == 0 || points.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= largest_mm;
}

Result<void> check_numbers(const Layout& layout) {
  const auto refuse = [](const char* what) {
    return fail(Fault::bad_input, "{} holds a number that is no length in mm", what);
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
  for (const Joint& joint : layout.joints)
    if (!(std::max(std::abs(joint.u_mm), std::abs(joint.v_mm)) <= largest_mm))
      return refuse("a joint");
  for (const LoadedJoint& load : layout.loaded_joints)
    if (!(std::abs(load.direction.norm() - 1) <= 1e-6))
      return fail(Fault::bad_input, "the direction of a loaded joint is no unit vector");
  return {};
}

// rods are paths over the nodes, a joint being on two: longer lists are nobody's shell
Result<void> check_sizes(const Layout& layout, Eigen::Index nodes) {
  Eigen::Index named = 0, most = 0;
  for (const auto& rod : layout.rods) {
    named += Eigen::Index(rod.size());
    for (const int node : rod) most = std::max<Eigen::Index>(most, node + 1);
  }
  if (named > 4 * nodes)
    return fail(Fault::bad_input, "the rods name {} nodes of {}", named, nodes);
  most = std::max<Eigen::Index>(most, Eigen::Index(layout.joints.size()));
  if (!layout.families.empty() && layout.families.size() != layout.rods.size())
    return fail(Fault::bad_input, "{} families are named for {} rods", layout.families.size(),
                layout.rods.size());
  if (!layout.strength_MPa.empty() && layout.strength_MPa.size() != layout.rods.size())
    return fail(Fault::bad_input, "{} strengths are given for {} rods", layout.strength_MPa.size(),
                layout.rods.size());
  if (!layout.diameters_mm.empty() && layout.diameters_mm.size() != layout.rods.size())
    return fail(Fault::bad_input, "{} diameters are given for {} rods", layout.diameters_mm.size(),
                layout.rods.size());
  if (!layout.laths_mm.empty() && layout.laths_mm.size() != 2 * layout.rods.size())
    return fail(Fault::bad_input, "{} widths and thicknesses are given for {} rods",
                layout.laths_mm.size(), layout.rods.size());
  if (!layout.above.empty() && layout.above.size() != layout.joints.size())
    return fail(Fault::bad_input, "{} second nodes are named for {} joints", layout.above.size(),
                layout.joints.size());
  for (const auto* net : {&layout.net_nodes, &layout.flat_nodes})
    if (net->cols() > 0 && net->cols() < most)
      return fail(Fault::bad_input, "the net has {} nodes, the shell {}", net->cols(), most);
  return {};
}

}  // namespace

Result<void> check_layout(const Layout& layout, Eigen::Index nodes) {
  if (layout.original_boundary.cols() != layout.actuated_boundary.cols())
    return fail(Fault::bad_input, "the original boundary has {} points, the actuated one {}",
                layout.original_boundary.cols(), layout.actuated_boundary.cols());
  TRY_DO(check_indices(layout, nodes));
  TRY_DO(check_sizes(layout, nodes));
  return check_numbers(layout);
}

Result<void> check_frame(const Layout& layout, const Frame& frame, std::size_t k,
                         Eigen::Index nodes) {
  const auto cells = static_cast<Eigen::Index>(layout.cells.size());
  if (frame.nodes.cols() != nodes)
    return fail(Fault::bad_input, "frame {} has {} nodes, the first one {}", k, frame.nodes.cols(),
                nodes);
  if (frame.cell_K.size() != cells)
    return fail(Fault::bad_input, "frame {} has {} values of cell_K for {} cells", k,
                frame.cell_K.size(), cells);
  const auto fits = [&](const char* what, Eigen::Index values,
                        Eigen::Index wanted) -> Result<void> {
    if (values == 0 || values == wanted) return {};
    return fail(Fault::bad_input, "frame {} has {} values of {}, must be {}", k, values, what,
                wanted);
  };
  TRY_DO(fits("axial_force_N", frame.axial_force_N.size(), edges_of_rods(layout)));
  TRY_DO(fits("curvature_per_mm", frame.curvature_per_mm.size(), points_of_rods(layout)));
  TRY_DO(fits("bending_mJ_per_m", frame.bending_mJ_per_m.size(), points_of_rods(layout)));
  TRY_DO(fits("stress_MPa", frame.stress_MPa.size(), points_of_rods(layout)));
  TRY_DO(fits("brace_force_N", frame.brace_force_N.size(), 2 * cells));
  const auto supports = Eigen::Index(layout.supports.size());
  TRY_DO(fits("loads_N", frame.loads_N.cols(), supports));
  return fits("reactions_N", frame.reactions_N.cols(), supports);
}

Result<void> check_consistency(const Trajectory& trajectory) {
  const Layout& layout = trajectory.layout;
  const FrameList& frames = trajectory.frames;
  // without a frame nobody knows how many nodes there are
  const Eigen::Index nodes = frames.empty() ? 0 : frames.front().nodes.cols();
  if (!frames.empty() || layout.original_boundary.cols() != layout.actuated_boundary.cols())
    TRY_DO(check_layout(layout, nodes));
  for (std::size_t k = 0; k < frames.size() && !frames.has_source(); ++k)
    TRY_DO(check_frame(layout, frames[k], k, nodes));
  return {};
}

}  // namespace gridshell::record
