// Wavefront OBJ: lines "v x y z" and elements "f a b c ..." or "l a b ...".
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gridshell::preset {

/// What takes the lines of a .obj file; `place` begins every error: "dome.obj:17".
struct ObjLines {
  std::function<Result<void>(const std::vector<double>& xyz, const std::string& place)> vertex;
  /// its vertices as the file counts them, from 0; whether they are there is not looked at
  std::function<Result<void>(const std::vector<long>& vertices, const std::string& place)> element;
};

/// Hands on the vertices of a file and its elements of one kind, "f" or "l"; all other lines are
/// left out. Errors (bad_input): a vertex that is not three finite numbers, an element with a word
/// that is no number of a vertex ("7", "7/1/2", or "-1" from the last), what `lines` says.
Result<void> read_obj_lines(std::string_view bytes, const std::string& name,
                            std::string_view element, const ObjLines& lines);

}  // namespace gridshell::preset
