// Preset: all values that an experiment and its pictures need, with defaults. The names are those
// of the TOML keys: `[rod] diameter_mm` is `preset.rod.diameter_mm`; the ending of a name is its
// unit. The field table (field_table.h) has the meaning, unit, range and default of each key. The
// reader of preset_file.h fills a preset.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/choices.h"
#include "engine/core/enum_words.h"
#include "engine/formats/shape_data.h"
#include "engine/preset/hand.h"
#include "engine/preset/pictures.h"

namespace gridshell::preset {

/// Materials by name; each sets young_GPa, shear_GPa, density_kg_m3 and strength_MPa.
enum class Material { none, nitinol, gfrp, spruce, oak, steel, aluminium };

/// Section, material and natural shape of a rod.
struct Rod {
  Material material = Material::none;
  double diameter_mm = 0.254;
  double young_GPa = 83.0;
  double shear_GPa = 0;                   ///< 0: not given
  double density_kg_m3 = 0;               ///< 0: not given
  double strength_MPa = 0;                ///< 0: not given, or by yield_strain
  double yield_strain = 0;                ///< 0: not given, or by strength_MPa
  double width_mm = 0, thickness_mm = 0;  ///< sides of a rectangular section; 0: round
  double wall_mm = 0;                     ///< wall thickness of a tube; 0: solid
  /// Stiffnesses, mass and section modulus of any other section; 0: computed from the section.
  double EA_N = 0, EI_Nmm2 = 0, GJ_Nmm2 = 0, mass_g_per_m = 0, modulus_mm3 = 0;
  double curvature_per_mm = 0;           ///< natural curvature, in the vertical plane
  double curvature_sideways_per_mm = 0;  ///< natural curvature, in the plane of the flat grid
  double twist_rad_per_mm = 0;           ///< natural twist
  bool as_drawn = false;  ///< whether the drawn line of a network's rod is its natural shape

