// The 512 bytes before the HDF5 part of trajectory.h5: its size and checksum, which HDF5 programs
// skip.

#include "engine/record/trajectory_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/core/checksum.h"
#include "engine/core/file_io.h"
#include "engine/core/try.h"
#include "engine/formats/hdf5_file.h"
#include "engine/record/trajectory.h"
#include "engine/record/trajectory_hdf5.h"

namespace gridshell::record {

/// What a trajectory says that it is, in its seal and as an attribute.
inline constexpr const char* trajectory_format = "gridshell trajectory 1";

/// HDF5 looks for its own beginning at 0, 512, 1024 ...: what lies before is the program's to use.
inline constexpr std::size_t trajectory_header_size = 512;

/// The seal that a file should bear, from the bytes after its first 512; empty when it cannot be
/// read.
std::string expected_header(const std::filesystem::path& path);

/// Why a file is not to be trusted, or empty. A file without a seal was written by another program:
/// it is trusted where `unsealed` is wanted.
std::string header_fault(const std::filesystem::path& path, bool unsealed);

namespace {

/// Name and checksum of the HDF5 bytes that follow.
std::string header_text(std::uintmax_t bytes, const Checksum& sum) {
  std::string seal =
      fmt::format("{}\n{} bytes, FNV-1a {:016x}\n", trajectory_format, bytes, sum.value());
  seal.resize(trajectory_header_size, '\0');
  return seal;
}

}  // namespace

std::string expected_header(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(trajectory_header_size);
  Checksum sum;
  std::uintmax_t bytes = 0;
  std::vector<char> block(1 << 18);
  while (file) {
    file.read(block.data(), std::streamsize(block.size()));
    const auto got = std::size_t(file.gcount());
    sum.add({block.data(), got});
    bytes += got;
  }
  return file.eof() ? header_text(bytes, sum) : std::string();
}

std::string header_fault(const std::filesystem::path& path, bool unsealed) {
  std::string start(trajectory_header_size, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), trajectory_header_size);
  const auto got = std::size_t(file.gcount());
  start.resize(got);
  if (start.starts_with("\x89HDF\r\n\x1a\n"))
    return unsealed ? ""
                    : "it bears no seal, so another program wrote it ('render --unsealed' reads it "
                      "all the same)";
  if (!start.starts_with(trajectory_format)) return "it is not an HDF5 file";
  if (got < trajectory_header_size) return "it is cut short";
  if (start == expected_header(path) || unsealed) return "";
  return "it is cut short, damaged or was changed: its checksum does not match";
}

namespace {

constexpr std::size_t longest_word = 60000;  // what an attribute takes

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

/// The HDF5 part onto a descriptor, then the seal before it; errno of what failed, or 0.
Result<void> write_sealed(int descriptor, const AtomicFile& target, const Trajectory& trajectory) {
  hdf5::Stream stream{descriptor, trajectory_header_size, 0};
  hdf5::Writer file(stream);
  file.attribute("/", "format", trajectory_format);
  write_origin(file, trajectory.origin);
  write_layout(file, trajectory.layout);
  write_frames(file, trajectory.layout, trajectory.frames);
  file.finish();
  const auto failed = [](int code) {
    return fail(Fault::io, std::generic_category().message(code));
  };
  if (stream.failure) return failed(stream.failure);
  if (!file.good()) return fail(Fault::io, file.reason());
  if (trajectory.frames.fault()) return tl::unexpected(*trajectory.frames.fault());
  const std::string seal = expected_header(target.temporary());
  if (seal.empty()) return fail(Fault::io, "it cannot be read back");
  const ssize_t put = ::pwrite(descriptor, seal.data(), seal.size(), 0);
  if (put != ssize_t(seal.size())) return failed(put < 0 ? errno : ENOSPC);
  return {};
}

Result<Trajectory> read_checked(const std::filesystem::path& path) {
  const auto refuse = [](const std::string& reason) { return fail(Fault::bad_input, reason); };
  const auto file = std::make_shared<hdf5::Reader>(path);
  if (!file->good()) return refuse("it is cut short or damaged");
  if (file->text_attribute("/", "format") != trajectory_format)
    return refuse(fmt::format("it does not say \"{}\"", trajectory_format));
  Trajectory trajectory;
  trajectory.layout = read_layout(*file);
  trajectory.origin = read_origin(*file);
  trajectory.frames = read_frames(file, trajectory.layout);
  if (!file->good()) return refuse(file->reason());
  // every frame is as long as the first: they share one dataset
  const Trajectory& read = trajectory;
  if (read.frames.empty()) return check_consistency(read).map([&] { return trajectory; });
  const Frame& first = read.frames.front();
  return check_frame(read.layout, first, 0, first.nodes.cols()).map([&] { return trajectory; });
}

/// A regular file that can be opened, or why not.
Result<void> readable(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& reason) {
    return fail(Fault::io, fmt::format("cannot read '{}': {}", path.string(), reason));
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (error || !std::filesystem::exists(status))
    return refuse(std::generic_category().message(error ? error.value() : ENOENT));
  if (std::filesystem::is_directory(status)) return refuse("Is a directory");
  if (!std::filesystem::is_regular_file(status))
    return refuse("it is a pipe or a device, must be a regular file");
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return refuse(std::generic_category().message(errno));
  ::close(descriptor);
  return {};
}

}  // namespace

Result<void> write_trajectory(const std::filesystem::path& path, const Trajectory& trajectory) {
  if (auto fits = check_consistency(trajectory); !fits) return fits;
  const auto refuse = [&](const std::string& reason) {
    return fail(Fault::io, fmt::format("cannot write '{}': {}", path.string(), reason));
  };
  AtomicFile target(path);
  const int descriptor =
      ::open(target.temporary().c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) return refuse(std::generic_category().message(errno));
  const auto written = write_sealed(descriptor, target, trajectory);
  // what is still on its way may meet the full disk only now
  if (::close(descriptor) != 0 && written) return refuse(std::generic_category().message(errno));
  if (!written) return refuse(written.error().message);
  return target.commit();
}

Result<Trajectory> read_trajectory(const std::filesystem::path& path,
                                   const TrajectoryReadOptions& how) {
  const auto refuse = [&](const std::string& reason) {
    return fail(Fault::bad_input,
                fmt::format("'{}' is no trajectory of a run: {}", path.string(), reason));
  };
  TRY_DO(readable(path));
  if (const auto reason = header_fault(path, how.unsealed); !reason.empty()) return refuse(reason);
  try {
    if (how.trial)
      if (auto survived = read_in_subprocess([&] { (void)read_checked(path); }); !survived)
        return refuse(survived.error().message);
    auto trajectory = read_checked(path);
    if (!trajectory) return refuse(trajectory.error().message);
    return trajectory;
  } catch (const std::bad_alloc&) {
    return refuse("it claims to hold more than fits into memory");
  }
}

}  // namespace gridshell::record
