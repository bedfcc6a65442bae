// A preset: everything an experiment and its pictures need, as plain values with defaults. The
// names are those of the TOML keys: `[rod] diameter_mm` is `preset.rod.diameter_mm`. What each key
// means, its unit, range and default stand once, in the field table (field_table.h); the words of
// an enum stand beside it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/choices.h"
#include "engine/core/enum_words.h"
#include "engine/formats/shape_data.h"
#include "engine/preset/hand.h"
#include "engine/preset/pictures.h"

namespace gridshell::preset {

/// Materials by name, for young_GPa, shear_GPa, density_kg_m3 and strength_MPa.
enum class Material { none, nitinol, gfrp, spruce, oak, steel, aluminium };

struct Rod {
  Material material = Material::none;
  double diameter_mm = 0.254;
  double young_GPa = 83.0;
  double shear_GPa = 0;                   ///< 0: not given
  double density_kg_m3 = 0;               ///< 0: not given
  double strength_MPa = 0;                ///< 0: not given, or by yield_strain
  double yield_strain = 0;                ///< 0: not given, or by strength_MPa
  double width_mm = 0, thickness_mm = 0;  ///< of a rectangular section; 0: round
  double wall_mm = 0;                     ///< of a tube; 0: solid
  /// Of a section that is none of these; 0: by the section
  double EA_N = 0, EI_Nmm2 = 0, GJ_Nmm2 = 0, mass_g_per_m = 0, modulus_mm3 = 0;
  double curvature_per_mm = 0;           ///< at rest, upright
  double curvature_sideways_per_mm = 0;  ///< at rest, in the flat
  double twist_rad_per_mm = 0;           ///< at rest
  bool as_drawn = false;                 ///< a network's: at rest along its line in the flat