  bool rectangular() const { return width_mm > 0 && thickness_mm > 0; }
  /// Smaller side of the section, or its diameter, mm.
  double thinnest_mm() const {
    return rectangular() ? std::min(width_mm, thickness_mm) : diameter_mm;
  }
  /// Whether the section is solid, or a tube whose wall leaves a hollow.
  bool wall_fits() const { return wall_mm == 0 || 2 * wall_mm < thinnest_mm(); }
  bool has_mass() const { return density_kg_m3 > 0 || mass_g_per_m > 0; }
  /// Largest stress that a fibre withstands, MPa; 0: not given.
  double fibre_strength_MPa() const {
    return yield_strain > 0 ? 1e3 * young_GPa * yield_strain : strength_MPa;
  }
  bool operator==(const Rod&) const = default;
};
/// Properties of the v rods, if they differ from those of the u rods.
struct RodV : Rod {
  bool differs = false;
};

enum class JointKind { shared, spring };
/// Connections of the rods at their crossings.
struct Joints {
  JointKind kind = JointKind::shared;
  double stiffness_N_per_mm = 0;  ///< stiffness of the spring between the two rods of a joint
  double shear_Nmm = 0;           ///< torque per rad of change of the crossing angle
  double twist_Nmm = 0;        ///< torque per rad of rotation about axes across the joint's normal
  double eccentricity_mm = 0;  ///< height of the second rod's axis above the first's
  /// Diameter of the joint's cylinder, whose top a scan sees; empty: chosen from the rods'
  /// thickness.
  std::optional<double> diameter_mm;
  std::optional<double> height_mm;  ///< height of the cylinder's top above the rods' crossing
  double mass_g = 0;                ///< mass of each joint, in addition to its rods
};

enum class Rings { pinned, free };
/// Constraints of the rods' ends at the boundary.
struct Ends {
  EndKind kind = EndKind::pinned;
  Rings rings = Rings::pinned;
  double second_ring_mm = 0;  ///< length of the tails outside the boundary; 0: none
  Points table;               ///< one row per end: family, rod, end, x, y, z, leg, tx, ty, tz
};

enum class CurveKind { circle, ellipse, superellipse, polygon, spline, file };
/// A closed curve in the plane, mm. The radius of a circle is a key of its own.
struct Curve {
  CurveKind kind = CurveKind::circle;
  double half_x_mm = 126.0, half_y_mm = 100.0;  ///< half-axes of an ellipse or superellipse
  double exponent = 4.0;                        ///< n of a superellipse |x/a|^n + |y/b|^n = 1
  Points points;                                ///< points (x, y) of a polygon or spline
};

/// Unit of a file's numbers; `file`: the unit that the file names, else mm.
enum class FileUnit { file, mm, cm, m, in, ft };
/// Length of the unit, mm; 0: the file names its unit.
inline double millimetres(FileUnit unit) {
  constexpr double sizes[] = {0, 1, 10, 1000, 25.4, 304.8};
  return sizes[std::size_t(unit)];
}

enum class FootprintKind { circle, net, curve, blocks, network };
/// The flat, unloaded grid.
struct Footprint {
  FootprintKind kind = FootprintKind::circle;
  Curve boundary;
  int rods = 12;             ///< number of rods per direction
  double radius_mm = 126.0;  ///< R_o
  double longest_leg = 0;    ///< L_d in units of d, instead of `radius_mm`; 0: not given
  double spacing_mm = 20.0;  ///< d
  Placement placement = Placement::half;
  NetworkData file;  ///< the network, or the boundary "file" of a curve as one closed rod
  /// Unit and joining distance with which `file` is read, and whether its lines are the segments of
  /// a linkage; reset to the defaults after reading.
  FileUnit file_unit = FileUnit::file;
  double join_mm = 0;
  bool linkage = false;
};

enum class NetKind { sphere, cylinder, spool, beltrami, profile, translation, surface };
/// Direction of the first rod of a net on a surface: a principal direction or x, turned by
/// axis_deg.
enum class NetAxis { principal, x };
/// Whether apex_mm gives the starting point, or the point and direction are searched for from which
/// a net reaches the largest area, or almost that with the largest least angle.
enum class NetApex { given, best, best_angle };
/// The Chebyshev net that a footprint is designed on.
struct Net {
  NetKind kind = NetKind::sphere;
  double radius_mm = 120.0;  ///< rho, the scale of the deviation
  double cut_height = 0;     ///< z*/rho, height of the boundary of a spherical cap
  double length_mm = 240.0;  ///< between the end rings
  double waist = 0.5;        ///< a, waist radius over rho
  double crossing_deg = 90;  ///< omega, between the rods in the middle of a surface of revolution
  Points profile;            ///< points (r, z): radius and position along the axis
  Points curve_u, curve_v;   ///< points (x, y, z) of the two curves of a translation net
  std::string implicit;      ///< F(x, y, z) of a surface F = 0
  std::string height;        ///< h(x, y) of a surface z = h
  SurfaceData file;          ///< heights over a grid, or a mesh
  FileUnit file_unit = FileUnit::file;  ///< unit of `file`; reset to the default after reading
  std::string within;                   ///< G(x, y, z) < 0 inside the boundary; empty: z > cut_mm
  /// Height of the cut; empty: a mesh ends at its rim, other surfaces at z = 0.
  std::optional<double> cut_mm;
  double fit_mm = 0;  ///< allowed distance of a mesh from the fitted surface; 0: as needed
  double least_angle_deg = 30;  ///< least angle between rods at their ends, on a mesh
  NetApex apex = NetApex::given;
  std::vector<double> apex_mm{0, 0};  ///< crossing of the axes, (x, y) or (x, y, z)
  NetAxis axis = NetAxis::principal;
  double axis_deg = 0;
};

/// A building block: a net and the rows of joints at which it is cut. An empty side is not cut.
struct Block {
  std::string name;
  Net net;
  std::optional<int> east, west, north, south;
};

/// Two sides of blocks that are joined by a seam, each as "name.side".
struct Join {
  std::string first, second;
};

/// Limits for the seams of building blocks.
struct Blocks {
  double max_gap_mm = 10;  ///< largest distance between two nets at a joint of their seam
};

enum class Start { flat, net };
enum class Seed { up, down };
/// Diagonal at whose two corners the joints of a buckled shell are lower.
enum class SeedDiagonal { y_eq_x, y_eq_minus_x };
constexpr auto words(SeedDiagonal) {
  return names_except<SeedDiagonal>(
      {{SeedDiagonal::y_eq_x, "y=x"}, {SeedDiagonal::y_eq_minus_x, "y=-x"}});
}
/// Motion of the boundary from its original to its actuated position.
struct Actuation {
  double radius_mm = 94.5;  ///< R_a
  double ratio = 0;         ///< R_a/R_o of a circle; 0: `radius_mm` is used
  double scale = 0;         ///< factor of the original boundary; 0: `boundary` is used
  Curve boundary;
  NetworkData file;  ///< the boundary "file" as one closed rod
  Correspondence correspondence = Correspondence::arc_length;
  Start start = Start::flat;
  Seed seed = Seed::up;
  SeedDiagonal seed_diagonal = SeedDiagonal::y_eq_x;
};

/// Settings of a snap that is computed in time.
struct Dynamics {
  bool snap = false;          ///< whether a loss of stability is followed in time
  double step_s = 0.002;      ///< time step
  double damping_per_s = 20;  ///< damping in proportion to the mass
};

/// Imperfection that selects the branch where a path loses its stability.
enum class ImperfectionForm { random, soft_mode };
struct Imperfection {
  double size = 1e-4;  ///< amplitude in units of d; 0: the symmetric branch
  int seed = 1;
  ImperfectionForm form = ImperfectionForm::random;
};

/// Variables of an inverse design.
enum class Vary { pins_radial, pins, pins_3d, legs, directions, diameters };
enum class Target { surface, net };
struct Inverse {
  std::vector<Vary> vary;  ///< empty: no design
  Target target = Target::surface;
  double norm = 8;           ///< p of the last stage; the first is 2
  double mu = 0.03;          ///< weight of the displacements relative to the distances
  double move_limit_mm = 5;  ///< largest displacement of a pin or change of a leg's length
  double round_mm = 0.1;     ///< rounding of lengths and positions for fabrication; 0: none
  /// smallest allowed ratio of the lowest eigenvalue to that before the design
  double min_stability = 0.5;
  double max_leg_force_N = 0;  ///< 0: no limit
};

enum class OnContact { tell, stop };
/// Limits at which a run stops.
struct Limits {
  double max_strain = 1e-3;       ///< axial strain of an edge (locking)
  double max_bending_strain = 0;  ///< 0: no limit, the strain is only reported
  double max_utilisation = 0;     ///< stress over strength; 0: no limit, it is only reported
  OnContact contact = OnContact::tell;
  /// Whether the plane of the boundary is a table that rods must not penetrate.
  bool table = false;
};

/// Contact model between rods.
enum class ContactModel { none, barrier };
struct Contact {
  ContactModel model = ContactModel::none;
  double gap_mm = 0.1;            ///< gap between surfaces below which rods repel each other
  double stiffness_N_per_mm = 1;  ///< stiffness of the barrier
};

/// How the search perturbs a shell in equilibrium.
enum class SearchMode { gravity, random, poke };
/// Settings of the search for all states of a shell.
struct SearchSettings {
  SearchMode mode = SearchMode::random;
  int trials = 0;  ///< 0: no search
  int seed = 1;
  /// progress of the actuation at each search; empty: chosen by the mode
  std::vector<double> levels;
  double field_N_per_mm = 1e-3;  ///< largest artificial gravity, N per mm of rod
  double amplitude = 1;          ///< largest random displacement of a joint, in units of d
  double depth = 3;              ///< largest push of a joint, in units of d
  int confined = 0;              ///< number of trials started from symmetric forms
  double tolerance = 0.02;  ///< distance of joints, in units of d, below which states are equal
  int drawn = 6;            ///< number of states in the picture
  int transitions = 0;      ///< number of states whose transitions are followed
  bool barriers = false;    ///< whether barriers between the states in the picture are computed

