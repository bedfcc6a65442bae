#include "app/scan_files.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/record/csv.h"
#include "engine/record/json.h"

namespace gridshell::app {
namespace {

using record::Json;

Json json_of(const LaidScan& scan) {
  Json json = Json::object();
  json["joints_found"] = scan.found;
  json["joints_missing"] = scan.missing();
  json["outliers"] = scan.outliers.cols();
  json["joints_within_two_radii"] = scan.within_bar;
  json["rms_mm"] = scan.rms_mm;
  json["mean_mm"] = scan.mean_mm;
  json["max_mm"] = scan.max_mm;
  json["mirrored"] = scan.mirrored;
  return json;
}

Json json_of(const Pose& pose) {
  Json json = Json::object();
  json["turn"] = Json::array();
  for (int row = 0; row < 3; ++row)
    json["turn"].push_back({pose.turn(row, 0), pose.turn(row, 1), pose.turn(row, 2)});
  json["shift_mm"] = {pose.shift.x(), pose.shift.y(), pose.shift.z()};
  return json;
}

}  // namespace

std::string scan_json(const ComparedScan& scan) {
  const ComparedState& best = scan.of_best();
  Json json = Json::object();
  json["points"] = scan.points;
  if (best.shown)
    json["state"] = best.name;
  else
    json["state"] = nullptr;
  json["nearest_state"] = best.name;
  json.update(json_of(*best.scan));
  json["specks"] = scan.clusters.specks;
  json["clusters_too_wide"] = scan.clusters.others;
  json["joint_diameter_mm"] = scan.cylinder.diameter_mm;
  json["joint_height_mm"] = scan.cylinder.height_mm;
  json["scan_to_run"] = json_of(best.scan->pose);
  json["states"] = Json::array();
  for (const ComparedState& state : scan.states) {
    Json one = Json::object();
    one["name"] = state.name;
    one["shown"] = state.shown;
    if (state.scan) one.update(json_of(*state.scan));
    json["states"].push_back(std::move(one));
  }
  return record::text_of(json);
}

std::string scan_csv(const ComparedScan& scan, const record::Layout& layout) {
  record::Csv csv;
  csv.line("i", "j", "x_mm", "y_mm", "z_mm", "distance_mm", "distance_radii");
  const LaidScan& laid = *scan.of_best().scan;
  for (Eigen::Index k = 0; k < laid.joints.cols(); ++k) {
    const record::Joint& joint = layout.joints[std::size_t(k)];
    csv.line(joint.i, joint.j, laid.joints(0, k), laid.joints(1, k), laid.joints(2, k),
             laid.distance_mm[k], laid.distance_mm[k] / (scan.cylinder.diameter_mm / 2));
  }
  return std::move(csv).text();
}

std::string measured_csv(const LaidScan& scan) {
  record::Csv csv;
  csv.line("x_mm", "y_mm", "z_mm");
  const Eigen::Matrix3Xd measured = scan.measured();
  for (const auto& joint : measured.colwise()) csv.line(joint.x(), joint.y(), joint.z());
  return std::move(csv).text();
}

std::string scan_text(const ComparedScan& scan) {
  const ComparedState& best = scan.of_best();
  const LaidScan& laid = *best.scan;
  std::string text = best.shown ? "shows " + best.name : "does not show " + best.name;
  if (!best.shown && scan.states.size() > 1)
    text = fmt::format("shows none of {} states; nearest: {}", scan.states.size(), best.name);
  text += fmt::format(
      "\n  {} of {} joints found, {} outliers, {} specks{}; off by {:.3f} mm rms, {:.3f} mm at "
      "most; {} within two radii ({:g} mm)\n",
      laid.found, laid.joints.cols(), laid.outliers.cols(), scan.clusters.specks,
      laid.mirrored ? ", mirrored" : "", laid.rms_mm, laid.max_mm, laid.within_bar,
      scan.cylinder.diameter_mm);
  return text;
}

}  // namespace gridshell::app
