#include "engine/record/trajectory_hdf5.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/record/frame_columns.h"
#include "engine/record/trajectory.h"

namespace gridshell::record {
namespace {

using hdf5::Dims;

hid_t memory_type(int) { return H5T_NATIVE_INT; }
hid_t memory_type(double) { return H5T_NATIVE_DOUBLE; }

std::string dataset_of(const FrameColumn& column) { return "/frames/" + column.name; }

/// Calls visit(value) for a column of every frame, if the column is of type T.
template <class T, class Frames, class Visit>
void each_value(const FrameColumn& column, Frames& frames, Visit visit) {
  for (auto& frame : frames)
    visit_column(column, frame, [&]<class U>(U&& value) {
      if constexpr (std::is_same_v<T, std::remove_cvref_t<U>>) visit(value);
    });
}

/// Writes all columns of a run; `heads` are the frames without their nodes.
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

/// Writes /K_bins; frames without bins get NaN.
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

/// Frames whose arrays are read from the file on demand; their columns are in memory.
class StoredFrames : public FrameSource {
 public:
  StoredFrames(std::shared_ptr<hdf5::Reader> file, std::vector<Frame> heads, Eigen::Index nodes,
               Eigen::Index cells, const Layout& layout)
      : file_(std::move(file)), heads_(std::move(heads)), nodes_(nodes), cells_(cells) {
    each_rod_field([&]<class Values>(const char* name, const char*, SizeOf size, const char*,
                                     Values Frame::*) {
      if (!file_->has(name)) return;
      const Dims requested = dims_of<Values>(heads_.size(), size(layout));
      const Dims dims = file_->dims(name, requested.size());
      if (file_->good() && dims != requested)
        file_->fail_because(std::string(name) + " does not fit the rods and the frames");
    });
  }

  std::size_t size() const override { return heads_.size(); }
  const Frame* head(std::size_t k) const override { return &heads_[k]; }

  Result<Frame> read(std::size_t k) const override {
    Frame frame = heads_[k];
    frame.nodes.resize(3, nodes_);
    frame.cell_K.resize(cells_);
    file_->read_slice("/nodes", H5T_NATIVE_DOUBLE, k, frame.nodes.data());
    file_->read_slice("/cell_K", H5T_NATIVE_DOUBLE, k, frame.cell_K.data());
    each_rod_field([&]<class Values>(const char* name, const char*, SizeOf, const char*,
                                     Values Frame::*field) {
      if (!file_->has(name)) return;
      const Dims dims = file_->dims(name, dims_of<Values>(0, 0).size());
      if (!file_->good()) return;
      Values& values = frame.*field = sized<Values>(Eigen::Index(dims[1]));
      file_->read_slice(name, H5T_NATIVE_DOUBLE, k, values.data());
      if (values.array().isNaN().all()) values = Values();
    });
    if (!file_->good()) return fail(Fault::io, "cannot read a frame: " + file_->reason());
    return frame;
  }

 private:
  std::shared_ptr<hdf5::Reader> file_;
  std::vector<Frame> heads_;
  Eigen::Index nodes_, cells_;
};

void make_unknown(int& value) { value = -1; }
void make_unknown(double& value) { value = unknown; }
void make_unknown(std::string& value) { value.clear(); }

void read_column(hdf5::Reader& file, const FrameColumn& column, std::vector<Frame>& heads) {
  const std::string name = dataset_of(column);
  const Frame any;
  visit_column(column, any, [&]<class T>(const T&) {
    // older versions did not write every column
    if (!file.has(name)) return each_value<T>(column, heads, [](T& value) { make_unknown(value); });
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

}  // namespace

void write_frames(hdf5::Writer& file, const Layout& layout, const FrameList& frames) {
  const hsize_t count = frames.size();
  const hsize_t nodes = frames.empty() ? 0 : frames.front().nodes.cols();
  file.dataset("/nodes", H5T_NATIVE_DOUBLE, {count, nodes, 3}, nullptr, "mm");
  file.attribute("/nodes", "meaning",
                 layout.extrapolated
                     ? "extrapolated over the last two meshes, as K is; residuals and pivots are "
                       "those of the finest mesh"
                     : "of the finest mesh");
  file.dataset("/cell_K", H5T_NATIVE_DOUBLE, {count, hsize_t(layout.cells.size())}, nullptr, "rad");
  // the first frames may have no loads or braces: their rows are filled with NaN
  std::set<std::string> known;
  const auto begin_fields = [&](const Frame& frame, hsize_t from) {
    each_rod_field([&]<class Values>(const char* name, const char* unit, SizeOf size_of,
                                     const char* meaning, Values Frame::*field) {
      if ((frame.*field).size() == 0 || !known.insert(name).second) return;
      const Eigen::Index size = size_of(layout);
      file.dataset(name, H5T_NATIVE_DOUBLE, dims_of<Values>(count, size), nullptr, unit);
      file.attribute(name, "meaning", std::string(meaning) + "; NaN: unknown");
      const Values none = sized<Values>(size);
      for (hsize_t k = 0; k < from; ++k) file.write_slice(name, H5T_NATIVE_DOUBLE, k, none.data());
    });
  };
  std::vector<Frame> heads;
  for (const Frame& frame : frames) {
    const hsize_t k = heads.size();
    begin_fields(frame, k);
    file.write_slice("/nodes", H5T_NATIVE_DOUBLE, k, frame.nodes.data());
    file.write_slice("/cell_K", H5T_NATIVE_DOUBLE, k, frame.cell_K.data());
    each_rod_field([&]<class Values>(const char* name, const char*, SizeOf size, const char*,
                                     Values Frame::*field) {
      if (!known.contains(name)) return;
      const Values values = (frame.*field).size() > 0 ? frame.*field : sized<Values>(size(layout));
      file.write_slice(name, H5T_NATIVE_DOUBLE, k, values.data());
    });
    heads.push_back(without_nodes(frame));
  }
  write_bins(file, heads);
  write_columns(file, heads);
}

FrameList read_frames(const std::shared_ptr<hdf5::Reader>& shared, const Layout& layout) {
  hdf5::Reader& file = *shared;
  const Dims nodes = file.dims("/nodes", 3), cells = file.dims("/cell_K", 2);
  if (!file.good()) return {};
  if (nodes[2] != 3 || cells[0] != nodes[0])
    file.fail_because(fmt::format("/nodes is {} x {} x {} and /cell_K {} x {}", nodes[0], nodes[1],
                                  nodes[2], cells[0], cells[1]));
  if (nodes[1] == 0 && nodes[0] > 0) file.fail_because("/nodes has frames without nodes");
  if (!file.good()) return {};
  // the layout gives the size of a frame's arrays
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

}  // namespace gridshell::record
