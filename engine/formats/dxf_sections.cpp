#include "engine/formats/dxf_sections.h"

#include <array>
#include <cmath>
#include <utility>

#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/formats/plain_text.h"

namespace gridshell::preset {
namespace {

Result<std::vector<DxfGroup>> groups_of(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with("AutoCAD Binary DXF"))
    return invalid("{}: got a binary DXF, expected text: save it as ASCII DXF", name);
  if (bytes.starts_with("AC10") && bytes.substr(0, 64).find('\n') == bytes.npos)
    return invalid("{}: got a DWG, expected a DXF: save it as one", name);
  std::vector<DxfGroup> groups;
  for (int line = 1; !trimmed(bytes.substr(0, 64)).empty() || bytes.size() > 64; line += 2) {
    const auto code = number_of(trimmed(next_line(bytes)));
    if (!code || !(std::abs(*code) <= 2000) || bytes.empty())
      return invalid("{}:{}: got no DXF text, expected a code and a value in turn{}", name, line,
                     groups.empty() ? "" : ": is it cut short?");
    groups.push_back({int(*code), trimmed(next_line(bytes)), line + 1});
    // some programs add a Ctrl-Z or blanks
    if (*code == 0 && groups.back().value == "EOF") break;
  }
  return groups;
}

/// Whether the value of a code is a number: a coordinate, a length, an angle.
bool is_number(int code) {
  return (code >= 10 && code < 60) || (code >= 70 && code < 80) || (code >= 210 && code < 240);
}

/// Sorts the groups of a file into sections and entities.
class Sections {
 public:
  explicit Sections(const std::string& name) : name_(name) {}

  Result<RawDrawing> take(const std::vector<DxfGroup>& groups) {
    for (std::size_t k = 0; k < groups.size(); ++k) {
      const DxfGroup& group = groups[k];
      if (group.code == 999) continue;
      if (group.code == 0 && group.value == "SECTION") {
        section_ = k + 1 < groups.size() ? groups[k + 1].value : "";
        ++k;
      } else if (group.code == 0 && group.value == "ENDSEC") {
        section_ = {};
        open_ = nullptr;
      } else if (section_ == "HEADER") {
        if (group.value == "$INSUNITS" && k + 1 < groups.size())
          drawing_.unit = int(std::clamp(number_of(groups[k + 1].value).value_or(0), 0.0, 1000.0));
      } else if (group.code == 0) {
        begin(group);
      } else if (open_) {
        if (is_number(group.code) && is_curve(open_->kind) && !number_of(group.value))
          return invalid("{}:{}: expected a finite number", name_, group.line);
        open_->groups.push_back(group);
      }
    }
    if (section_ == "ENTITIES" || section_ == "BLOCKS")
      return invalid("{}: ends within its section {}: is it cut short?", name_, section_);
    finish_tables();
    return std::move(drawing_);
  }

 private:
  void begin(const DxfGroup& group) {
    open_ = nullptr;
    RawEntity fresh{std::string(group.value), group.line};
    if (section_ == "TABLES" && group.value == "LAYER") {
      open_ = &layers_.emplace_back(std::move(fresh));
    } else if (section_ == "BLOCKS" && group.value == "BLOCK") {
      open_ = &heads_.emplace_back(std::move(fresh), std::vector<RawEntity>()).first;
    } else if (group.value == "ENDBLK" || group.value == "SEQEND") {
      follows_ = false;
    } else if (section_ == "ENTITIES" || (section_ == "BLOCKS" && !heads_.empty())) {
      auto& list = section_ == "ENTITIES" ? drawing_.entities : heads_.back().second;
      const bool part = group.value == "VERTEX" || group.value == "ATTRIB";
      if (part && follows_ && !list.empty())
        open_ = &list.back().parts.emplace_back(std::move(fresh));
      else
        open_ = &list.emplace_back(std::move(fresh));
      if (!part) follows_ = group.value == "POLYLINE" || group.value == "INSERT";
    }
  }

  void finish_tables() {
    for (const RawEntity& layer : layers_)
      drawing_.layers[lower(layer.text(2))] = layer.number(62, 7) >= 0 && layer.flags(70) % 2 == 0;
    for (auto& [head, entities] : heads_)
      drawing_.blocks[lower(head.text(2))] = {head.point(10), (head.flags(70) & (4 | 8 | 32)) != 0,
                                              std::move(entities)};
  }

  std::string name_;
  std::string_view section_;
  RawEntity* open_ = nullptr;
  bool follows_ = false;
  std::vector<RawEntity> layers_;
  std::vector<std::pair<RawEntity, std::vector<RawEntity>>> heads_;
  RawDrawing drawing_;
};

}  // namespace

bool is_curve(const std::string& kind) {
  static constexpr std::array<std::string_view, 9> curves{
      "LINE", "LWPOLYLINE", "POLYLINE", "VERTEX", "ARC", "CIRCLE", "ELLIPSE", "SPLINE", "INSERT"};
  return std::ranges::find(curves, kind) != curves.end();
}

Result<RawDrawing> read_sections(std::string_view bytes, const std::string& name) {
  TRY(groups, groups_of(bytes, name));
  return Sections(name).take(*groups);
}

}  // namespace gridshell::preset
