// STL: triangles by the coordinates of their corners, as text or as 50 bytes each.
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>

#include "engine/preset/mesh_draft.h"

namespace gridshell::preset {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read as they stand");

constexpr std::size_t header = 84, triangle = 50;

/// The number of triangles that a binary file says it has.
std::size_t count_in(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= header) std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return count;
}

/// A corner; the third ends its triangle.
Result<void> add_corner(MeshDraft& draft, const std::vector<double>& xyz,
                        const std::string& place) {
  if (auto added = draft.add_vertex(xyz, place); !added) return added;
  const long count = long(draft.vertices());
  if (count % 3 != 0) return {};
  return draft.add_polygon({count - 3, count - 2, count - 1}, place);
}

Result<SurfaceData> read_binary(std::string_view bytes, const std::string& name) {
  MeshDraft draft;
  for (std::size_t k = 0; k < count_in(bytes); ++k)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      float xyz[3];
      // the normal comes first
      std::memcpy(xyz, bytes.data() + header + k * triangle + 12 * (corner + 1), sizeof(xyz));
      if (auto added = add_corner(draft, {xyz[0], xyz[1], xyz[2]},
                                  fmt::format("{}: triangle {}", name, k + 1));
          !added)
        return tl::unexpected(added.error());
    }
  return draft.take(name);
}

Result<SurfaceData> read_text(std::string_view bytes, const std::string& name) {
  MeshDraft draft;
  for (int number = 1; !bytes.empty(); ++number) {
    const auto words = blank_apart(next_line(bytes));
    if (words.empty() || words[0] != "vertex") continue;
    const auto place = fmt::format("{}:{}", name, number);
    std::vector<double> xyz;
    for (std::size_t k = 1; k < words.size(); ++k)
      if (const auto value = number_of(words[k])) xyz.push_back(*value);
    if (xyz.size() != 3 || words.size() != 4)
      return fail(Fault::bad_input, place + ": a vertex must have three numbers, vertex x y z");
    if (auto added = add_corner(draft, xyz, place); !added) return tl::unexpected(added.error());
  }
  if (draft.vertices() % 3 != 0)
    return fail(Fault::bad_input,
                fmt::format("{}: ends within a triangle: {} vertices, must be three a triangle",
                            name, draft.vertices()));
  return draft.take(name);
}

}  // namespace

Result<SurfaceData> read_stl(std::string_view bytes, const std::string& name) {
  // a binary file may begin with "solid" too, and is told by its size
  if (bytes.size() >= header && bytes.size() == header + triangle * count_in(bytes))
    return read_binary(bytes, name);
  if (bytes.starts_with("solid")) return read_text(bytes, name);
  return fail(Fault::bad_input,
              fmt::format("{}: no STL: begins without \"solid\", and its {} bytes are not those of "
                          "the {} triangles that it says",
                          name, bytes.size(), count_in(bytes)));
}

}  // namespace gridshell::preset
