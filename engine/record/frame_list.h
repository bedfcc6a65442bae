// The frames of a run in order: held in memory, or read from a file one at a time as they are asked
// for, so that a run of any length can be drawn and rewritten in bounded memory.
#pragma once

#include <initializer_list>
#include <iterator>
#include <list>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/record/frame.h"

namespace gridshell::record {

/// Frames that lie elsewhere.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual std::size_t size() const = 0;
  /// The k-th in order. Errors: io, bad_input when what is read is damaged.
  virtual Result<Frame> read(std::size_t k) const = 0;
};

/// Behaves as a const vector of frames whichever way they are kept, for one thread at a time.
/// References into a list with a source hold until some other eight frames have been asked for;
/// those to its first and last frame hold always. Whoever changes a list brings it into memory.
class FrameList {
 public:
  class const_iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Frame;
    using difference_type = std::ptrdiff_t;
    using pointer = const Frame*;
    using reference = const Frame&;

    const_iterator(const FrameList* list, std::size_t at) : list_(list), at_(at) {}
    const Frame& operator*() const { return (*list_)[at_]; }
    const Frame* operator->() const { return &(*list_)[at_]; }
    const_iterator& operator++() { return ++at_, *this; }
    bool operator==(const const_iterator& other) const { return at_ == other.at_; }

   private:
    const FrameList* list_;
    std::size_t at_;
  };

  FrameList() = default;
  FrameList(std::initializer_list<Frame> frames) : frames_(frames) {}
  FrameList(std::vector<Frame> frames) : frames_(std::move(frames)) {}
  explicit FrameList(std::shared_ptr<const FrameSource> source);

  std::size_t size() const { return source_ ? source_->size() : frames_.size(); }
  bool empty() const { return size() == 0; }
  const Frame& operator[](std::size_t k) const;
  const Frame& front() const { return (*this)[0]; }
  const Frame& back() const { return (*this)[size() - 1]; }
  const_iterator begin() const { return {this, 0}; }
  const_iterator end() const { return {this, size()}; }

  /// Why a frame could not be read, the first time that happened; it then stood for an empty one.
  const std::optional<Error>& fault() const { return fault_; }

  Frame& operator[](std::size_t k) { return in_memory()[k]; }
  Frame& front() { return in_memory().front(); }
  Frame& back() { return in_memory().back(); }
  auto begin() { return in_memory().begin(); }
  auto end() { return in_memory().end(); }
  void push_back(Frame frame) { in_memory().push_back(std::move(frame)); }
  void insert(std::vector<Frame>::iterator before, Frame frame) {
    in_memory().insert(before, std::move(frame));
  }
  void pop_back() { in_memory().pop_back(); }
  void resize(std::size_t size) { in_memory().resize(size); }
  void clear() { *this = FrameList(); }

 private:
  struct Kept {
    std::size_t k = 0, bytes = 0;
    std::shared_ptr<const Frame> frame;
  };

  std::vector<Frame>& in_memory();
  std::shared_ptr<const Frame> fetch(std::size_t k) const;

  std::vector<Frame> frames_;  // without a source
  std::shared_ptr<const FrameSource> source_;
  mutable std::list<Kept> recent_;  // the latest first
  mutable std::shared_ptr<const Frame> first_, last_;
  mutable std::size_t bytes_ = 0;
  mutable std::optional<Error> fault_;
};

}  // namespace gridshell::record
