// Networks as DXF: the lines and polylines of its entities.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/preset/mesh_draft.h"
#include "engine/preset/network_draft.h"

namespace gridshell::preset {
namespace {

/// A code and what stands on the line after it.
struct Group {
  int code = 0;
  std::string_view value;
  int line = 0;  ///< of the value
};

std::string_view trimmed(std::string_view text) {
  const auto words = blank_apart(text);
  if (words.empty()) return {};
  return {words.front().data(),
          std::size_t(words.back().data() + words.back().size() - words.front().data())};
}

Result<std::vector<Group>> groups_of(std::string_view bytes, const std::string& name) {
  std::vector<Group> groups;
  for (int line = 1; !trimmed(bytes.substr(0, 64)).empty() || bytes.size() > 64; line += 2) {
    const auto code = number_of(trimmed(next_line(bytes)));
    if (!code || !(std::abs(*code) <= 2000) || bytes.empty())
      return fail(
          Fault::bad_input,
          fmt::format("{}:{}: is no DXF text, must be a code and a value in turn", name, line));
    groups.push_back({int(*code), trimmed(next_line(bytes)), line + 1});
  }
  return groups;
}

/// A line or polyline.
struct Outline {
  std::string layer{};
  std::vector<std::vector<double>> points{};
  bool closed = false;
  int line = 0;
};

/// The numbers by which groups say what of a curve they hold.
namespace code {
constexpr int entity = 0, layer = 8, x = 10, last_coordinate = 31, elevation = 38, bulge = 42,
              flags = 70;
}

/// Takes the curves out of the groups of a file.
class Entities {
 public:
  explicit Entities(const std::string& name) : name_(name) {}

  Result<std::vector<Outline>> take(const std::vector<Group>& groups) {
    std::string_view section;
    for (std::size_t k = 0; k < groups.size(); ++k) {
      const Group& group = groups[k];
      if (group.code == code::entity && group.value == "SECTION")
        section = k + 1 < groups.size() ? groups[k + 1].value : "";
      if (section != "ENTITIES") continue;
      if (group.code == code::entity)
        begin(group);
      else if (auto taken = put(group); !taken)
        return tl::unexpected(taken.error());
    }
    return std::move(curves_);
  }

 private:
  enum class Kind { other, line, light, heavy, vertex };

  void begin(const Group& group) {
    const bool follows = kind_ == Kind::heavy || kind_ == Kind::vertex;
    kind_ = group.value == "LINE"                ? Kind::line
            : group.value == "LWPOLYLINE"        ? Kind::light
            : group.value == "POLYLINE"          ? Kind::heavy
            : follows && group.value == "VERTEX" ? Kind::vertex
                                                 : Kind::other;
    if (kind_ == Kind::other) return;
    if (kind_ != Kind::vertex) {
      curves_.emplace_back();
      curves_.back().line = group.line;
    }
    if (kind_ == Kind::vertex) curves_.back().points.push_back({0, 0, 0});
    if (kind_ == Kind::line) curves_.back().points.assign(2, {0, 0, 0});
    elevation_ = 0;
  }

  Result<void> put(const Group& group) {
    if (kind_ == Kind::other) return {};
    Outline& curve = curves_.back();
    if (group.code == code::layer && kind_ != Kind::vertex) curve.layer = group.value;
    const bool coordinate =
        group.code >= code::x && group.code <= code::last_coordinate && group.code % 10 < 2;
    if (!coordinate && group.code != code::elevation && group.code != code::bulge &&
        group.code != code::flags)
      return {};
    const auto value = number_of(group.value);
    const auto wrong = [&](const char* what) {
      return fail(Fault::bad_input, fmt::format("{}:{}: {}", name_, group.line, what));
    };
    if (!value) return wrong("must be a finite number");
    if (group.code == code::flags && (kind_ == Kind::light || kind_ == Kind::heavy))
      curve.closed = int(std::clamp(*value, 0.0, 1e6)) % 2 == 1;
    if (group.code == code::bulge && *value != 0 && kind_ != Kind::line)
      return wrong("an arc, must be a polyline of straight pieces");
    if (group.code == code::elevation) elevation_ = *value;
    if (coordinate) put_coordinate(group.code, *value);
    return {};
  }

  /// x, y, z of the first point: 10, 20, 30; of the second of a line 11, 21, 31.
  void put_coordinate(int number, double value) {
    auto& points = curves_.back().points;
    if (kind_ == Kind::light && number == code::x) points.push_back({0, 0, elevation_});
    // a heavy polyline's own is its elevation, which its vertices repeat
    if (kind_ == Kind::heavy || points.empty()) return;
    auto& point = number % 10 == 0 && kind_ == Kind::line ? points.front() : points.back();
    point[std::size_t(number / 10 - 1)] = value;
  }

  std::string name_;
  Kind kind_ = Kind::other;
  double elevation_ = 0;
  std::vector<Outline> curves_;
};

}  // namespace

Result<NetworkData> read_network_dxf(std::string_view bytes, const std::string& name) {
  const auto groups = groups_of(bytes, name);
  if (!groups) return tl::unexpected(groups.error());
  auto curves = Entities(name).take(*groups);
  if (!curves) return tl::unexpected(curves.error());
  const auto is_rod = [](const Outline& curve) { return curve.layer == "rods"; };
  const bool by_layer = std::ranges::any_of(*curves, is_rod);
  NetworkDraft draft;
  for (const Outline& curve : *curves) {
    if (by_layer && !is_rod(curve)) continue;
    const auto place = fmt::format("{}:{}", name, curve.line);
    std::vector<int> points;
    for (const auto& xyz : curve.points) {
      const auto point = draft.place(xyz, place);
      if (!point) return tl::unexpected(point.error());
      points.push_back(*point);
    }
    if (curve.closed && !points.empty()) points.push_back(points.front());
    if (auto added = draft.add_rod(std::move(points), 0, place); !added)
      return tl::unexpected(added.error());
  }
  return draft.join_crossings(name).and_then([&] { return draft.take(name); });
}

}  // namespace gridshell::preset
