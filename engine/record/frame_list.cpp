#include "engine/record/frame_list.h"

namespace gridshell::record {
namespace {

// what a list with a source keeps of the frames asked for last
constexpr std::size_t kept_bytes = std::size_t(64) << 20, kept_frames = 8;

std::size_t bytes_of(const Frame& frame) {
  return sizeof(Frame) +
         sizeof(double) *
             std::size_t(frame.nodes.size() + frame.cell_K.size() + frame.K_bins.size() +
                         frame.axial_force_N.size() + frame.curvature_per_mm.size() +
                         frame.bending_mJ_per_m.size() + frame.reactions_N.size());
}

}  // namespace

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

std::vector<Frame>& FrameList::in_memory() {
  if (!source_) return frames_;
  std::vector<Frame> all;
  for (std::size_t k = 0; k < size(); ++k) all.push_back(std::as_const(*this)[k]);
  auto fault = std::move(fault_);
  *this = FrameList(std::move(all));
  fault_ = std::move(fault);
  return frames_;
}

}  // namespace gridshell::record
