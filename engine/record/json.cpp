#include "engine/record/json.h"

namespace gridshell::record {
namespace {

std::string dumped(const Json& json, int indent, bool ascii) {
  return json.dump(indent, ' ', ascii, Json::error_handler_t::replace);
}

}  // namespace

Json parsed(std::string_view text) { return Json::parse(text, nullptr, false); }

std::string text_of(const Json& json) { return dumped(json, 2, false) + "\n"; }

std::string line_of(const Json& json, bool ascii) { return dumped(json, -1, ascii); }

}  // namespace gridshell::record
