#include "engine/record/run_folder.h"

#include <algorithm>
#include <cmath>

#include "engine/core/file_io.h"
#include "engine/core/system_info.h"
#include "engine/core/try.h"
#include "engine/formats/csv.h"
#include "engine/record/frame_columns.h"
#include "engine/record/trajectory_file.h"

namespace gridshell::record {

std::string joints_csv(const Trajectory& trajectory) {
  CsvWriter csv;
  csv.line("i", "j", "u_mm", "v_mm", "x_mm", "y_mm", "z_mm", "deviation_mm");
  if (trajectory.frames.empty()) return std::move(csv).text();
  const Frame& last = trajectory.frames.back();
  const Eigen::Matrix3Xd& net = trajectory.layout.net_nodes;
  for (const Joint& joint : trajectory.layout.joints) {
    const auto at = last.nodes.col(joint.node);
    const double deviation = joint.node < net.cols() ? (at - net.col(joint.node)).norm() : unknown;
    csv.line(joint.i, joint.j, joint.u_mm, joint.v_mm, at.x(), at.y(), at.z(), deviation);
  }
  return std::move(csv).text();
}

std::string cells_csv(const Trajectory& trajectory) {
  CsvWriter csv;
  csv.line("i", "j", "u_mm", "v_mm", "cx_mm", "cy_mm", "cz_mm", "K");
  if (trajectory.frames.empty()) return std::move(csv).text();
  const Layout& layout = trajectory.layout;
  const Frame& last = trajectory.frames.back();
  for (std::size_t k = 0; k < layout.cells.size(); ++k) {
    const Cell& cell = layout.cells[k];
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    for (const int joint : cell.joints) centroid += last.nodes.col(layout.joints[joint].node) / 4;
    csv.line(cell.i, cell.j, cell.u_mm, cell.v_mm, centroid.x(), centroid.y(), centroid.z(),
             last.cell_K[static_cast<Eigen::Index>(k)]);
  }
  return std::move(csv).text();
}

std::string seams_csv(const Layout& layout) {
  CsvWriter csv;
  csv.line("seam", "family", "line_mm", "gap_mm", "kink_deg");
  for (const SeamRod& rod : layout.seam_rods)
    csv.line(rod.seam, std::string(1, rod.family), rod.line_mm, rod.gap_mm, rod.kink_deg);
  return std::move(csv).text();
}

namespace {

/// Writes a cell. A count below zero is not known and gives an empty cell. Commas of a text become
/// semicolons, so that readers that do not know quotes find the right columns.
void put(CsvWriter& csv, int value) { value < 0 ? csv.cell("") : csv.cell(value); }
void put(CsvWriter& csv, double value) { csv.cell(value); }
void put(CsvWriter& csv, std::string text) {
  std::ranges::replace(text, ',', ';');
  csv.cell(text);
}

}  // namespace

std::string bins_csv(const Trajectory& trajectory) {
  CsvWriter csv;
  csv.line("frame", "x_low", "x_high", "K_mean", "K_deviation", "cells");
  for (std::size_t f = 0; f < trajectory.frames.size(); ++f) {
    const Frame& frame = trajectory.frames.head(f);
    const Eigen::Index bins = frame.K_bins.rows();
    // a frame whose bins are not known has no row
    for (Eigen::Index k = 0; k < bins; ++k)
      if (const double cells = frame.K_bins(k, 2); !std::isnan(cells))
        csv.line(frame.index, -1 + 2.0 * double(k) / double(bins),
                 -1 + 2.0 * double(k + 1) / double(bins), frame.K_bins(k, 0), frame.K_bins(k, 1),
                 int(cells));
  }
  return std::move(csv).text();
}

std::string frames_csv(const Trajectory& trajectory) {
  CsvWriter csv;
  for (const FrameColumn& column : frame_columns) csv.cell(column.name);
  csv.end_line();
  for (std::size_t k = 0; k < trajectory.frames.size(); ++k) {
    for (const FrameColumn& column : frame_columns)
      visit_column(column, trajectory.frames.head(k), [&](const auto& value) { put(csv, value); });
    csv.end_line();
  }
  return std::move(csv).text();
}

Result<void> write_run(const std::filesystem::path& folder, const Trajectory& trajectory,
                       const Summary& summary) {
  TRY_DO(check_consistency(trajectory));
  TRY_DO(make_folder(folder));
  TRY_DO(write_file(folder / "joints.csv", joints_csv(trajectory)));
  TRY_DO(write_file(folder / "cells.csv", cells_csv(trajectory)));
  TRY_DO(write_file(folder / "frames.csv", frames_csv(trajectory)));
  if (!trajectory.layout.seam_rods.empty())
    TRY_DO(write_file(folder / "seams.csv", seams_csv(trajectory.layout)));
  TRY_DO(write_file(folder / "bins.csv", bins_csv(trajectory)));
  TRY_DO(write_trajectory(folder / "trajectory.h5", trajectory));
  return write_summary(folder / "summary.json", summary);
}

namespace fs = std::filesystem;

Result<void> FolderSink::begin(Layout layout) {
  TRY_DO(make_folder(folder_));
  TRY_DO(keep_coarser());
  TRY(journal, JournalWriter::create(folder_ / journal_name, name_, layout));
  journal_.emplace(std::move(*journal));
  return {};
}

Result<void> FolderSink::keep_coarser() {
  if (!journal_) coarser_frames_ = frames_in_journal(folder_ / coarser_journal_name);
  const std::size_t frames =
      journal_ ? journal_->frames() : frames_in_journal(folder_ / journal_name);
  if (frames <= coarser_frames_) return {};
  coarser_frames_ = frames;
  journal_.reset();
  std::error_code error;
  fs::rename(folder_ / journal_name, folder_ / coarser_journal_name, error);
  if (!error) return {};
  return fail(Fault::io, "cannot rename '{}': {}", (folder_ / journal_name).string(),
              error.message());
}

Result<void> FolderSink::take(Frame frame) {
  if (!journal_) return invalid("a frame came before its layout");
  auto appended = journal_->append(frame);
  if (!appended || coarser_frames_ == 0 || journal_->frames() < coarser_frames_) return appended;
  std::error_code ignored;
  fs::remove(folder_ / coarser_journal_name, ignored);
  coarser_frames_ = 0;
  return {};
}

Result<Trajectory> FolderSink::finish(const Summary& summary) {
  journal_.reset();
  // this program has just written the journal, so it is read without a trial in another process
  TRY(journal, read_journal(folder_ / journal_name, false));
  journal->trajectory.origin = {name_.title, name_.preset, std::string("gridshell ") + version()};
  TRY_DO(write_run(folder_, journal->trajectory, summary));
  std::error_code ignored;
  for (const char* name : {journal_name, coarser_journal_name}) fs::remove(folder_ / name, ignored);
  return std::move(journal->trajectory);
}

}  // namespace gridshell::record
