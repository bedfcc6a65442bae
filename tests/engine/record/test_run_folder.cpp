#include <clocale>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/core/file_io.h"
#include "engine/core/system_info.h"
#include "engine/core/text.h"
#include "engine/formats/csv.h"
#include "engine/record/run_folder.h"
#include "tests/engine/record/sample_run.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::record;
namespace fs = std::filesystem;

namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// The parts of the text between separators `at`, as for a reader that knows no quotes.
std::vector<std::string> cut(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// The message that refuses a summary.json in which the text `from` is replaced by `to`.
std::string refusal(const std::string& from, const std::string& to) {
  TemporaryFolder folder;
  const fs::path path = folder / "summary.json";
  std::string text = to_json(sample_summary());
  REQUIRE(text.find(from) != std::string::npos);
  text.replace(text.find(from), from.size(), to);
  REQUIRE(write_file(path, text));
  const std::string start = "'" + path.string() + "' is no summary of a run: ",
                    why = gridshell::refusal(read_summary(path));
  CHECK_THAT(why, Catch::StartsWith(start));
  return why.substr(start.size());
}

}  // namespace

TEST_CASE("summary.json has the keys of a run in order, and null for what is unknown") {
  const auto json = nlohmann::ordered_json::parse(to_json(sample_summary()));
  std::string keys;
  for (const auto& [key, value] : json.items()) keys += key + " ";
  CHECK(keys ==
        "program preset model model_reason edges_per_segment rods joints cells dof stable "
        "negative_pivots limit limit_reason doubt tolerance_met residual_N largest_strain "
        "error_estimate_mm "
        "force_N push_error_N stiffness_N_per_mm stiffness_error_N_per_mm largest_force_N "
        "force_error_N energies_error_mJ largest_bending_strain bending_strain_at "
        "largest_stress_MPa utilisation stress_at pushed_joint energy_bend_mJ energy_stretch_mJ "
        "energy_twist_mJ energy_joint_mJ energy_shear_mJ energy_load_mJ energy_support_mJ "
        "energy_contact_mJ energy_mJ height_mm lowest_mm contacts rod_gap_mm joint_gap_mm contact "
        "total_K max_deviation mean_deviation median_deviation deviation_p90 max_seam_gap_mm "
        "max_seam_kink_deg newton_iterations factorizations seconds_setup seconds_simulation "
        "seconds_render steps kind finished ");
  CHECK(json["error_estimate_mm"].is_null());
  CHECK(json["mean_deviation"].is_null());
  CHECK(json["max_deviation"] == 0.031029);
  CHECK(json["limit"] == "snap");
  CHECK(json["stable"] == true);
  CHECK(json["program"] == std::string("gridshell ") + version());
  CHECK(json["energy_mJ"] == sample_summary().energies.total());
}

TEST_CASE("a summary reads back as it was") {
  TemporaryFolder folder;
  const fs::path path = folder / "summary.json";
  const Summary summary = sample_summary();
  REQUIRE(write_summary(path, summary));
  const auto back = value_of(read_summary(path));
  CHECK(to_json(back) == to_json(summary));
  CHECK(same_bits(back.residual_N, summary.residual_N));
  CHECK(std::isnan(back.error_estimate_mm));
  CHECK(back.limit == Limit::snap);
  for (const Limit limit : {Limit::none, Limit::locking, Limit::branch_lost, Limit::no_equilibrium,
                            Limit::strength, Limit::contact}) {
    Summary other = summary;
    other.limit = limit;
    REQUIRE(write_summary(path, other));
    CHECK(read_summary(path)->limit == limit);
  }
  CHECK(std::string(word_of(Limit::branch_lost)) == "branch_lost");
  // the last frame of a run that was stopped in motion: its stability is not known
  Summary moving = summary;
  Frame last;
  last.negative_pivots = -1;
  moving.take_state(last);
  CHECK(nlohmann::ordered_json::parse(to_json(moving))["negative_pivots"].is_null());
  REQUIRE(write_summary(path, moving));
  CHECK(read_summary(path)->negative_pivots == -1);
  CHECK(read_summary(path)->solved);
}

TEST_CASE("a summary that is none is refused by its key") {
  CHECK(refusal("\"dof\": 2736,", "") == "has no \"dof\"");
  CHECK(refusal("2736", "2736.5") == "\"dof\": got 2736.5, expected an integer");
  CHECK(refusal("2736", "99999999999") == "\"dof\": got 99999999999, expected an integer");
  CHECK(refusal("39.979", "\"much\"") ==
        "\"energy_bend_mJ\": got \"much\", expected a number or null");
  CHECK(refusal("\"snap\"", "\"crackle\"") ==
        "\"limit\": got \"crackle\", expected one of \"none\", \"locking\", \"snap\", "
        "\"branch_lost\", "
        "\"no_equilibrium\", \"strength\", \"contact\"");
  CHECK(refusal("{", "[") == "got no JSON object");
}

