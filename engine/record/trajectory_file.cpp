#include "engine/record/trajectory_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <new>
#include <optional>
#include <system_error>

#include "engine/core/file_io.h"
#include "engine/core/try.h"
#include "engine/formats/hdf5_file.h"
#include "engine/record/trajectory_hdf5.h"

namespace gridshell::record {

namespace {

/// Name of the format, in the header of a file and as an attribute.
constexpr const char* trajectory_format = "gridshell trajectory 1";

/// Size of the header before the HDF5 part. The HDF5 library looks for the start of its part at
/// byte 0, 512, 1024 ..., and ignores the bytes before it.
constexpr std::size_t header_size = 512;

/// The header that a file should have, computed from the bytes after it; empty if they cannot be
/// read.
std::optional<std::string> expected_header(const ReadableFile& file,
                                           ChecksumKind kind = ChecksumKind::crc32) {
  constexpr std::uint64_t block = 1 << 18;
  Checksum sum(kind);
  for (std::uint64_t at = header_size; at < file.size(); at += block) {
    const auto bytes = file.read(at, std::min(block, file.size() - at));
    if (!bytes) return std::nullopt;
    sum.add(*bytes);
  }
  const std::string header =
      fmt::format("{}\n{} bytes, {} {:016x}\n", trajectory_format, file.size() - header_size,
                  kind == ChecksumKind::crc32 ? "CRC-32" : "FNV-1a", sum.value());
  return header + std::string(header_size - header.size(), '\0');
}

/// The reason why a file is refused; empty: it is read. A file without a header was written by
/// another program: it is only read if `no_checksum` is set.
std::string header_error(const ReadableFile& file, bool no_checksum) {
  const auto start = file.read(0, std::min<std::uint64_t>(header_size, file.size()));
  if (start && start->starts_with("\x89HDF\r\n\x1a\n"))
    return no_checksum
               ? ""
               : "it has no checksum, so another program wrote it (--no-checksum, in Python "
                 "no_checksum=True, reads it all the same)";
  if (!start || !start->starts_with(trajectory_format)) return "it is not an HDF5 file";
  if (start->size() < header_size) return "it is cut short";
  const bool older = start->find("FNV-1a") != start->npos;
  if (no_checksum ||
      start == expected_header(file, older ? ChecksumKind::fnv1a : ChecksumKind::crc32))
    return "";
  return "it is cut short, damaged or was changed: its checksum does not match (of one that "
         "another "
         "program changed, --no-checksum, in Python no_checksum=True, reads what there is)";
}

constexpr std::size_t longest_word = 60000;  // HDF5 limits an attribute to 64 kB

void write_origin(hdf5::Writer& file, const Origin& origin) {
  for (const auto& [name, value] : {std::pair("title", &origin.title),
                                    {"preset", &origin.preset},
                                    {"program", &origin.program}})
    if (!value->empty() && value->size() < longest_word) file.attribute("/", name, *value);
}

Origin read_origin(hdf5::Reader& file) {
  const auto text = [&](const char* name) { return file.text_attribute("/", name); };
  return {text("title"), text("preset"), text("program")};
}

/// Writes the HDF5 part to a descriptor, then the header before it. Returns the error, or an empty
/// text.
std::string write_error(int descriptor, const AtomicFile& target, const Trajectory& trajectory) {
  hdf5::Stream stream{descriptor, header_size, 0};
  hdf5::Writer file(stream);
  file.attribute("/", "format", trajectory_format);
  write_origin(file, trajectory.origin);
  write_layout(file, trajectory.layout);
  write_frames(file, trajectory.layout, trajectory.frames);
  file.finish();
  const auto words_of = [](int code) { return std::generic_category().message(code); };
  if (stream.failure) return words_of(stream.failure);
  if (!file.good()) return file.reason();
  if (trajectory.frames.fault()) return trajectory.frames.fault()->message;
  const auto written = ReadableFile::open(target.temporary());
  const auto header = written ? expected_header(*written) : std::nullopt;
  if (!header) return "it cannot be read back";
  const ssize_t put = ::pwrite(descriptor, header->data(), header->size(), 0);
  return put == ssize_t(header->size()) ? "" : words_of(put < 0 ? errno : ENOSPC);
}

/// How often this process has the file open. If another library (h5py) has opened it, the HDF5
/// library cannot open it again with another driver.
int times_open(const std::filesystem::path& path) {
  struct stat file {
  }, open{};
  std::error_code error;
  int times = 0;
  if (::stat(path.c_str(), &file) != 0) return times;
  for (const auto& one : std::filesystem::directory_iterator("/proc/self/fd", error))
    if (::stat(one.path().c_str(), &open) == 0 && open.st_dev == file.st_dev &&
        open.st_ino == file.st_ino)
      ++times;
  return times;
}

Result<Trajectory> read_checked(const std::filesystem::path& path) {
  const auto refuse = [](const std::string& reason) { return invalid(reason); };
  const bool open = times_open(path) > 1;  // the caller has opened it once
  const auto file = std::make_shared<hdf5::Reader>(path);
  if (!file->good())
    return refuse(open ? "it is open in this process (by h5py?): close it there first"
                       : "it is cut short or damaged");
  if (file->text_attribute("/", "format") != trajectory_format)
    return refuse(fmt::format("it is not of the format \"{}\"", trajectory_format));
  Trajectory trajectory;
  trajectory.layout = read_layout(*file);
  trajectory.origin = read_origin(*file);
  trajectory.frames = read_frames(file, trajectory.layout);
  if (!file->good()) return refuse(file->reason());
  // all frames are in the same datasets, so they have the same size as the first
  const Trajectory& read = trajectory;
  if (read.frames.empty()) return check_consistency(read).map([&] { return trajectory; });
  const Frame& first = read.frames.front();
  return check_frame(read.layout, first, 0, first.nodes.cols()).map([&] { return trajectory; });
}

}  // namespace

Result<void> write_trajectory(const std::filesystem::path& path, const Trajectory& trajectory) {
  TRY_DO(check_consistency(trajectory));
  AtomicFile target(path);
  Descriptor file(::open(target.temporary().c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file < 0) return fail_io("write", path, errno);
  if (const std::string fault = write_error(file, target, trajectory); !fault.empty())
    return fail(Fault::io, "cannot write '{}': {}", path.string(), fault);
  if (const int code = file.close()) return fail_io("write", path, code);
  return target.commit();
}

Result<Trajectory> read_trajectory(const std::filesystem::path& path,
                                   const TrajectoryReadOptions& how) {
  const auto refuse = [&](const std::string& reason) {
    return invalid("'{}' is no trajectory of a run: {}", path.string(), reason);
  };
  TRY(file, ReadableFile::open(path));
  if (const auto reason = header_error(*file, how.no_checksum); !reason.empty())
    return refuse(reason);
  try {
    if (how.trial)
      if (auto survived = read_in_subprocess([&] { (void)read_checked(path); }); !survived)
        return refuse(survived.error().message);
    auto trajectory = read_checked(path);
    if (!trajectory) return refuse(trajectory.error().message);
    return trajectory;
  } catch (const std::bad_alloc&) {
    return refuse("it claims to contain more than fits into memory");
  }
}

}  // namespace gridshell::record
