#include "engine/simulate/saved_segments.h"

#include <fmt/format.h>
#include <algorithm>
#include <concepts>
#include <cstring>
#include <fstream>
#include <string>

#include "engine/core/file_io.h"
#include "engine/core/packing.h"
#include "engine/core/system_info.h"

namespace gridshell::simulate {
namespace {

// Conversion of values to bytes and back: every struct lists its members once, for both directions.

template <class T, class Of>
concept Is = std::same_as<std::remove_const_t<T>, Of>;

/// Writes values directly into a file, as a path may be large, in the format of ByteWriter.
struct Pack {
  std::ofstream file;
  Checksum sum = Checksum(ChecksumKind::crc32);

  void raw(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const char*>(data);
    sum.add({bytes, size});
    file.write(bytes, std::streamsize(size));
  }
  void number(const auto& value) { raw(&value, sizeof value); }
  template <class Matrix>
  void matrix(const Matrix& values) {
    number(std::int64_t(values.rows()));
    number(std::int64_t(values.cols()));
    raw(values.data(), sizeof(typename Matrix::Scalar) * std::size_t(values.size()));
  }
  void text(const std::string& value) {
    size_of(value);
    raw(value.data(), value.size());
  }
  void size_of(const auto& list) { number(std::uint64_t(list.size())); }
};

/// Reads values from bytes of that format.
struct Unpack {
  ByteReader bytes;
  bool good() const { return bytes.good(); }
  template <class T>
  void number(T& value) {
    value = bytes.number<T>();
  }
  void matrix(auto& values) { bytes.matrix(values); }
  void text(std::string& value) { value = bytes.text(); }
  std::size_t size_of(auto& list) {
    list.clear();
    return bytes.number<std::uint64_t>();
  }
};

template <class T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

void put(auto& in, Number auto& value) { in.number(value); }
void put(auto& in, Is<std::string> auto& value) { in.text(value); }
template <class M>
requires requires(M& m) { m.derived(); }
void put(auto& in, M& values) { in.matrix(values); }

template <class In, class... T>
void all(In& in, T&... values);

void put(auto& in, Is<State> auto& s) { all(in, s.x, s.force, s.director, s.reference_twist); }
void put(auto& in, Is<Inertia> auto& s) {
  all(in, s.negative_pivots, s.usable, s.smallest_pivot, s.largest_pivot);
}
void put(auto& in, Is<MeshDifference> auto& s) { all(in, s.t, s.x, s.force); }
void put(auto& in, Is<PathPoint> auto& s) { all(in, s.t, s.state, s.velocity, s.step); }
void put(auto& in, Is<NestedPathPoint> auto& s) {
  all(in, s.t, s.state, s.velocity, s.step, s.companions, s.inertia);
}
void put(auto& in, Is<Certificate> auto& s) {
  all(in, s.residual_N, s.negative_pivots, s.error_estimate_mm, s.largest_strain);
}
void put(auto& in, Is<record::Contact> auto& s) {
  all(in, s.kind, s.first, s.second, s.gap_mm, s.at);
}
void put(auto& in, Is<record::Contacts> auto& s) {
  all(in, s.interpenetrations, s.rod_gap_mm, s.joint_gap_mm);
}
void put(auto& in, Is<LoadStep> auto& s) {
  all(in, s.point, s.certificate, s.contacts, s.stability_confirmed);
}
void put(auto& in, Is<TimedState> auto& s) { all(in, s.time, s.state); }
void put(auto& in, Is<PathRecord::Snap> auto& s) { all(in, s.before, s.moments); }
void put(auto& in, Is<PathRecord> auto& s) { all(in, s.load_steps, s.snaps); }
void put(auto& in, Is<Event::Location> auto& s) { all(in, s.edges, s.t, s.located); }
void put(auto& in, Is<Event> auto& s) {
  all(in, s.kind, s.t, s.error, s.to, s.jump, s.confirmed, s.what, s.location);
}
void put(auto& in, Is<NestedState> auto& s) {
  all(in, s.t, s.levels, s.measured, s.velocity, s.step, s.lowest_eigenvalue, s.lowest_mode, s.x,
      s.error_estimate_mm, s.residual_N, s.inertia, s.largest_strain, s.reactions,
      s.reaction_error_N, s.constraint_stiffness, s.stiffness_error_N_per_mm);
}
void put(auto& in, Is<SegmentBegin> auto& s) { all(in, s.state, s.from, s.to, s.edges); }
void put(auto& in, Is<Effort> auto& s) { all(in, s.newton_iterations, s.factorizations); }
void put(auto& in, Is<LowestStiffness> auto& s) { all(in, s.t, s.stiffness); }
void put(auto& in, Is<SavedSegment> auto& s) {
  all(in, s.begin, s.end, s.state, s.record, s.events, s.effort, s.lowest_stiffness,
      s.unmeasured_since, s.companion);
}

template <class T>
void one(Unpack& in, std::vector<T>& values) {
  // a size that is too large ends where the bytes end
  for (std::size_t left = in.size_of(values); left > 0 && in.good(); --left)
    all(in, values.emplace_back());
}
template <class T>
void one(Pack& in, const std::vector<T>& values) {
  in.size_of(values);
  for (const T& value : values) all(in, value);
}
template <class T>
void one(Unpack& in, std::optional<T>& value) {
  bool any = false;
  in.number(any);
  value.reset();
  if (any) all(in, value.emplace());
}
template <class T>
void one(Pack& in, const std::optional<T>& value) {
  in.number(value.has_value());
  if (value) all(in, *value);
}
template <class In, class T>
void one(In& in, T& value) {
  put(in, value);
}

template <class In, class... T>
void all(In& in, T&... values) {
  (one(in, values), ...);
}

}  // namespace

SavedSegments::SavedSegments(std::filesystem::path folder, double worth_s)
    : folder_(std::move(folder)), worth_s_(worth_s), wait_s_(worth_s), written_at_(seconds_now()) {}

std::filesystem::path SavedSegments::file() const {
  return folder_ / fmt::format("segment_{:04}", segments_);
}

std::optional<SavedSegment> SavedSegments::next(const SegmentBegin& begin) {
  ++segments_;
  has_file_ = false;
  const auto bytes = read_file(file());
  std::uint64_t sum = 0;
  if (!bytes || bytes->size() < sizeof sum) return std::nullopt;
  const std::size_t size = bytes->size() - sizeof sum;
  const std::string_view content = std::string_view(*bytes).substr(0, size);
  std::memcpy(&sum, bytes->data() + size, sizeof sum);
  if (sum != Checksum::of(content, ChecksumKind::crc32)) return std::nullopt;
  Unpack in{ByteReader(content)};
  SavedSegment segment;
  all(in, segment);
  if (!in.bytes.at_end() || segment.begin != begin) return std::nullopt;
  has_file_ = true;
  return segment;
}

bool SavedSegments::should_save(bool at_its_end) const {
  return (at_its_end && has_file_) || seconds_now() - written_at_ >= wait_s_;
}

void SavedSegments::save(const SavedSegment& segment) {
  const double start_s = seconds_now();
  if (make_folder(folder_)) {
    AtomicFile target(file());
    Pack out{std::ofstream(target.temporary(), std::ios::binary)};
    all(out, segment);
    const std::uint64_t sum = out.sum.value();
    out.number(sum);
    out.file.close();
    if (out.file) has_file_ = bool(target.commit());
  }
  written_at_ = seconds_now();
  // a segment that takes long to write is written less often, unless all are requested
  if (worth_s_ > 0) wait_s_ = std::max(worth_s_, 20 * (written_at_ - start_s));
}

}  // namespace gridshell::simulate
