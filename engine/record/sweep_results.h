// Results of the points of a sweep, and the table and pictures made from them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/enum_words.h"
#include "engine/core/fields.h"
#include "engine/core/file_io.h"
#include "engine/core/result.h"
#include "engine/record/frame.h"

namespace gridshell::record {

/// How a point of a sweep ended. A path that met a limit is also `done`: its figures name the
/// limit.
enum class PointOutcome { done, no_equilibrium, refused };

/// One figure (result) of a run; std::monostate: not known.
using Figure = std::variant<std::monostate, bool, double, std::string>;
/// Figures by their names.
using Figures = std::vector<std::pair<std::string, Figure>>;

/// A value of JSON as a figure; not known if it is no boolean, number or text.
Figure figure_of(const nlohmann::ordered_json& value);

/// A figure as a number, false and true as 0 and 1; NaN if it is no number.
double number_of(const Figure& figure);

/// A finished point.
struct PointResult {
  std::size_t point = 0;
  PointOutcome outcome = PointOutcome::done;
  std::string reason;  ///< why it has no figures
  Figures figures;     ///< by the names of summary.json, units in them

  /// The figure of that name; null if there is none.
  const Figure* figure(const std::string& name) const;
};

/// The values of a point of a sweep, as its files contain them.
struct PointKeys {
  std::string case_name;            ///< empty where the preset has no cases
  std::vector<std::string> values;  ///< as TOML, one per axis
  int seed = 0;                     ///< 0 if the sweep has only one
};

/// The swept keys of a phase diagram: a number, and an integer.
inline constexpr const char *leg_key = "footprint.longest_leg", *rods_key = "footprint.rods";

/// A finished sweep: one row per point, in order.
struct SweepTable {
  std::vector<std::string> axes;  ///< swept keys: "rod.diameter_mm"
  bool has_cases = false, has_seeds = false;
  struct Row {
    PointKeys keys;
    PointResult result;
  };
  std::vector<Row> rows;
};

/// The text of sweep.csv, with the columns point, case (if there are cases), the swept keys, seed
/// (if there are several), outcome, every figure that any point has, reason.
std::string sweep_csv(const SweepTable& table);

/// Reads the text of a sweep.csv; its values are texts without the quotes of TOML. Errors
/// (bad_input), naming the line: it is no such text, a value of leg_key or rods_key is no number.
Result<SweepTable> read_sweep_csv(std::string_view text);

// Power laws of figures over the swept keys: laws.csv has one row per key.

/// The exponent of one key in the power law of a figure.
struct LawRow {
  std::string case_name, figure, key;
  double exponent = unknown;
  double error = unknown;  ///< standard error of the exponent, from the residuals
};
template <RecordOf<LawRow> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit("case", row.case_name);
  GRIDSHELL_VISIT(visit, row.figure, row.key, row.exponent, row.error);
}

/// figure = factor * product of key^exponent, by least squares of the logarithms.
struct PowerLaw {
  std::vector<LawRow> keys;
  double factor = 0;
  double scatter = 0;  ///< root mean square of the logarithms' residuals
  /// Fraction of neighbouring points, in the order of the law's values, whose residuals have equal
  /// signs: about 0.5 if the residuals are random, near 1 if the results follow another curve.
  double same_side = 0;
  /// Whether the results follow the law: the scatter is below 0.1, each exponent's error is below
  /// 0.05 max(1, |exponent|), and the residuals are random or all at most 0.02.
  bool is_confirmed() const;
  /// At each point: value of the law, result, value of the first key.
  std::vector<double> law, found, first_key;
};

/// Power law of a figure over the points of one case that have it and are without
/// interpenetrations. Empty if a key has fewer than three values, if its largest value is less than
/// one and a half times its smallest, if keys or results are not all numbers above 0, or if there
/// are too few points.
std::optional<PowerLaw> power_law(const SweepTable& table, const std::string& case_name,
                                  const std::string& figure);

// The log of a sweep, `sweep.jsonl`: a line that identifies the sweep, then one line per finished
// point, each JSON with a checksum. Lines are only appended. The writer locks the file.

inline constexpr const char* sweep_log_name = "sweep.jsonl";

/// Identity of the sweep that a log belongs to.
struct SweepIdentity {
  std::string preset;        ///< name of the preset, only for readers of the log
  std::uint64_t config = 0;  ///< hash of everything that the results depend on
  std::size_t points = 0;    ///< number of all points

  bool same_sweep(const SweepIdentity& other) const {
    return config == other.config && points == other.points;
  }
};

/// Contents of a log.
struct SweepContents {
  SweepIdentity name;
  std::map<std::size_t, PointResult> found;  ///< results by point; the first line of a point counts
  std::size_t damaged = 0;                   ///< number of lines whose checksum is wrong
  bool cut_off = false;                      ///< whether the last line is incomplete
  std::uint64_t whole_bytes = 0;             ///< bytes up to the end of the last complete line
};

/// Reads a log that others may be writing. Errors (bad_input): no log of a sweep, naming the file.
Result<SweepContents> read_sweep_log(const std::filesystem::path& file);

/// An open log, locked during its lifetime.
class SweepLog {
 public:
  /// Returns the values of a point, for its line.
  using KeysOf = std::function<PointKeys(std::size_t point)>;

  /// Starts a log or continues one; an incomplete last line is dropped. Errors (bad_input): another
  /// program has the lock, it is of another sweep, it is no log; io.
  static Result<SweepLog> open(const std::filesystem::path& file, const SweepIdentity& name,
                               std::vector<std::string> axes, KeysOf keys);

  const std::map<std::size_t, PointResult>& found() const { return contents_.found; }
  std::size_t damaged() const { return contents_.damaged; }
  bool cut_off() const { return contents_.cut_off; }

  /// Appends the line of a point and waits until it is on the disk. After an error no part of the
  /// line is in the file. Errors: io.
  Result<void> append(const PointResult& result);

 private:
  Result<void> resume_log(const SweepIdentity& name);
  Result<void> put(const std::string& line);
  tl::unexpected<Error> refuse(Fault fault, const std::string& why) const;

  std::filesystem::path file_;
  Descriptor descriptor_;
  SweepContents contents_;
  std::vector<std::string> axes_;
  KeysOf keys_;
};

}  // namespace gridshell::record