  bool rectangular() const { return width_mm > 0 && thickness_mm > 0; }
  bool has_mass() const { return density_kg_m3 > 0 || mass_g_per_m > 0; }
  /// Stress that a fibre bears, MPa; 0: not given.
  double fibre_strength_MPa() const {
    return yield_strain > 0 ? 1e3 * young_GPa * yield_strain : strength_MPa;
  }
  bool operator==(const Rod&) const = default;
};
/// The v rods, where they are others.
struct RodV : Rod {
  bool differs = false;
};

enum class JointKind { shared, spring };
struct Joints {
  JointKind kind = JointKind::shared;
  double stiffness_N_per_mm = 0;  ///< of springs
  double shear_Nmm = 0;           ///< per rad of shear
  double twist_Nmm = 0;           ///< per rad of spin beside the joint's normal
  double eccentricity_mm = 0;     ///< how far the second rod's axis lies above the first's
  double diameter_mm = 3;         ///< of the joint's cylinder, of which a scan sees the top
  double height_mm = 5;           ///< and how far its top lies above the rods' crossing
  double mass_g = 0;              ///< of each, beside that of its rods
};

enum class Rings { pinned, free };
struct Ends {
  EndKind kind = EndKind::pinned;
  Rings rings = Rings::pinned;
  double second_ring_mm = 0;  ///< length of the tails beyond the boundary; 0: none
  Points table;               ///< a row an end: family, rod, end, x, y, z, leg, tx, ty, tz
};

enum class CurveKind { circle, ellipse, superellipse, polygon, spline, file };
/// A closed curve in the plane; the radius of a circle stands beside it.
struct Curve {
  CurveKind kind = CurveKind::circle;
  double half_x_mm = 126.0, half_y_mm = 100.0;  ///< of an ellipse or superellipse
  double exponent = 4.0;                        ///< of a superellipse
  Points points;                                ///< (x, y) of a polygon or spline
};

/// The unit of a file's numbers; `file`: the one that it names, else mm.
enum class FileUnit { file, mm, cm, m, in, ft };
/// In millimetres; 0: as the file says.
inline double millimetres(FileUnit unit) {
  constexpr double sizes[] = {0, 1, 10, 1000, 25.4, 304.8};
  return sizes[std::size_t(unit)];
}

enum class FootprintKind { circle, net, curve, blocks, network };
struct Footprint {
  FootprintKind kind = FootprintKind::circle;
  Curve boundary;
  int rods = 12;             ///< a direction
  double radius_mm = 126.0;  ///< R_o
  double longest_leg = 0;    ///< L_d, of d; 0: `radius_mm` says how large a circle is
  double spacing_mm = 20.0;  ///< d
  Placement placement = Placement::half;
  NetworkData file;  ///< of kind network; of a curve whose boundary is "file": one closed rod
  /// How the file is read that `file` names; the defaults again once it is.
  FileUnit file_unit = FileUnit::file;
  double join_mm = 0;
};

enum class NetKind { sphere, cylinder, spool, beltrami, profile, translation, surface };
/// What the first rod of a net on a surface sets out along, or turned from it by axis_deg.
enum class NetAxis { principal, x };
/// Whether apex_mm says where it begins, or both place and direction are searched for.
enum class NetApex { given, best };
struct Net {
  NetKind kind = NetKind::sphere;
  double radius_mm = 120.0;             ///< rho, the deviation's scale
  double cut_height = 0;                ///< z*/rho of a cap
  double length_mm = 240.0;             ///< between the end rings
  double waist = 0.5;                   ///< a
  double crossing_deg = 90;             ///< omega in the middle of a surface of revolution
  Points profile;                       ///< (r, z)
  Points curve_u, curve_v;              ///< (x, y, z) of a translation net
  std::string implicit;                 ///< F(x, y, z) of a surface F = 0
  std::string height;                   ///< h(x, y) of a surface z = h
  SurfaceData file;                     ///< heights over a grid, or a mesh
  FileUnit file_unit = FileUnit::file;  ///< of the file that `file` names; once read the default
  std::string within;                   ///< G(x, y, z) < 0 inside the boundary; empty: z > cut_mm
  /// nothing: a mesh ends at its rim, other surfaces at z = 0
  std::optional<double> cut_mm;
  double fit_mm = 0;            ///< of a mesh: how far it may lie off its surface; 0: as needed
  double least_angle_deg = 30;  ///< of a mesh: between rods, where they end
  NetApex apex = NetApex::given;
  std::vector<double> apex_mm{0, 0};  ///< where the axes cross; z may be left out of a height
  NetAxis axis = NetAxis::principal;
  double axis_deg = 0;
};

/// A building block: a net and the rows of joints at which it is cut.
struct Block {
  std::string name;
  Net net;
  std::optional<int> east, west, north, south;
};

/// Two sides of blocks that become one seam, each as "name.side".
struct Join {
  std::string first, second;
};

struct Blocks {
  double max_gap_mm = 10;
};

enum class Start { flat, net };
enum class Seed { up, down };
enum class SeedDiagonal { y_eq_x, y_eq_minus_x };
constexpr auto words(SeedDiagonal) {
  return names_except<SeedDiagonal>(
      {{SeedDiagonal::y_eq_x, "y=x"}, {SeedDiagonal::y_eq_minus_x, "y=-x"}});
}
struct Actuation {
  double radius_mm = 94.5;  ///< R_a
  double ratio = 0;         ///< R_a/R_o of a circle; 0: `radius_mm` says it
  double scale = 0;         ///< of the original boundary; 0: `boundary` is given by itself
  Curve boundary;
  NetworkData file;  ///< of a boundary "file": one closed rod
  Correspondence correspondence = Correspondence::arc_length;
  Start start = Start::flat;
  Seed seed = Seed::up;
  SeedDiagonal seed_diagonal = SeedDiagonal::y_eq_x;
};

/// Of a snap in time.
struct Dynamics {
  bool snap = false;
  double step_s = 0.002;
  double damping_per_s = 20;
};

/// What chooses where a path that loses its stability goes.
enum class ImperfectionForm { random, soft_mode };
struct Imperfection {
  double size = 1e-4;  ///< of d; 0: the symmetric branch
  int seed = 1;
  ImperfectionForm form = ImperfectionForm::random;
};

/// What an inverse design may change.
enum class Vary { pins_radial, pins, pins_3d, legs, directions, diameters };
enum class Target { surface, net };
struct Inverse {
  std::vector<Vary> vary;  ///< empty: nothing is designed
  Target target = Target::surface;
  double norm = 8;             ///< p of the last stage; the first is 2
  double mu = 0.03;            ///< weight of the moves beside the distances
  double move_limit_mm = 5;    ///< of a pin or a leg
  double round_mm = 0.1;       ///< to which a builder measures; 0: exact
  double min_stability = 0.5;  ///< of the smallest eigenvalue, over the one before
  double max_leg_force_N = 0;  ///< 0: any
};

enum class OnContact { tell, stop };
struct Limits {
  double max_strain = 1e-3;
  double max_bending_strain = 0;  ///< 0: none, it is told
  double max_utilisation = 0;     ///< of the rods' strength; 0: none, it is told
  OnContact contact = OnContact::tell;
  bool table = false;  ///< whether the boundary's plane is one that no rod passes
};

/// What keeps rods apart.
enum class ContactModel { none, barrier };
struct Contact {
  ContactModel model = ContactModel::none;
  double gap_mm = 0.1;
  double stiffness_N_per_mm = 1;
};

/// How a shell is shaken out of the state it would rest in.
enum class SearchMode { gravity, random, poke };
/// The search for all states of a shell.
struct SearchSettings {
  SearchMode mode = SearchMode::random;
  int trials = 0;  ///< 0: no search
  int seed = 1;
  std::vector<double> levels;    ///< progress of the actuation; empty: as the mode has it
  double field_N_per_mm = 1e-3;  ///< largest artificial gravity, on a millimetre of rod
  double amplitude = 1;          ///< of a random field, of d
  double depth = 3;              ///< of a poke, of d
  int confined = 0;              ///< trials begun from symmetric forms
  double tolerance = 0.02;       ///< of d: joints of one and the same state
  int drawn = 6;                 ///< states in the picture
  int transitions = 0;           ///< states whose ways to others are followed
  bool barriers = false;         ///< between the states in the picture