  bool requested() const { return trials > 0 || confined > 0; }
};

/// Accuracy of the result: meshes and rod model.
struct Accuracy {
  double tolerance = 1e-3;    ///< largest joint error over R_o of a circle or rho of a net
  int edges_per_segment = 0;  ///< 0: chosen from the tolerance
  int leading_edges = 0;      ///< a key of version 0.2, without effect
  RodModel model = RodModel::automatic;
  double memory_GB = 0;  ///< 0: half of the machine's memory
};

/// One key that a sweep changes, and the values that it takes.
struct SweepAxis {
  std::string key;                  ///< "rod.diameter_mm"
  std::vector<std::string> values;  ///< values as TOML
};
/// A sweep: runs of one preset for all combinations of values, each repeated with several seeds.
struct Sweep {
  std::vector<SweepAxis> over;  ///< the first key changes slowest
  int seeds = 1;  ///< runs per combination, with imperfection.seed and the following numbers
  std::vector<std::string> plot;  ///< results that are plotted, a chart for each
  std::string x;                  ///< result on the x axis; empty: the first key
  /// relative deviation from the value at the right end of a line chart at which a mark is drawn;
  /// 0: no mark
  double departure = 0;

  bool requested() const { return !over.empty() || seeds > 1; }
};

/// All values of an experiment; each member is a table of the TOML file.
struct Preset {
  // defined in preset.cpp: compiling a copy in each file takes much longer
  Preset();
  ~Preset();
  Preset(const Preset&);
  Preset(Preset&&) noexcept;
  Preset& operator=(const Preset&);
  Preset& operator=(Preset&&) noexcept;

