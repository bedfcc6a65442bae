#include "engine/record/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/record/checksum.h"
#include "engine/record/consistency.h"
#include "engine/record/journal_records.h"
#include "engine/record/layout_file.h"
#include "engine/record/packing.h"
#include "engine/record/trial.h"

namespace gridshell::record {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t before_payload = 12, after_payload = 8;
// of a record: beyond any shell, and little enough to be asked for
constexpr std::uint64_t largest_record = std::uint64_t(1) << 31;

class File {
 public:
  explicit File(const fs::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)) {
    struct stat about {};
    if (descriptor_ < 0 || ::fstat(descriptor_, &about) != 0)
      failure_ = errno;
    else if (!S_ISREG(about.st_mode))
      failure_ = EINVAL;
    size_ = std::uint64_t(about.st_size);
  }
  ~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  int failure() const { return failure_; }
  std::uint64_t size() const { return size_; }

  /// exactly so many bytes, or nothing
  std::optional<std::string> read(std::uint64_t at, std::uint64_t size) const {
    if (failure_ || at > size_ || size > size_ - at) return std::nullopt;
    std::string bytes(size, '\0');
    for (std::size_t got = 0; got < size;) {
      const ssize_t now = ::pread(descriptor_, bytes.data() + got, size - got, off_t(at + got));
      if (now < 0 && errno == EINTR) continue;
      if (now <= 0) return std::nullopt;
      got += std::size_t(now);
    }
    return bytes;
  }

 private:
  int descriptor_ = -1, failure_ = 0;
  std::uint64_t size_ = 0;
};

struct Record {
  std::uint32_t kind = 0;
  std::uint64_t at = 0;  // of the payload
  std::string payload;
  std::uint64_t next = 0;
};

/// The record at `at`, if it is whole.
std::optional<Record> record_at(const File& file, std::uint64_t at) {
  const auto start = file.read(at, before_payload);
  if (!start) return std::nullopt;
  Unpacker in(*start);
  Record found;
  found.kind = in.number<std::uint32_t>();
  const auto length = in.number<std::uint64_t>();
  if (length > largest_record) return std::nullopt;
  auto rest = file.read(at + before_payload, length + after_payload);
  if (!rest) return std::nullopt;
  Checksum sum;
  sum.add(*start);
  sum.add(std::string_view(*rest).substr(0, length));
  if (Unpacker(std::string_view(*rest).substr(length)).number<std::uint64_t>() != sum.value())
    return std::nullopt;
  found.at = at + before_payload;
  found.next = found.at + length + after_payload;
  rest->resize(length);
  found.payload = std::move(*rest);
  return found;
}

struct Head : JournalHead {
  std::uint64_t next = 0;  ///< where the frames begin
};

Result<Head> head_of(const File& file) {
  const auto refuse = [](const char* because) { return fail(Fault::bad_input, because); };
  if (file.failure() == EINVAL) return refuse("it is a pipe or a device");
  if (file.read(0, journal_first_line.size()) != journal_first_line)
    return refuse("it is no journal of a run");
  const auto first = record_at(file, journal_first_line.size());
  if (!first || first->kind != head_record) return refuse("its beginning is damaged");
  auto head = unpacked_head(first->payload);
  if (!head) return refuse("its beginning is damaged");
  return Head{std::move(*head), first->next};
}

/// Where each frame lies, by index.
std::map<int, std::pair<std::uint64_t, std::uint64_t>> frames_of(const File& file,
                                                                 std::uint64_t at) {
  std::map<int, std::pair<std::uint64_t, std::uint64_t>> found;
  while (const auto record = record_at(file, at)) {
    if (record->kind == frame_record && record->payload.size() >= sizeof(std::int32_t)) {
      const int index = Unpacker(record->payload).number<std::int32_t>();
      found[index] = {record->at, record->payload.size()};
    }
    at = record->next;
  }
  return found;
}

class JournalFrames : public FrameSource {
 public:
  JournalFrames(std::shared_ptr<File> file, std::vector<std::string> columns)
      : file_(std::move(file)), columns_(std::move(columns)) {}

  void add(std::uint64_t at, std::uint64_t size) { places_.emplace_back(at, size); }
  std::size_t size() const override { return places_.size(); }
  Result<Frame> read(std::size_t k) const override {
    const auto bytes = file_->read(places_[k].first, places_[k].second);
    if (!bytes) return fail(Fault::io, "cannot read a frame of the journal");
    return unpacked_frame(*bytes, columns_);
  }

 private:
  std::shared_ptr<File> file_;
  std::vector<std::string> columns_;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> places_;
};

}  // namespace

Result<Journal> read_journal(const fs::path& path, bool trial) {
  const auto refuse = [&](const std::string& because) {
    return fail(Fault::bad_input, fmt::format("'{}': {}", path.string(), because));
  };
  const auto file = std::make_shared<File>(path);
  if (file->failure() && file->failure() != EINVAL)
    return fail(Fault::io, fmt::format("cannot read '{}': {}", path.string(),
                                       std::generic_category().message(file->failure())));
  auto head = head_of(*file);
  if (!head) return refuse(head.error().message);
  if (trial)
    if (auto survived = try_out([&] { (void)layout_of_image(head->layout); }); !survived)
      return refuse(survived.error().message);
  auto layout = layout_of_image(head->layout);
  if (!layout) return refuse(layout.error().message);
  // the first frame decides how many nodes there are; one that does not fit it is left out
  const auto frames = std::make_shared<JournalFrames>(file, head->columns);
  Eigen::Index nodes = -1;
  for (const auto& [index, place] : frames_of(*file, head->next)) {
    const auto bytes = file->read(place.first, place.second);
    const auto one = bytes ? unpacked_frame(*bytes, head->columns) : Result<Frame>();
    if (!bytes || !one) continue;
    if (nodes < 0 && check_layout(*layout, one->nodes.cols())) nodes = one->nodes.cols();
    if (nodes >= 0 && check_frame(*layout, *one, 0, nodes)) frames->add(place.first, place.second);
  }
  return Journal{head->name, {std::move(*layout), FrameList(frames)}};
}

Result<Journal> read_journal_of(const fs::path& folder) {
  auto finer = read_journal(folder / journal_name);
  std::error_code error;
  if (!fs::exists(folder / coarser_journal_name, error)) return finer;
  auto coarser = read_journal(folder / coarser_journal_name);
  if (!coarser) return finer;
  if (finer && finer->trajectory.frames.size() >= coarser->trajectory.frames.size()) return finer;
  return coarser;
}

std::optional<std::string> preset_of_journal(const fs::path& folder) {
  for (const char* name : {journal_name, coarser_journal_name}) {
    const File file(folder / name);
    if (file.failure()) continue;
    if (const auto head = head_of(file)) return head->name.preset;
  }
  return std::nullopt;
}

std::size_t frames_in_journal(const fs::path& folder) {
  std::size_t most = 0;
  for (const char* name : {journal_name, coarser_journal_name}) {
    const File file(folder / name);
    if (file.failure()) continue;
    if (const auto head = head_of(file)) most = std::max(most, frames_of(file, head->next).size());
  }
  return most;
}

}  // namespace gridshell::record
