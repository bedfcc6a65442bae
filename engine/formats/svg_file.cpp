#include "engine/formats/svg_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/formats/plain_text.h"
#include "engine/formats/svg_path.h"

namespace gridshell::preset {
namespace {

using Point = Eigen::Vector2d;

struct Tag {
  std::string name;
  std::map<std::string, std::string> attributes;
  bool ends = false, alone = false;  ///< an end tag </g>; an empty element <path/>

  std::string get(const std::string& key) const {
    const auto found = attributes.find(key);
    return found == attributes.end() ? "" : found->second;
  }
};

/// The position of the ">" that ends the tag at `at`; npos: there is none.
std::size_t end_of_tag(std::string_view text, std::size_t at) {
  char quote = 0;  // a ">" within an attribute's value ends nothing
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quote == 0 && c == '>') return at;
    if (quote != 0 ? c == quote : c == '"' || c == '\'') quote = quote == 0 ? c : '\0';
  }
  return text.npos;
}

/// Parses the text between "<" and ">".
Tag tag_of(std::string_view text) {
  Tag tag;
  if (text.starts_with('/')) tag.ends = true, text.remove_prefix(1);
  if (text.ends_with('/')) tag.alone = true, text.remove_suffix(1);
  const auto is_space = [](char c) { return std::isspace((unsigned char)c) != 0; };
  auto at = std::ranges::find_if(text, is_space);
  tag.name.assign(text.begin(), at);
  if (const auto colon = tag.name.find(':'); colon != tag.name.npos) tag.name.erase(0, colon + 1);
  while (at != text.end()) {
    at = std::find_if_not(at, text.end(), is_space);
    const auto equals = std::find(at, text.end(), '=');
    if (equals == text.end()) break;
    std::string key(at, equals);
    std::erase_if(key, is_space);
    const auto open = std::find_if_not(equals + 1, text.end(), is_space);
    if (open == text.end()) break;
    const auto close = std::find(open + 1, text.end(), *open);
    if (close == text.end()) break;
    std::string& value = tag.attributes[key] = std::string(open + 1, close);
    std::ranges::replace_if(value, is_space, ' ');
    at = close + 1;
  }
  return tag;
}

constexpr double pixel_mm = 25.4 / 96;

/// A number with the size of its unit; without one it is in pixels.
struct Length {
  double number = 0, unit_mm = pixel_mm;
  bool has_unit = false;
};

/// Reads a length; empty: it is none, or relative to something else (%, em).
std::optional<Length> length_of(const std::string& text) {
  SvgWords words(text);
  const auto number = words.number();
  const std::string_view unit = trimmed(words.rest());
  const double size = unit.empty() || unit == "px" ? pixel_mm
                      : unit == "pt"               ? 25.4 / 72
                      : unit == "pc"               ? 25.4 / 6
                                                   : millimetres_of(unit);
  if (!number || size <= 0) return std::nullopt;
  return Length{*number, size, !unit.empty()};
}

void take_unit(const Tag& svg, PlanDrawing& drawing) {
  std::vector<double> box;
  SvgWords words(svg.get("viewBox"));
  while (const auto value = words.number()) box.push_back(*value);
  drawing.unit_mm = pixel_mm;
  drawing.unit = fmt::format("in pixels of 1/96 inch, as it {}",
                             box.size() == 4 ? "names no unit" : "has no viewBox");
  if (box.size() != 4) return;
  // the box is drawn as large as width and height permit; they may be rounded
  constexpr double rounding = 1e-3;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [key, adjective, extent] :
       {std::tuple("width", "wide", box[2]), {"height", "high", box[3]}}) {
    const auto side = length_of(svg.get(key));
    if (!side || side->number <= 0 || extent <= 0) continue;
    const double unit_mm = side->number * side->unit_mm / extent;
    if (unit_mm > (1 - rounding) * least) continue;
    least = drawing.unit_mm = unit_mm;
    if (side->has_unit) drawing.unit = fmt::format("{} {} as it says", svg.get(key), adjective);
  }
}

