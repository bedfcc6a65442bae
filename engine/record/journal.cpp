#include "engine/record/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/record/checksum.h"
#include "engine/record/consistency.h"
#include "engine/record/frame_columns.h"
#include "engine/record/layout_file.h"
#include "engine/record/trial.h"

namespace gridshell::record {
namespace fs = std::filesystem;
namespace {

const std::string first_line = "gridshell journal 1\n";

enum RecordKind : std::uint32_t { head_record = 1, frame_record = 2 };
constexpr std::size_t before_payload = 12, after_payload = 8;
// of a record: beyond any shell, and little enough to be asked for
constexpr std::uint64_t largest_record = std::uint64_t(1) << 31;
// what a movie numbers its frames up to; snaps in time add some
constexpr int largest_index = 10000000;

/// Values to bytes.
class Packer {
 public:
  template <class T>
  void number(T value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void text(const std::string& value) {
    number(std::uint64_t(value.size()));
    text_ += value;
  }
  template <class Matrix>
  void matrix(const Matrix& values) {
    number(std::int64_t(values.rows()));
    number(std::int64_t(values.cols()));
    text_.append(reinterpret_cast<const char*>(values.data()),
                 sizeof(double) * std::size_t(values.size()));
  }
  void put(int value) { number(std::int32_t(value)); }
  void put(double value) { number(value); }
  void put(const std::string& value) { text(value); }
  const std::string& bytes() const { return text_; }

 private:
  std::string text_;
};

/// And back; never beyond the end, and false ever after something was missing.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : left_(bytes) {}
  bool good() const { return good_; }
  bool at_end() const { return good_ && left_.empty(); }

  template <class T>
  T number() {
    T value{};
    if (take(sizeof value)) std::memcpy(&value, taken_.data(), sizeof value);
    return value;
  }
  std::string text() {
    const auto size = number<std::uint64_t>();
    return take(size) ? std::string(taken_) : std::string();
  }
  template <class Matrix>
  void matrix(Matrix& values, std::int64_t rows_wanted = -1) {
    const auto rows = number<std::int64_t>(), cols = number<std::int64_t>();
    const auto most = std::int64_t(left_.size() / sizeof(double));
    if (rows < 0 || cols < 0 || rows > most || cols > most ||
        (rows_wanted >= 0 && rows != rows_wanted) || (cols > 0 && rows > most / cols))
      good_ = false;
    if (!good_ || !take(sizeof(double) * std::size_t(rows * cols))) return;
    if (Matrix::ColsAtCompileTime >= 0 && cols != Matrix::ColsAtCompileTime) {
      good_ = false;
      return;
    }
    values.resize(rows, cols);
    std::memcpy(values.data(), taken_.data(), taken_.size());
  }
  void get(int& value) { value = number<std::int32_t>(); }
  void get(double& value) { value = number<double>(); }
  void get(std::string& value) { value = text(); }

 private:
  bool take(std::uint64_t size) {
    good_ = good_ && size <= left_.size();
    if (!good_) return false;
    taken_ = left_.substr(0, size);
    left_.remove_prefix(size);
    return true;
  }
  std::string_view left_, taken_;
  bool good_ = true;
};

template <class Visit>
void each_column(Visit visit) {
  for (const FrameColumn& column : frame_columns) visit(column);
  visit(actuation_column);
}

std::uint8_t kind_of(int) { return 0; }
std::uint8_t kind_of(double) { return 1; }
std::uint8_t kind_of(const std::string&) { return 2; }

std::string packed_head(const RunName& name, const Layout& layout) {
  Packer out;
  out.text(name.preset);
  out.put(int(name.kind));
  std::vector<std::string> names;
  each_column([&](const FrameColumn& column) { names.push_back(column.name); });
  out.number(std::uint64_t(names.size()));
  for (const auto& name : names) out.text(name);
  out.text(image_of(layout));
  return out.bytes();
}

std::string packed_frame(const Frame& frame) {
  Packer out;
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
  return out.bytes();
}

void skip(Unpacker& in, std::uint8_t kind) {
  if (kind == kind_of(0)) in.number<std::int32_t>();
  if (kind == kind_of(0.0)) in.number<double>();
  if (kind == kind_of(std::string())) in.text();
}

/// A frame whose columns are named so; those without a name here are left out.
Result<Frame> unpacked_frame(std::string_view bytes, const std::vector<std::string>& names) {
  Unpacker in(bytes);
  Frame frame;
  in.get(frame.index);
  for (const auto& name : names) {
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
  Eigen::MatrixXd K;
  in.matrix(K);
  if (K.cols() == 1) frame.cell_K = K;
  in.matrix(frame.K_bins);
  if (!in.at_end()) return fail(Fault::bad_input, "a frame is damaged");
  return frame;
}

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

struct Head {
  RunName name;
  std::string layout;
  std::vector<std::string> columns;
  std::uint64_t next = 0;
};

Result<Head> head_of(const File& file) {
  const auto refuse = [](const char* because) { return fail(Fault::bad_input, because); };
  if (file.failure() == EINVAL) return refuse("it is a pipe or a device");
  if (file.read(0, first_line.size()) != first_line) return refuse("it is no journal of a run");
  const auto first = record_at(file, first_line.size());
  if (!first || first->kind != head_record) return refuse("its beginning is damaged");
  Unpacker in(first->payload);
  Head found;
  found.name.preset = in.text();
  const int kind = in.number<std::int32_t>();
  if (kind >= 0 && kind <= int(Kind::movie)) found.name.kind = static_cast<Kind>(kind);
  const auto count = in.number<std::uint64_t>();
  for (std::uint64_t k = 0; k < count && in.good(); ++k) found.columns.push_back(in.text());
  found.layout = in.text();
  found.next = first->next;
  if (!in.at_end()) return refuse("its beginning is damaged");
  return found;
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

Result<JournalWriter> JournalWriter::create(const fs::path& path, const RunName& name,
                                            const Layout& layout) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  JournalWriter journal(path, descriptor);
  const auto refuse = [&](int code) {
    return fail(Fault::io, fmt::format("cannot write '{}': {}", path.string(),
                                       std::generic_category().message(code)));
  };
  if (descriptor < 0) return refuse(errno);
  const ssize_t put = ::write(descriptor, first_line.data(), first_line.size());
  if (put != ssize_t(first_line.size())) return refuse(put < 0 ? errno : ENOSPC);
  journal.end_ = first_line.size();
  if (auto headed = journal.put(head_record, packed_head(name, layout)); !headed)
    return tl::unexpected(headed.error());
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
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t now = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (now < 0 && errno == EINTR) continue;
    if (now <= 0) {
      const int code = now < 0 ? errno : ENOSPC;
      // what others find is whole
      if (::ftruncate(descriptor_, off_t(end_)) == 0) ::lseek(descriptor_, off_t(end_), SEEK_SET);
      return fail(Fault::io, fmt::format("cannot write '{}': {}", path_.string(),
                                         std::generic_category().message(code)));
    }
    done += std::size_t(now);
  }
  end_ += bytes.size();
  return {};
}

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
