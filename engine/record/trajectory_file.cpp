#include "engine/record/trajectory_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <functional>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>

#include "engine/core/atomic_file.h"
#include "engine/record/checksum.h"
#include "engine/record/consistency.h"
#include "engine/record/frame_columns.h"
#include "engine/record/hdf5_reader.h"
#include "engine/record/hdf5_writer.h"
#include "engine/record/layout_file.h"
#include "engine/record/trial.h"

namespace gridshell::record {
namespace {

using hdf5::Dims;

constexpr std::size_t longest_word = 60000;  // what an attribute takes

const std::string format_name = "gridshell trajectory 1";

// HDF5 looks for its own beginning at 0, 512, 1024 ...: what lies before is the program's to use
constexpr std::size_t seal_size = 512;

/// Name and checksum of the HDF5 bytes that follow.
std::string seal_of(std::uintmax_t bytes, const Checksum& sum) {
  std::string seal = fmt::format("{}\n{} bytes, FNV-1a {:016x}\n", format_name, bytes, sum.value());
  seal.resize(seal_size, '\0');
  return seal;
}

/// The seal that a file should bear, from the bytes after its first 512; empty when it cannot be
/// read.
std::string seal_due(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(seal_size);
  Checksum sum;
  std::uintmax_t bytes = 0;
  std::vector<char> block(1 << 18);
  while (file) {
    file.read(block.data(), std::streamsize(block.size()));
    const auto got = std::size_t(file.gcount());
    sum.add({block.data(), got});
    bytes += got;
  }
  return file.eof() ? seal_of(bytes, sum) : std::string();
}

/// Why a file is not to be trusted, or empty. Without a seal another program wrote it.
std::string distrust(const std::filesystem::path& path, bool unsealed) {
  std::string start(seal_size, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), seal_size);
  const auto got = std::size_t(file.gcount());
  start.resize(got);
  if (start.starts_with("\x89HDF\r\n\x1a\n"))
    return unsealed ? ""
                    : "it bears no seal, so another program wrote it ('render --unsealed' reads it "
                      "all the same)";
  if (!start.starts_with(format_name)) return "it is not an HDF5 file";
  if (got < seal_size) return "it is cut short";
  if (start == seal_due(path) || unsealed) return "";
  return "it is cut short, damaged or was changed: its checksum does not match";
}

hid_t memory_type(int) { return H5T_NATIVE_INT; }
hid_t memory_type(double) { return H5T_NATIVE_DOUBLE; }

std::string dataset_of(const FrameColumn& column) { return "/frames/" + column.name; }

/// A column's values over all frames.
template <class T, class Frames, class Visit>
void each_value(const FrameColumn& column, Frames& frames, Visit visit) {
  for (auto& frame : frames)
    visit_column(column, frame, [&]<class U>(U&& value) {
      if constexpr (std::is_same_v<T, std::remove_cvref_t<U>>) visit(value);
    });
}

/// All columns of a run, of frames without their nodes.
void write_columns(hdf5::Writer& file, const std::vector<Frame>& heads) {
  const Frame any;
  const auto write = [&](const FrameColumn& column) {
    const std::string name = dataset_of(column);
    visit_column(column, any, [&]<class T>(const T&) {
      std::vector<T> values;
      each_value<T>(column, heads, [&](const T& value) { values.push_back(value); });
      if constexpr (std::is_same_v<T, std::string>)
        file.strings(name, values);
      else
        file.dataset(name, memory_type(T{}), {values.size()}, values.data(), column.unit);
    });
  };
  file.group("/frames");
  for (const FrameColumn& column : frame_columns) write(column);
  write(actuation_column);
}

/// A frame without bins has unknown ones.
void write_bins(hdf5::Writer& file, const std::vector<Frame>& heads) {
  Eigen::Index bins = 0;
  for (const Frame& frame : heads) bins = std::max(bins, frame.K_bins.rows());
  if (bins == 0) return;
  std::vector<double> values;
  for (const Frame& frame : heads)
    for (Eigen::Index k = 0; k < bins; ++k)
      for (Eigen::Index column = 0; column < 3; ++column)
        values.push_back(k < frame.K_bins.rows() ? frame.K_bins(k, column) : unknown);
  file.dataset("/K_bins", H5T_NATIVE_DOUBLE, {heads.size(), static_cast<hsize_t>(bins), 3},
               values.data(), "rad, rad, cells");
}

/// What a frame may lack, with the size that it has otherwise: visit(name, unit, size, meaning,
/// field).
template <class Visit>
void each_of_rods(const Layout& layout, Visit visit) {
  visit("/axial_force_N", "N", edges_of_rods(layout), "of each edge, rod after rod",
        &Frame::axial_force_N);
  visit("/curvature_per_mm", "1/mm", points_of_rods(layout), "at each point, rod after rod",
        &Frame::curvature_per_mm);
  visit("/reactions_N", "N", Eigen::Index(layout.supports.size()), "on each of /layout/supports",
        &Frame::reactions_N);
}

template <class Values>
Values sized(Eigen::Index size) {
  if constexpr (Values::RowsAtCompileTime == 3)
    return Values::Constant(3, size, unknown);
  else
    return Values::Constant(size, unknown);
}

template <class Values>
Dims dims_of(std::size_t frames, Eigen::Index size) {
  Dims dims{frames, hsize_t(size)};
  if (Values::RowsAtCompileTime == 3) dims.push_back(3);
  return dims;
}

/// Of runs whose end knows them.
void write_of_rods(hdf5::Writer& file, const Layout& layout, const FrameList& frames) {
  if (frames.empty()) return;
  each_of_rods(layout, [&]<class Values>(const char* name, const char* unit, Eigen::Index size,
                                         const char* meaning, Values Frame::*field) {
    if (size == 0 || (frames.back().*field).size() == 0) return;
    file.dataset(name, H5T_NATIVE_DOUBLE, dims_of<Values>(frames.size(), size), nullptr, unit);
    file.attribute(name, "meaning",
                   std::string(meaning) +
                       "; of the finest mesh itself, never extrapolated, so that "
                       "with the loads they balance to residual_N; NaN: unknown");
    hsize_t k = 0;
    for (const Frame& frame : frames) {
      const Values& known = frame.*field;
      file.write_slice(name, H5T_NATIVE_DOUBLE, k++,
                       (known.size() > 0 ? known : sized<Values>(size)).eval().data());
    }
  });
}

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

void write_frames(hdf5::Writer& file, const FrameList& frames, hsize_t cells, bool extrapolated) {
  const hsize_t count = frames.size();
  const hsize_t nodes = frames.empty() ? 0 : frames.front().nodes.cols();
  file.dataset("/nodes", H5T_NATIVE_DOUBLE, {count, nodes, 3}, nullptr, "mm");
  file.attribute("/nodes", "meaning",
                 extrapolated
                     ? "extrapolated over the last two meshes, as energies and K are; residuals "
                       "and pivots are those of the finest mesh"
                     : "of the finest mesh");
  file.dataset("/cell_K", H5T_NATIVE_DOUBLE, {count, cells}, nullptr, "rad");
  std::vector<Frame> heads;
  hsize_t k = 0;
  for (const Frame& frame : frames) {
    file.write_slice("/nodes", H5T_NATIVE_DOUBLE, k, frame.nodes.data());
    file.write_slice("/cell_K", H5T_NATIVE_DOUBLE, k++, frame.cell_K.data());
    heads.push_back(without_nodes(frame));
  }
  write_bins(file, heads);
  write_columns(file, heads);
}

/// The HDF5 part onto a descriptor, then the seal before it; errno of what failed, or 0.
Result<void> write_sealed(int descriptor, const AtomicFile& target, const Trajectory& trajectory) {
  hdf5::Stream stream{descriptor, seal_size, 0};
  hdf5::Writer file(stream);
  file.attribute("/", "format", format_name);
  write_origin(file, trajectory.origin);
  write_layout(file, trajectory.layout);
  write_frames(file, trajectory.frames, trajectory.layout.cells.size(),
               trajectory.layout.extrapolated);
  write_of_rods(file, trajectory.layout, trajectory.frames);
  file.finish();
  const auto failed = [](int code) {
    return fail(Fault::io, std::generic_category().message(code));
  };
  if (stream.failure) return failed(stream.failure);
  if (!file.good()) return fail(Fault::io, file.reason());
  if (trajectory.frames.fault()) return tl::unexpected(*trajectory.frames.fault());
  const std::string seal = seal_due(target.temporary());
  if (seal.empty()) return fail(Fault::io, "it cannot be read back");
  const ssize_t put = ::pwrite(descriptor, seal.data(), seal.size(), 0);
  if (put != ssize_t(seal.size())) return failed(put < 0 ? errno : ENOSPC);
  return {};
}

/// Frames that stay in the file; the columns, which are small, are in memory.
class StoredFrames : public FrameSource {
 public:
  StoredFrames(std::shared_ptr<hdf5::Reader> file, std::vector<Frame> heads, Eigen::Index nodes,
               Eigen::Index cells, const Layout& layout)
      : file_(std::move(file)), heads_(std::move(heads)), nodes_(nodes), cells_(cells) {
    each_of_rods(layout, [&]<class Values>(const char* name, const char*, Eigen::Index size,
                                           const char*, Values Frame::*field) {
      if (!file_->has(name)) return;
      const Dims wanted = dims_of<Values>(heads_.size(), size);
      const Dims dims = file_->dims(name, wanted.size());
      if (file_->good() && dims != wanted)
        file_->fail_because(std::string(name) + " does not fit the rods and the frames");
      of_rods_.push_back([name, size, field](hdf5::Reader& from, std::size_t k, Frame& frame) {
        Values& values = frame.*field = sized<Values>(size);
        from.read_slice(name, H5T_NATIVE_DOUBLE, k, values.data());
        if (values.array().isNaN().all()) values.resize(values.rows() == 3 ? 3 : 0, 0);
      });
    });
  }