/// The lines of a shape; empty if the tag is no shape. `wrong` receives the error of an invalid
/// shape.
std::optional<std::vector<PlanLine>> lines_of(const Tag& tag, std::string& wrong) {
  const auto length = [&](const char* key) {
    const auto found = tag.attributes.find(key);
    if (found == tag.attributes.end()) return 0.0;
    const auto read = length_of(found->second);
    if (!read)
      wrong = fmt::format(
          "{} = \"{}\", expected a number or a length in mm, cm, in, pt or px: convert the shape "
          "to a path",
          key, found->second);
    return read ? read->number * (read->unit_mm / pixel_mm) : 0;
  };
  const auto point = [&](const char* x, const char* y) { return Point(length(x), length(y)); };
  std::vector<PlanLine> lines;
  if (tag.name == "path") {
    wrong = read_path(tag.get("d"), lines);
    return lines;
  }
  PlanLine line{{}, tag.name != "polyline" && tag.name != "line"};
  if (tag.name == "polygon" || tag.name == "polyline") {
    SvgWords words(tag.get("points"));
    while (!words.at_end()) {
      const auto x = words.number(), y = words.number();
      if (!x || !y) return wrong = "a point of fewer than two numbers", std::nullopt;
      line.points.emplace_back(*x, *y);
    }
  } else if (tag.name == "line") {
    line.points = {point("x1", "y1"), point("x2", "y2")};
  } else if (tag.name == "rect") {
    const Point low = point("x", "y"), size = point("width", "height");
    line.points = {low, low + Point(size.x(), 0), low + size, low + Point(0, size.y())};
  } else if (tag.name == "circle" || tag.name == "ellipse") {
    const bool circle = tag.name == "circle";
    const Point middle = point("cx", "cy"), radii = point(circle ? "r" : "rx", circle ? "r" : "ry");
    for (int k = 0; k < 360; ++k)
      line.points.emplace_back(middle.x() + radii.x() * std::cos(k * M_PI / 180),
                               middle.y() + radii.y() * std::sin(k * M_PI / 180));
  } else {
    return std::nullopt;
  }
  lines.push_back(std::move(line));
  return lines;
}

/// The value of the last declaration of a property in "fill:none; display: none"; empty: there is
/// none.
std::string_view value_of(std::string_view property, std::string_view declarations) {
  std::string_view value;
  for (const std::string_view one : words_in(declarations, ";")) {
    const auto colon = one.find(':');
    if (colon != one.npos && trimmed(one.substr(0, colon)) == property)
      value = trimmed(one.substr(colon + 1));
  }
  return value;
}

/// The rules of <style> elements, by their selectors: a name of tags, ".class" or "#id".
class StyleRules {
 public:
  /// Adds the rules of a text. Returns a selector of another kind that may hide or move shapes;
  /// empty: there is none.
  std::string add(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return std::isspace((unsigned char)c); }, ' ');
    for (const char* mark : {"<![CDATA[", "]]>", "<!--", "-->"})
      if (const auto at = text.find(mark); at != text.npos)
        text.erase(at, std::string_view(mark).size());
    for (std::size_t at = 0; (at = text.find("/*", at)) != text.npos;)
      text.erase(at, std::min(text.find("*/", at + 2), text.size() - 2) + 2 - at);
    std::string_view rest = text;
    for (std::size_t close = 0; (close = rest.find('}')) != rest.npos;
         rest.remove_prefix(close + 1)) {
      const auto open = rest.find('{');
      if (open > close) continue;
      const std::string_view declarations = rest.substr(open + 1, close - open - 1);
      const auto declares = [&](auto property) { return declarations.find(property) != rest.npos; };
      if (std::ranges::none_of(used, declares)) continue;
      for (const std::string_view one : words_in(rest.substr(0, open), ",")) {
        const std::string selector(trimmed(one));
        if (selector.find_first_of(" *:[>+~@{") != selector.npos ||
            selector.find_first_of(".#", 1) != selector.npos)
          return selector;
        (rules_[selector] += declarations) += ';';
      }
    }
    return "";
  }
  /// The declarations for an element: those of its attributes, of rules, of its own style.
  std::string declarations(const Tag& tag) const {
    std::string all;
    for (const char* property : used) all += fmt::format("{}:{};", property, tag.get(property));
    const auto add = [&](const std::string& selector) {
      if (const auto found = rules_.find(selector); found != rules_.end()) all += found->second;
    };
    add(tag.name);
    const std::string classes = tag.get("class");
    for (const std::string_view one : words_in(classes)) add("." + std::string(one));
    add("#" + tag.get("id"));
    return all + tag.get("style");
  }

 private:
  static constexpr const char* used[] = {"display", "visibility", "transform"};
  std::map<std::string, std::string> rules_;
};

/// The transform of an open element, and whether its contents are drawn.
struct Level {
  Eigen::Affine2d transform = Eigen::Affine2d::Identity();
  bool drawn = true, visible = true;
};

/// The position after a comment, declaration or CDATA that starts at `at`; empty: a tag starts
/// there.
std::optional<std::size_t> skipped(std::string_view text, std::size_t at) {
  for (const auto& [begin, end] :
       {std::pair{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"<!", ">"}})
    if (text.substr(at).starts_with(begin)) {
      const auto found = text.find(end, at);
      return found == text.npos ? text.size() : found + std::string_view(end).size();
    }
  return std::nullopt;
}

