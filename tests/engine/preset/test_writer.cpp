#include <catch2/catch.hpp>
#include <set>

#include "engine/preset/field_table.h"
#include "engine/preset/writer.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

// lists of tables speak of their last item
Preset with_items(Preset preset = {}) {
  if (preset.block.empty()) preset.block.emplace_back();
  if (preset.join.empty()) preset.join.emplace_back();
  return preset;
}

// every field as text: two presets with the same have the same values
std::vector<std::string> values_of(const Preset& given) {
  const auto preset = with_items(given);
  std::vector<std::string> values;
  for (const auto& field : field_table()) values.push_back(value_text(field, preset));
  return values;
}

Presets read_back(const std::string& text) {
  const auto presets = read_preset_text(text, "written.toml", "written");
  if (!presets) FAIL(presets.error().message << "\nin\n" << text);
  return *presets;
}

// a preset in which no field has its default
Preset all_changed() {
  Preset preset = with_items();
  for (const auto& field : field_table()) {
    auto kind = field.kind;
    if (auto* k = std::get_if<Real>(&kind)) k->in(preset) = k->in(preset)*0.7 + 0.01;
    if (auto* k = std::get_if<Integer>(&kind)) k->in(preset) += 1;
    if (auto* k = std::get_if<Flag>(&kind)) k->in(preset) = !k->in(preset);
    if (auto* k = std::get_if<Text>(&kind)) k->in(preset) = "a \"b\" \\ \n\tc = # 'd' □";
    if (auto* k = std::get_if<Word>(&kind))
      k->set(preset, k->get(preset) == 0 ? int(k->words.size()) - 1 : 0);
    if (auto* k = std::get_if<IntegerPair>(&kind)) k->in(preset) = {333, 222};
    if (auto* k = std::get_if<IntegerList>(&kind)) k->in(preset) = {3, 2};
    if (auto* k = std::get_if<RealList>(&kind)) k->in(preset) = {87.1, 1e2 / 1.5};
    if (auto* k = std::get_if<OptionalInteger>(&kind)) k->in(preset) = -3;
    if (auto* k = std::get_if<PointList>(&kind))
      k->in(preset) = {std::vector<double>(k->coordinates.size(), 0.1),
                       std::vector<double>(k->coordinates.size(), -1e-7)};
  }
  // what goes with free rings and held tangents
  preset.footprint.kind = FootprintKind::net;
  preset.net.kind = NetKind::beltrami;
  // joints are pushed, and snap in time, on the bend rung alone; checked apart too
  preset.dynamics.snap = false;
  preset.indentation.depth = preset.indentation.depth_mm = 0;
  // only a circle has them; they are checked apart
  preset.figure.radii_mm.clear();
  return preset;
}

}  // namespace

TEST_CASE("a written preset reads back as the same preset") {
  CHECK(values_of(read_back(to_toml(Preset{})).base) == values_of(Preset{}));
  const auto changed = all_changed();
  CHECK(values_of(read_back(to_toml(changed)).base) == values_of(changed));
  Preset circle;
  circle.figure.radii_mm = {120.1, 1e2};
  circle.rod.density_kg_m3 = 6450;
  circle.dynamics.snap = true;
  circle.indentation.depth = 0.07;
  circle.indentation.depth_mm = 1.25;
  CHECK(values_of(read_back(to_toml(circle)).base) == values_of(circle));
  // the two differ everywhere that has a choice, so the test saw every field
  const auto a = values_of(Preset{}), b = values_of(changed);
  for (std::size_t k = 0; k < a.size(); ++k) {
    const auto* word = std::get_if<Word>(&field_table()[k].kind);
    const std::set<std::string> apart{"[figure] radii_mm", "[indentation] depth",
                                      "[indentation] depth_mm", "[dynamics] snap"};
    if (apart.contains(name_of(field_table()[k]))) continue;
    if (!word || word->words.size() > 1) {
      INFO(name_of(field_table()[k]));
      CHECK(a[k] != b[k]);
    }
  }
}

TEST_CASE("cases are written as what differs from the base") {
  const auto presets = read_back(
      "[[case]]\nname = \"one\"\nrod.young_GPa = 70.0\n[[case]]\nname = \"two\"\ntitle = \"t\"\n");
  const auto text = to_toml(presets);
  CHECK_THAT(text, Catch::EndsWith("\n[[case]]\nname = \"one\"\nrod.young_GPa = 70.0\n"
                                   "\n[[case]]\nname = \"two\"\ntitle = \"t\"\n"));
  const auto again = read_back(text);
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
    if (const auto* k = std::get_if<Real>(&field.kind)) {
      Preset preset = defaults;
      CHECK(k->range.holds(k->in(preset)));
    }
    // units stand in the key
    if (field.unit == "mm") CHECK_THAT(field.key, Catch::EndsWith("_mm"));
    if (field.unit == "deg") CHECK_THAT(field.key, Catch::EndsWith("_deg"));
  }
}

TEST_CASE("the reference names every key") {
  const auto text = reference_markdown();
  for (const auto& field : field_table())
    CHECK_THAT(text, Catch::Contains("| `" + field.key + "` |"));
}
