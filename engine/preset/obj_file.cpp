#include "engine/preset/obj_file.h"

#include <fmt/format.h>

#include <optional>

#include "engine/core/number.h"
#include "engine/preset/mesh_draft.h"

namespace gridshell::preset {
namespace {

std::optional<long> obj_vertex(std::string_view word, long vertices) {
  word = word.substr(0, word.find('/'));
  const auto number = number_from<long>(word);
  if (!number || *number == 0) return std::nullopt;
  return *number > 0 ? *number - 1 : vertices + *number;
}

}  // namespace

Result<void> read_obj_lines(std::string_view bytes, const std::string& name,
                            std::string_view element, const ObjLines& lines) {
  long vertices = 0;
  for (int number = 1; !bytes.empty(); ++number) {
    const auto words = blank_apart(next_line(bytes));
    if (words.empty() || (words[0] != "v" && words[0] != element)) continue;
    const auto place = fmt::format("{}:{}", name, number);
    if (words[0] == "v") {
      std::vector<double> xyz;
      for (std::size_t k = 1; k < words.size() && k < 4; ++k)
        if (const auto value = number_of(words[k])) xyz.push_back(*value);
      if (xyz.size() != 3)
        return fail(Fault::bad_input, place + ": a vertex must have three numbers, v x y z");
      if (auto taken = lines.vertex(xyz, place); !taken) return taken;
      ++vertices;
      continue;
    }
    std::vector<long> corners;
    for (std::size_t k = 1; k < words.size(); ++k) {
      const auto corner = obj_vertex(words[k], vertices);
      if (!corner)
        return fail(Fault::bad_input, fmt::format("{}: '{}' is no vertex, must be its number",
                                                  place, words[k].substr(0, 40)));
      corners.push_back(*corner);
    }
    if (auto taken = lines.element(corners, place); !taken) return taken;
  }
  return {};
}

}  // namespace gridshell::preset
