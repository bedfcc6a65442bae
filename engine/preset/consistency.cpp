#include "engine/preset/consistency.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <tuple>

#include "engine/core/suggest.h"
#include "engine/preset/field_groups.h"
#include "engine/preset/model_choice.h"

namespace gridshell::preset {
namespace {

constexpr const char* spacing = "[footprint] spacing_mm";
constexpr int least_leader = 4;

/// Whether a net ends in two rings.
bool has_rings(const Preset& preset) {
  if (preset.footprint.kind != FootprintKind::net) return false;
  switch (preset.net.kind) {
    case NetKind::sphere:
    case NetKind::translation:
    case NetKind::surface:
      return false;
    case NetKind::cylinder:
    case NetKind::spool:
    case NetKind::beltrami:
    case NetKind::profile:
      break;
  }
  return true;
}

/// Of a circle: from R_o to R_a its boundary shrinks, through the radii of its stills.
void check_radii(const Preset& preset, std::vector<Conflict>& found) {
  const double original = preset.original_radius_mm(), actuated = preset.actuated_radius_mm();
  const bool by_leg = preset.footprint.longest_leg > 0, by_ratio = preset.actuation.ratio > 0;
  const char* from = by_leg ? "[footprint] longest_leg" : "[footprint] radius_mm";
  const char* to = by_ratio ? "[actuation] ratio" : "[actuation] radius_mm";
  const auto is = [](bool indirect, const char* key, const char* name, double radius) {
    return indirect ? fmt::format("{} = {} by {}", name, radius, key)
                    : fmt::format("{} = {}", key, radius);
  };
  const auto original_is = is(by_leg, from, "R_o", original);
  if (actuated > original)
    found.push_back({"actuation",
                     "radius_mm",
                     {from},
                     fmt::format("larger than the footprint, must be at most {}", original_is)});
  double last = original;
  for (const double radius : preset.figure.radii_mm) {
    if (radius > last || radius < actuated) {
      found.push_back({"figure",
                       "radii_mm",
                       {from, to},
                       fmt::format("{} is not on the way, must fall from at most {} to at least {}",
                                   radius, original_is, is(by_ratio, to, "R_a", actuated))});
      break;
    }
    last = radius;
  }
}

}  // namespace

std::vector<Conflict> conflicts(const Preset& preset) {
  std::vector<Conflict> found;
  const bool circle = preset.footprint.kind == FootprintKind::circle;
  const bool net = preset.on_net();
  if (circle) check_radii(preset, found);
  if (preset.footprint.kind != FootprintKind::network &&
      preset.rod.diameter_mm >= preset.footprint.spacing_mm)
    found.push_back({"rod",
                     "diameter_mm",
                     {spacing},
                     fmt::format("neighbouring rods would touch, must be less than {} = {}",
                                 spacing, preset.footprint.spacing_mm)});
  if (!net && preset.actuation.start == Start::net)
    found.push_back({"actuation",
                     "start",
                     {"[footprint] kind"},
                     circle ? "a circle has no net to start from, must be \"flat\", or [footprint] "
                              "kind = \"net\""
                            : "a curve has no net to start from, must be \"flat\", or [footprint] "
                              "kind = \"net\""});
  if (!has_rings(preset) && preset.ends.rings == Rings::free)
    found.push_back({"ends",
                     "rings",
                     {"[footprint] kind", "[net] kind"},
                     "only a surface of revolution has end rings, must be \"pinned\""});
  if (!circle && !preset.figure.radii_mm.empty())
    found.push_back({"figure",
                     "radii_mm",
                     {"[footprint] kind"},
                     "only a circle's boundary has a radius all the way, must be empty for "
                     "any other [footprint] kind"});
  if (preset.jitter.wanted() && preset.indentation.wanted())
    found.push_back(
        {"jitter",
         "trials",
         {"[indentation] depth", "[indentation] depth_mm", "[jitter] confined"},
         "states are looked for of a shell that nothing pushes, must be 0, or the depth "
         "of [indentation]"});
  for (auto& conflict : physics_conflicts(preset)) found.push_back(std::move(conflict));
  if (const auto count = preset.indentation.joint.size(); count != 0 && count != 2)
    found.push_back(
        {"indentation", "joint", {}, fmt::format("a list of {}, must be [i, j] or empty", count)});
  if (const int leader = preset.accuracy.leading_edges; leader > 0) {
    if (leader < least_leader)
      found.push_back({"accuracy",
                       "leading_edges",
                       {},
                       fmt::format("{} edges know bifurcations that the shell does not have, must "
                                   "be 0 or at least {}",
                                   leader, least_leader)});
    if (preset.accuracy.edges_per_segment > 0)
      found.push_back({"accuracy",
                       "leading_edges",
                       {"[accuracy] edges_per_segment"},
                       "the mesh asked for says which one leads, must be 0"});
  }
  for (const auto& [table, key, range] : {std::tuple("style", "range", &preset.style.range),
                                          {"movie", "bins_range", &preset.movie.bins_range}})
    if (!range->empty() && (range->size() != 2 || (*range)[0] >= (*range)[1]))
      found.push_back({table, key, {}, "must be [low, high] with low < high, or empty"});
  if (preset.movie.colour_by == ColourBy::deviation && !net)
    found.push_back({"movie",
                     "colour_by",
                     {"[footprint] kind"},
                     "\"deviation\" is from the net that a footprint was designed on, must be "
                     "another, or [footprint] kind = \"net\" or \"blocks\""});
  if (const auto count = preset.movie.target_mm.size(); count != 0 && count != 3)
    found.push_back(
        {"movie", "target_mm", {}, fmt::format("a list of {}, must be [x, y, z] or empty", count)});
  for (auto& more : {shape_conflicts(preset), block_conflicts(preset), end_conflicts(preset),
                     step_conflicts(preset)})
    found.insert(found.end(), more.begin(), more.end());
  return found;
}

namespace {

const std::vector<std::string> side_names{"east", "west", "north", "south"};

bool given_by_points(CurveKind kind) {
  switch (kind) {
    case CurveKind::polygon:
    case CurveKind::spline:
      return true;
    case CurveKind::circle:
    case CurveKind::ellipse:
    case CurveKind::superellipse:
      break;
  }
  return false;
}

/// Where a curve is given by points it needs some.
void check_curve(const std::string& table, const Curve& curve, std::vector<Conflict>& found) {
  if (given_by_points(curve.kind) && curve.points.size() < 3)
    found.push_back({table,
                     "points_mm",
                     {fmt::format("[{}] boundary", table)},
                     fmt::format("{} points, must be at least 3 for a polygon or spline",
                                 curve.points.size())});
}

void check_net(const std::string& table, const Net& net, int item, std::vector<Conflict>& found) {
  const auto need = [&](const char* key, const Points& points, const char* kind) {
    if (points.size() >= 4) return;
    const std::string kind_key =
        item < 0 ? fmt::format("[{}] kind", table) : fmt::format("[[{}]] {} kind", table, item + 1);
    found.push_back(
        {table,
         key,
         {kind_key},
         fmt::format("{} points, must be at least 4 for kind = \"{}\"", points.size(), kind),
         item});
  };
  if (net.kind == NetKind::profile) need("profile", net.profile, "profile");
  if (net.kind == NetKind::translation) {
    need("curve_u", net.curve_u, "translation");
    need("curve_v", net.curve_v, "translation");
  }
}

void check_surface(const Net& net, std::vector<Conflict>& found) {
  const auto wrong = [&](const char* key, std::vector<std::string> others, const char* why) {
    found.push_back({"net", key, std::move(others), why});
  };
  const int given = int(!net.implicit.empty()) + int(!net.height.empty()) + int(!net.file.empty());
  if (given == 0)
    wrong(
        "implicit", {"[net] height", "[net] file"},
        "kind = \"surface\" needs an expression, must be F(x, y, z), or height must be h(x, y), or "
        "file a surface");
  if (given > 1)
    wrong(net.file.empty() ? "height" : "file", {"[net] implicit", "[net] height"},
          "the surface is given twice, must be empty");
  const std::size_t size = net.apex_mm.size();
  if (!net.implicit.empty() ? size != 3 : size < 2 || size > 3)
    wrong("apex_mm", {"[net] implicit", "[net] height"},
          net.implicit.empty() ? "must be [x, y]"
                               : "must be [x, y, z], a point of the surface where the net begins");
}

void check_join(const Preset& preset, int item, const char* key, const std::string& name,
                std::vector<Conflict>& found) {
  if (side_named(preset, name)) return;
  std::vector<std::string> known;
  for (const Block& block : preset.block)
    for (const auto& side : side_names) known.push_back(block.name + "." + side);
  found.push_back({"join",
                   key,
                   {},
                   "no side of a block, must be a block's name and east, west, north or south with "
                   "a dot between" +
                       did_you_mean(name, known),
                   item});
}

void check_network(const Preset& preset, std::vector<Conflict>& found) {
  const NetworkData& file = preset.footprint.file;
  if (file.empty())
    found.push_back({"footprint",
                     "file",
                     {"[footprint] kind"},
                     "kind = \"network\" needs rods, must be the name of a file"});
  if (preset.rod.rectangular() && !file.diameters.empty())
    found.push_back({"footprint",
                     "file",
                     {"[rod] width_mm"},
                     "gives diameters, and rectangular rods have none, [rod] width_mm must be 0"});
}

}  // namespace

std::vector<Conflict> shape_conflicts(const Preset& preset) {
  std::vector<Conflict> found;
  if (preset.footprint.kind == FootprintKind::curve) {
    check_curve("footprint", preset.footprint.boundary, found);
    if (preset.actuation.scale == 0) check_curve("actuation", preset.actuation.boundary, found);
  }
  if (preset.footprint.kind == FootprintKind::net) check_net("net", preset.net, -1, found);
  if (preset.footprint.kind == FootprintKind::net && preset.net.kind == NetKind::surface)
    check_surface(preset.net, found);
  if (preset.footprint.kind == FootprintKind::network) check_network(preset, found);
  return found;
}

std::vector<Conflict> block_conflicts(const Preset& preset) {
  std::vector<Conflict> found;
  if (preset.footprint.kind != FootprintKind::blocks) return found;
  if (preset.block.empty())
    found.push_back(
        {"footprint", "kind", {}, "there is no block, must have at least one [[block]]"});
  std::set<std::string> names;
  for (int k = 0; k < int(preset.block.size()); ++k) {
    const Block& block = preset.block[k];
    if (block.name.empty() || block.name.find('.') != std::string::npos)
      found.push_back({"block", "name", {}, "must be a name without a dot", k});
    else if (!names.insert(block.name).second)
      found.push_back({"block", "name", {}, "used twice, must be unique", k});
    check_net("block", block.net, k, found);
    if (block.net.kind == NetKind::surface)
      found.push_back({"block",
                       "kind",
                       {},
                       "blocks are parts of spheres, translation nets and surfaces of revolution, "
                       "must be one of these",
                       k});
  }
  for (int k = 0; k < int(preset.join.size()); ++k) {
    check_join(preset, k, "first", preset.join[k].first, found);
    check_join(preset, k, "second", preset.join[k].second, found);
  }
  return found;
}

std::vector<Conflict> end_conflicts(const Preset& preset) {
  std::vector<Conflict> found;
  if (preset.ends.second_ring_mm > 0 && !preset.on_net())
    found.push_back({"ends",
                     "second_ring_mm",
                     {"[footprint] kind"},
                     "the far ends are pinned along the tangents of a net, and this footprint has "
                     "none, must be 0, or [footprint] kind = \"net\""});
  if (preset.ends.second_ring_mm > 0 && preset.ends.kind != EndKind::pinned)
    found.push_back({"ends",
                     "second_ring_mm",
                     {"[ends] kind"},
                     "a tail holds the direction of its end, which is held already, must be 0, or "
                     "[ends] kind = \"pinned\""});
  for (const Vary vary : preset.inverse.vary)
    if (vary == Vary::directions && preset.ends.kind != EndKind::tangent)
      found.push_back({"inverse",
                       "vary",
                       {"[ends] kind"},
                       "directions are held alone only with [ends] kind = \"tangent\", must not "
                       "name \"directions\""});
  for (const Vary vary : preset.inverse.vary)
    if (vary == Vary::diameters && (preset.rod.rectangular() || preset.rod_v.rectangular()))
      found.push_back({"inverse",
                       "vary",
                       {"[rod] width_mm", "[rod_v] width_mm"},
                       "rectangular rods have no diameters, must not name \"diameters\""});
  if (!preset.inverse.vary.empty() && !preset.on_net())
    found.push_back({"inverse",
                     "vary",
                     {"[footprint] kind"},
                     "the footprint has no net, so there is no surface to meet, must be empty, or "
                     "[footprint] kind = \"net\""});
  return found;
}

std::optional<NamedSide> side_named(const Preset& preset, const std::string& name) {
  const auto dot = name.find('.');
  if (dot == std::string::npos) return std::nullopt;
  for (int k = 0; k < int(preset.block.size()); ++k)
    for (const auto& side : side_names)
      if (preset.block[k].name == name.substr(0, dot) && side == name.substr(dot + 1))
        return NamedSide{k, side};
  return std::nullopt;
}

}  // namespace gridshell::preset
