#include "engine/preset/consistency.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "engine/preset/field_groups.h"
#include "engine/preset/field_table.h"

namespace gridshell::preset {
namespace {

/// A key and the kinds that use it.
template <class Kind>
struct Use {
  const char* key;
  std::vector<Kind> by;
};

const std::vector<Use<NetKind>>& uses_of_net() {
  using K = NetKind;
  static const std::vector<Use<K>> uses = {
      {"radius_mm", {K::sphere, K::cylinder, K::spool, K::beltrami}},
      {"cut_height", {K::sphere}},
      {"length_mm", {K::cylinder, K::spool, K::beltrami, K::profile}},
      {"waist", {K::spool, K::beltrami}},
      {"crossing_deg", {K::cylinder, K::spool, K::beltrami, K::profile}},
      {"profile", {K::profile}},
      {"curve_u", {K::translation}},
      {"curve_v", {K::translation}},
  };
  return uses;
}

/// Of [net] alone: blocks have none of these.
const std::vector<Use<NetKind>>& uses_of_surface() {
  using K = NetKind;
  static const std::vector<Use<K>> uses = {
      {"implicit", {K::surface}}, {"height", {K::surface}},   {"apex_mm", {K::surface}},
      {"axis", {K::surface}},     {"axis_deg", {K::surface}}, {"cut_mm", {K::surface}},
      {"file", {K::surface}},     {"within", {K::surface}},
  };
  return uses;
}

/// `radius_mm` stands beside the curve, for a circle.
const std::vector<Use<CurveKind>>& uses_of_curve() {
  using K = CurveKind;
  static const std::vector<Use<K>> uses = {
      {"radius_mm", {K::circle}},
      {"half_x_mm", {K::ellipse, K::superellipse}},
      {"half_y_mm", {K::ellipse, K::superellipse}},
      {"exponent", {K::superellipse}},
      {"points_mm", {K::polygon, K::spline}},
  };
  return uses;
}

template <class Kind>
std::string names_of(const std::vector<Kind>& kinds) {
  std::string text;
  for (std::size_t k = 0; k < kinds.size(); ++k)
    text += fmt::format("{}\"{}\"",
                        k == 0                  ? ""
                        : k + 1 == kinds.size() ? " or "
                                                : ", ",
                        word_of(kinds[k]));
  return text;
}

std::string key_label(const std::string& table, const char* key, int item) {
  return item < 0 ? fmt::format("[{}] {}", table, key)
                  : fmt::format("[[{}]] {} {}", table, item + 1, key);
}

/// Gathers the keys that count for nothing.
class UnusedKeyFinder {
 public:
  explicit UnusedKeyFinder(const Preset& preset) : preset_(preset) {}

  std::vector<UnusedKey> take() {
    shapes();
    boundaries();
    rods("rod", preset_.rod);
    if (preset_.rod_v.differs) rods("rod_v", preset_.rod_v);
    push();
    steps();
    motion();
    tables();
    jitter();
    sweep();
    pictures();
    return std::move(found_);
  }

 private:
  void add(const char* table, const char* key, std::vector<std::string> deciders, std::string why,
           int item = -1) {
    found_.push_back({table, key, item, std::move(deciders), std::move(why)});
  }

  void add_all(const char* table, const std::vector<std::string>& deciders, const std::string& why,
               int item = -1) {
    for (const Field& field : field_table())
      if (field.table == table) add(table, field.key.c_str(), deciders, why, item);
  }

  /// keys that other values of `decider` use
  template <class Kind>
  void add_unused(const char* table, const std::vector<Use<Kind>>& uses, Kind kind,
                  const char* decider, int item = -1) {
    const auto name = key_label(table, decider, item);
    for (const auto& use : uses)
      if (std::ranges::find(use.by, kind) == use.by.end())
        add(table, use.key, {name},
            fmt::format("{} = \"{}\" does not use it, only {}", name, word_of(kind),
                        names_of(use.by)),
            item);
  }

  void shapes() {
    using K = FootprintKind;
    const K kind = preset_.footprint.kind;
    const std::vector<std::string> decider{"[footprint] kind"};
    const auto of = [&](K user) {
      return fmt::format("[footprint] kind = \"{}\" does not use it, only \"{}\"", word_of(kind),
                         word_of(user));
    };
    if (kind != K::circle) add("footprint", "rods", decider, of(K::circle));
    if (kind != K::network) {
      add("footprint", "file", decider, of(K::network));
    } else {
      for (const char* key : {"spacing_mm", "placement"})
        add("footprint", key, decider,
            "of a footprint of kind \"network\" the file says where rods and joints lie");
      add_all("rod_v", decider, "a network's rods are of one kind, with diameters in its file");
    }
    if (kind == K::net)
      net();
    else
      add_all("net", decider, of(K::net));
    if (kind != K::blocks) add_all("blocks", decider, of(K::blocks));
    for (int k = 0; k < int(preset_.block.size()); ++k)
      if (kind == K::blocks)
        add_unused("block", uses_of_net(), preset_.block[k].net.kind, "kind", k);
      else
        add_all("block", decider, of(K::blocks), k);
    for (int k = 0; k < int(preset_.join.size()) && kind != K::blocks; ++k)
      add_all("join", decider, of(K::blocks), k);
  }

