// What the records of a journal hold: the head, then frames, packed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/record/frame.h"
#include "engine/record/journal.h"
#include "engine/record/snapshot.h"

namespace gridshell::record {

/// Of the whole file, before its records.
inline constexpr std::string_view journal_first_line = "gridshell journal 1\n";

enum RecordKind : std::uint32_t { head_record = 1, frame_record = 2 };

/// Whose frames they are, the names of their columns, and the layout as layout_of_image() reads it.
struct JournalHead {
  RunName name;
  std::vector<std::string> columns;
  std::string layout;
};

std::string packed_head(const RunName& name, const Layout& layout);
/// Nothing where it is damaged.
std::optional<JournalHead> unpacked_head(std::string_view bytes);

/// The index comes first.
std::string packed_frame(const Frame& frame);
/// A frame whose columns are named so; those without a name here are left out. Errors: bad_input.
Result<Frame> unpacked_frame(std::string_view bytes, const std::vector<std::string>& columns);

}  // namespace gridshell::record
