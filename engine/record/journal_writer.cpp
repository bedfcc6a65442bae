// How a journal is written: every record at once, and what was cut short taken back.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

#include "engine/core/atomic_file.h"
#include "engine/record/checksum.h"
#include "engine/record/journal.h"
#include "engine/record/journal_records.h"
#include "engine/record/packing.h"

namespace gridshell::record {
namespace fs = std::filesystem;
namespace {

// what a movie numbers its frames up to; snaps in time add some
constexpr int largest_index = 10000000;

}  // namespace

Result<JournalWriter> JournalWriter::create(const fs::path& path, const RunName& name,
                                            const Layout& layout) {
  // under its name once its head is whole: whoever kills the run before then leaves no journal
  AtomicFile file(path);
  const int descriptor =
      ::open(file.temporary().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  JournalWriter journal(path, descriptor);
  const auto refuse = [&](int code) {
    return fail(Fault::io, fmt::format("cannot write '{}': {}", path.string(),
                                       std::generic_category().message(code)));
  };
  if (descriptor < 0) return refuse(errno);
  if (const int code = write_all(descriptor, journal_first_line)) return refuse(code);
  journal.end_ = journal_first_line.size();
  if (auto headed = journal.put(head_record, packed_head(name, layout)); !headed)
    return tl::unexpected(headed.error());
  if (auto placed = file.commit(); !placed) return tl::unexpected(placed.error());
  return journal;
}

JournalWriter::JournalWriter(JournalWriter&& other) noexcept { *this = std::move(other); }

JournalWriter& JournalWriter::operator=(JournalWriter&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(end_, other.end_);
  std::swap(indices_, other.indices_);
  std::swap(seen_, other.seen_);
  return *this;
}

JournalWriter::~JournalWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<void> JournalWriter::append(const Frame& frame) {
  if (frame.index < 0 || frame.index > largest_index)
    return fail(Fault::bad_input, fmt::format("frame {} has no place in a journal", frame.index));
  if (auto written = put(frame_record, packed_frame(frame)); !written) return written;
  const auto index = std::size_t(frame.index);
  if (seen_.size() <= index) seen_.resize(index + 1);
  if (!seen_[index]) ++indices_;
  seen_[index] = true;
  return {};
}

Result<void> JournalWriter::put(std::uint32_t kind, const std::string& payload) {
  Packer out;
  out.number(kind);
  out.number(std::uint64_t(payload.size()));
  std::string bytes = out.bytes() + payload;
  Checksum sum;
  sum.add(bytes);
  Packer last;
  last.number(sum.value());
  bytes += last.bytes();
  if (const int code = write_all(descriptor_, bytes)) {
    // what others find is whole
    if (::ftruncate(descriptor_, off_t(end_)) == 0) ::lseek(descriptor_, off_t(end_), SEEK_SET);
    return fail(Fault::io, fmt::format("cannot write '{}': {}", path_.string(),
                                       std::generic_category().message(code)));
  }
  end_ += bytes.size();
  return {};
}

}  // namespace gridshell::record