TEST_CASE("a summary of version 0.1 is read, what it did not say is unknown") {
  const TemporaryFolder folder;
  auto json = nlohmann::ordered_json::parse(to_json(sample_summary()));
  for (const std::string_view key : words_in(
           "program energy_joint_mJ energy_shear_mJ energy_load_mJ energy_support_mJ "
           "energy_contact_mJ energy_mJ pushed_joint kind "
           "finished force_N push_error_N stiffness_N_per_mm stiffness_error_N_per_mm "
           "largest_force_N force_error_N energies_error_mJ largest_bending_strain "
           "bending_strain_at "
           "largest_stress_MPa utilisation stress_at lowest_mm contacts rod_gap_mm joint_gap_mm "
           "contact",
           " "))
    json.erase(std::string(key));
  REQUIRE(write_file(folder / "summary.json", json.dump()));
  const auto old = value_of(read_summary(folder / "summary.json"));
  CHECK(old.energies[Term::bend] == 39.979);
  CHECK(std::isnan(old.energies[Term::load]));
  CHECK(std::isnan(old.force_error_N));
  CHECK(old.bending_strain_at.empty());
  CHECK(old.kind == Kind::unknown);
  CHECK(old.finished);
  CHECK(old.contacts == -1);
  CHECK(old.program.empty());
  CHECK(std::isnan(old.rod_gap_mm));
}

TEST_CASE("CSV files have the columns that others read") {
  const Trajectory run = sample_trajectory();
  CHECK(first_line(joints_csv(run)) == "i,j,u_mm,v_mm,x_mm,y_mm,z_mm,deviation_mm");
  CHECK(first_line(cells_csv(run)) == "i,j,u_mm,v_mm,cx_mm,cy_mm,cz_mm,K");
  CHECK(first_line(frames_csv(run)) ==
        "frame,progress,boundary_radius_mm,depth_mm,force_N,energy_bend_mJ,energy_stretch_mJ,"
        "energy_twist_mJ,energy_joint_mJ,energy_shear_mJ,energy_load_mJ,energy_support_mJ,"
        "energy_contact_mJ,"
        "height_mm,total_K,"
        "residual_N,negative_pivots,error_estimate_mm,"
        "newton_iterations,reach_above_tenth,reach_above_half,lowest_latitude_deg,time_s,"
        "stiffness_N_per_mm,stiffness_error_N_per_mm,push_error_N,largest_force_N,force_error_N,"
        "energies_error_mJ,largest_bending_strain,largest_stress_MPa,"
        "utilisation,lowest_mm,contacts,rod_gap_mm,joint_gap_mm,energy_mJ,"
        "joint_angle_deg,joint_angle_error_deg,smallest_joint_angle_deg,largest_joint_angle_deg,"
        "one_joint_angle_error_deg,joint_torque_Nmm,joint_torque_error_Nmm,springs_error_mJ,kind,"
        "bending_strain_at,stress_at,event");
}

TEST_CASE("CSV lines contain the last frame, shortest numbers, and nothing for what is unknown") {
  Trajectory run = sample_trajectory();
  Eigen::Matrix3Xd& nodes = run.frames.edit().back().nodes;
  nodes.col(0) << 0.1, -1e-7, 1.0 / 3;
  nodes.col(1) << 4, 0, 0;
  nodes.col(2) << 0, 8, 0;
  nodes.col(3) << 0, 0, 2;
  nodes(0, 0) = unknown;
  CHECK(joints_csv(run) ==
        "i,j,u_mm,v_mm,x_mm,y_mm,z_mm,deviation_mm\n"
        "-1,-1,-10,-10,,-1e-07,0.3333333333333333,\n"
        "0,-1,10,-10,4,0,0,\n"
        "0,0,10,10,0,8,0,\n"
        "-1,0,-10,10,0,0,2,\n");
  // next to a net
  run.layout.net_nodes = nodes;
  run.layout.net_nodes(1, 1) = 3;
  CHECK(joints_csv(run).find("\n0,-1,10,-10,4,0,0,3\n0,0,10,10,0,8,0,0\n") != std::string::npos);
  nodes.col(0).setZero();
  CHECK(cells_csv(run) ==
        "i,j,u_mm,v_mm,cx_mm,cy_mm,cz_mm,K\n"
        "-1,-1,0,0,1,2,0.5,0.02\n");
  const std::string frames = frames_csv(run);
  CHECK_THAT(frames, Catch::Contains(
                         "\n1,0.3333333333333333,125.9,,,1e-300,0.30000000000000004,-0,0,0,0,0,0,"
                         "0.14285714285714285,3.141592653589793,5e-324,1,,7,,,,,,,,,,,,,,-0.5,1,,"
                         "0.3333333333333333,0.30000000000000004,,,,,,,,,solved,,,\n"));
  CHECK(frames.ends_with(
      ",0.001,14,,,,,,,,,2e-05,,,,1.4,-1,2,-0.1,0.3333333333333333,0.5,,,,,,,,,solved,"
      "u0; 45.00 mm from its start; at joint [0; 1],"
      "u0; 45.00 mm from its start; at joint [0; 1],"
      "\"snap; \"\"fast\"\" \xC3\xA9\"\n"));
}

