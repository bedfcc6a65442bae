#include "engine/record/journal.h"

#include <fcntl.h>
#include <algorithm>
#include <cerrno>
#include <functional>
#include <map>
#include <utility>

#include "engine/core/packing.h"
#include "engine/core/try.h"
#include "engine/formats/hdf5_file.h"
#include "engine/record/frame_columns.h"
#include "engine/record/trajectory_hdf5.h"

namespace gridshell::record {
namespace fs = std::filesystem;
namespace {

// versions before 0.2.0 wrote the older one
constexpr std::string_view first_line = "gridshell journal 2\n",
                           older_first_line = "gridshell journal 1\n";
enum RecordKind : std::uint32_t { head_record = 1, frame_record = 2 };
constexpr std::size_t before_payload = 12, after_payload = 8;
// size of a record: more than any shell needs, and small enough to allocate
constexpr std::uint64_t largest_record = std::uint64_t(1) << 31;
// more than the largest number of frames of a movie, as snaps in time add frames
constexpr int largest_index = 10000000;

std::vector<FrameColumn> columns_of_a_frame() {
  std::vector<FrameColumn> columns = frame_columns;
  columns.push_back(actuation_column);
  return columns;
}

// the kind is written before each value, so that readers can skip columns that they do not know
std::uint8_t kind_of(int) { return 0; }
std::uint8_t kind_of(double) { return 1; }
std::uint8_t kind_of(const std::string&) { return 2; }

void skip(ByteReader& in, std::uint8_t kind) {
  if (kind == kind_of(0)) in.number<std::int32_t>();
  if (kind == kind_of(0.0)) in.number<double>();
  if (kind == kind_of(std::string())) in.text();
}

/// Position and size of a payload in the file.
struct ByteRange {
  std::uint64_t at = 0, size = 0;
};

struct Record {
  std::uint32_t kind = 0;
  ByteRange range;
  std::string payload;
  std::uint64_t next = 0;
};

/// The record at byte `at`; empty if it is incomplete or damaged.
std::optional<Record> record_at(const ReadableFile& file, std::uint64_t at, ChecksumKind summed) {
  const auto start = file.read(at, before_payload);
  if (!start) return std::nullopt;
  ByteReader in(*start);
  Record found;
  found.kind = in.number<std::uint32_t>();
  const auto length = in.number<std::uint64_t>();
  if (length > largest_record) return std::nullopt;
  auto rest = file.read(at + before_payload, length + after_payload);
  if (!rest) return std::nullopt;
  Checksum sum(summed);
  sum.add(*start);
  sum.add(std::string_view(*rest).substr(0, length));
  if (ByteReader(std::string_view(*rest).substr(length)).number<std::uint64_t>() != sum.value())
    return std::nullopt;
  found.range = {at + before_payload, length};
  found.next = found.range.at + length + after_payload;
  rest->resize(length);
  found.payload = std::move(*rest);
  return found;
}

struct OpenJournal {
  ReadableFile file;
  JournalHead head;
  ChecksumKind summed;
  std::uint64_t begin;  ///< byte at which the records of frames start

  /// Calls take(index, record) for every complete record of a frame, in the order of the file.
  void each_frame(const std::function<void(int, const Record&)>& take) const {
    for (auto record = record_at(file, begin, summed); record;
         record = record_at(file, record->next, summed))
      if (record->kind == frame_record && record->payload.size() >= sizeof(std::int32_t))
        take(ByteReader(record->payload).number<std::int32_t>(), *record);
  }
};

Result<OpenJournal> open_journal(const fs::path& path) {
  const auto refuse = [&](const char* because) {
    return invalid("'{}': {}", path.string(), because);
  };
  TRY(file, ReadableFile::open(path));
  const auto line = file->read(0, first_line.size());
  if (line != first_line && line != older_first_line) return refuse("it is no journal of a run");
  const auto summed = line == first_line ? ChecksumKind::crc32 : ChecksumKind::fnv1a;
  const auto first = record_at(*file, first_line.size(), summed);
  auto head = first && first->kind == head_record ? unpacked_head(first->payload) : std::nullopt;
  if (!head) return refuse("its beginning is damaged");
  return OpenJournal{std::move(*file), std::move(*head), summed, first->next};
}

class JournalFrames : public FrameSource {
 public:
  explicit JournalFrames(OpenJournal journal) : journal_(std::move(journal)) {}

  /// Finds the frames that fit the layout. The one with the lowest index decides the number of
  /// nodes; frames with another number are left out.
  void find_those_of(const Layout& layout) {
    struct Found {
      ByteRange range;
      Eigen::Index nodes;  // number of nodes; -1: the frame does not fit the layout
      Frame head;
    };
    std::map<int, Found> found;
    journal_.each_frame([&](int index, const Record& record) {
      const auto one = unpacked_frame(record.payload, journal_.head.columns);
      const Eigen::Index nodes = one ? one->nodes.cols() : -1;
      const bool fits = one && check_layout(layout, nodes) && check_frame(layout, *one, 0, nodes);
      found[index] = {record.range, fits ? nodes : -1, fits ? without_nodes(*one) : Frame()};
    });
    Eigen::Index nodes = -1;
    for (auto& [index, one] : found) {
      if (nodes < 0) nodes = one.nodes;
      if (nodes < 0 || one.nodes != nodes) continue;
      ranges_.push_back(one.range);
      heads_.push_back(std::move(one.head));
    }
  }
  const Frame* head(std::size_t k) const override { return &heads_[k]; }
  std::size_t size() const override { return ranges_.size(); }
  Result<Frame> read(std::size_t k) const override { return frame_at(ranges_[k]); }

