#include "engine/formats/network_file.h"

#include <fmt/format.h>
#include <cmath>

#include "engine/core/try.h"
#include "engine/formats/point_file.h"

namespace gridshell::preset {
namespace {

constexpr std::size_t most = 100000, most_entries = 1000000;
constexpr double largest_mm = 1e9;

std::string coordinates_error(const std::vector<double>& xyz) {
  if (xyz.size() < 2 || xyz.size() > 3)
    return fmt::format("got a point of {} coordinates, expected [x, y] or [x, y, z]", xyz.size());
  for (const double value : xyz)
    if (!(std::abs(value) <= largest_mm))
      return "got a coordinate that is no number of at most 1e9, expected mm";
  return "";
}

}  // namespace

int NetworkBuilder::known(const std::vector<double>& xyz) const {
  const auto cell = [&](std::size_t k, long step) {
    return long(std::floor(xyz[k] / near_mm_)) + step;
  };
  for (long i = -1; i <= 1; ++i)
    for (long j = -1; j <= 1; ++j)
      for (long k = -1; k <= 1; ++k) {
        const auto found = at_.find({cell(0, i), cell(1, j), cell(2, k)});
        if (found == at_.end()) continue;
        for (const int point : found->second) {
          const auto& other = network_.points[std::size_t(point)];
          if (std::hypot(other[0] - xyz[0], other[1] - xyz[1], other[2] - xyz[2]) < near_mm_)
            return point;
        }
      }
  return -1;
}

Result<void> NetworkBuilder::add_point(const std::vector<double>& xyz, const std::string& at) {
  if (const auto wrong = coordinates_error(xyz); !wrong.empty()) return invalid(at + ": " + wrong);
  if (points() == most) return invalid("{}: expected at most {} points", at, most);
  const std::vector<double> coordinates{xyz[0], xyz[1], xyz.size() == 3 ? xyz[2] : 0};
  const int number = int(points()), same = known(coordinates);
  same_as_.push_back(same >= 0 ? same : number);
  network_.points.push_back(coordinates);
  if (same < 0)
    at_[{long(std::floor(coordinates[0] / near_mm_)), long(std::floor(coordinates[1] / near_mm_)),
         long(std::floor(coordinates[2] / near_mm_))}]
        .push_back(number);
  return {};
}

Result<int> NetworkBuilder::find_or_add_point(const std::vector<double>& xyz,
                                              const std::string& at) {
  if (const auto wrong = coordinates_error(xyz); !wrong.empty()) return invalid(at + ": " + wrong);
  const int same = known({xyz[0], xyz[1], xyz.size() == 3 ? xyz[2] : 0});
  if (same >= 0) return same;
  TRY_DO(add_point(xyz, at));
  return int(points()) - 1;
}

Result<int> NetworkBuilder::point(long number, const std::string& at) const {
  if (number < 0 || number >= long(points()))
    return invalid(
        points() == 0
            ? fmt::format("{}: got point {}, but there are no points", at, number)
            : fmt::format("{}: got point {}, expected 0 to {}", at, number, points() - 1));
  return same_as_[std::size_t(number)];
}

Result<void> NetworkBuilder::add_rod(std::vector<int> points, double diameter_mm,
                                     const std::string& at) {
  if (joins_near()) points.erase(std::unique(points.begin(), points.end()), points.end());
  if (std::ranges::count(points, points.empty() ? 0 : points.front()) == long(points.size()))
    return invalid(at +
                   ": got a rod of one point, expected at least two points at different positions");
  if (const auto same = std::ranges::adjacent_find(points); same != points.end())
    return invalid(
        "{}: got a segment of no length, expected points at a distance, and point {} follows "
        "itself, or another point at its position",
        at, *same);
  entries_ += points.size();
  if (network_.rods.size() == most || entries_ > most_entries)
    return invalid("{}: expected at most {} rods through {} points", at, most, most_entries);
  diameters_ = diameters_ || diameter_mm > 0;
  network_.rods.push_back(std::move(points));
  network_.diameters.push_back(diameter_mm);
  locations_.push_back(at);
  return {};
}

Result<NetworkData> NetworkBuilder::take(const std::string& name) {
  if (network_.rods.empty()) return invalid(name + ": got no rods, expected at least one");
  if (!diameters_) network_.diameters.clear();
  if (const auto wrong = network_error(network_); !wrong.empty())
    return invalid(name + ": " + wrong);
  return std::move(network_);
}

std::string spring_error(const std::vector<double>& k) {
  bool any = false;
  for (const double one : k) {
    if (!(one == 0 || (one >= softest_spring && one <= stiffest_spring)))
      return fmt::format("got a spring of {:g} N/mm, expected 0 or from {:g} to {:g}", one,
                         softest_spring, stiffest_spring);
    any = any || one > 0;
  }
  return any ? "" : "a spring of 0 N/mm supports nothing, a free end has \"to_mm\": \"free\"";
}

std::string network_error(const NetworkData& network) {
  const std::size_t points = network.points.size(), rods = network.rods.size();
  if (rods == 0 || rods > most || points > most)
    return fmt::format("got {} points and {} rods, expected 1 to {}", points, rods, most);
  for (const auto& point : network.points)
    if (point.size() != 3 || !coordinates_error(point).empty())
      return "points_mm: expected points [x, y, z], mm";
  const auto there = [&](double number) {
    return number >= 0 && number < double(points) && number == std::floor(number);
  };
  for (std::size_t r = 0; r < rods; ++r) {
    if (network.rods[r].size() < 2)
      return fmt::format("rods[{}]: got one point, expected at least two", r);
    for (const int point : network.rods[r])
      if (!there(point))
        return fmt::format("rods[{}]: got point {}, expected 0 to {}", r, point, points - 1);
  }
  if (!network.diameters.empty() && network.diameters.size() != rods)
    return fmt::format("got {} diameters_mm, expected one for each of {} rods",
                       network.diameters.size(), rods);
  for (std::size_t r = 0; r < network.diameters.size(); ++r)
    if (const double diameter = network.diameters[r];
        diameter != 0 && !(diameter >= 1e-6 && diameter <= 1e6))
      return fmt::format("rods[{}]: got a diameter of {:g} mm, expected 1e-6 to 1e6", r, diameter);
  const auto of_rod = [](const RodValue& value) { return value.rod; };
  if (!std::ranges::is_sorted(network.own, {}, of_rod))
    return "own: expected rows [rod, key, value], in the order of the rods";
  if (!network.own.empty() && network.own.back().rod >= int(rods))
    return fmt::format("own: got rod {}, expected 0 to {}", network.own.back().rod, rods - 1);
  std::set<double> named;
  for (const auto& row : network.supports) {
    if (row.size() != 1 && row.size() != 4)
      return "supports_mm: expected rows [point] or [point, x, y, z]";
    if (!there(row[0])) return fmt::format("a support at point {} of {}", row[0], points);
    if (!named.insert(row[0]).second)
      return fmt::format("got point {} as a support twice, expected once", row[0]);
  }
  std::set<double> sprung;
  for (const auto& row : network.springs) {
    if (row.size() != 4) return "springs_N_per_mm: expected rows [point, kx, ky, kz]";
    if (!named.contains(row[0]) || !sprung.insert(row[0]).second)
      return fmt::format("got a spring at point {}, expected a support", row[0]);
    if (const auto wrong = spring_error({row[1], row[2], row[3]}); !wrong.empty()) return wrong;
  }
  std::set<double> ruled;
  for (const auto& row : network.joint_laws) {
    if ((row.size() != 3 && row.size() != 4) || !(row[0] == every_joint || there(row[0])) ||
        !(row[1] <= 1e9 && row[2] <= 1e9 && std::abs(row.back()) <= 1e9))
      return "joint_laws: expected rows [point (-1: all others), shear_Nmm, twist_Nmm], below 0: "
             "rigid, and may end "
             "with "
             "an eccentricity_mm";
    if (row[0] == every_joint && row.size() == 4 && row[3] != 0)
      return "joint_laws: got an eccentricity_mm in the row of all others (point -1), expected it "
             "in "
             "the rows of single joints, or [joints] eccentricity_mm";
    if (!ruled.insert(row[0]).second)
      return row[0] == every_joint
                 ? std::string("got two laws for all joints, expected one")
                 : fmt::format("got two laws for the joint at point {}, expected one", row[0]);
  }
  std::set<std::pair<double, double>> constrained;
  for (const auto& row : network.end_constraints) {
    if (row.size() != 3 || !(row[1] == 0 || row[1] == 1) ||
        !(row[2] == 0 || row[2] == 1 || row[2] == 2))
      return "`holds`: expected rows [rod, 0 (begin) or 1 (end), 0 (pinned), 1 (tangent) or 2 "
             "(clamped)]";
    if (!(row[0] >= 0 && row[0] < double(rods) && row[0] == std::floor(row[0])))
      return fmt::format("a constraint of rod {:g} of {}", row[0], rods);
    if (!constrained.insert({row[0], row[1]}).second)
      return fmt::format("rods[{}] has two constraints at one end", row[0]);
  }
  std::set<int> freed;
  for (const int point : network.free) {
    if (!there(point))
      return fmt::format("free: got point {}, expected 0 to {}", point, points - 1);
    if (!freed.insert(point).second)
      return fmt::format("got point {} as free twice, expected once", point);
  }
  return "";
}

Result<NetworkData> read_network(std::string_view bytes, const std::string& name,
                                 const NetworkOptions& options, FileReport* report) {
  const std::string ending = ending_of(name);
  FileReport found;
  const auto read = [&]() -> Result<NetworkData> {
    if (ending == ".json") return read_network_json(bytes, name, options);
    if (ending == ".obj") return read_network_obj(bytes, name, options, found);
    if (ending == ".dxf") return read_network_dxf(bytes, name, options, found);
    if (ending == ".ply" || ending == ".off") return read_network_mesh(bytes, name, options, found);
    return invalid(
        "{}: expected a name that ends in .json (points, rods and supports), .obj or .dxf (rods), "
        ".ply or "
        ".off (a mesh whose edges are rods)",
        name);
  };
  auto network = read();
  if (!network || !report) return network;
  report_network(*network, options, found);
  found.text = name + ": " + found.text;
  *report = std::move(found);
  return network;
}

}  // namespace gridshell::preset
