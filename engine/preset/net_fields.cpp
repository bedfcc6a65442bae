#include "engine/core/text.h"
#include "engine/preset/consistency.h"
#include "engine/preset/field_list.h"

namespace gridshell::preset {
namespace {

using Kinds = FootprintKind;

/// Adds the rules of a list of points that only one kind of net uses: at least four points.
void made_of(FieldList<Net>& net, NetKind kind, Points Net::*points) {
  net.used_by(&Net::kind, {kind}).refused({"kind"}, [=](const Net& of) {
    return of.kind == kind && (of.*points).size() < 4
               ? fmt::format("{} points, expected at least 4 for kind = \"{}\"",
                             (of.*points).size(), word_of(kind))
               : "";
  });
}

FieldList<Net> add_net(FieldList<Net> net, bool block) {
  using K = NetKind;
  net.add<&Net::kind>(
      "\"sphere\": a cap; \"translation\": the sum of two curves; \"surface\": an expression or a "
      "file; others: half a surface of revolution about x (\"spool\", \"beltrami\": Gauss "
      "curvature -1/rho^2)");
  if (block)
    net.refused(
        {},
        "blocks are parts of spheres, translation nets and surfaces of revolution, expected "
        "one of these",
        [](const Net& of) { return of.kind == K::surface; });
  net.add<&Net::radius_mm>(
         above(0),
         "radius rho of sphere or cylinder; spool and beltrami have the Gauss curvature -1/rho^2")
      .used_by(&Net::kind, {K::sphere, K::cylinder, K::spool, K::beltrami});
  net.add<&Net::cut_height>(between(0, 0.999),
                            "height of a cap's boundary over rho, z*/rho; 0: the hemisphere")
      .used_by(&Net::kind, {K::sphere});
  const auto revolution = {K::cylinder, K::spool, K::beltrami, K::profile};
  net.add<&Net::length_mm>(
         at_least(0),
         "distance between the end rings of a surface of revolution; 0: all of a profile")
      .used_by(&Net::kind, revolution);
  net.add<&Net::waist>(
         {0, 100, true},
         "radius over rho in the middle of a spool (its smallest) or beltrami surface (below 1)")
      .used_by(&Net::kind, {K::spool, K::beltrami});
  net.add<&Net::crossing_deg>(
         between(1, 179),
         "angle between the rods, seen along the axis, in the middle of a surface of revolution")
      .used_by(&Net::kind, revolution);
  net.add<&Net::profile>("points of a profile, mm: radius and position along the axis")
      .points({"r", "z"});
  made_of(net, K::profile, &Net::profile);
  net.add<&Net::curve_u>("points of the curve X of a translation net X(u) + Y(v), mm")
      .points({"x", "y", "z"});
  made_of(net, K::translation, &Net::curve_u);
  net.add<&Net::curve_v>("points of the curve Y").points({"x", "y", "z"});
  made_of(net, K::translation, &Net::curve_v);
  return net;
}

/// Adds the keys of a net on a surface that an expression or a file gives.
void add_surface(FieldList<Net> net) {
  const auto given = [](const Net& of) {
    return of.kind != NetKind::surface
               ? 1
               : int(!of.implicit.empty()) + int(!of.height.empty()) + int(!of.file.empty());
  };
  const char* twice = "the surface is given twice, expected an empty value";
  const auto surface = [&net]() -> FieldList<Net>& {
    return net.used_by(&Net::kind, {NetKind::surface});
  };
  net.add<&Net::implicit>("F(x, y, z) of a surface F = 0, mm: \"x^2 + y^2 + z^2 - 120^2\"");
  surface().refused({"height", "file"},
                    "kind = \"surface\" needs an expression, expected F(x, y, z), or for height "
                    "h(x, y), or for file a surface",
                    [=](const Net& of) { return given(of) == 0; });
  net.add<&Net::height>("h(x, y) of a surface z = h, mm, instead of `implicit`");
  surface().refused({"implicit"}, twice,
                    [=](const Net& of) { return given(of) > 1 && of.file.empty(); });
  net.add<&Net::file>(
      "instead of an expression: heights x, y, z over a rectangular grid (.csv, .txt), "
      "interpolated by a spline, or triangles (.obj, .ply, .stl), to which a smooth surface is "
      "fitted");
  surface().refused({"implicit", "height"}, twice,
                    [=](const Net& of) { return given(of) > 1 && !of.file.empty(); });
  net.add<&Net::file_unit>("unit of the file's numbers; \"file\": the one that it names, else mm");
  surface().refused(
      {"file"}, "it is for a file that `file` names, expected none: a surface listed here is in mm",
      [](const Net& of) { return of.file_unit != FileUnit::file; });
  const auto mesh = [](const Net& of) { return of.kind == NetKind::surface && of.file.is_mesh(); };
  const auto of_mesh = [&] {
    surface().unused({"file"}, "only a net on a mesh of triangles uses it",
                     [=](const Net& of) { return of.kind == NetKind::surface && !mesh(of); });
  };
  net.add<&Net::fit_mm>(at_least(0),
                        "mesh: largest distance of its vertices from the fitted surface, which is "
                        "as smooth as this allows; 0: a thousandth of the size, or what is needed");
  of_mesh();
  net.add<&Net::least_angle_deg>(between(7, 80),
                                 "mesh: rods end where they would cross at less than this angle");
  of_mesh();
  net.add<&Net::apex>(
      "\"given\": at `apex_mm`; \"best\", for a mesh: where rods reach the largest area; "
      "\"best_angle\": where, at 0.95 of it, the least angle is largest");
  surface().refused({"file"},
                    "the search is for a mesh of triangles, expected \"given\" for other surfaces",
                    [=](const Net& of) { return of.apex != NetApex::given && !mesh(of); });
  const auto searched = [](const Net& of) { return of.apex != NetApex::given; };
  const char* found = "the search for the apex finds it, as `apex` requests";
  net.add<&Net::apex_mm>(
      "[x, y, z], a point of the surface where the net's axes cross at right angles; of a height "
      "or a file [x, y]");
  surface().refused({"implicit", "height"}, [](const Net& of) {
    const std::size_t size = of.apex_mm.size();
    const bool implicit = !of.implicit.empty();
    if (of.kind != NetKind::surface || size == 3 || (size == 2 && !implicit)) return "";
    return implicit ? "expected [x, y, z], a point of the surface where the net begins"
                    : "expected [x, y]";
  });
  net.unused({"apex"}, found, searched);
  net.add<&Net::axis>(
      "direction of the u-axis at the apex: that of the largest curvature (x, if all are equal), "
      "or x");
  surface().unused({"apex"}, found, searched);
  net.add<&Net::axis_deg>(
      between(-180, 180),
      "rotation of the u-axis from the direction of `axis`, to the left as seen from above");
  surface().unused({"apex"}, found, searched);
  net.add<&Net::cut_mm>(
      "height of the plane that cuts the surface, whose upper part remains; \"none\": a mesh ends "
      "at its own rim, other surfaces at 0");
  surface().unused({"within"}, "[net] within is the boundary in the plane instead",
                   [](const Net& of) { return !of.within.empty(); });
  net.add<&Net::within>(
      "G(x, y, z), negative where the net is retained, instead of the plane; empty: the plane");
  surface();
}

void name_rule(FieldList<Block>& list) {
  list.refused({}, [](const Preset& preset, const Block& block) {
    if (block.name.empty() || block.name.find('.') != std::string::npos)
      return "expected a name without a dot";
    for (const Block* other = preset.block.data(); other != &block; ++other)
      if (other->name == block.name) return "used twice, expected a unique name";
    return "";
  });
}

/// Adds the rule that a join must name a side of a block.
void side_rule(FieldList<Join>& list, std::string Join::*side) {
  list.refused({}, [=](const Preset& preset, const Join& join) -> std::string {
    if (side_named(preset, join.*side)) return "";
    std::vector<std::string> known;
    for (const Block& block : preset.block)
      for (const char* name : side_names) known.push_back(block.name + "." + name);
    return "not a side of a block, expected a block's name and east, west, north or south with a "
           "dot "
           "between" +
           did_you_mean(join.*side, known);
  });
}

void add_blocks(std::vector<Field>& all) {
  const auto joined = [](const Preset& preset) { return preset.footprint.kind == Kinds::blocks; };
  FieldList<Blocks> blocks(all, "blocks", &Preset::blocks);
  blocks.used_by_footprint({Kinds::blocks})
      .add<&Blocks::max_gap_mm>(
          at_least(0), "largest distance in space between two blocks at a joint of their seam");
  const auto at = [](auto& list, int item) -> auto& {
    return item < 0 ? list.back() : list[std::size_t(item)];
  };
  FieldList<Block> block(
      all, "block", [=](Preset& preset, int item) -> Block& { return at(preset.block, item); });
  block.used_by_footprint({Kinds::blocks}).where(joined);
  block.add<&Block::name>("name of the block, unique");
  name_rule(block);
  FieldList<Net> net(all, "block",
                     [=](Preset& preset, int item) -> Net& { return at(preset.block, item).net; });
  net.used_by_footprint({Kinds::blocks}).where(joined);
  add_net(net, true);
  const Range cuts = between(-500, 500);
  block.add<&Block::east>(
      cuts,
      "row m of joints at which it is cut: the part u + v <= m d remains, u and v of its own net");
  block.add<&Block::west>(cuts, "the part u + v >= m d remains");
  block.add<&Block::north>(cuts, "the part v - u <= m d remains");
  block.add<&Block::south>(cuts, "the part v - u >= m d remains");
  FieldList<Join> join(all, "join",
                       [=](Preset& preset, int item) -> Join& { return at(preset.join, item); });
  join.used_by_footprint({Kinds::blocks}).where(joined);
  join.add<&Join::first>("side of a block, as \"name.east\"");
  side_rule(join, &Join::first);
  join.add<&Join::second>("side that faces it, as \"other.west\"");
  side_rule(join, &Join::second);
}

}  // namespace

void add_net_fields(std::vector<Field>& all) {
  FieldList<Net> net(all, "net", &Preset::net);
  net.used_by_footprint({Kinds::net}).where([](const Preset& preset) {
    return preset.footprint.kind == Kinds::net;
  });
  add_surface(add_net(net, false));
  add_blocks(all);
}

}  // namespace gridshell::preset