class SvgReader {
 public:
  SvgReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Result<PlanDrawing> read() {
    // rules apply to the shapes before them, too
    TRY_DO(each_tag(&SvgReader::add_rules));
    TRY_DO(each_tag(&SvgReader::add));
    if (!is_svg_) return invalid("{}: got no <svg>, expected an SVG", name_);
    std::vector<std::string> counts;
    for (const auto& [kind, count] : others_) counts.push_back(fmt::format("{} {}", count, kind));
    if (!counts.empty()) drawing_.left_out = fmt::format("; not used: {}", fmt::join(counts, ", "));
    return std::move(drawing_);
  }

 private:
  /// Calls a function for each tag.
  Result<void> each_tag(Result<void> (SvgReader::*take)(const Tag&)) {
    std::size_t counted = 0;  // the lines of the text before this position were counted
    line_ = 1;
    for (std::size_t at = text_.find('<'); at < text_.size(); at = text_.find('<', at)) {
      line_ += std::ranges::count(text_.substr(counted, at - counted), '\n');
      counted = at;
      if (const auto next = skipped(text_, at)) {
        at = *next;
        continue;
      }
      const auto end = end_of_tag(text_, at);
      if (end == text_.npos) return invalid("{}: a tag does not end", where());
      after_ = end + 1;
      TRY_DO((this->*take)(tag_of(text_.substr(at + 1, end - at - 1))));
      at = after_;
    }
    return {};
  }

  Result<void> add_rules(const Tag& tag) {
    if (tag.name != "style" || tag.ends || tag.alone) return {};
    const std::string_view rest = text_.substr(after_);
    const std::string selector = styles_.add(std::string(rest.substr(0, rest.find("</"))));
    if (selector.empty()) return {};
    return invalid(
        "{}: <style> may hide or move shapes by \"{}\", expected the name of a tag, a class or an "
        "id: delete hidden shapes, or save a plain SVG",
        where(), selector);
  }

  Result<void> add(const Tag& tag) {
    static const std::set<std::string> hidden{"defs",   "symbol",  "clipPath", "mask",
                                              "marker", "pattern", "metadata"};
    static const std::set<std::string> reported{"text", "image", "use"};
    if (tag.ends) {
      if (levels_.size() > 1) levels_.pop_back();
      return {};
    }
    const std::string style = styles_.declarations(tag);
    const std::string_view turned = value_of("transform", style);
    const auto transform = transform_of(turned);
    if (!transform) return invalid("{}: transform = \"{}\" is not understood", where(), turned);
    const bool outermost = tag.name == "svg" && !is_svg_;
    if (outermost) is_svg_ = true, take_unit(tag, drawing_);
    Level level = levels_.back();
    level.transform = level.transform * *transform;
    if (hidden.contains(tag.name) || value_of("display", style).starts_with("none"))
      level.drawn = false;
    if (const auto seen = value_of("visibility", style); !seen.empty() && seen != "inherit")
      level.visible = seen.starts_with("visible");
    if (!tag.alone) levels_.push_back(level);
    if (!level.drawn) return {};
    if (tag.name == "svg" && !outermost && (tag.get("viewBox") + tag.get("x") + tag.get("y")) != "")
      return invalid("{}: got an <svg> within an <svg>, expected one: ungroup it", where());
    if (!level.visible) return {};
    std::string wrong;
    const auto lines = lines_of(tag, wrong);
    if (!wrong.empty()) return invalid("{}: <{}> has {}", where(), tag.name, wrong);
    if (reported.contains(tag.name)) ++others_[tag.name];
    if (!lines) return {};
    for (PlanLine line : *lines) {
      for (Point& point : line.points) {
        point = level.transform * point;
        point.y() = -point.y();
      }
      drawing_.lines.push_back(std::move(line));
    }
    return {};
  }

  std::string where() const { return fmt::format("{}:{}", name_, line_); }

  std::string_view text_;
  const std::string& name_;
  long line_ = 1;
  std::size_t after_ = 0;  // position after the tag
  StyleRules styles_;
  std::vector<Level> levels_{{}};
  PlanDrawing drawing_;
  std::map<std::string, int> others_;
  bool is_svg_ = false;
};

}  // namespace

Result<PlanDrawing> read_svg(std::string_view bytes, const std::string& name) {
  std::string storage;
  return SvgReader(plain_text(bytes, storage), name).read();
}

}  // namespace gridshell::preset
