// The steps that can be undone: storing their states in memory or in a file, and restoring them.
#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include "app/window/edit_session.h"
#include "engine/core/packing.h"
#include "engine/core/try.h"

namespace gridshell::window {

std::optional<ScratchFile::Range> ScratchFile::put(std::string_view bytes) {
  if (!file_) file_.reset(std::tmpfile());
  if (!file_ || ::fseeko(file_.get(), end_, SEEK_SET) != 0 ||
      std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size() ||
      std::fflush(file_.get()) != 0)
    return std::nullopt;
  return Range{std::exchange(end_, end_ + std::int64_t(bytes.size())), bytes.size()};
}

std::string ScratchFile::take(const Range& range) const {
  std::string bytes(range.size, 0);
  const bool read = file_ && ::fseeko(file_.get(), range.at, SEEK_SET) == 0 &&
                    std::fread(bytes.data(), 1, range.size, file_.get()) == range.size;
  return read ? bytes : std::string();
}

namespace {

constexpr std::int64_t most_bytes_aside = std::int64_t(8) << 30;

/// Calls visit(array) for each of a checkpoint's arrays of numbers.
template <class Kept, class Visit>
void each_array(Kept& kept, const Visit& visit) {
  visit(kept.state.x), visit(kept.state.velocity.x), visit(kept.state.velocity.force);
  for (auto& level : kept.state.levels)
    visit(level.x), visit(level.force), visit(level.director), visit(level.reference_twist);
  for (auto& motion : kept.motions) visit(motion.begin), visit(motion.change);
}

std::int64_t bytes_of(const Checkpoint& kept) {
  std::int64_t doubles = 0;
  each_array(kept, [&](const auto& array) { doubles += array.size(); });
  return doubles * std::int64_t(sizeof(double));
}

}  // namespace

/// Stores the state before a command as a step to undo; not before further commands of a drag.
/// Returns whether it was stored.
bool EditSession::remember(const Command& command) {
  if (!session_ || (command.drag != 0 && command.drag == drag_)) return false;
  drag_ = command.drag;
  undo_.push_back({now_, session_->save(), is_any<Design>(command.edit)});
  pending_redo_ = std::exchange(redo_, {});
  limit_memory(undo_);
  return true;
}

/// Moves older steps into a file; if that has no room, discards them.
void EditSession::limit_memory(std::deque<UndoStep>& steps) {
  clear_scratch();
  std::int64_t bytes = 0;
  std::size_t kept = 0;
  while (kept < steps.size() && bytes <= most_bytes_)
    bytes += bytes_of(steps[steps.size() - 1 - kept++].checkpoint);
  // of the older ones, all but the last few are in the file already
  for (std::size_t k = steps.size() - kept; k-- > 0 && !steps[k].saved;)
    if (!save_to_scratch(steps[k])) {
      steps.erase(steps.begin(), steps.begin() + std::ptrdiff_t(k) + 1);
      return;
    }
}

/// Empties the file if no step is in it.
void EditSession::clear_scratch() {
  const auto saved = [](const UndoStep& step) { return step.saved.has_value(); };
  if (std::ranges::none_of(undo_, saved) && std::ranges::none_of(redo_, saved) &&
      std::ranges::none_of(pending_redo_, saved))
    scratch_ = ScratchFile();
}

bool EditSession::save_to_scratch(UndoStep& step) {
  if (scratch_.bytes() > most_bytes_aside) return false;
  ByteWriter out;
  each_array(step.checkpoint, [&](const auto& array) { out.matrix(array); });
  step.saved = scratch_.put(out.bytes());
  if (step.saved) each_array(step.checkpoint, []<class Array>(Array& array) { array = Array(); });
  return step.saved.has_value();
}

bool EditSession::load_from_scratch(UndoStep& step) const {
  if (!step.saved) return true;
  const std::string bytes = scratch_.take(*step.saved);
  ByteReader in(bytes);
  each_array(step.checkpoint, [&](auto& array) { in.matrix(array); });
  if (in.at_end()) step.saved.reset();
  return !step.saved;
}

Result<void> EditSession::restore(const UndoStep& step) {
  if (step.state.scene != now_.scene) {
    TRY(session, Simulation::open(step.state.scene, step.checkpoint.shell->plan()));
    session_ = std::move(*session);
  }
  session_->restore(step.checkpoint);
  now_ = step.state;
  view_.layout.reset();
  steps_drag_ = 0;
  return {};
}

Result<void> EditSession::swap_state(std::deque<UndoStep>& from, std::deque<UndoStep>& to,
                                     const char* none) {
  if (from.empty()) return invalid(none);
  if (!load_from_scratch(from.back()))
    return fail(Fault::io, "the file with the state of this step cannot be read");
  // the current state, to which the opposite command returns
  UndoStep before{now_, session_->save(), from.back().before_design};
  try {
    TRY_DO(restore(from.back()));
  } catch (const std::exception&) {
    TRY_DO(restore(before));
    throw;
  }
  from.pop_back();
  to.push_back(std::move(before));
  limit_memory(to);
  drag_ = 0;
  return {};
}

Result<void> EditSession::act(const Undo& command, const Watch&) {
  auto back = swap_state(undo_, redo_, "there is nothing to undo");
  while (command.all && back && !undo_.empty()) back = swap_state(undo_, redo_, "");
  return back;
}

Result<void> EditSession::act(const Redo&, const Watch&) {
  return swap_state(redo_, undo_, "there is nothing to do again");
}

std::string error_text(const std::exception& thrown) {
  return dynamic_cast<const std::bad_alloc*>(&thrown) ? "memory ran out" : thrown.what();
}

/// After an exception: restores the state before the command, or before its drag.
void EditSession::recover(const Command& command, const std::exception& thrown) {
  try {
    const std::string why = error_text(thrown);
    const bool of_drag = command.drag != 0 && command.drag == drag_;
    if ((remembered_ || of_drag) && !undo_.empty()) {
      const Result<void> back = restore(undo_.back());
      take_back_step();
      view_.error = back ? why : why + "; " + back.error().message;
    } else {
      if (redo_.empty()) redo_.swap(pending_redo_);
      view_.error = why;
    }
    update_view();
  } catch (const std::exception&) {
    // the last view remains; this text is short enough for any memory
    view_.error = "memory ran out";
  }
}

/// Discards the step that was stored before the current command; Redo is possible again.
void EditSession::take_back_step() {
  undo_.pop_back();
  redo_ = std::exchange(pending_redo_, {});
  drag_ = 0;
}

}  // namespace gridshell::window
