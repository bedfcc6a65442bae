#include "engine/core/text.h"
#include "engine/preset/consistency.h"
#include "engine/preset/field_list.h"

namespace gridshell::preset {
namespace {

using Kinds = FootprintKind;

bool is_circle(const Preset& preset) { return preset.footprint.kind == Kinds::circle; }
bool is_curve(const Preset& preset) { return preset.footprint.kind == Kinds::curve; }

/// "[footprint] radius_mm = 126", or "R_o = 126 by [footprint] longest_leg" for a key that gives
/// the radius indirectly.
std::string radius_text(const char* key, const char* name, double radius) {
  return std::string(key).ends_with("radius_mm") ? fmt::format("{} = {}", key, radius)
                                                 : fmt::format("{} = {} by {}", name, radius, key);
}

std::string original_text(const Preset& preset) {
  return radius_text(
      preset.footprint.longest_leg > 0 ? "[footprint] longest_leg" : "[footprint] radius_mm", "R_o",
      preset.original_radius_mm());
}

/// Adds the keys of a closed curve: the boundary of a footprint or the actuated boundary.
void add_curve(FieldList<Curve> curve, const std::string& meaning) {
  curve.add<&Curve::kind>(meaning).named("boundary");
  const auto ellipses = {CurveKind::ellipse, CurveKind::superellipse};
  curve.add<&Curve::half_x_mm>(above(0), "half axis of an ellipse or superellipse along x")
      .used_by(&Curve::kind, ellipses);
  curve.add<&Curve::half_y_mm>(above(0), "half axis along y").used_by(&Curve::kind, ellipses);
  curve.add<&Curve::exponent>(between(1, 100), "n of a superellipse, |x/a|^n + |y/b|^n = 1")
      .used_by(&Curve::kind, {CurveKind::superellipse});
  curve.add<&Curve::points>("corners of a polygon, or points that a closed spline goes through")
      .named("points_mm")
      .unit("mm")
      .points({"x", "y"})
      .used_by(&Curve::kind, {CurveKind::polygon, CurveKind::spline})
      .refused({"boundary"}, [](const Curve& of) {
        const bool pointed = of.kind == CurveKind::polygon || of.kind == CurveKind::spline;
        return pointed && of.points.size() < 3
                   ? fmt::format("{} points, expected at least 3 for a polygon or spline",
                                 of.points.size())
                   : "";
      });
}

/// Adds the rules of the key of a circle's radius: footprints of kind "circle" use it, and curves
/// whose boundary is a circle. The key named `label`, with the member `other`, replaces it.
template <class Struct>
void radius_rules(FieldList<Struct>& list, Curve Struct::*boundary, double Struct::*other,
                  const std::string& label) {
  list.used_by_footprint({Kinds::circle, Kinds::curve})
      .unused({label}, label + " replaces it",
              [=](const Preset& preset, const Struct& of) {
                return is_circle(preset) && of.*other > 0;
              })
      .unused({"boundary"}, [=](const Preset& preset, const Struct& of) {
        const CurveKind kind = (of.*boundary).kind;
        return !is_curve(preset) || kind == CurveKind::circle
                   ? ""
                   : fmt::format("{} boundary = \"{}\" does not use it, only \"circle\"",
                                 label.substr(0, label.find(' ')), word_of(kind));
      });
}

void add_footprint(std::vector<Field>& all) {
  FieldList<Footprint> list(all, "footprint", &Preset::footprint);
  list.add<&Footprint::kind>(
          "what cuts the flat square grid: a circle, the boundary that fits a net, a curve of your "
          "own, or joined blocks; \"network\": any rods from a file")
      .refused({}, "no block, expected at least one [[block]]",
               [](const Preset& preset) {
                 return preset.footprint.kind == Kinds::blocks && preset.block.empty();
               })
      .needs_equilibrium("a footprint that was not designed on a net has none",
                         [](const Preset& preset) { return !preset.on_net(); });
  const auto network = [](const Footprint& of) { return of.kind == Kinds::network; };
  const auto drawn = [=](const Footprint& of) {
    return network(of) || (of.kind == Kinds::curve && of.boundary.kind == CurveKind::file);
  };
  list.add<&Footprint::file>(
          "kind \"network\": points, rods, supports (.json), or rods alone (.obj, .dxf, .ply, "
          ".off); boundary = \"file\": a drawing (.dxf, .svg, .obj) whose largest closed line is "
          "the boundary")
      .unused({"kind"}, "only a network, and a curve whose boundary is \"file\", use it",
              [=](const Footprint& of) { return !drawn(of); })
      .refused({"boundary"},
               "boundary = \"file\" needs a drawing, expected its name in [footprint] file",
               [=](const Footprint& of) { return drawn(of) && !network(of) && of.file.empty(); })
      .refused({"kind"}, "kind = \"network\" needs rods, expected the name of a file",
               [=](const Footprint& of) { return network(of) && of.file.empty(); })
      .refused({},
               [=](const Preset& preset) {
                 const Footprint& of = preset.footprint;
                 return network(of) ? own_value_error(of.file) : std::string();
               })
      .refused({"[rod] width_mm"},
               "it has diameters, and rectangular rods have none, expected [rod] width_mm = 0",
               [=](const Preset& preset, const Footprint& of) {
                 return network(of) && preset.rod.rectangular() && !of.file.diameters.empty();
               })
      .needs_twist("joints of the file have laws of their own",
                   [=](const Footprint& of) {
                     return network(of) &&
                            std::ranges::any_of(of.file.joint_laws, [](const auto& row) {
                              return row[1] != 0 || row[2] != 0;
                            });
                   })
      .needs_twist(
          "the file is one closed rod (if it is an outline: kind = \"curve\", boundary = \"file\")",
          [=](const Footprint& of) {
            return network(of) && of.file.rods.size() == 1 && has_closed_rods(of.file);
          })
      .needs_twist("rods that are closed have no ends that could spin",
                   [=](const Footprint& of) { return network(of) && has_closed_rods(of.file); })
      .needs_twist("clamped ends of the file prescribe the rods' twist angle",
                   [=](const Footprint& of) { return network(of) && clamps(of.file); });
  const char* of_a_file =
      "it is for a file that `file` names, expected none: rods listed here are in mm and joined";
  list.add<&Footprint::file_unit>(
          "unit of a drawing (.obj, .dxf, .svg), of [actuation] file too; \"file\": the one that "
          "it names, else mm")
      .used_by(&Footprint::kind, {Kinds::network, Kinds::curve})
      .refused({"file"}, of_a_file,
               [=](const Footprint& of) { return network(of) && of.file_unit != FileUnit::file; });
  list.add<&Footprint::join_mm>(
          between(0, 1000),
          "points of the file within this distance become one, ends so near to a rod are joined to "
          "it, gaps of an outline are closed; 0: 0.001 mm")
      .used_by(&Footprint::kind, {Kinds::network, Kinds::curve})
      .refused({"file"}, of_a_file,
               [=](const Footprint& of) { return network(of) && of.join_mm > 0; });
  list.add<&Footprint::linkage>(
          "each line of the file is one segment (X-shells as .obj): rods are found by direction, "
          "every joint is a hinge; false: lines in line are one rod")
      .used_by(&Footprint::kind, {Kinds::network})
      .refused({"file"}, of_a_file, [=](const Footprint& of) { return network(of) && of.linkage; });
  list.add<&Footprint::rods>(between(1, 500), "rods per direction in a circle, n")
      .label("rods per direction")
      .used_by(&Footprint::kind, {Kinds::circle});
  list.add<&Footprint::radius_mm>(above(0), "radius of a circle, R_o").label("radius Rₒ");
  radius_rules(list, &Footprint::boundary, &Footprint::longest_leg, "[footprint] longest_leg");
  list.add<&Footprint::longest_leg>(between(0, 1000),
                                    "L_d of a circle, instead of `radius_mm`: longest leg over d; "
                                    "R_o = d (L_d + (n - 1)/2); 0: not given")
      .label("longest leg over d")
      .used_by(&Footprint::kind, {Kinds::circle});
  const char* in_the_file =
      "of a footprint of kind \"network\" the file says where rods and joints lie";
  list.add<&Footprint::spacing_mm>(above(0), "distance between neighbouring rods, d")
      .label("spacing d")
      .unused({"kind"}, in_the_file, network);
  list.add<&Footprint::placement>("rods at u = (i + 1/2) d, or at u = i d with one on each axis")
      .unused({"kind"}, in_the_file, network);
  FieldList<Curve> boundary(all, "footprint",
                            [](Preset& preset) -> Curve& { return preset.footprint.boundary; });
  boundary.used_by_footprint({Kinds::curve}).where(is_curve);
  add_curve(boundary, "boundary of a footprint of kind \"curve\", about the origin");
}

void add_actuation(std::vector<Field>& all) {
  FieldList<Actuation> list(all, "actuation", &Preset::actuation);
  const char* scaled = "the actuated boundary is the original one times [actuation] scale";
  const auto by_scale = [](const Preset& preset) {
    return is_curve(preset) && preset.actuation.scale > 0;
  };
  list.add<&Actuation::radius_mm>(above(0),
                                  "radius of the actuated boundary of a circle, R_a, at most R_o")
      .label("radius Rₐ")
      .unused({"scale"}, scaled, by_scale)
      .refused({"[footprint] radius_mm", "[footprint] longest_leg"}, [](const Preset& preset) {
        return is_circle(preset) && preset.actuated_radius_mm() > preset.original_radius_mm()
                   ? "larger than the footprint, expected at most " + original_text(preset)
                   : "";
      });
  radius_rules(list, &Actuation::boundary, &Actuation::ratio, "[actuation] ratio");
  list.add<&Actuation::ratio>(between(0, 1),
                              "R_a/R_o of a circle, instead of `radius_mm`; 0: not given")
      .label("Rₐ/Rₒ")
      .used_by_footprint({Kinds::circle});
  list.add<&Actuation::start>(
          "\"flat\": along the path from the flat grid; \"net\": directly to the equilibrium near "
          "the net")
      .refused({"[footprint] kind"}, [](const Preset& preset) {
        return preset.on_net() || preset.actuation.start == Start::flat
                   ? ""
                   : fmt::format(
                         "a {} has no net to start from, expected \"flat\", or [footprint] "
                         "kind = \"net\"",
                         word_of(preset.footprint.kind));
      });
  const char* at_net = "only a path from the flat buckles: [actuation] start is \"net\"";
  const auto from_net = [](const Preset& preset) {
    return preset.on_net() && preset.actuation.start == Start::net;
  };
  list.add<&Actuation::seed>("side to which the flat shell buckles")
      .unused({"start"}, at_net, from_net);
  list.add<&Actuation::seed_diagonal>("diagonal at whose two corners the joints are lower")
      .unused({"start"}, at_net, from_net);
  list.add<&Actuation::scale>(between(0, 1),
                              "\"curve\": the actuated boundary is the original one times this; 0: "
                              "`boundary` gives it. \"network\": supports without `to_mm` move "
                              "towards the middle by this factor; 0: they stay")
      .used_by_footprint({Kinds::curve, Kinds::network});
  list.add<&Actuation::file>(
          "boundary = \"file\": a drawing whose largest closed line is the actuated boundary; if "
          "both are drawn, the middle of the original is the origin of both")
      .unused({"boundary"}, "only boundary = \"file\" uses it",
              [=](const Preset& preset, const Actuation& of) {
                return !is_curve(preset) || of.boundary.kind != CurveKind::file || of.scale > 0;
              })
      .refused({"boundary"},
               "boundary = \"file\" needs a drawing, expected its name in [actuation] file",
               [=](const Preset& preset, const Actuation& of) {
                 return is_curve(preset) && of.boundary.kind == CurveKind::file && of.scale == 0 &&
                        of.file.empty();
               });
  FieldList<Curve> boundary(all, "actuation",
                            [](Preset& preset) -> Curve& { return preset.actuation.boundary; });
  boundary.used_by_footprint({Kinds::curve}).unused({"scale"}, scaled, by_scale);
  boundary.where(
      [=](const Preset& preset) { return is_curve(preset) && preset.actuation.scale == 0; });
  add_curve(boundary, "actuated boundary of a footprint of kind \"curve\"");
  list.add<&Actuation::correspondence>(
          "point of the actuated boundary to which an edge point moves: at the same fraction of "
          "the "
          "length from the positive x-axis, or at the same polar angle")
      .used_by_footprint({Kinds::curve});
}

}  // namespace

void add_shape_fields(std::vector<Field>& all) {
  add_footprint(all);
  add_actuation(all);
}

}  // namespace gridshell::preset
