#include "render/figure/sweep_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "engine/core/number.h"
#include "render/plot/canvas.h"
#include "render/plot/text.h"

namespace gridshell::render {
namespace {

using record::SweepTable;

/// 1.0 reads 1; a string loses its quotes.
std::string short_text(const std::string& value) {
  if (value.size() > 1 && value.front() == '"') return value.substr(1, value.size() - 2);
  if (value.ends_with(".0")) return value.substr(0, value.size() - 2);
  return value;
}

const std::string& text_of(const SweepTable& table, const SweepTable::Row& row, std::size_t k,
                           std::string& seed) {
  if (!table.axes.empty()) return row.keys.values[k];
  return seed = std::to_string(row.keys.seed);
}

}  // namespace

std::string label_of(const std::string& name) {
  static const std::map<std::string, std::string> known{
      {"max_deviation", "largest deviation from the net over *ρ*"},
      {"mean_deviation", "mean deviation from the net over *ρ*"},
      {"largest_strain", "largest axial strain, by size"},
      {"stiffness_ratio", "*EA* *d*^{2}/*EI*"},
      {"total_K", "total *K* (rad)"},
      {"energy_bend_mJ", "bending energy (mJ)"},
      {"energy_stretch_mJ", "stretching energy (mJ)"},
      {"energy_twist_mJ", "torsional energy (mJ)"},
      {"energy_joint_mJ", "energy in joint springs (mJ)"},
      {"energy_shear_mJ", "energy of joint shear (mJ)"},
      {"energy_load_mJ", "energy of loads and ground (mJ)"},
      {"energy_support_mJ", "energy in springs of supports (mJ)"},
      {"actuation.ratio", "*R*_{a}/*R*_{o}"},
      {"footprint.longest_leg", "longest leg *L̄*_{d}, in *d*"},
      {"footprint.rods", "rods in each direction *n*"},
      {"rod.young_GPa", "Young's modulus *E* (GPa)"},
      {"actuation.radius_mm", "*R*_{a} (mm)"},
      {"footprint.radius_mm", "*R*_{o} (mm)"},
      {"footprint.spacing_mm", "spacing *d* (mm)"},
      {"rod.diameter_mm", "rod diameter *D* (mm)"},
      {"net.cut_height", "height of the cut *z*^{∗}/*ρ*"}};
  if (const auto at = known.find(name); at != known.end()) return at->second;
  static const std::vector<std::pair<std::string, std::string>> units{
      {"_N_per_mm", "N/mm"}, {"_per_mm", "1/mm"}, {"_kg_m3", "kg/m^{3}"},
      {"_m_s2", "m/s^{2}"},  {"_Nmm", "N mm"},    {"_mm", "mm"},
      {"_mJ", "mJ"},         {"_GPa", "GPa"},     {"_deg", "degrees"},
      {"_per_s", "1/s"},     {"_N", "N"},         {"_s", "s"}};
  const auto dot = name.find('.');
  std::string word = dot == std::string::npos ? name : name.substr(dot + 1);
  for (const auto& [ending, unit] : units)
    if (word.ends_with(ending))
      return plain(spaced(word.substr(0, word.size() - ending.size()))) + " (" + unit + ")";
  return plain(spaced(word));
}

SweepScale scale_of(const SweepTable& table, std::size_t k) {
  SweepScale scale;
  scale.label = table.axes.empty() ? "seed" : label_of(table.axes[k]);
  std::string seed;
  for (const auto& row : table.rows) {
    const std::string& text = text_of(table, row, k, seed);
    if (std::ranges::find(scale.texts, text) != scale.texts.end()) continue;
    scale.texts.push_back(text);
    const auto number = number_from<double>(text);
    scale.is_number = scale.is_number && number;
    scale.numbers.push_back(number.value_or(0));
  }
  if (scale.is_number) return scale;
  scale.label += ": ";
  for (std::size_t n = 0; n < scale.texts.size(); ++n) {
    scale.numbers[n] = double(n + 1);
    scale.label +=
        (n == 0 ? "" : ", ") + std::to_string(n + 1) + " " + plain(short_text(scale.texts[n]));
  }
  return scale;
}

std::size_t place_of(const SweepTable& table, const SweepScale& scale, const SweepTable::Row& row,
                     std::size_t k) {
  std::string seed;
  const auto at = std::ranges::find(scale.texts, text_of(table, row, k, seed));
  return std::size_t(at - scale.texts.begin());
}

double number_of(const SweepTable::Row& row, const std::string& figure) {
  const auto* found = row.result.figure(figure);
  const double number =
      found ? record::number_of(*found) : std::numeric_limits<double>::quiet_NaN();
  // its sign says whether it is tension, which differs from edge to edge
  return figure == "largest_strain" ? std::abs(number) : number;
}

std::string limit_of(const SweepTable::Row& row) {
  const auto* found = row.result.figure("limit");
  const auto* word = found ? std::get_if<std::string>(found) : nullptr;
  return !word || *word == "none" ? "" : *word;
}

std::vector<std::string> cases_of(const SweepTable& table) {
  std::vector<std::string> cases;
  for (const auto& row : table.rows)
    if (std::ranges::find(cases, row.keys.case_name) == cases.end())
      cases.push_back(row.keys.case_name);
  return cases;
}

}  // namespace gridshell::render