  void net() {
    const Net& net = preset_.net;
    add_unused("net", uses_of_net(), net.kind, "kind");
    add_unused("net", uses_of_surface(), net.kind, "kind");
    if (net.kind == NetKind::surface && !net.within.empty())
      add("net", "cut_mm", {"[net] within"}, "[net] within is the boundary in the plane's place");
  }

  void boundaries() {
    const std::vector<std::string> decider{"[footprint] kind"};
    const bool curve = preset_.footprint.kind == FootprintKind::curve;
    const bool circle = preset_.footprint.kind == FootprintKind::circle;
    const Actuation& to = preset_.actuation;
    const std::string by_kind = fmt::format("[footprint] kind = \"{}\" does not use it, only ",
                                            word_of(preset_.footprint.kind));
    if (curve) {
      add_unused("footprint", uses_of_curve(), preset_.footprint.boundary.kind, "boundary");
    } else {
      for (const char* key : {"boundary", "half_x_mm", "half_y_mm", "exponent", "points_mm"})
        add("footprint", key, decider, by_kind + "\"curve\"");
      for (const char* key :
           {"boundary", "half_x_mm", "half_y_mm", "exponent", "points_mm", "correspondence"})
        add("actuation", key, decider, by_kind + "\"curve\"");
      if (preset_.footprint.kind != FootprintKind::network)
        add("actuation", "scale", decider, by_kind + "\"curve\" or \"network\"");
    }
    radii(circle, by_kind);
    if (!curve && !circle)
      for (const char* table : {"footprint", "actuation"})
        add(table, "radius_mm", decider, by_kind + "\"circle\" or \"curve\"");
    if (curve && to.scale == 0)
      add_unused("actuation", uses_of_curve(), to.boundary.kind, "boundary");
    if (curve && to.scale > 0)
      for (const char* key :
           {"radius_mm", "boundary", "half_x_mm", "half_y_mm", "exponent", "points_mm"})
        add("actuation", key, {"[actuation] scale"},
            "the actuated boundary is the original one times [actuation] scale");
  }

  /// a circle's radii may be given by other keys
  void radii(bool circle, const std::string& by_kind) {
    for (const auto& [table, key, value] :
         {std::tuple("footprint", "longest_leg", preset_.footprint.longest_leg),
          {"actuation", "ratio", preset_.actuation.ratio}}) {
      const auto name = key_label(table, key, -1);
      if (!circle)
        add(table, key, {"[footprint] kind"}, by_kind + "\"circle\"");
      else if (value > 0)
        add(table, "radius_mm", {name}, name + " takes its place");
    }
  }

  void rods(const char* table, const Rod& rod) {
    if (rod.rectangular())
      add(table, "diameter_mm",
          {fmt::format("[{}] width_mm", table), fmt::format("[{}] thickness_mm", table)},
          fmt::format("[{}] width_mm and thickness_mm make the rods rectangular", table));
  }

  void push() {
    const Indentation& push = preset_.indentation;
    const std::string depth = "[indentation] depth", depth_mm = "[indentation] depth_mm";
    if (!push.wanted()) {
      for (const char* key :
           {"at", "latitude_deg", "longitude_deg", "joint", "direction", "lateral", "unload"})
        add("indentation", key, {depth, depth_mm},
            "nothing is pushed: [indentation] depth and depth_mm are 0");
      return;
    }
    if (push.depth_mm > 0)
      add("indentation", "depth", {depth_mm}, "[indentation] depth_mm takes its place");
    if (!push.joint.empty()) {
      for (const char* key : {"at", "latitude_deg", "longitude_deg"})
        add("indentation", key, {"[indentation] joint"},
            "[indentation] joint names the joint that is pushed");
    } else if (push.latitude_deg < 90) {
      add("indentation", "at", {"[indentation] latitude_deg"},
          "[indentation] latitude_deg takes its place");
    } else {
      add("indentation", "longitude_deg", {"[indentation] latitude_deg"},
          "at a latitude of 90 degrees there is no longitude");
    }
  }