  std::size_t size() const override { return heads_.size(); }

  Result<Frame> read(std::size_t k) const override {
    Frame frame = heads_[k];
    frame.nodes.resize(3, nodes_);
    frame.cell_K.resize(cells_);
    file_->read_slice("/nodes", H5T_NATIVE_DOUBLE, k, frame.nodes.data());
    file_->read_slice("/cell_K", H5T_NATIVE_DOUBLE, k, frame.cell_K.data());
    for (const auto& take : of_rods_) take(*file_, k, frame);
    if (!file_->good()) return fail(Fault::io, "cannot read a frame: " + file_->reason());
    return frame;
  }

 private:
  std::shared_ptr<hdf5::Reader> file_;
  std::vector<Frame> heads_;
  Eigen::Index nodes_, cells_;
  std::vector<std::function<void(hdf5::Reader&, std::size_t, Frame&)>> of_rods_;
};

void forget(int& value) { value = -1; }
void forget(double& value) { value = unknown; }
void forget(std::string& value) { value.clear(); }

void read_column(hdf5::Reader& file, const FrameColumn& column, std::vector<Frame>& heads) {
  const std::string name = dataset_of(column);
  const Frame any;
  visit_column(column, any, [&]<class T>(const T&) {
    // an older version did not know it
    if (!file.has(name)) return each_value<T>(column, heads, [](T& value) { forget(value); });
    std::vector<T> values;
    if constexpr (std::is_same_v<T, std::string>)
      values = file.strings(name);
    else
      values = file.vector<T>(name, memory_type(T{}));
    if (values.size() != heads.size())
      file.fail_because(
          fmt::format("{} has {} values for {} frames", name, values.size(), heads.size()));
    if (!file.good()) return;
    auto at = values.begin();
    each_value<T>(column, heads, [&](T& value) { value = std::move(*at++); });
  });
}

void read_bins(hdf5::Reader& file, std::vector<Frame>& heads) {
  if (!file.has("/K_bins")) return;
  const Dims dims = file.dims("/K_bins", 3);
  if (!file.good()) return;
  if (dims[0] != heads.size() || dims[2] != 3)
    return file.fail_because(fmt::format("/K_bins is {} x {} x {} for {} frames", dims[0], dims[1],
                                         dims[2], heads.size()));
  std::vector<double> values(dims[0] * dims[1] * dims[2]);
  file.read("/K_bins", H5T_NATIVE_DOUBLE, values.data());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const Eigen::Index bins = static_cast<Eigen::Index>(dims[1]);
  for (std::size_t k = 0; k < heads.size(); ++k)
    heads[k].K_bins = Eigen::Map<const Rows>(values.data() + 3 * dims[1] * k, bins, 3);
}

FrameList read_frames(const std::shared_ptr<hdf5::Reader>& shared, const Layout& layout) {
  hdf5::Reader& file = *shared;
  const Dims nodes = file.dims("/nodes", 3), cells = file.dims("/cell_K", 2);
  if (!file.good()) return {};
  if (nodes[2] != 3 || cells[0] != nodes[0])
    file.fail_because(fmt::format("/nodes is {} x {} x {} and /cell_K {} x {}", nodes[0], nodes[1],
                                  nodes[2], cells[0], cells[1]));
  if (nodes[1] == 0 && nodes[0] > 0) file.fail_because("/nodes holds frames without nodes");
  if (!file.good()) return {};
  // what frames hold is counted by the layout
  if (nodes[0] > 0)
    if (auto fits = check_layout(layout, Eigen::Index(nodes[1])); !fits)
      file.fail_because(fits.error().message);
  if (!file.good()) return {};
  std::vector<Frame> heads(nodes[0]);
  for (const FrameColumn& column : frame_columns) read_column(file, column, heads);
  read_column(file, actuation_column, heads);
  read_bins(file, heads);
  if (!file.good()) return {};
  auto stored = std::make_shared<StoredFrames>(shared, std::move(heads), Eigen::Index(nodes[1]),
                                               Eigen::Index(cells[1]), layout);
  return file.good() ? FrameList(std::move(stored)) : FrameList();
}

Result<Trajectory> read_checked(const std::filesystem::path& path) {
  const auto refuse = [](const std::string& reason) { return fail(Fault::bad_input, reason); };
  const auto file = std::make_shared<hdf5::Reader>(path);
  if (!file->good()) return refuse("it is cut short or damaged");
  if (file->text_attribute("/", "format") != format_name)
    return refuse(fmt::format("it does not say \"{}\"", format_name));
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
                                   const TrajectoryReading& how) {
  const auto refuse = [&](const std::string& reason) {
    return fail(Fault::bad_input,
                fmt::format("'{}' is no trajectory of a run: {}", path.string(), reason));
  };
  if (auto opens = readable(path); !opens) return tl::unexpected(opens.error());
  if (const auto reason = distrust(path, how.unsealed); !reason.empty()) return refuse(reason);
  try {
    if (how.trial)
      if (auto survived = try_out([&] { (void)read_checked(path); }); !survived)
        return refuse(survived.error().message);
    auto trajectory = read_checked(path);
    if (!trajectory) return refuse(trajectory.error().message);
    return trajectory;
  } catch (const std::bad_alloc&) {
    return refuse("it claims to hold more than fits into memory");
  }
}

}  // namespace gridshell::record