TEST_CASE("a frame whose bins are not known has none in bins.csv") {
  Trajectory run = sample_trajectory();
  run.frames.edit()[1].K_bins.setConstant(unknown);
  const std::string bins = bins_csv(run);
  CHECK(cut(bins, '\n').size() == 1 + 2 * 5 + 1);
  CHECK_THAT(bins, !Catch::Contains("\n1,"));
}

TEST_CASE("every line of frames.csv splits at its commas into as many cells, numbers first") {
  std::vector<std::string> lines;
  for (const std::string& line : cut(frames_csv(sample_trajectory()), '\n'))
    if (!line.empty()) lines.push_back(line);
  REQUIRE(lines.size() == sample_trajectory().frames.size() + 1);
  const auto names = cut(lines.front(), ',');
  for (const std::string& line : lines) {
    const auto cells = cut(line, ',');
    REQUIRE(cells.size() == names.size());
    if (line == lines.front()) continue;
    for (std::size_t k = 0; k + 4 < cells.size(); ++k)
      CHECK((cells[k].empty() || parse_number<double>(cells[k])));
  }
}

TEST_CASE("the energies by term in a table sum up to energy_mJ") {
  const auto rows = csv_cells(frames_csv(sample_trajectory()));
  double sum = 0, total = 0;
  for (std::size_t k = 0; k < rows[0].size(); ++k) {
    if (rows[0][k].starts_with("energy_") && rows[0][k] != "energy_mJ")
      sum += *parse_number<double>(rows[1][k]);
    if (rows[0][k] == "energy_mJ") total = *parse_number<double>(rows[1][k]);
  }
  CHECK(sum != 0);
  CHECK(sum == total);
}

TEST_CASE("a rod above its strength breaks in plain words") {
  Summary summary = sample_summary();
  summary.utilisation = 2.083;
  CHECK(summary.breaking() == "BREAKS: 2.08 times the strength");
  summary.utilisation = 0.4;
  CHECK(summary.breaking().empty());
}

TEST_CASE("numbers in frames.csv and summary.json do not follow the locale") {
  const std::string before = frames_csv(sample_trajectory());
  const std::string json = to_json(sample_summary());
  const char* locale = std::setlocale(LC_ALL, "de_DE.UTF-8");
  if (!locale) locale = std::setlocale(LC_ALL, "fr_FR.UTF-8");
  if (!locale) WARN("no locale with a decimal comma is installed");
  CHECK(frames_csv(sample_trajectory()) == before);
  CHECK(to_json(sample_summary()) == json);
  std::setlocale(LC_ALL, "C");
}

TEST_CASE(
    "a run's folder contains its files and nothing else, seams.csv only where there are seams") {
  TemporaryFolder folder;
  const fs::path run = folder / "out" / "s1_actuation";
  REQUIRE(write_run(run, sample_trajectory(), sample_summary()));
  CHECK(names_in(run) == std::vector<std::string>{"bins.csv", "cells.csv", "frames.csv",
                                                  "joints.csv", "seams.csv", "summary.json",
                                                  "trajectory.h5"});
  CHECK(seams_csv(sample_trajectory().layout) ==
        "seam,family,line_mm,gap_mm,kink_deg\n"
        "left.east - right.west,u,-10,0.3333333333333333,7\n"
        "left.east - right.west,v,10,0.3333333333333333,0.1\n");
  auto plain = sample_trajectory();
  plain.layout.seam_rods.clear();
  REQUIRE(write_run(folder / "plain", plain, sample_summary()));
  CHECK_FALSE(fs::exists(folder / "plain/seams.csv"));
  CHECK(read_summary(run / "summary.json"));
  CHECK(read_trajectory(run / "trajectory.h5")->frames.size() == 3);
}

TEST_CASE("a run that cannot be written says where and why") {
  TemporaryFolder folder;
  const fs::path file = folder / "file";
  REQUIRE(write_file(file, "x"));
  CHECK(refusal(write_run(file / "run", sample_trajectory(), sample_summary()), Fault::io) ==
        "cannot make folder '" + (file / "run").string() + "': Not a directory");

  // the disk fills up at the largest file: no summary claims that the run is there
  const fs::path run = folder / "run";
  const FileSizeLimit full_disk(3000);
  CHECK(refusal(write_run(run, sample_trajectory(), sample_summary()), Fault::io) ==
        "cannot write '" + (run / "trajectory.h5").string() + "': File too large");
  CHECK_FALSE(fs::exists(run / "summary.json"));
  CHECK_FALSE(fs::exists(run / "trajectory.h5"));
}
