// summary.json: the figures of a run as one JSON object, keys as in Summary, in its order.
#pragma once

#include <filesystem>
#include <string>

#include "engine/core/result.h"
#include "engine/record/summary.h"
#include "engine/record/sweep.h"

namespace gridshell::record {

/// The text of summary.json. What is unknown (NaN) is null; numbers read back bit for bit.
std::string to_json(const Summary& summary);

/// The same as figures of a point of a sweep, without what differs from one time to the next
/// (seconds) and what is the same for all (preset, model_reason, kind, finished).
Figures figures_of(const Summary& summary);

/// Writes summary.json whole or not at all. Errors: Fault::io with path and reason.
Result<void> write_summary(const std::filesystem::path& path, const Summary& summary);

/// Reads what write_summary wrote; keys it does not know are left alone. Errors: Fault::io when the
/// file cannot be read; Fault::bad_input naming the path and the key that is missing or wrong.
Result<Summary> read_summary(const std::filesystem::path& path);

}  // namespace gridshell::record
