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

/// How a point of a sweep ended. A path that met a limit is done too: its figures say so.
enum class PointOutcome { done, no_equilibrium, refused };

/// One figure of a run; nothing where it is not known.
using Figure = std::variant<std::monostate, bool, double, std::string>;
using Figures = std::vector<std::pair<std::string, Figure>>;

/// A value of JSON as a figure, nothing where it is none.
Figure figure_of(const nlohmann::ordered_json& value);

/// A figure as a number, NaN where it is none.
double number_of(const Figure& figure);

/// A finished point.
struct PointResult {
  std::size_t point = 0;
  PointOutcome outcome = PointOutcome::done;
  std::string reason;  ///< why it has no figures
  Figures figures;     ///< by the names of summary.json, units in them

  /// The figure of that name, nothing where there is none.
  const Figure* figure(const std::string& name) const;
};

/// What a point was set to, as the files say it.
struct PointKeys {
  std::string case_name;            ///< empty where the preset has no cases
  std::vector<std::string> values;  ///< as TOML, one per axis
  int seed = 0;                     ///< 0 where the sweep has one alone
};

/// A finished sweep, a row a point in their order.
struct SweepTable {
  std::vector<std::string> axes;  ///< "rod.diameter_mm"
  bool has_cases = false, has_seeds = false;
  struct Row {
    PointKeys keys;
    PointResult result;
  };
  std::vector<Row> rows;
};

/// The text of sweep.csv: point, case and seed where there are some, the keys, the outcome, every
/// figure that any point has, the reason.
std::string sweep_csv(const SweepTable& table);

/// What such a text says; values are without the quotes of TOML. Errors (bad_input): it is none,
/// naming the line.
Result<SweepTable> read_sweep_csv(std::string_view text);

// How a figure grows with the keys that were swept, as a power law: a line of laws.csv a key.

/// One key's part in the law of a figure.
struct LawRow {
  std::string case_name, figure, key;
  double exponent = unknown;
  double error = unknown;  ///< standard error, of what the law leaves
};
template <RecordOf<LawRow> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit_each(visit, "case", row.case_name, "figure", row.figure, "key", row.key, "exponent",
             row.exponent, "error", row.error);
}

/// figure = factor * product of key^exponent, by least squares of the logarithms.
struct PowerLaw {
  std::vector<LawRow> keys;
  double factor = 0;
  double scatter = 0;  ///< root mean square of the logarithms' residuals
  /// Fraction of the pairs of neighbours in the order of the law that are on the same side of it: a
  /// half if the residuals are random, near 1 if the results follow another curve.
  double same_side = 0;
  /// Whether the results follow the law: within a tenth, with each exponent known to a twentieth of
  /// itself or of one, and with residuals that are random or at most a fiftieth.
  bool holds() const;
  /// Value of the law and the result at each point, and the first key there.
  std::vector<double> law, found, first_key;
};

/// Power law of the points of one case that reached a state without interpenetrations. Empty if a
/// key has fewer than three values or its largest is less than one and a half times its smallest,
/// or if keys or results are not all numbers above 0.
std::optional<PowerLaw> power_law(const SweepTable& table, const std::string& case_name,
                                  const std::string& figure);

// The log of a sweep, `sweep.jsonl`: a line that identifies the sweep, then one line per finished
// point, each JSON with a checksum; lines are only appended. The writer has the file's lock.

inline constexpr const char* sweep_log_name = "sweep.jsonl";

/// Identity of the sweep that a log belongs to.
struct SweepIdentity {
  std::string preset;        ///< for readers of the log
  std::uint64_t config = 0;  ///< hash of everything that its numbers depend on
  std::size_t points = 0;    ///< in all

  bool same_sweep(const SweepIdentity& other) const {
    return config == other.config && points == other.points;
  }
};

/// Contents of a log.
struct SweepContents {
  SweepIdentity name;
  std::map<std::size_t, PointResult> found;  ///< by the point; the first line of one counts
  std::size_t damaged = 0;                   ///< lines whose checksum is wrong
  bool cut_off = false;                      ///< the last line was not written to its end
  std::uint64_t whole_bytes = 0;             ///< up to the end of the last whole line
};

/// Reads a log that others may be writing. Errors (bad_input): no log of a sweep, naming the file.
Result<SweepContents> read_sweep_log(const std::filesystem::path& file);

/// An open log, locked during its lifetime.
class SweepLog {
 public:
  /// What a point was set to, for its line.
  using KeysOf = std::function<PointKeys(std::size_t point)>;

  /// Starts a log or continues one; an incomplete last line is dropped. Errors (bad_input): another
  /// program has the lock, it is of another sweep, it is no log; io.
  static Result<SweepLog> open(const std::filesystem::path& file, const SweepIdentity& name,
                               std::vector<std::string> axes, KeysOf keys);

  const std::map<std::size_t, PointResult>& found() const { return contents_.found; }
  std::size_t damaged() const { return contents_.damaged; }
  bool cut_off() const { return contents_.cut_off; }

  /// A line on the disk, or none. Errors: io.
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
