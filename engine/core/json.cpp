#include "engine/core/json.h"

#include <utility>

namespace gridshell::record {
namespace {

std::string dumped(const Json& json, int indent, bool ascii) {
  return json.dump(indent, ' ', ascii, Json::error_handler_t::replace);
}

}  // namespace

Json parsed(std::string_view text) { return Json::parse(text, nullptr, false); }

std::optional<int> whole_number(const Json& json) {
  if (!json.is_number_integer()) return std::nullopt;
  const bool fits = json.is_number_unsigned() ? std::in_range<int>(json.get<std::uint64_t>())
                                              : std::in_range<int>(json.get<std::int64_t>());
  return fits ? std::optional(json.get<int>()) : std::nullopt;
}

std::string text_of(const Json& json) { return dumped(json, 2, false) + "\n"; }

std::string line_of(const Json& json, bool ascii) { return dumped(json, -1, ascii); }

}  // namespace gridshell::record
