#include "engine/scene/block_design.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/preset/shape_consistency.h"

namespace gridshell {
namespace {

/// u + v along x, v - u along y: where rods of a surface of revolution lie on both sides of its
/// axis
FlatFrame common_frame() {
  FlatFrame frame;
  frame.axes << M_SQRT1_2, M_SQRT1_2, -M_SQRT1_2, M_SQRT1_2, 0, 0;
  return frame;
}

Result<Block> block_of(const preset::Block& wanted, const preset::Footprint& footprint) {
  auto design = net_design(wanted.net, footprint.spacing_mm);
  if (!design)
    return fail(design.error().fault,
                fmt::format("block \"{}\": {}", wanted.name, design.error().message));
  Block block;
  block.name = wanted.name;
  block.net = design->net;
  block.domain = std::move(design->domain);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  block.pose.linear() = common_frame().axes * design->flat.axes.transpose() + up * up.transpose();
  block.pose.translation().z() = -design->flat.origin.z();
  block.spacing = footprint.spacing_mm;
  block.placement = same_word<Placement>(footprint.placement);
  block.cut = {wanted.east, wanted.west, wanted.north, wanted.south};
  return block;
}

Result<BlockSide> block_side(const preset::Preset& preset, const std::string& name) {
  const auto side = preset::side_named(preset, name);
  const auto facing = side ? find_word<Side>(side->side) : std::nullopt;
  if (!facing) return fail(Fault::bad_input, fmt::format("\"{}\" is no side of a block", name));
  return BlockSide{side->block, *facing};
}

}  // namespace

Result<NetDesign> block_design(const preset::Preset& preset) {
  std::vector<Block> blocks;
  for (const preset::Block& wanted : preset.block) {
    auto block = block_of(wanted, preset.footprint);
    if (!block) return tl::unexpected(block.error());
    blocks.push_back(std::move(*block));
  }
  std::vector<Join> joins;
  for (const preset::Join& wanted : preset.join) {
    const auto first = block_side(preset, wanted.first), second = block_side(preset, wanted.second);
    if (!first) return tl::unexpected(first.error());
    if (!second) return tl::unexpected(second.error());
    joins.push_back({*first, *second});
  }
  auto whole = Assemblage::make(std::move(blocks), joins, preset.blocks.max_gap_mm);
  if (!whole) return tl::unexpected(whole.error());
  NetDesign design;
  design.net = whole->net();
  design.domain = whole->domain();
  design.flat = common_frame();
  const Eigen::Matrix2Xd ring = design.domain->boundary(256);
  design.scale_mm = 0.5 * (ring.rowwise().maxCoeff() - ring.rowwise().minCoeff()).norm();
  design.blocks = std::make_shared<const Assemblage>(std::move(*whole));
  return design;
}

}  // namespace gridshell
