#include "engine/formats/network_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/formats/obj_ply.h"
#include "engine/formats/point_file.h"
#include "engine/formats/surface_file.h"

namespace gridshell::preset {
namespace {

constexpr std::size_t most = 100000, most_entries = 1000000;
constexpr double largest_mm = 1e9;

std::string coordinates_fault(const std::vector<double>& xyz) {
  if (xyz.size() < 2 || xyz.size() > 3)
    return fmt::format("a point of {} coordinates, must be [x, y] or [x, y, z]", xyz.size());
  for (const double value : xyz)
    if (!(std::abs(value) <= largest_mm))
      return "a coordinate that is no number of at most 1e9, must be mm";
  return "";
}

// Networks as Wavefront OBJ: vertices and lines.

Result<NetworkData> read_network_obj(std::string_view bytes, const std::string& name) {
  NetworkBuilder draft;
  const auto add_rod = [&](const std::vector<long>& vertices, const std::string& at) {
    std::vector<int> points;
    for (const long vertex : vertices) {
      const auto point = draft.point(vertex, at);
      if (!point) return Result<void>(tl::unexpected(point.error()));
      points.push_back(*point);
    }
    return draft.add_rod(std::move(points), 0, at);
  };
  return read_obj_lines(
             bytes, name, "l",
             {[&](const auto& xyz, const auto& at) { return draft.add_point(xyz, at); }, add_rod})
      .and_then([&] { return draft.join_crossings(name); })
      .and_then([&] { return draft.take(name); });
}

// Networks as DXF: the lines and polylines of its entities.

/// A code and what stands on the line after it.
struct Group {
  int code = 0;
  std::string_view value;
  int line = 0;  ///< of the value
};

std::string_view trimmed(std::string_view text) {
  const auto words = words_in(text);
  if (words.empty()) return {};
  return {words.front().data(),
          std::size_t(words.back().data() + words.back().size() - words.front().data())};
}

Result<std::vector<Group>> groups_of(std::string_view bytes, const std::string& name) {
  std::vector<Group> groups;
  for (int line = 1; !trimmed(bytes.substr(0, 64)).empty() || bytes.size() > 64; line += 2) {
    const auto code = number_of(trimmed(next_line(bytes)));
    if (!code || !(std::abs(*code) <= 2000) || bytes.empty())
      return invalid("{}:{}: is no DXF text, must be a code and a value in turn", name, line);
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
      else
        TRY_DO(put(group));
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
      return invalid("{}:{}: {}", name_, group.line, what);
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

Result<NetworkData> read_network_dxf(std::string_view bytes, const std::string& name) {
  TRY(groups, groups_of(bytes, name));
  TRY(curves, Entities(name).take(*groups));
  const auto is_rod = [](const Outline& curve) { return curve.layer == "rods"; };
  const bool by_layer = std::ranges::any_of(*curves, is_rod);
  NetworkBuilder draft;
  for (const Outline& curve : *curves) {
    if (by_layer && !is_rod(curve)) continue;
    const auto place = fmt::format("{}:{}", name, curve.line);
    std::vector<int> points;
    for (const auto& xyz : curve.points) {
      TRY(point, draft.place(xyz, place));
      points.push_back(*point);
    }
    if (curve.closed && !points.empty() && points.back() != points.front())
      points.push_back(points.front());
    TRY_DO(draft.add_rod(std::move(points), 0, place));
  }
  return draft.join_crossings(name).and_then([&] { return draft.take(name); });
}

}  // namespace

int NetworkBuilder::known(const std::vector<double>& xyz) const {
  const auto cell = [&](std::size_t k, long beside) {
    return long(std::floor(xyz[k] / one_point_mm)) + beside;
  };
  for (long i = -1; i <= 1; ++i)
    for (long j = -1; j <= 1; ++j)
      for (long k = -1; k <= 1; ++k) {
        const auto found = at_.find({cell(0, i), cell(1, j), cell(2, k)});
        if (found == at_.end()) continue;
        for (const int point : found->second) {
          const auto& other = network_.points[std::size_t(point)];
          if (std::hypot(other[0] - xyz[0], other[1] - xyz[1], other[2] - xyz[2]) < one_point_mm)
            return point;
        }
      }
  return -1;
}

Result<void> NetworkBuilder::add_point(const std::vector<double>& xyz, const std::string& at) {
  if (const auto wrong = coordinates_fault(xyz); !wrong.empty()) return invalid(at + ": " + wrong);
  if (points() == most) return invalid("{}: must be at most {} points", at, most);
  const std::vector<double> place{xyz[0], xyz[1], xyz.size() == 3 ? xyz[2] : 0};
  const int number = int(points()), same = known(place);
  same_as_.push_back(same >= 0 ? same : number);
  network_.points.push_back(place);
  if (same < 0)
    at_[{long(std::floor(place[0] / one_point_mm)), long(std::floor(place[1] / one_point_mm)),
         long(std::floor(place[2] / one_point_mm))}]
        .push_back(number);
  return {};
}

Result<int> NetworkBuilder::place(const std::vector<double>& xyz, const std::string& at) {
  if (const auto wrong = coordinates_fault(xyz); !wrong.empty()) return invalid(at + ": " + wrong);
  const int same = known({xyz[0], xyz[1], xyz.size() == 3 ? xyz[2] : 0});
  if (same >= 0) return same;
  TRY_DO(add_point(xyz, at));
  return int(points()) - 1;
}

Result<int> NetworkBuilder::point(long number, const std::string& at) const {
  if (number < 0 || number >= long(points()))
    return invalid(points() == 0 ? fmt::format("{}: point {}, and there are none", at, number)
                                 : fmt::format("{}: point {}, must be from 0 to {}", at, number,
                                               points() - 1));
  return same_as_[std::size_t(number)];
}

Result<void> NetworkBuilder::add_rod(std::vector<int> points, double diameter_mm,
                                     const std::string& at) {
  if (std::ranges::count(points, points.empty() ? 0 : points.front()) == long(points.size()))
    return invalid(at + ": a rod of one point, must have at least two, apart");
  if (const auto same = std::ranges::adjacent_find(points); same != points.end())
    return invalid(
        "{}: a stretch of no length: the points of a rod must lie apart, and point {} "
        "follows itself, or another point at its place",
        at, *same);
  entries_ += points.size();
  if (network_.rods.size() == most || entries_ > most_entries)
    return invalid("{}: must be at most {} rods through {} points", at, most, most_entries);
  diameters_ = diameters_ || diameter_mm > 0;
  network_.rods.push_back(std::move(points));
  network_.diameters.push_back(diameter_mm);
  return {};
}

Result<NetworkData> NetworkBuilder::take(const std::string& name) {
  if (network_.rods.empty()) return invalid(name + ": holds no rods, must have one at least");
  if (!diameters_) network_.diameters.clear();
  if (const auto wrong = network_fault(network_); !wrong.empty())
    return invalid(name + ": " + wrong);
  return std::move(network_);
}

std::string spring_fault(const std::vector<double>& k) {
  bool any = false;
  for (const double one : k) {
    if (!(one == 0 || (one >= softest_spring && one <= stiffest_spring)))
      return fmt::format("a spring of {:g} N/mm, must be 0 or from {:g} to {:g}", one,
                         softest_spring, stiffest_spring);
    any = any || one > 0;
  }
  return any ? "" : "a spring of 0 N/mm holds nothing, an end that is free has \"to_mm\": \"free\"";
}

std::string network_fault(const NetworkData& network) {
  const std::size_t points = network.points.size(), rods = network.rods.size();
  if (rods == 0 || rods > most || points > most)
    return fmt::format("holds {} points and {} rods, must be from 1 to {}", points, rods, most);
  for (const auto& point : network.points)
    if (point.size() != 3 || !coordinates_fault(point).empty())
      return "points_mm must be points [x, y, z], mm";
  const auto there = [&](double number) {
    return number >= 0 && number < double(points) && number == std::floor(number);
  };
  for (std::size_t r = 0; r < rods; ++r) {
    if (network.rods[r].size() < 2) return fmt::format("rods[{}] must have at least two points", r);
    for (const int point : network.rods[r])
      if (!there(point)) return fmt::format("rods[{}] names point {} of {}", r, point, points);
  }
  if (!network.diameters.empty() && network.diameters.size() != rods)
    return fmt::format("holds {} diameters_mm, must be one for each of {} rods",
                       network.diameters.size(), rods);
  for (std::size_t r = 0; r < network.diameters.size(); ++r)
    if (const double diameter = network.diameters[r];
        diameter != 0 && !(diameter >= 1e-6 && diameter <= 1e6))
      return fmt::format("rods[{}]: a diameter of {:g} mm, must be from 1e-6 to 1e6", r, diameter);
  const auto of_rod = [](const RodValue& value) { return value.rod; };
  if (!std::ranges::is_sorted(network.own, {}, of_rod) ||
      (rods > 0 && !network.own.empty() && network.own.back().rod >= int(rods)))
    return "own must be rows [rod, key, value], in the order of the rods";
  std::set<double> named;
  for (const auto& row : network.supports) {
    if (row.size() != 1 && row.size() != 4)
      return "supports_mm must be rows [point] or [point, x, y, z]";
    if (!there(row[0])) return fmt::format("a support at point {} of {}", row[0], points);
    if (!named.insert(row[0]).second)
      return fmt::format("point {} is named as a support twice, must be once", row[0]);
  }
  std::set<double> sprung;
  for (const auto& row : network.springs) {
    if (row.size() != 4) return "springs_N_per_mm must be rows [point, kx, ky, kz]";
    if (!named.contains(row[0]) || !sprung.insert(row[0]).second)
      return fmt::format("a spring at point {}, must be one of a support", row[0]);
    if (const auto wrong = spring_fault({row[1], row[2], row[3]}); !wrong.empty()) return wrong;
  }
  std::set<double> ruled;
  for (const auto& row : network.joint_laws) {
    if ((row.size() != 3 && row.size() != 4) || !(row[0] == every_joint || there(row[0])) ||
        !(row[1] <= 1e9 && row[2] <= 1e9 && std::abs(row.back()) <= 1e9))
      return "joint_laws must be rows [point (-1: all others), shear_Nmm, twist_Nmm], below 0: "
             "rigid, and may end "
             "with "
             "an eccentricity_mm";
    if (!ruled.insert(row[0]).second)
      return row[0] == every_joint
                 ? std::string("all joints have two laws, must have one")
                 : fmt::format("the joint at point {} has two laws, must have one", row[0]);
  }
  std::set<std::pair<double, double>> held;
  for (const auto& row : network.holds) {
    if (row.size() != 3 || !(row[1] == 0 || row[1] == 1) ||
        !(row[2] == 0 || row[2] == 1 || row[2] == 2))
      return "holds must be rows [rod, 0 (begin) or 1 (end), 0 (pinned), 1 (tangent) or 2 "
             "(clamped)]";
    if (!(row[0] >= 0 && row[0] < double(rods) && row[0] == std::floor(row[0])))
      return fmt::format("a hold of rod {:g} of {}", row[0], rods);
    if (!held.insert({row[0], row[1]}).second)
      return fmt::format("rods[{}] has two holds at one end", row[0]);
  }
  std::set<int> freed;
  for (const int point : network.free) {
    if (!there(point)) return fmt::format("free names point {} of {}", point, points);
    if (!freed.insert(point).second)
      return fmt::format("point {} is named as free twice, must be once", point);
  }
  return "";
}

Result<NetworkData> read_network(std::string_view bytes, const std::string& name) {
  const std::string ending = ending_of(name);
  if (ending == ".json") return read_network_json(bytes, name);
  if (ending == ".obj") return read_network_obj(bytes, name);
  if (ending == ".dxf") return read_network_dxf(bytes, name);
  return invalid("{}: its name must end in .json (points, rods and supports), .obj or .dxf (rods)",
                 name);
}

}  // namespace gridshell::preset
