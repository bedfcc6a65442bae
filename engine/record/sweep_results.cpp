#include "engine/record/sweep_results.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <numeric>
#include <set>
#include <system_error>

#include "engine/core/dense.h"
#include "engine/core/json.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/formats/csv.h"

namespace gridshell::record {
namespace {

/// The names of all figures, in the order of their first occurrence.
std::vector<std::string> names_of(const SweepTable& table) {
  std::vector<std::string> names;
  for (const auto& row : table.rows)
    for (const auto& [name, figure] : row.result.figures)
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

void put(CsvWriter& csv, std::monostate) { csv.cell(""); }
void put(CsvWriter& csv, bool flag) { csv.cell(flag ? "true" : "false"); }
void put(CsvWriter& csv, const auto& value) { csv.cell(value); }

/// A string of TOML without its quotes.
std::string bare(const std::string& value) {
  const bool quoted = value.size() > 1 && value.front() == '"' && value.back() == '"';
  return quoted ? value.substr(1, value.size() - 2) : value;
}

/// The figure that a cell was written from.
Figure figure_in(const std::string& cell) {
  if (cell.empty()) return {};
  if (cell == "true" || cell == "false") return cell == "true";
  if (const auto number = parse_number<double>(cell)) return *number;
  return cell;
}

/// Reads a cell of a column before the figures into `row`. False if it does not fit its column.
bool take_key(const std::string& name, const std::string& cell, SweepTable::Row& row) {
  if (name == "case") {
    row.keys.case_name = cell;
  } else if (name == "point" || name == "seed") {
    const auto number = parse_number<int>(cell);
    if (!number) return false;
    if (name == "seed") row.keys.seed = *number;
    if (name == "point") row.result.point = std::size_t(*number);
  } else if (name == "outcome") {
    const auto word = find_word<PointOutcome>(cell);
    if (!word) return false;
    row.result.outcome = *word;
  } else {
    row.keys.values.push_back(cell);
    if (name == leg_key) return parse_number<double>(cell).has_value();
    if (name == rods_key) return parse_number<int>(cell).has_value();
  }
  return true;
}

constexpr std::size_t sum_length = 26;  // length of ,"sum":"0123456789abcdef"}

std::string ending_of(std::string_view text) {
  return fmt::format(",\"sum\":\"{:016x}\"}}", Checksum::of(text));
}

/// A JSON object as a line that ends with the checksum of all before it.
std::string sealed(const Json& json) {
  std::string text = line_of(json);
  text.pop_back();
  return text + ending_of(text) + "\n";
}

/// The object of a line; empty if its checksum is wrong.
std::optional<Json> without_checksum(std::string_view line) {
  if (line.size() <= sum_length) return std::nullopt;
  const auto text = line.substr(0, line.size() - sum_length);
  if (line.substr(text.size()) != ending_of(text)) return std::nullopt;
  Json json = parsed(line);
  if (!json.is_object()) return std::nullopt;
  return json;
}

/// Whether the object has this key with a value of this type.
bool has(const Json& json, const char* key, bool (Json::*kind)() const noexcept) {
  return json.contains(key) && (json.at(key).*kind)();
}

Json value_of(std::monostate) { return nullptr; }
Json value_of(const auto& value) { return value; }

std::string first_line(const SweepIdentity& name) {
  Json json = Json::object();
  json["sweep"] = name.preset;
  json["config"] = fmt::format("{:016x}", name.config);
  json["points"] = name.points;
  return sealed(json);
}

std::optional<SweepIdentity> name_of(std::string_view line) {
  const auto json = without_checksum(line);
  if (!json || !has(*json, "sweep", &Json::is_string) || !has(*json, "config", &Json::is_string) ||
      !has(*json, "points", &Json::is_number_unsigned))
    return std::nullopt;
  const auto config = json->at("config").get<std::string>();
  const auto number = parse_number<decltype(SweepIdentity::config)>(config, 16);
  if (!number) return std::nullopt;
  return SweepIdentity{json->at("sweep").get<std::string>(), *number,
                       json->at("points").get<std::size_t>()};
}

std::string point_line(const std::vector<std::string>& axes, const PointKeys& keys,
                       const PointResult& result) {
  Json json = Json::object();
  json["point"] = result.point;
  if (!keys.case_name.empty()) json["case"] = keys.case_name;
  json["keys"] = Json::object();
  for (std::size_t k = 0; k < axes.size(); ++k) {
    // numbers, texts and lists have the same syntax in TOML and JSON
    Json value = parsed(keys.values[k]);
    json["keys"][axes[k]] = value.is_discarded() ? Json(keys.values[k]) : std::move(value);
  }
  if (keys.seed != 0) json["seed"] = keys.seed;
  json["outcome"] = word_of(result.outcome);
  if (!result.reason.empty()) json["reason"] = result.reason;
  json["figures"] = Json::object();
  for (const auto& [name, figure] : result.figures)
    json["figures"][name] = std::visit([](const auto& value) { return value_of(value); }, figure);
  return sealed(json);
}

std::optional<PointResult> point_of(std::string_view line, std::size_t points) {
  const auto json = without_checksum(line);
  if (!json || !has(*json, "point", &Json::is_number_unsigned) ||
      !has(*json, "outcome", &Json::is_string) || !has(*json, "figures", &Json::is_object))
    return std::nullopt;
  const auto outcome = find_word<PointOutcome>(json->at("outcome").get<std::string>());
  PointResult result;
  result.point = json->at("point").get<std::size_t>();
  if (!outcome || result.point >= points) return std::nullopt;
  result.outcome = *outcome;
  if (has(*json, "reason", &Json::is_string)) result.reason = json->at("reason").get<std::string>();
  for (const auto& [name, figure] : json->at("figures").items())
    result.figures.emplace_back(name, figure_of(figure));
  return result;
}

}  // namespace

Figure figure_of(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  return {};
}

double number_of(const Figure& figure) {
  if (const auto* number = std::get_if<double>(&figure)) return *number;
  if (const auto* flag = std::get_if<bool>(&figure)) return *flag ? 1 : 0;
  return unknown;
}

const Figure* PointResult::figure(const std::string& name) const {
  for (const auto& [key, value] : figures)
    if (key == name) return &value;
  return nullptr;
}

std::string sweep_csv(const SweepTable& table) {
  const auto names = names_of(table);
  CsvWriter csv;
  csv.cell("point");
  if (table.has_cases) csv.cell("case");
  for (const auto& axis : table.axes) csv.cell(axis);
  if (table.has_seeds) csv.cell("seed");
  csv.cell("outcome");
  for (const auto& name : names) csv.cell(name);
  csv.cell("reason");
  csv.end_line();
  for (const auto& [keys, result] : table.rows) {
    csv.cell(int(result.point));
    if (table.has_cases) csv.cell(keys.case_name);
    for (const auto& value : keys.values) csv.cell(bare(value));
    if (table.has_seeds) csv.cell(keys.seed);
    csv.cell(std::string(word_of(result.outcome)));
    for (const auto& name : names) {
      const Figure* figure = result.figure(name);
      std::visit([&](const auto& value) { put(csv, value); }, figure ? *figure : Figure());
    }
    csv.cell(result.reason);
    csv.end_line();
  }
  return std::move(csv).text();
}

Result<SweepTable> read_sweep_csv(std::string_view text) {
  const auto rows = csv_cells(text);
  if (rows.empty() || rows.front().front() != "point" || rows.front().back() != "reason")
    return invalid("line 1 is not 'point,...,outcome,...,reason'");
  const auto& names = rows.front();
  const auto figures = std::size_t(std::ranges::find(names, "outcome") - names.begin()) + 1;
  if (figures > names.size()) return invalid("line 1 has no column 'outcome'");
  SweepTable table;
  for (std::size_t k = 1; k + 1 < figures; ++k)
    if (names[k] == "case" || names[k] == "seed")
      (names[k] == "case" ? table.has_cases : table.has_seeds) = true;
    else
      table.axes.push_back(names[k]);
  for (std::size_t line = 1; line < rows.size(); ++line) {
    const auto& cells = rows[line];
    SweepTable::Row& row = table.rows.emplace_back();
    if (cells.size() != names.size())
      return invalid("line {}: got {} cells, expected {} of a point of a sweep", line + 1,
                     cells.size(), names.size());
    for (std::size_t k = 0; k < figures; ++k)
      if (!take_key(names[k], cells[k], row))
        return invalid("line {}: {}: got '{}', expected a value of a sweep", line + 1, names[k],
                       cells[k]);
    for (std::size_t k = figures; k + 1 < names.size(); ++k)
      row.result.figures.emplace_back(names[k], figure_in(cells[k]));
    row.result.reason = cells.back();
  }
  if (table.rows.empty()) return invalid("got no point of a sweep, expected at least one");
  return table;
}

namespace fs = std::filesystem;
Result<SweepContents> read_sweep_log(const fs::path& file) {
  TRY(text, read_file(file));
  SweepContents contents;
  std::string_view rest = *text;
  for (bool first = true; !rest.empty(); first = false) {
    const auto end = rest.find('\n');
    if (end == std::string_view::npos) {
      contents.cut_off = true;
      break;
    }
    const auto line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (first) {
      const auto name = name_of(line);
      if (!name)
        return invalid("'{}' is no log of a sweep: its first line does not name one",
                       file.string());
      contents.name = *name;
    } else if (auto point = point_of(line, contents.name.points)) {
      contents.found.try_emplace(point->point, std::move(*point));
    } else {
      ++contents.damaged;
    }
    contents.whole_bytes += end + 1;
  }
  return contents;
}

Result<SweepLog> SweepLog::open(const fs::path& file, const SweepIdentity& name,
                                std::vector<std::string> axes, KeysOf keys) {
  SweepLog log;
  log.file_ = file;
  log.descriptor_ = Descriptor(::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (log.descriptor_ < 0) return fail_io("write", file, errno);
  if (::flock(log.descriptor_, LOCK_EX | LOCK_NB) != 0)
    return log.refuse(Fault::bad_input, errno == EWOULDBLOCK
                                            ? "another sweep is writing it"
                                            : std::generic_category().message(errno));
  log.axes_ = std::move(axes);
  log.keys_ = std::move(keys);
  TRY_DO(log.resume_log(name));
  return log;
}

/// Reads the log, drops an incomplete last line, and writes the first line if there is none.
Result<void> SweepLog::resume_log(const SweepIdentity& name) {
  TRY(contents, read_sweep_log(file_));
  contents_ = std::move(*contents);
  if (contents_.whole_bytes == 0) {
    // an incomplete first line must be the start of this sweep's one, else it is another file
    TRY(text, read_file(file_));
    if (!first_line(name).starts_with(*text))
      return refuse(Fault::bad_input, "it is no log of a sweep");
  } else if (!contents_.name.same_sweep(name)) {
    return refuse(Fault::bad_input,
                  fmt::format("it is of another preset ('{}', {} points), or of other values; "
                              "choose another folder with -o",
                              contents_.name.preset, contents_.name.points));
  }
  if (contents_.cut_off && ::ftruncate(descriptor_, off_t(contents_.whole_bytes)) != 0)
    return fail_io("write", file_, errno);
  if (contents_.whole_bytes == 0) return put(first_line(name));
  return {};
}

Result<void> SweepLog::append(const PointResult& result) {
  auto written = put(point_line(axes_, keys_(result.point), result));
  if (written) contents_.found.try_emplace(result.point, result);
  return written;
}

Result<void> SweepLog::put(const std::string& line) {
  const std::uint64_t before = contents_.whole_bytes;
  if (const int code = append_whole(descriptor_, line, contents_.whole_bytes))
    return fail_io("write", file_, code);
  if (::fdatasync(descriptor_) == 0 || errno == EINVAL) return {};
  const int code = errno;
  if (::ftruncate(descriptor_, off_t(before)) == 0) contents_.whole_bytes = before;
  return fail_io("write", file_, code);
}

tl::unexpected<Error> SweepLog::refuse(Fault fault, const std::string& why) const {
  return fail(fault, "cannot write '{}': {}", file_.string(), why);
}

bool PowerLaw::is_confirmed() const {
  constexpr double close = 0.02;
  double worst = 0;
  for (std::size_t k = 0; k < law.size(); ++k)
    worst = std::max(worst, std::abs(std::log(found[k] / law[k])));
  // of n pairs n/2 +- sqrt(n)/2 have equal signs by chance: the limit is two standard deviations
  const double neighbours = std::max(1.0, double(law.size()) - 1);
  if (worst > close && same_side > 0.5 + 1 / std::sqrt(neighbours)) return false;
  return scatter < 0.1 && std::ranges::all_of(keys, [](const LawRow& key) {
           return key.error < 0.05 * std::max(1.0, std::abs(key.exponent));
         });
}

std::optional<PowerLaw> power_law(const SweepTable& table, const std::string& case_name,
                                  const std::string& figure) {
  constexpr std::size_t fewest_values = 3;
  // least ratio of a key's largest to its smallest value: in a smaller range every law is nearly a
  // line
  constexpr double least_ratio = 1.5;
  const auto keys = Eigen::Index(table.axes.size());
  std::vector<std::set<double>> values(table.axes.size());
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> logs;
  for (const SweepTable::Row& row : table.rows) {
    const Figure* known = row.result.figure(figure);
    if (row.keys.case_name != case_name || !known) continue;
    // shells that penetrate themselves cannot exist
    if (const Figure* overlaps = row.result.figure("contacts");
        overlaps && number_of(*overlaps) > 0)
      continue;
    const double found = number_of(*known);
    if (!(found > 0)) return std::nullopt;
    // the factor's column is the last
    Eigen::VectorXd one = Eigen::VectorXd::Ones(keys + 1);
    for (std::size_t k = 0; k < table.axes.size(); ++k) {
      const auto value = parse_number<double>(row.keys.values[k]);
      if (!value || !(*value > 0)) return std::nullopt;
      values[k].insert(*value);
      one[Eigen::Index(k)] = std::log(*value);
    }
    rows.push_back(std::move(one));
    logs.push_back(std::log(found));
  }
  for (const auto& of_key : values)
    if (of_key.size() < fewest_values || *of_key.rbegin() < least_ratio * *of_key.begin())
      return std::nullopt;
  const auto free = Eigen::Index(rows.size()) - keys - 1;
  if (keys == 0 || free < 1) return std::nullopt;
  Eigen::MatrixXd A(Eigen::Index(rows.size()), keys + 1);
  for (std::size_t k = 0; k < rows.size(); ++k) A.row(Eigen::Index(k)) = rows[k].transpose();
  const Eigen::VectorXd b =
      Eigen::Map<const Eigen::VectorXd>(logs.data(), Eigen::Index(logs.size()));
  const Eigen::VectorXd x = least_squares(A, b), left = b - A * x;
  const Eigen::MatrixXd spread = inverse(A.transpose() * A);
  PowerLaw law;
  law.factor = std::exp(x[keys]);
  law.scatter = std::sqrt(left.squaredNorm() / double(rows.size()));
  for (Eigen::Index k = 0; k < keys; ++k)
    law.keys.push_back({case_name, figure, table.axes[std::size_t(k)], x[k],
                        std::sqrt(spread(k, k) * left.squaredNorm() / double(free))});
  for (std::size_t k = 0; k < rows.size(); ++k) {
    law.first_key.push_back(std::exp(A(Eigen::Index(k), 0)));
    law.law.push_back(std::exp(A.row(Eigen::Index(k)).dot(x)));
    law.found.push_back(std::exp(logs[k]));
  }
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::sort(order, {}, [&](std::size_t k) { return law.law[k]; });
  int same = 0;
  for (std::size_t k = 1; k < order.size(); ++k)
    same += left[Eigen::Index(order[k - 1])] * left[Eigen::Index(order[k])] > 0;
  law.same_side = double(same) / std::max(1.0, double(order.size()) - 1);
  return law;
}

}  // namespace gridshell::record
