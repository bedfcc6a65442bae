#include "engine/record/summary.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "engine/core/file_io.h"
#include "engine/core/json.h"
#include "engine/core/try.h"

namespace gridshell::record {

void Summary::take_state(const Frame& last) {
  negative_pivots = std::max(last.negative_pivots, 0);
  stable = last.negative_pivots == 0;
  residual_N = last.residual_N;
  error_estimate_mm = last.error_estimate_mm;
  energies = last.energies;
  height_mm = last.height_mm;
  total_K = last.total_K;
}

namespace {

/// visit(key, field) for every key of summary.json, in order
template <class SummaryType, class Visit>
void each_field(SummaryType& summary, Visit visit) {
  visit("preset", summary.preset);
  visit("model", summary.model);
  visit("model_reason", summary.model_reason);
  visit("edges_per_segment", summary.edges_per_segment);
  visit("rods", summary.rods);
  visit("joints", summary.joints);
  visit("cells", summary.cells);
  visit("dof", summary.dof);
  visit("stable", summary.stable);
  visit("negative_pivots", summary.negative_pivots);
  visit("limit", summary.limit);
  visit("limit_reason", summary.limit_reason);
  visit("doubt", summary.doubt);
  visit("residual_N", summary.residual_N);
  visit("largest_strain", summary.largest_strain);
  visit("error_estimate_mm", summary.error_estimate_mm);
  for (const TermName& term : energy_terms)
    visit(fmt::format("energy_{}_mJ", term.name).c_str(), summary.energies[term.term]);
  visit("height_mm", summary.height_mm);
  visit("total_K", summary.total_K);
  visit("max_deviation", summary.max_deviation);
  visit("mean_deviation", summary.mean_deviation);
  visit("median_deviation", summary.median_deviation);
  visit("deviation_p90", summary.deviation_p90);
  visit("max_seam_gap_mm", summary.max_seam_gap_mm);
  visit("max_seam_kink_deg", summary.max_seam_kink_deg);
  visit("newton_iterations", summary.newton_iterations);
  visit("factorizations", summary.factorizations);
  visit("seconds_setup", summary.seconds_setup);
  visit("seconds_simulation", summary.seconds_simulation);
  visit("seconds_render", summary.seconds_render);
  visit("steps", summary.steps);
  visit("kind", summary.kind);
  visit("finished", summary.finished);
}

template <class T>
Json json_of(const T& value) {
  return value;
}
Json json_of(const Limit& limit) { return word_of(limit); }
Json json_of(const Kind& kind) { return word_of(kind); }

/// takes the value if it is of the right kind; `expected` then says which kind is
bool take(const Json& json, std::string& value, std::string& expected) {
  expected = "a string";
  if (json.is_string()) value = json.get<std::string>();
  return json.is_string();
}
bool take(const Json& json, int& value, std::string& expected) {
  expected = "a whole number";
  const auto number = whole_number(json);
  value = number.value_or(value);
  return number.has_value();
}
bool take(const Json& json, bool& value, std::string& expected) {
  expected = "true or false";
  if (json.is_boolean()) value = json.get<bool>();
  return json.is_boolean();
}
bool take(const Json& json, double& value, std::string& expected) {
  expected = "a number or null";
  value = json.is_number() ? json.get<double>() : unknown;
  return json.is_number() || json.is_null();
}
bool take(const Json& json, std::vector<std::string>& value, std::string& expected) {
  expected = "a list of strings";
  if (!json.is_array()) return false;
  for (const Json& item : json) {
    if (!item.is_string()) return false;
    value.push_back(item.get<std::string>());
  }
  return true;
}
/// "one of "run", "figure", "movie""; a word that is empty is none to write.
template <class Enum>
std::string one_of() {
  std::string text;
  for (const auto& [value, word] : words_of<Enum>())
    if (!word.empty()) text += fmt::format("{} \"{}\"", text.empty() ? "one of" : ",", word);
  return text;
}
template <class Enum>
bool take_word(const Json& json, Enum& value) {
  const auto found =
      json.is_string() ? find_word<Enum>(json.get<std::string>()) : std::optional<Enum>();
  value = found.value_or(value);
  return found.has_value();
}
bool take(const Json& json, Limit& value, std::string& expected) {
  expected = one_of<Limit>();
  return take_word(json, value);
}
bool take(const Json& json, Kind& value, std::string& expected) {
  expected = one_of<Kind>();
  return take_word(json, value);
}

/// What a key comes to that an older version did not write.
void forget(double& value) { value = unknown; }
template <class T>
void forget(T&) {}  // the default is what it was then

/// Whether version 0.1 wrote the key.
bool always_written(const std::string& key) {
  return !key.starts_with("energy_") && key != "kind" && key != "finished" &&
         key != "largest_strain" && key != "steps" && key != "doubt";
}

}  // namespace

std::string to_json(const Summary& summary) {
  Json json = Json::object();  // made by [] it would not survive a failed allocation
  each_field(summary, [&](const char* key, const auto& value) { json[key] = json_of(value); });
  if (!summary.solved) json["stable"] = json["negative_pivots"] = nullptr;
  return text_of(json);
}

Figures figures_of(const Summary& summary) {
  static const std::set<std::string> left_out{"preset", "model_reason", "steps", "kind",
                                              "finished"};
  Figures figures;
  each_field(summary, [&](const std::string& key, const auto& value) {
    if (left_out.contains(key) || key.starts_with("seconds_")) return;
    const Json json = json_of(value);
    Figure figure;
    if (json.is_boolean()) figure = json.get<bool>();
    if (json.is_string()) figure = json.get<std::string>();
    if (json.is_number() && std::isfinite(json.get<double>())) figure = json.get<double>();
    if (!summary.solved && (key == "stable" || key == "negative_pivots")) figure = {};
    figures.emplace_back(key, std::move(figure));
  });
  return figures;
}

Result<void> write_summary(const std::filesystem::path& path, const Summary& summary) {
  return write_file(path, to_json(summary));
}

Result<Summary> read_summary(const std::filesystem::path& path) {
  TRY(text, read_file(path, largest_text));
  Json json = parsed(*text);
  if (!json.is_object())
    return fail(Fault::bad_input,
                fmt::format("'{}' is no summary of a run: not a JSON object", path.string()));
  Summary summary;
  std::string fault;
  // of a net, for which nothing was solved
  if (json.contains("stable") && json["stable"].is_null()) {
    summary.solved = false;
    json["stable"] = false;
    json["negative_pivots"] = 0;
  }
  each_field(summary, [&](const char* key, auto& value) {
    if (!fault.empty()) return;
    std::string expected;
    if (!json.contains(key) && always_written(key))
      fault = fmt::format("has no \"{}\"", key);
    else if (!json.contains(key))
      forget(value);
    else if (!take(json[key], value, expected))
      fault = fmt::format("\"{}\" is {}, expected {}", key, line_of(json[key]), expected);
  });
  if (!fault.empty())
    return fail(Fault::bad_input,
                fmt::format("'{}' is no summary of a run: {}", path.string(), fault));
  return summary;
}

}  // namespace gridshell::record
