// A preset: everything an experiment and its pictures need, as plain values with defaults. The
// names are those of the TOML keys: `[rod] diameter_mm` is `preset.rod.diameter_mm`. What each key
// means, its unit, range and default stand once, in the field table (field_table.h).
#pragma once

#include <array>
#include <string>
#include <vector>

namespace gridshell::preset {

struct Rod {
  double diameter_mm = 0.254;
  double young_GPa = 83.0;
};

enum class JointKind { shared };
struct Joints {
  JointKind kind = JointKind::shared;
};

enum class EndKind { pinned };
struct Ends {
  EndKind kind = EndKind::pinned;
};

enum class FootprintKind { circle };
enum class Placement { half, on_axis };
struct Footprint {
  FootprintKind kind = FootprintKind::circle;
  int rods = 12;             ///< a direction
  double radius_mm = 126.0;  ///< R_o
  double spacing_mm = 20.0;  ///< d
  Placement placement = Placement::half;
};

enum class Seed { up, down };
enum class SeedDiagonal { y_eq_x, y_eq_minus_x };  ///< "y=x", "y=-x"
struct Actuation {
  double radius_mm = 94.5;  ///< R_a
  Seed seed = Seed::up;
  SeedDiagonal seed_diagonal = SeedDiagonal::y_eq_x;
};

struct Limits {
  double max_strain = 1e-3;
};

enum class Model { automatic, bend };  ///< "auto", "bend"
struct Accuracy {
  double tolerance = 1e-3;
  int edges_per_segment = 0;  ///< 0: chosen from the tolerance
  Model model = Model::automatic;
};

enum class Quality { draft, movie, figure };
enum class ColourBy { none, K };
struct Movie {
  int frames = 240;
  std::array<int, 2> size{1280, 720};
  int fps = 30;
  Quality quality = Quality::movie;
  ColourBy colour_by = ColourBy::K;
  double azimuth_deg = 30;    ///< camera at the first frame, from +x towards +y
  double elevation_deg = 22;  ///< camera, above the boundary's plane
  double turn_deg = 40;       ///< camera turn over the whole movie
  double zoom = 1;
  bool inset = true;  ///< the small top view
  bool captions = true;
};

struct Figure {
  std::vector<double> radii_mm;  ///< boundary radii of the stills
  double scale_bar_mm = 20;
};

struct Preset {
  std::string name;  ///< of the file, without ".toml"
  std::string title, description, source;
  bool allow_unstable = false;
  Rod rod;
  Joints joints;
  Ends ends;
  Footprint footprint;
  Actuation actuation;
  Limits limits;
  Accuracy accuracy;
  Movie movie;
  Figure figure;
};

}  // namespace gridshell::preset
