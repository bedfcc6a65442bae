#include <map>
#include <set>

#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

// adds an item to every empty list of tables, because a field of such a list is that of its last
// item
Preset with_items(Preset preset = {}) {
  each_list([&](const char*, auto member) {
    if ((preset.*member).empty()) (preset.*member).emplace_back();
  });
  return preset;
}

// texts of all fields that have an effect, by name; of lists of tables those of the last item
std::map<std::string, std::string> values_of(const Preset& given) {
  const auto preset = with_items(given);
  std::set<std::string> idle;
  for (const auto& key : unused_keys(preset)) idle.insert(name_of(*find_field(key.table, key.key)));
  std::map<std::string, std::string> values;
  for (const auto& field : field_table())
    if (!idle.contains(name_of(field))) values[name_of(field)] = value_text(field, preset);
  return values;
}

// a preset in which no field has its default
Preset all_changed() {
  Preset preset = with_items();
  for (const auto& field : field_table()) {
    if (auto* real = field.as<double>(preset)) *real = *real * 0.7 + 0.01;
    if (auto* number = field.as<int>(preset)) *number += 1;
    if (auto* flag = field.as<bool>(preset)) *flag = !*flag;
    if (auto* text = field.as<std::string>(preset))
      *text = field.colour ? "#0a1B2c" : "a \"b\" \\ \n\tc = # 'd' □";
    if (const auto word = field.as_word(preset))
      word->set(word->member, word->get(word->member) == 0 ? int(field.words.size()) - 1 : 0);
    if (auto* pair = field.as<std::array<int, 2>>(preset)) *pair = {333, 222};
    if (auto* list = field.as<std::vector<int>>(preset)) *list = {3, 2};
    if (auto* list = field.as<std::vector<double>>(preset)) *list = {87.1, 1e2 / 1.5};
    if (auto* number = field.as<std::optional<int>>(preset)) *number = -3;
    if (auto* number = field.as<std::optional<double>>(preset)) *number = 1.5;
    if (auto* points = field.as<Points>(preset))
      for (int n = 0; n < 4; ++n) {
        auto& point = points->emplace_back(field.coordinates.size(), 0.1 - 1e-7 * n);
        for (std::size_t c = 0; c < point.size(); ++c)
          if (!field.words_of(c).empty()) point[c] = 1;
      }
  }
  // files are read once, with their units: the written preset has their contents
  preset.footprint.file_unit = preset.net.file_unit = FileUnit::file;
  preset.footprint.join_mm = 0;
  preset.inverse.vary = {Vary::pins, Vary::legs};
  preset.jitter.levels = {0.25, 1e0 / 3};
  preset.movie.target_mm = {1.5, -2, 1e2 / 3};
  preset.movie.bins_range = preset.style.range = {-0.02, 0.07};
  // only a mesh is searched for an apex
  preset.net.apex = NetApex::given;
  // each is checked separately: only circles have radii, only the bend model pushes and snaps
  preset.figure.radii_mm.clear();
  preset.indentation.depth = preset.indentation.depth_mm = 0;
  preset.dynamics.snap = false;
  preset.contact.model = ContactModel::none;
  // a strength is given by one key alone; laths have no given stiffnesses; a wall needs a hollow
  for (Rod* rod : {&preset.rod, static_cast<Rod*>(&preset.rod_v)}) {
    rod->yield_strain = rod->wall_mm = 0;
    rod->EA_N = rod->EI_Nmm2 = rod->GJ_Nmm2 = rod->mass_g_per_m = rod->modulus_mm3 = 0;
  }
  // eccentric joints need bolts
  preset.joints.eccentricity_mm = 0;
  // only pinned ends have tails
  preset.ends.second_ring_mm = 0;
  preset.footprint.kind = FootprintKind::net;
  preset.net.kind = NetKind::beltrami;
  preset.block.clear();
  preset.join.clear();
  preset.step.clear();
  return preset;
}

Preset of_net(NetKind kind) {
  auto preset = all_changed();
  preset.net.kind = kind;
  // only surfaces of revolution have rings that can be free
  const bool rings =
      kind != NetKind::sphere && kind != NetKind::translation && kind != NetKind::surface;
  if (!rings) preset.ends.rings = Rings::pinned;
  preset.net.apex_mm = {1.5, -2, 1e2 / 3};
  return preset;
}

Preset of_curve(CurveKind kind, double scale) {
  auto preset = of_net(NetKind::sphere);
  preset.footprint.kind = FootprintKind::curve;
  preset.actuation.start = Start::flat;
  preset.inverse = {};
  // this load case has the wind direction of [loads], those of other samples their own
  preset.load_case.front().wind_deg.reset();
  preset.footprint.boundary.kind = preset.actuation.boundary.kind = kind;
  preset.actuation.scale = scale;
  if (kind == CurveKind::file)
    preset.footprint.file = preset.actuation.file = {
        {{0, 0, 0}, {1e2 / 3, 0, 0}, {0, 20, 0}}, {{0, 1, 2, 0}}, {}, {}, {}, {}, {}, {}, {}};
  return preset;
}

