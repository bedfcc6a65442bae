#include "engine/preset/field_table.h"

#include "engine/preset/field_groups.h"

namespace gridshell::preset {
namespace {

using P = Preset;

std::vector<Field> shell_fields() {
  return {
      {"", "title", "", text<&P::title>(), "one line that names the experiment"},
      {"", "description", "", text<&P::description>(), "what it shows and what was chosen"},
      {"", "source", "", text<&P::source>(), "figure or movie of the paper it follows"},
      {"", "allow_unstable", "", flag<&P::allow_unstable>(),
       "whether a run may end in an unstable state without failing"},
      {"footprint", "kind", "", word<&P::footprint, &Footprint::kind>(),
       "boundary that cuts the flat square grid: a circle, the one that a net maps to the boundary "
       "wanted, a curve of your own, or that of blocks joined; or \"network\": any rods of a "
       "file"},
      {"footprint", "file", "", network<&P::footprint, &Footprint::file>(),
       "of a footprint of kind \"network\": its points, rods, supports and where these go (.json), "
       "or its rods alone (.obj, .dxf); mm"},
      {"footprint", "rods", "", integer<&P::footprint, &Footprint::rods>(between(1, 500)),
       "rods a direction in a circle, n"},
      {"footprint", "radius_mm", "mm", real<&P::footprint, &Footprint::radius_mm>(above(0)),
       "radius of a circle, R_o"},
      {"footprint", "longest_leg", "",
       real<&P::footprint, &Footprint::longest_leg>(between(0, 1000)),
       "L_d of a circle, in the place of `radius_mm`: R_o = d (L_d + (n - 1)/2); 0: not given"},
      {"footprint", "spacing_mm", "mm", real<&P::footprint, &Footprint::spacing_mm>(above(0)),
       "distance between neighbouring rods, d"},
      {"footprint", "placement", "", word<&P::footprint, &Footprint::placement>(),
       "rods at u = (i + 1/2) d, or at u = i d with one on each axis"},
      {"actuation", "radius_mm", "mm", real<&P::actuation, &Actuation::radius_mm>(above(0)),
       "radius of the actuated boundary of a circle, R_a, at most R_o"},
      {"actuation", "ratio", "", real<&P::actuation, &Actuation::ratio>(between(0, 1)),
       "R_a/R_o of a circle, in the place of `radius_mm`; 0: not given"},
      {"actuation", "start", "", word<&P::actuation, &Actuation::start>(),
       "\"flat\": patiently from the flat footprint; \"net\": at once to the equilibrium next to "
       "the net"},
      {"actuation", "seed", "", word<&P::actuation, &Actuation::seed>(),
       "side to which the flat shell buckles"},
      {"actuation", "seed_diagonal", "", word<&P::actuation, &Actuation::seed_diagonal>(),
       "of the corner pairs on the two diagonals, the one whose joints lie lower"},
      {"imperfection", "size", "", real<&P::imperfection, &Imperfection::size>(between(0, 0.05)),
       "with which a branch is entered that leaves a path where it loses its stability, of d; it "
       "only chooses, each state being one of the perfect shell; 0: the symmetric branch, whose "
       "frames say where it is not stable"},
      {"imperfection", "seed", "", integer<&P::imperfection, &Imperfection::seed>(between(0, 1e9)),
       "of what is drawn by chance"},
      {"imperfection", "form", "", word<&P::imperfection, &Imperfection::form>(),
       "\"random\": to the side on which a direction a joint points; \"soft_mode\": along the mode "
       "that went soft, to one side with odd seeds and to the other with even ones"},
  };
}

std::vector<Field> indentation_fields() {
  using I = Indentation;
  return {
      {"indentation", "at", "", word<&P::indentation, &I::at>(),
       "joint that is pushed: the one nearest to the pole, or the highest"},
      {"indentation", "latitude_deg", "deg",
       real<&P::indentation, &I::latitude_deg>(between(-90, 90)),
       "of the place pushed, as seen from the net's origin; below 90 in the place of `at`"},
      {"indentation", "longitude_deg", "deg",
       real<&P::indentation, &I::longitude_deg>(between(-360, 360)), "from +x towards +y"},
      {"indentation", "joint", "", integers<&P::indentation, &I::joint>(between(-500, 500)),
       "[i, j] of the joint pushed, in the place of all of these; empty: not by its indices"},
      {"indentation", "direction", "", word<&P::indentation, &I::direction>(),
       "against or along the normal of the net, or of the unloaded shell, at the joint; fixed in "
       "space"},
      {"indentation", "depth", "", real<&P::indentation, &I::depth>(between(0, 10)),
       "depth of the push over rho of a net or R_o of a circle; 0: nothing is pushed"},
      {"indentation", "depth_mm", "mm", real<&P::indentation, &I::depth_mm>(at_least(0)),
       "the same in millimetres, in the place of `depth`"},
      {"indentation", "lateral", "", word<&P::indentation, &I::lateral>(),
       "whether the joint pushed may move across the push"},
      {"indentation", "unload", "", flag<&P::indentation, &I::unload>(),
       "whether the push is taken back at the end, in the second half of the frames"},
  };
}

std::vector<Field> numerics_fields() {
  return {
      {"limits", "max_strain", "", real<&P::limits, &Limits::max_strain>(above(0)),
       "axial strain of an edge at which the run stops with limit \"locking\""},
      {"accuracy", "tolerance", "", real<&P::accuracy, &Accuracy::tolerance>(between(1e-9, 1)),
       "largest joint error allowed, over R_o of a circle or rho of a net"},
      {"accuracy", "edges_per_segment", "",
       integer<&P::accuracy, &Accuracy::edges_per_segment>(between(0, 64)),
       "edges between two joints of a rod; 0 chooses them from the tolerance"},
      {"accuracy", "leading_edges", "",
       integer<&P::accuracy, &Accuracy::leading_edges>(between(0, 32)),
       "of the coarsest mesh, which leads over bifurcations and snaps, and finer ones follow: its "
       "path is kept where a finer leader would go another, which is said; 0: 4, and the finer "
       "leader's path then. The window writes it where a shell was shaken or snapped by hand"},
      {"accuracy", "model", "", word<&P::accuracy, &Accuracy::model>(),
       "\"net\": the smooth net itself, nothing solved; \"bend\": stretching and bending, 3 "
       "unknowns "
       "a node; \"twist\": torsion too, 1 more an edge; \"auto\" takes the least that is exact"},
      {"accuracy", "memory_GB", "GB", real<&P::accuracy, &Accuracy::memory_GB>(between(0, 1e6)),
       "memory that the meshes may take; 0: half of the machine's"},
  };
}

std::vector<Field> sweep_fields() {
  return {
      {"sweep", "over", "", axes<&P::sweep, &Sweep::over>(),
       "keys that change from run to run, all combinations; `count` values from `from` to `to`, "
       "both among them, even steps or with `log = true` even factors"},
      {"sweep", "seeds", "", integer<&P::sweep, &Sweep::seeds>(between(1, 100000)),
       "runs of each combination: with imperfection.seed and those after it"},
      {"sweep", "plot", "", texts<&P::sweep, &Sweep::plot>(),
       "figures of summary.json that are drawn over the keys, a picture each; empty: height_mm"},
      {"sweep", "x", "", text<&P::sweep, &Sweep::x>(),
       "figure that is the x axis of line charts; empty: the key that is swept"},
      {"sweep", "departure", "", real<&P::sweep, &Sweep::departure>(between(0, 10)),
       "share by which a figure has left its value at the right end of a line chart where that is "
       "marked; 0: nowhere"},
  };
}

std::vector<Field> picture_fields() {
  return {
      {"movie", "frames", "", integer<&P::movie, &Movie::frames>(between(2, 100000)),
       "frames from the original to the final state; they only sample the path"},
      {"movie", "size", "px", pair<&P::movie, &Movie::size>(between(16, 16384)),
       "width and height of a frame"},
      {"movie", "fps", "1/s", integer<&P::movie, &Movie::fps>(between(1, 240)),
       "frames a second of movie.mp4"},
      {"movie", "quality", "", word<&P::movie, &Movie::quality>(),
       "draft: no shadow; movie: a soft shadow; figure: many passes with jittered light"},
      {"movie", "colour_by", "", word<&P::movie, &Movie::colour_by>(),
       "none; the cells by their integrated Gauss curvature K, by how much it changed since the "
       "first frame, or by how far their joints lie off the net, over rho; or the rods by how far "
       "they moved over the depth of the push, by their bending energy over length or by their "
       "axial force"},
      {"movie", "azimuth_deg", "deg", real<&P::movie, &Movie::azimuth_deg>(between(-360, 360)),
       "direction of the camera at the first frame, from +x towards +y"},
      {"movie", "elevation_deg", "deg", real<&P::movie, &Movie::elevation_deg>(between(-90, 90)),
       "height of the camera above the boundary's plane"},
      {"movie", "turn_deg", "deg", real<&P::movie, &Movie::turn_deg>(between(-3600, 3600)),
       "turn of the camera over the whole movie"},
      {"movie", "zoom", "", real<&P::movie, &Movie::zoom>({0, 100, true}),
       "1 fits the whole run into the picture"},
      {"movie", "inset", "", flag<&P::movie, &Movie::inset>(),
       "whether to draw the small top view"},
      {"movie", "bins", "", flag<&P::movie, &Movie::bins>(),
       "whether to plot K of the cells in bins along x beside the shell, in wide pictures"},
      {"movie", "captions", "", flag<&P::movie, &Movie::captions>(),
       "whether to write radius, height and frame"},
      {"movie", "beside", "", flag<&P::movie, &Movie::beside>(),
       "whether a movie shows the cases of a preset beside one another; else each has its own"},
      {"figure", "radii_mm", "mm", list<&P::figure, &Figure::radii_mm>(above(0)),
       "boundary radii of the stills, falling from R_o to R_a; empty: the final state alone"},
      {"figure", "scale_bar_mm", "mm", real<&P::figure, &Figure::scale_bar_mm>(at_least(0)),
       "length of the scale bar; 0: none"},
      {"figure", "scan", "", points<&P::figure, &Figure::scan>({"x", "y", "z"}),
       "joints measured by others, mm, in the frame of the net: red over shells on their nets, and "
       "in the latitude plot"},
  };
}

}  // namespace

const std::vector<Table>& tables() {
  static const std::vector<Table> all = {
      {"", "What the preset is."},
      {"rod", "The rods' material and section."},
      {"rod_v", "The same of the v rods, where they are others."},
      {"joints", "What holds crossing rods together."},
      {"ends", "What holds the rods' ends on the boundary."},
      {"footprint", "The flat, unloaded grid."},
      {"net", "The net that the footprint is designed on, for footprints of kind \"net\"."},
      {"blocks", "How building blocks must meet, for footprints of kind \"blocks\"."},
      {"block", "A building block: a net and where it is cut.", true},
      {"join", "Two sides of blocks that become one seam.", true},
      {"actuation", "How the boundary moves: every edge point straight and evenly."},
      {"imperfection", "What chooses where a shell goes that loses its stability."},
      {"indentation", "The push at one joint of the actuated shell."},
      {"step", "What a hand does to the actuated shell, one step after the other.", true},
      {"loads", "What pulls on the shell beside its boundary."},
      {"dynamics", "How a shell moves that has lost its stability."},
      {"limits", "Where the model stops being valid."},
      {"inverse", "What `gridshell design` changes so that the shell meets its surface."},
      {"accuracy", "How exact the answer is to be."},
      {"jitter", "How the states of a shell are looked for."},
      {"sweep", "Many runs with other values, for `gridshell sweep`."},
      {"movie", "The frames of `gridshell movie` and their camera."},
      {"style", "How pictures look."},
      {"figure", "The stills of `gridshell figure`."},
      {"page", "A page that shows a figure of the paper, for `gridshell figure`."},
  };
  return all;
}

const std::vector<Field>& field_table() {
  static const std::vector<Field> all = [] {
    auto fields = shell_fields();
    for (auto& more :
         {rod_fields(), joint_fields(), boundary_fields(), net_fields(), indentation_fields(),
          step_fields(), load_fields(), inverse_fields(), numerics_fields(), jitter_fields(),
          sweep_fields(), picture_fields(), style_fields()})
      fields.insert(fields.end(), more.begin(), more.end());
    return fields;
  }();
  return all;
}

const Field* find_field(const std::string& table, const std::string& key) {
  for (const auto& field : field_table())
    if (field.table == table && field.key == key) return &field;
  return nullptr;
}

}  // namespace gridshell::preset