  bool wanted() const { return trials > 0 || confined > 0; }
};

struct Accuracy {
  double tolerance = 1e-3;
  int edges_per_segment = 0;  ///< 0: chosen from the tolerance
  int leading_edges = 0;      ///< of version 0.2, without effect
  RodModel model = RodModel::automatic;
  double memory_GB = 0;  ///< 0: half of the machine's
};

/// One key that a sweep changes, and what it is set to in turn.
struct SweepAxis {
  std::string key;                  ///< "rod.diameter_mm"
  std::vector<std::string> values;  ///< as TOML
};
/// Many runs of one preset: all combinations of values, each so many times with other seeds.
struct Sweep {
  std::vector<SweepAxis> over;    ///< the first changes slowest
  int seeds = 1;                  ///< runs a combination: imperfection.seed and those after it
  std::vector<std::string> plot;  ///< figures of a run, a picture each
  std::string x;                  ///< figure that is the x axis; empty: the first key
  double departure = 0;           ///< at which a line chart is marked; 0: nowhere

  bool wanted() const { return !over.empty() || seeds > 1; }
};

struct Preset {
  // compiled once: a file that copies one itself takes much longer
  Preset();
  ~Preset();
  Preset(const Preset&);
  Preset(Preset&&) noexcept;
  Preset& operator=(const Preset&);
  Preset& operator=(Preset&&) noexcept;

  std::string name;  ///< of the file, without ".toml"
  std::string title, description, source;
  bool allow_unstable = false;
  Rod rod;
  RodV rod_v;
  Points rod_table;  ///< a row a rod: family, rod, diameter
  Joints joints;
  Ends ends;
  Footprint footprint;
  Net net;
  Blocks blocks;
  std::vector<Block> block;  ///< [[block]]
  std::vector<Join> join;    ///< [[join]]
  Actuation actuation;
  Indentation indentation;
  std::vector<Step> step;  ///< [[step]]
  Loads loads;
  std::vector<LoadCase> load_case;  ///< [[loads.case]]
  Dynamics dynamics;
  Imperfection imperfection;
  Inverse inverse;
  Limits limits;
  Contact contact;
  Accuracy accuracy;
  SearchSettings jitter;
  Sweep sweep;
  Movie movie;
  Style style;
  Figure figure;
  Page page;

  bool on_net() const {
    return footprint.kind == FootprintKind::net || footprint.kind == FootprintKind::blocks;
  }
  bool on_mesh() const {
    return footprint.kind == FootprintKind::net && net.kind == NetKind::surface &&
           net.file.is_mesh();
  }
  /// R_o of a circle: by its longest leg L_d = R_o/d - (n - 1)/2 [Baek 2018], or as it is given.
  double original_radius_mm() const {
    const Footprint& of = footprint;
    if (of.longest_leg == 0) return of.radius_mm;
    return of.spacing_mm * (of.longest_leg + 0.5 * (of.rods - 1));
  }
  /// R_a of a circle.
  double actuated_radius_mm() const {
    return actuation.ratio == 0 ? actuation.radius_mm : actuation.ratio * original_radius_mm();
  }
  /// The same circle with both radii as they are given.
  void set_radii(double original_mm, double actuated_mm) {
    footprint.radius_mm = original_mm;
    actuation.radius_mm = actuated_mm;
    footprint.longest_leg = actuation.ratio = 0;
  }
};

// What a preset is called where people read it.

/// Its title, or where it has none its name.
const std::string& title_or_name(const Preset& preset);

// The tables of a preset that stand once an item, [[block]], [[join]], [[step]] and
// [[loads.case]], all at once.

/// Calls visit(name, member) for each of them, in the order of the file; `member` is that of
/// Preset.
template <class Visit>
void each_list(const Visit& visit) {
  visit("block", &Preset::block);
  visit("join", &Preset::join);
  visit("step", &Preset::step);
  visit("loads.case", &Preset::load_case);
}

/// One item more with its defaults, at the end of that list.
void add_item(Preset& preset, const std::string& table);

/// A preset with one item of each: what an item is before a key of it is read.
Preset default_items();

/// How many items that list has; empty: the table is none of these.
std::optional<int> items_of(const Preset& preset, const std::string& table);

}  // namespace gridshell::preset