Preset of_blocks(NetKind kind) {
  auto preset = of_net(NetKind::sphere);
  preset.footprint.kind = FootprintKind::blocks;
  const auto items = all_changed();
  for (const char* name : {"first one", "second"}) {
    preset.block.push_back({name, items.net, -3, 4, -5, 6});
    preset.block.back().net.kind = kind;
  }
  preset.join = {{"first one.east", "second.west"}};
  return preset;
}

// a circle with the bend model, its push given by a latitude, or with `joint` by its indices
Preset pushed(bool joint) {
  Preset preset;
  const auto changed = all_changed();
  preset.footprint.rods = changed.footprint.rods;
  preset.footprint.radius_mm = 130.5;
  preset.actuation.radius_mm = changed.actuation.radius_mm;
  preset.rod.diameter_mm = 0.3;
  preset.rod.density_kg_m3 = 6450;
  preset.rod.yield_strain = 0.011;
  if (joint) {
    preset.rod.wall_mm = 0.07;
  } else {
    preset.rod.EA_N = 4000.5;
    preset.rod.EI_Nmm2 = 30.25;
    preset.rod.GJ_Nmm2 = 20.125;
    preset.rod.mass_g_per_m = 0.4;
    preset.rod.modulus_mm3 = 0.003;
  }
  static_cast<Rod&>(preset.rod_v) = preset.rod;
  preset.rod_v.differs = true;
  preset.dynamics = {true, 0.0011, 13.7};
  preset.indentation = changed.indentation;
  preset.indentation.depth = joint ? 0.07 : 0;
  preset.indentation.depth_mm = joint ? 0 : 1.25;
  if (!joint) preset.indentation.joint.clear();
  preset.sweep = changed.sweep;
  preset.sweep.over = {{"rod.young_GPa", {"70.0", "83.5"}}, {"actuation.seed", {"\"down\""}}};
  preset.sweep.plot = {"total_K", "force_N"};
  // angles count only if no view is named
  preset.movie.azimuth_deg = 12.5;
  preset.movie.elevation_deg = -3.5;
  return preset;
}

// the steps of a user, each alone: none uses all keys
std::vector<Preset> stepped() {
  std::vector<Step> steps;
  const auto add = [&](StepKind task) -> Step& {
    steps.emplace_back().kind = task;
    if (task != StepKind::move) steps.back().joint = {3, -2};
    return steps.back();
  };
  add(StepKind::move).progress = 0.71;
  steps.back().edge_points = {{3, 1.5, -1e-11, 1e2 / 3}};
  add(StepKind::move).radius_mm = 87.1;
  add(StepKind::push).to_mm = {1.5, 0, 1e2 / 3};
  steps.back().along = {0, 0.6, 0.8};
  add(StepKind::push).depth_mm = -3.3;
  steps.back().lateral = Lateral::held;
  add(StepKind::hold);
  add(StepKind::release);
  add(StepKind::load).factor = 0.3;
  add(StepKind::rest).side = BranchSide::against;
  add(StepKind::jitter).seed = 7;
  steps.back().force_N = 0.11;
  add(StepKind::tighten).stiffness_Nmm = 1e5 / 3;
  Step& opened = add(StepKind::open);
  opened.angle_deg = 100.0 / 3;
  opened.drive = JointDrive::mean;
  add(StepKind::open).angles = {{1, 0, 70.5}};
  Step& braced = add(StepKind::brace);
  braced.cells = {{-1, 2}};
  braced.diagonals = Diagonals::second;
  braced.brace = BraceKind::strut;
  braced.EA_N = 1e3 / 7;
  add(StepKind::release).what = Released::braces;
  add(StepKind::load).load_case = "snow";
  std::vector<Preset> all;
  for (Step& step : steps) {
    if (step.kind > StepKind::release) step.joint.clear();
    all.emplace_back().step = {step};
    if (!step.load_case.empty()) all.back().load_case.emplace_back().name = step.load_case;
  }
  return all;
}

