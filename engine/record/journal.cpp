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

#include "engine/core/checksum.h"
#include "engine/core/file_io.h"
#include "engine/core/try.h"
#include "engine/formats/hdf5_file.h"
#include "engine/formats/packing.h"
#include "engine/record/frame_columns.h"
#include "engine/record/trajectory.h"
#include "engine/record/trajectory_hdf5.h"

namespace gridshell::record {
namespace {

template <class Visit>
void each_column(Visit visit) {
  for (const FrameColumn& column : frame_columns) visit(column);
  visit(actuation_column);
}

std::uint8_t kind_of(int) { return 0; }
std::uint8_t kind_of(double) { return 1; }
std::uint8_t kind_of(const std::string&) { return 2; }

void skip(ByteReader& in, std::uint8_t kind) {
  if (kind == kind_of(0)) in.number<std::int32_t>();
  if (kind == kind_of(0.0)) in.number<double>();
  if (kind == kind_of(std::string())) in.text();
}

}  // namespace

std::string packed_head(const RunIdentity& name, const Layout& layout) {
  ByteWriter out;
  out.text(name.preset);
  out.put(int(name.kind));
  std::vector<std::string> names;
  each_column([&](const FrameColumn& column) { names.push_back(column.name); });
  out.number(std::uint64_t(names.size()));
  for (const auto& name : names) out.text(name);
  out.text(image_of(layout));
  return out.bytes();
}

std::optional<JournalHead> unpacked_head(std::string_view bytes) {
  ByteReader in(bytes);
  JournalHead found;
  found.name.preset = in.text();
  const int kind = in.number<std::int32_t>();
  if (kind >= 0 && kind < int(words_of<Kind>().size())) found.name.kind = static_cast<Kind>(kind);
  const auto count = in.number<std::uint64_t>();
  for (std::uint64_t k = 0; k < count && in.good(); ++k) found.columns.push_back(in.text());
  found.layout = in.text();
  if (!in.at_end()) return std::nullopt;
  return found;
}

std::string packed_frame(const Frame& frame) {
  ByteWriter out;
  out.put(frame.index);
  each_column([&](const FrameColumn& column) {
    // its kind goes with a value, for whoever does not know the column
    visit_column(column, frame, [&](const auto& value) {
      out.number(kind_of(value));
      out.put(value);
    });
  });
  out.matrix(frame.nodes);
  out.matrix(frame.cell_K);
  out.matrix(frame.K_bins);
  out.matrix(frame.axial_force_N);
  out.matrix(frame.curvature_per_mm);
  out.matrix(frame.reactions_N);
  out.matrix(frame.bending_mJ_per_m);
  return out.bytes();
}

Result<Frame> unpacked_frame(std::string_view bytes, const std::vector<std::string>& columns) {
  ByteReader in(bytes);
  Frame frame;
  in.get(frame.index);
  for (const auto& name : columns) {
    const auto kind = in.number<std::uint8_t>();
    bool taken = false;
    each_column([&](const FrameColumn& column) {
      if (taken || name != column.name) return;
      visit_column(column, frame, [&](auto& value) {
        if (kind != kind_of(value)) return;
        taken = true;
        in.get(value);
      });
    });
    if (!taken) skip(in, kind);
  }
  in.matrix(frame.nodes, 3);
  in.matrix(frame.cell_K);
  in.matrix(frame.K_bins);
  // older versions ended here, or before the energies
  if (!in.at_end()) {
    in.matrix(frame.axial_force_N);
    in.matrix(frame.curvature_per_mm);
    in.matrix(frame.reactions_N, 3);
  }
  if (!in.at_end()) in.matrix(frame.bending_mJ_per_m);
  if (!in.at_end()) return fail(Fault::bad_input, "a frame is damaged");
  return frame;
}

// How a journal is written: every record at once, and what was cut short taken back.

namespace fs = std::filesystem;
namespace {

// what a movie numbers its frames up to; snaps in time add some
constexpr int largest_index = 10000000;

}  // namespace

Result<JournalWriter> JournalWriter::create(const fs::path& path, const RunIdentity& name,
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
  TRY_DO(journal.put(head_record, packed_head(name, layout)));
  TRY_DO(file.commit());
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
  ByteWriter out;
  out.number(kind);
  out.number(std::uint64_t(payload.size()));
  std::string bytes = out.bytes() + payload;
  Checksum sum;
  sum.add(bytes);
  ByteWriter last;
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
  ByteReader in(*start);
  Record found;
  found.kind = in.number<std::uint32_t>();
  const auto length = in.number<std::uint64_t>();
  if (length > largest_record) return std::nullopt;
  auto rest = file.read(at + before_payload, length + after_payload);
  if (!rest) return std::nullopt;
  Checksum sum;
  sum.add(*start);
  sum.add(std::string_view(*rest).substr(0, length));
  if (ByteReader(std::string_view(*rest).substr(length)).number<std::uint64_t>() != sum.value())
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
      const int index = ByteReader(record->payload).number<std::int32_t>();
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
    if (auto survived = read_in_subprocess([&] { (void)layout_of_image(head->layout); }); !survived)
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
