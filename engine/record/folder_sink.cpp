#include "engine/record/folder_sink.h"

#include <fmt/format.h>

#include "engine/core/atomic_file.h"
#include "engine/core/version.h"
#include "engine/record/run_folder.h"

namespace gridshell::record {
namespace fs = std::filesystem;

Result<void> FolderSink::begin(Layout layout) {
  if (auto made = make_folder(folder_); !made) return made;
  if (auto kept = keep_coarser(); !kept) return kept;
  auto journal = JournalWriter::create(folder_ / journal_name, name_, layout);
  if (!journal) return tl::unexpected(journal.error());
  journal_.emplace(std::move(*journal));
  return {};
}

Result<void> FolderSink::keep_coarser() {
  if (!journal_ || journal_->frames() <= coarser_frames_) return {};
  coarser_frames_ = journal_->frames();
  journal_.reset();
  std::error_code error;
  fs::rename(folder_ / journal_name, folder_ / coarser_journal_name, error);
  if (!error) return {};
  return fail(Fault::io, fmt::format("cannot rename '{}': {}", (folder_ / journal_name).string(),
                                     error.message()));
}

Result<void> FolderSink::take(Frame frame) {
  if (!journal_) return fail(Fault::bad_input, "a frame came before its layout");
  auto appended = journal_->append(frame);
  if (!appended || coarser_frames_ == 0 || journal_->frames() < coarser_frames_) return appended;
  std::error_code ignored;
  fs::remove(folder_ / coarser_journal_name, ignored);
  coarser_frames_ = 0;
  return {};
}

Result<Trajectory> FolderSink::finish(const Summary& summary) {
  journal_.reset();
  // what this program has just written needs no trial
  auto journal = read_journal(folder_ / journal_name, false);
  if (!journal) return tl::unexpected(journal.error());
  journal->trajectory.origin = {name_.title, name_.preset, std::string("gridshell ") + version()};
  if (auto written = write_run(folder_, journal->trajectory, summary); !written)
    return tl::unexpected(written.error());
  remove_journals(folder_);
  return std::move(journal->trajectory);
}

void remove_journals(const fs::path& folder) {
  std::error_code ignored;
  for (const char* name : {journal_name, coarser_journal_name}) fs::remove(folder / name, ignored);
}

}  // namespace gridshell::record
