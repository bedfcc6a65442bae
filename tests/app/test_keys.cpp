// Every key of the field table must have an effect: one without would mislead its user.
#include <map>
#include <regex>
#include <set>

#include "app/cli/pictures.h"
#include "engine/preset/consistency.h"
#include "engine/preset/field_table.h"
#include "tests/app/bench.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

// keys that only people read, in the file itself
const std::set<std::string> for_people{"description"};

// where the member has another name than the key, or is computed from it
const std::map<std::string, std::string> member_names{{"points_mm", "points"},
                                                      {"do", "kind"},
                                                      {"file_unit", "file"},
                                                      {"join_mm", "file"},
                                                      {"linkage", "file"},
                                                      {"longest_leg", "original_radius_mm"},
                                                      {"strength_MPa", "fibre_strength_MPa"},
                                                      {"yield_strain", "fibre_strength_MPa"},
                                                      {"material", "young_GPa"},
                                                      {"ratio", "actuated_radius_mm"}};

// names of the members that are used in sources that work with presets, without engine/preset,
// which reads, checks and writes the keys themselves
std::set<std::string> members_read() {
  static const std::regex member("(?:\\.|->)([A-Za-z_]\\w*)");
  std::set<std::string> found;
  for (const char* folder : {"engine", "render", "app"})
    for (const auto& file : files_under(fs::path(GRIDSHELL_SOURCE_DIR) / folder, ".cpp")) {
      const auto text = text_of(file);
      if (file.string().find("/engine/preset/") != std::string::npos ||
          (text.find("preset::") == std::string::npos && folder != std::string("render")))
        continue;
      for (std::sregex_iterator at(text.begin(), text.end(), member), end; at != end; ++at)
        found.insert((*at)[1]);
    }
  return found;
}

// gives the field another value than its default
void change(const Field& field, Preset& preset) {
  if (auto* real = field.as<double>(preset)) *real += 1;
  if (auto* number = field.as<int>(preset)) *number += 1;
  if (auto* flag = field.as<bool>(preset)) *flag = !*flag;
  // the last name: the first after "auto" is often the one that "auto" chooses
  if (const auto word = field.as_word(preset))
    word->set(word->member, word->get(word->member) == 0 ? int(field.words.size()) - 1 : 0);
  if (auto* pair = field.as<std::array<int, 2>>(preset)) (*pair)[1] += 1;
  if (auto* list = field.as<std::vector<double>>(preset)) *list = {1, 2, 3};
  if (auto* points = field.as<Points>(preset)) *points = {{1, 2, 3}};
  if (auto* text = field.as<std::string>(preset); text && field.colour) *text = "#010203";
}

}  // namespace

TEST_CASE("something reads the member of every key") {
  const auto read = members_read();
  CHECK(read.size() > 100);
  CHECK_FALSE(read.contains("a_key_that_nothing_reads"));
  for (const auto& field : field_table()) {
    if (field.table.empty() && for_people.contains(field.key)) continue;
    const auto other = member_names.find(field.key);
    INFO(name_of(field));
    CHECK(read.contains(other == member_names.end() ? field.key : other->second));
  }
}

namespace {

/// Whether two movies look the same, by every key of [movie] and every choice of their style.
bool same(const render::MovieStyle& a, const render::MovieStyle& b) {
  const auto movie = [](const render::MovieStyle& style) {
    Preset preset;
    preset.movie = style;
    return to_toml(preset);
  };
  const auto beside = [](const render::MovieStyle& s) {
    return std::tuple(s.legends, s.heading, s.scale_bar_mm, s.title, s.source, s.print, s.vector,
                      s.font_scale);
  };
  // a binding of all members does not compile when one is added
  const auto look = [](const render::Appearance& all) {
    const auto& [rod_mm, joint_mm, ring_mm, rod, joint, ring, background, rod_chosen, joint_chosen,
                 map, range, cells, rings, floor, shadow, loads, braces, ghost, supports, clamped,
                 lath_width_mm, lath_thickness_mm, sheen, far_fade, letters] = all;
    return std::tie(rod_mm, joint_mm, ring_mm, rod, joint, ring, background, rod_chosen,
                    joint_chosen, map, range, cells, rings, floor, shadow, loads, braces, ghost,
                    supports, clamped, lath_width_mm, lath_thickness_mm, sheen, far_fade, letters);
  };
  // to_toml writes bins_range only if there are bins
  return movie(a) == movie(b) && a.bins_range == b.bins_range && beside(a) == beside(b) &&
         look(a.look) == look(b.look);
}

}  // namespace

