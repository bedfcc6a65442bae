#include "engine/record/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/core/text.h"
#include "engine/core/try.h"

namespace gridshell::record {

void Summary::take_state(const Frame& last) {
  StateFigures::operator=(last);
  stable = last.negative_pivots == 0;
}

std::string Summary::breaking() const {
  if (!(utilisation > 1)) return "";
  return fmt::format("BREAKS: {:.3g} times the strength", utilisation);
}

namespace {

/// Whether a file may lack the key, since an older version did not write it.
bool may_lack(const std::string& key) {
  static const auto later = words_in(
      "program energies_error_mJ pushed_joint kind finished largest_strain steps doubt "
      "tolerance_met force_N push_error_N stiffness_N_per_mm "
      "stiffness_error_N_per_mm largest_force_N force_error_N largest_bending_strain "
      "bending_strain_at largest_stress_MPa utilisation stress_at lowest_mm contact contacts",
      " ");
  return key.starts_with("energy_") || key.ends_with("_gap_mm") ||
         std::ranges::find(later, key) != later.end();
}

Json json_of_run(const Summary& summary) {
  Json json = json_of(summary);
  if (!summary.solved) json["stable"] = nullptr;
  if (!summary.solved || summary.negative_pivots < 0) json["negative_pivots"] = nullptr;
  return json;
}

}  // namespace

std::string to_json(const Summary& summary) { return text_of(json_of_run(summary)); }

Figures figures_of(const Summary& summary) {
  static const std::set<std::string> left_out{
      "program",           "preset",    "model_reason", "steps", "kind", "finished",
      "bending_strain_at", "stress_at", "pushed_joint"};
  Figures figures;
  const Json json = json_of_run(summary);
  for (const auto& [key, value] : json.items()) {
    if (left_out.contains(key) || key.starts_with("seconds_")) continue;
    const bool endless = value.is_number() && !std::isfinite(value.get<double>());
    figures.emplace_back(key, endless ? Figure() : figure_of(value));
  }
  return figures;
}

Result<void> write_summary(const std::filesystem::path& path, const Summary& summary) {
  return write_file(path, to_json(summary));
}

Result<Summary> read_summary(const std::filesystem::path& path) {
  TRY(text, read_file(path, largest_text));
  const auto refuse = [&](const std::string& fault) {
    return invalid("'{}' is no summary of a run: {}", path.string(), fault);
  };
  Json json = parsed(*text);
  if (!json.is_object()) return refuse("got no JSON object");
  Summary summary;
  // an older version did not write these
  summary.program.clear();
  for (const TermName& term : energy_terms) summary.energies[term.term] = unknown;
  summary.solved = !json.contains("stable") || !json["stable"].is_null();
  if (!summary.solved) json["stable"] = false;
  if (json.contains("negative_pivots") && json["negative_pivots"].is_null())
    json["negative_pivots"] = -1;
  const std::string fault = take_fields(json, summary, may_lack);
  if (!fault.empty()) return refuse(fault);
  return summary;
}

}  // namespace gridshell::record