  void steps() {
    for (int k = 0; k < int(preset_.step.size()); ++k) {
      const Step& step = preset_.step[std::size_t(k)];
      const auto name = key_label("step", "do", k);
      for (const Field& field : field_table()) {
        if (field.table != "step") continue;
        const auto deeds = step_kinds_of_key(field.key);
        if (!deeds.empty() && std::ranges::find(deeds, step.kind) == deeds.end())
          add("step", field.key.c_str(), {name},
              fmt::format("{} = \"{}\" does not use it, only {}", name, word_of(step.kind),
                          names_of(deeds)),
              k);
      }
      if (step.kind == StepKind::move && step.radius_mm > 0)
        add("step", "progress", {key_label("step", "radius_mm", k)}, "radius_mm takes its place",
            k);
    }
  }

  /// rows that name rods of a square grid
  void tables() {
    if (preset_.footprint.kind != FootprintKind::network) return;
    for (const char* table : {"ends", "rod"})
      add(table, "table", {"[footprint] kind"},
          "it names rods of a square grid, a network's file says it");
    for (const char* key : {"rings", "second_ring_mm"})
      add("ends", key, {"[footprint] kind"}, "a network has no net whose end rings it could be");
  }

  void motion() {
    // where the path begins
    if (preset_.on_net() && preset_.actuation.start == Start::net)
      for (const char* key : {"seed", "seed_diagonal"})
        add("actuation", key, {"[actuation] start"},
            "only a path from the flat buckles: [actuation] start is \"net\"");
    if (preset_.accuracy.model == RodModel::net) {
      const std::string why = "nothing is solved with [accuracy] model = \"net\"";
      for (const char* table : {"imperfection", "dynamics", "limits"})
        add_all(table, {"[accuracy] model"}, why);
      add("accuracy", "memory_GB", {"[accuracy] model"}, why);
    }
    if (preset_.inverse.vary.empty())
      for (const char* key : {"target", "norm", "move_limit_mm", "round_mm", "min_stability",
                              "max_leg_force_N", "mu"})
        add("inverse", key, {"[inverse] vary"}, "nothing is designed: [inverse] vary is empty");
    if (!preset_.dynamics.snap)
      for (const char* key : {"step_s", "damping_per_s"})
        add("dynamics", key, {"[dynamics] snap"}, "no snap is followed in time without it");
    if (preset_.imperfection.size == 0)
      for (const char* key : {"seed", "form"})
        add("imperfection", key, {"[imperfection] size"},
            "with [imperfection] size = 0 nothing is chosen: the path stays on the symmetric "
            "branch");
  }

  void jitter() {
    const SearchSettings& jitter = preset_.jitter;
    if (!jitter.wanted()) {
      for (const Field& field : field_table())
        if (field.table == "jitter" && field.key != "trials" && field.key != "confined")
          add("jitter", field.key.c_str(), {"[jitter] trials", "[jitter] confined"},
              "no states are looked for: [jitter] trials and confined are 0");
      return;
    }
    const std::string why =
        fmt::format("[jitter] mode = \"{}\" does not use it, only ", word_of(jitter.mode));
    if (jitter.mode != SearchMode::gravity)
      add("jitter", "field_N_per_mm", {"[jitter] mode"}, why + "\"gravity\"");
    if (jitter.mode != SearchMode::random && jitter.confined == 0)
      add("jitter", "amplitude", {"[jitter] mode", "[jitter] confined"}, why + "\"random\"");
    if (jitter.mode != SearchMode::poke && jitter.transitions == 0)
      add("jitter", "depth", {"[jitter] mode", "[jitter] transitions"}, why + "\"poke\"");
  }

  void sweep() {
    if (preset_.sweep.wanted()) return;
    // a preset that sweeps nothing needs no line about it
    add_all("sweep", {"[sweep] over", "[sweep] seeds"},
            "nothing is swept: [sweep] over is empty and seeds is 1");
  }

  void pictures() {
    if (!preset_.movie.bins)
      add("movie", "bins_range", {"[movie] bins"}, "no bins are drawn: [movie] bins is false");
    if (preset_.movie.view != View::free)
      for (const char* key : {"azimuth_deg", "elevation_deg"})
        add("movie", key, {"[movie] view"}, "[movie] view takes its place");
    if (preset_.page.kind == PageKind::none)
      add_all("page", {"[page] kind"}, "no page is made: [page] kind is \"none\"");
    else if (preset_.page.kind != PageKind::fig2)
      add("page", "sweep", {"[page] kind"}, "[page] kind is not \"fig2\"");
  }

  const Preset& preset_;
  std::vector<UnusedKey> found_;
};

}  // namespace

std::vector<UnusedKey> unused_keys(const Preset& preset) { return UnusedKeyFinder(preset).take(); }

}  // namespace gridshell::preset