  std::string name;  ///< name of the file without ".toml"
  std::string title, description, source;
  bool allow_unstable = false;
  Rod rod;
  RodV rod_v;
  Points rod_table;  ///< one row (family, rod, diameter) per rod of another diameter
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

  /// Whether the strength of all rods is given in [rod] and, where it differs, in [rod_v].
  bool rods_have_strength() const {
    return rod.fibre_strength_MPa() > 0 && (!rod_v.differs || rod_v.fibre_strength_MPa() > 0);
  }
  bool on_net() const {
    return footprint.kind == FootprintKind::net || footprint.kind == FootprintKind::blocks;
  }
  /// R_o of a circle, mm: from its longest leg by L_d = R_o/d - (n - 1)/2 [Baek 2018], or as given.
  double original_radius_mm() const {
    const Footprint& of = footprint;
    if (of.longest_leg == 0) return of.radius_mm;
    return of.spacing_mm * (of.longest_leg + 0.5 * (of.rods - 1));
  }
  /// R_a of a circle, mm.
  double actuated_radius_mm() const {
    return actuation.ratio == 0 ? actuation.radius_mm : actuation.ratio * original_radius_mm();
  }
  /// Sets both radii of a circle, mm, and clears `longest_leg` and `ratio`.
  void set_radii(double original_mm, double actuated_mm) {
    footprint.radius_mm = original_mm;
    actuation.radius_mm = actuated_mm;
    footprint.longest_leg = actuation.ratio = 0;
  }
};

/// Title of a preset, or its name if it has no title.
const std::string& title_or_name(const Preset& preset);

// The tables of a preset that are lists: [[block]], [[join]], [[step]] and [[loads.case]].

/// Calls visit(name, member) for each list, in the order of the file; `member` points to a member
/// of Preset.
template <class Visit>
void each_list(const Visit& visit) {
  visit("block", &Preset::block);
  visit("join", &Preset::join);
  visit("step", &Preset::step);
  visit("loads.case", &Preset::load_case);
}

/// Appends an item with the default values to the list named `table`.
void add_item(Preset& preset, const std::string& table);

/// A preset whose lists have one default item each: the values of an item before its keys are read.
Preset default_items();

/// Number of items of the list named `table`; empty: `table` is not a list.
std::optional<int> items_of(const Preset& preset, const std::string& table);

}  // namespace gridshell::preset