TEST_CASE("every key of [movie] and [style] changes how a movie looks, those of [figure] a still") {
  // the number of frames, whether cases are in one picture and which other files are made belong to
  // the movie, not to its style; the font is that of the process
  const std::set<std::string> elsewhere{"frames", "beside", "webm", "gif", "poster", "font"};
  const std::set<std::string> stills{"quality", "scale_bar_mm", "width_mm", "vector"};
  for (const auto& field : field_table()) {
    const bool movie =
        (field.table == "style" || field.table == "movie") && !elsewhere.contains(field.key);
    if (!movie && !(field.table == "figure" && stills.contains(field.key))) continue;
    const auto pictures = movie ? app::Pictures::movie : app::Pictures::stills;
    Preset preset;
    const auto before = app::style_of(preset, pictures);
    change(field, preset);
    INFO(name_of(field));
    CHECK_FALSE(same(app::style_of(preset, pictures), before));
  }
}

TEST_CASE("every member of a preset has a key") {
  const fs::path folder = fs::path(GRIDSHELL_SOURCE_DIR) / "engine/preset";
  const std::string header = text_of(folder / "preset.h") + text_of(folder / "pictures.h");
  // names that follow :: or . in the tables
  std::set<std::string> named;
  const std::regex member("(?:::|\\.)(\\w+)");
  for (const char* ending : {".cpp", ".h"})
    for (const auto& file : files_under(folder, ending)) {
      if (file.filename() == "preset.h" || file.filename() == "pictures.h") continue;
      const std::string text = text_of(file);
      for (std::sregex_iterator at(text.begin(), text.end(), member), end; at != end; ++at)
        named.insert((*at)[1]);
    }
  // "double half_x_mm = 126.0, half_y_mm = 100.0;"
  const std::regex line(
      "\\n  (?!return|static|const)[A-Za-z_][\\w:<>]*(?: [A-Za-z]+>)? (\\w+[^;(){}]*);");
  const std::regex declared("(?:^|, )(\\w+)");
  int members = 0;
  for (std::sregex_iterator at(header.begin(), header.end(), line), end; at != end; ++at) {
    const std::string names = (*at)[1];
    for (std::sregex_iterator one(names.begin(), names.end(), declared); one != end; ++one) {
      ++members;
      INFO((*one)[1]);
      CHECK(named.contains((*one)[1]));
    }
  }
  CHECK(members > 80);
}

TEST_CASE("a key of joints, ends or loads that matters on a net excludes the model net") {
  // the first matters for spring joints alone, the second for surfaces with rings, the next two for
  // scans, the fifth with gravity and in motion, the others for load cases
  const std::set<std::string> harmless{"stiffness_N_per_mm", "rings",          "diameter_mm",
                                       "height_mm",          "mass_g",         "snow_N_m2",
                                       "wind_N_m2",          "pressure_N_m2",  "wind_deg",
                                       "edge_N_m",           "edge_direction", "imperfection"};
  Preset cap;
  cap.footprint.kind = FootprintKind::net;
  cap.accuracy.tolerance = 0.05;
  REQUIRE(rod_model_of(cap) == RodModel::net);
  for (const auto& field : field_table()) {
    if (field.table != "joints" && field.table != "ends" && field.table != "loads") continue;
    Preset preset = cap;
    change(field, preset);
    INFO(name_of(field));
    CHECK((rod_model_of(preset) == RodModel::net) == harmless.contains(field.key));
  }
}