std::vector<Preset> samples() {
  auto at_highest = pushed(false);
  at_highest.indentation.latitude_deg = 90;
  Preset by_leg;
  by_leg.footprint.longest_leg = 2.3;
  by_leg.actuation.ratio = 0.81;
  by_leg.figure.radii_mm = {150.1, 4e2 / 3};
  by_leg.accuracy.leading_edges = 5;
  by_leg.contact = {ContactModel::barrier, 0.2, 2.5};
  by_leg.page = {PageKind::fig2, "its photo.png", "out/a sweep"};
  std::vector<Preset> all{Preset{},   pushed(true), pushed(false),
                          at_highest, by_leg,       of_curve(CurveKind::ellipse, 0.77)};
  all.push_back(of_net(NetKind::sphere));
  all.back().ends = {.second_ring_mm = 7.5, .table = {}};
  for (const auto& [kind, word] : words_of<CurveKind>()) all.push_back(of_curve(kind, 0));
  for (const auto& [kind, word] : words_of<NetKind>()) {
    if (kind == NetKind::surface) continue;  // these follow below; they cannot be blocks
    all.push_back(of_net(kind));
    all.push_back(of_blocks(kind));
  }
  // surfaces by either expression, cut by either boundary
  all.push_back(of_net(NetKind::surface));
  all.back().net.height.clear();
  all.push_back(of_net(NetKind::surface));
  all.back().net.implicit.clear();
  all.back().net.within.clear();
  // surfaces by heights and by a mesh
  for (const SurfaceData& file :
       {SurfaceData{
            {0, 0.1, 3, 1e2 / 3}, {-2, 1e-12, 3, 4}, Points(4, {1, 2.5, -1e-11, 0}), {}, {}},
        SurfaceData{{}, {}, {}, {{0, 0, 1e-12}, {1, 0, 0}, {0, 1e2 / 3, 0}}, {{0, 1, 2}}}}) {
    all.push_back(of_net(NetKind::surface));
    all.back().net.implicit.clear();
    all.back().net.height.clear();
    all.back().net.file = file;
    if (file.is_mesh()) all.back().net.apex = NetApex::best;
  }
  Preset network;
  network.footprint.kind = FootprintKind::network;
  network.rod.as_drawn = true;
  network.rod.shear_GPa = 30;
  network.joints.eccentricity_mm = -0.4;
  network.footprint.file = {{{0, 0, 0}, {1e2 / 3, 0, 0}, {0, 20, 0}},
                            {{0, 1, 2}},
                            {0.25},
                            {{0, "young_GPa", 1e2 / 3}},
                            {{0}, {1, 30, 0, 2}},
                            {{1, 1e2 / 3, 0, 5}},
                            {2},
                            {{1, 2.5, -1, 0.3}},
                            {{0, 1, 2}}};
  all.push_back(network);
  for (Preset& preset : stepped()) all.push_back(std::move(preset));
  return all;
}

}  // namespace

TEST_CASE("a written preset reads back as one that does the same") {
  std::set<std::string> seen;
  const Preset plain = with_items();
  for (const Preset& preset : samples()) {
    const auto values = values_of(preset);
    INFO(to_toml(preset));
    CHECK(values_of(good(to_toml(preset)).base) == values);
    for (const auto& field : field_table())
      if (const auto at = values.find(name_of(field));
          at != values.end() && at->second != value_text(field, plain))
        seen.insert(at->first);
  }
  // and the samples together use every field with another value than its default
  const std::set<std::string> of_files{"file_unit", "join_mm", "linkage"};
  for (const auto& field : field_table()) {
    INFO(name_of(field));
    CHECK((of_files.contains(field.key) || seen.contains(name_of(field))));
  }
}

TEST_CASE("cases are written as what differs from the base") {
  const auto presets = good(
      "[[case]]\nname = \"one\"\nrod.young_GPa = 70.0\n[[case]]\nname = \"two\"\ntitle = \"t\"\n");
  const auto text = to_toml(presets);
  CHECK_THAT(text, Catch::EndsWith("\n[[case]]\nname = \"one\"\nrod.young_GPa = 70.0\n"
                                   "\n[[case]]\nname = \"two\"\ntitle = \"t\"\n"));
  const auto again = good(text);
  REQUIRE(again.cases.size() == 2);
  for (std::size_t k = 0; k < 2; ++k)
    CHECK(values_of(again.cases[k].preset) == values_of(presets.cases[k].preset));
}

TEST_CASE("the field table is sound") {
  std::set<std::string> names, known;
  for (const auto& table : tables()) known.insert(table.name);
  const Preset defaults = with_items();
  for (const auto& field : field_table()) {
    INFO(name_of(field));
    CHECK(known.contains(field.table));
    CHECK(names.insert(name_of(field)).second);
    CHECK_FALSE(field.meaning.empty());
    CHECK(field.meaning.back() != '.');
    Preset preset = defaults;
    if (const auto* real = field.as<double>(preset)) CHECK(field.range.contains(*real));
    // units are in the key
    if (field.unit == "mm") CHECK_THAT(field.key, Catch::EndsWith("_mm"));
    if (field.unit == "deg") CHECK_THAT(field.key, Catch::EndsWith("_deg"));
  }
}

TEST_CASE("the reference names every key") {
  const auto text = reference_markdown();
  for (const auto& field : field_table())
    CHECK_THAT(text, Catch::Contains("| `" + field.key + "` |"));
}