 private:
  Result<Frame> frame_at(const ByteRange& range) const {
    const auto bytes = journal_.file.read(range.at, range.size);
    if (!bytes) return fail(Fault::io, "cannot read a frame of the journal");
    return unpacked_frame(*bytes, journal_.head.columns);
  }

  OpenJournal journal_;
  std::vector<ByteRange> ranges_;
  std::vector<Frame> heads_;
};

}  // namespace

std::string packed_head(const RunIdentity& name, const Layout& layout) {
  ByteWriter out;
  out.text(name.preset);
  out.put(int(name.kind));
  const auto columns = columns_of_a_frame();
  out.number(std::uint64_t(columns.size()));
  for (const FrameColumn& column : columns) out.text(column.name);
  out.text(image_of(layout));
  return std::move(out).bytes();
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
  std::size_t bytes = 4096;  // numbers, words
  visit_matrices(frame, [&](const auto& values) {
    bytes += 16 + sizeof(double) * std::size_t(values.size());
  });
  out.reserve(bytes);
  out.put(frame.index);
  for (const FrameColumn& column : columns_of_a_frame())
    visit_column(column, frame, [&](const auto& value) {
      out.number(kind_of(value));
      out.put(value);
    });
  visit_matrices(frame, [&](const auto& values) { out.matrix(values); });
  return std::move(out).bytes();
}

Result<Frame> unpacked_frame(std::string_view bytes, const std::vector<std::string>& columns) {
  static const std::vector<FrameColumn> known = columns_of_a_frame();
  ByteReader in(bytes);
  Frame frame;
  in.get(frame.index);
  for (const auto& name : columns) {
    const auto kind = in.number<std::uint8_t>();
    const auto column = std::ranges::find(known, name, &FrameColumn::name);
    const bool taken = column != known.end() && visit_column(*column, frame, [&](auto& value) {
                         if (kind != kind_of(value)) return false;
                         in.get(value);
                         return true;
                       });
    if (!taken) skip(in, kind);
  }
  int matrices = 0;
  visit_matrices(frame, [&](auto& values) {
    // older versions wrote fewer arrays
    const bool may_end = matrices == 3 || matrices >= 6;
    if (may_end && in.at_end()) return;
    ++matrices;
    in.matrix(values);
  });
  if (!in.at_end()) return invalid("a frame is damaged");
  return frame;
}

Result<JournalWriter> JournalWriter::create(const fs::path& path, const RunIdentity& name,
                                            const Layout& layout) {
  // the file gets its name when its head is complete: a run killed before leaves no journal
  AtomicFile file(path);
  JournalWriter journal;
  journal.path_ = path;
  journal.file_ =
      Descriptor(::open(file.temporary().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (journal.file_ < 0) return fail_io("write", path, errno);
  if (const int code = append_whole(journal.file_, first_line, journal.size_))
    return fail_io("write", path, code);
  TRY_DO(journal.put(head_record, packed_head(name, layout)));
  TRY_DO(file.commit());
  return journal;
}

Result<void> JournalWriter::append(const Frame& frame) {
  if (frame.index < 0 || frame.index > largest_index)
    return invalid("frame {} cannot be stored in a journal", frame.index);
  TRY_DO(put(frame_record, packed_frame(frame)));
  indices_.insert(frame.index);
  return {};
}

Result<void> JournalWriter::put(std::uint32_t kind, const std::string& payload) {
  ByteWriter record;
  record.reserve(before_payload + payload.size() + after_payload);
  record.number(kind);
  record.text(payload);
  record.number(Checksum::of(record.bytes(), ChecksumKind::crc32));
  if (const int code = append_whole(file_, record.bytes(), size_))
    return fail_io("write", path_, code);
  return {};
}

Result<Journal> read_journal(const fs::path& path, bool trial) {
  TRY(journal, open_journal(path));
  const JournalHead& head = journal->head;
  const auto survived =
      trial ? read_in_subprocess([&] { (void)layout_of_image(head.layout); }) : Result<void>();
  auto layout = survived.and_then([&] { return layout_of_image(head.layout); });
  if (!layout) return invalid("'{}': {}", path.string(), layout.error().message);
  const RunIdentity name = head.name;
  const auto frames = std::make_shared<JournalFrames>(std::move(*journal));
  frames->find_those_of(*layout);
  return Journal{name, {std::move(*layout), FrameList(frames)}};
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
  for (const char* name : {journal_name, coarser_journal_name})
    if (const auto journal = open_journal(folder / name)) return journal->head.name.preset;
  return std::nullopt;
}

std::size_t frames_in_journal(const fs::path& file) {
  std::set<int> indices;
  if (const auto journal = open_journal(file))
    journal->each_frame([&](int index, const Record&) { indices.insert(index); });
  return indices.size();
}

std::size_t frames_in_journals(const fs::path& folder) {
  return std::max(frames_in_journal(folder / journal_name),
                  frames_in_journal(folder / coarser_journal_name));
}

}  // namespace gridshell::record
