#include "engine/formats/svg_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "engine/core/try.h"
#include "engine/formats/plain_text.h"

namespace gridshell::preset {
namespace {

using Point = Eigen::Vector2d;

/// Reads numbers and commands of an attribute, one after the other.
class Words {
 public:
  explicit Words(std::string text) : text_(std::move(text)), rest_(text_) {}
  Words(const Words&) = delete;

  bool at_end() { return skip(), rest_.empty(); }
  /// The next command; empty: a number is next.
  std::optional<char> command() {
    skip();
    if (rest_.empty() || !std::isalpha((unsigned char)rest_.front())) return std::nullopt;
    const char letter = rest_.front();
    rest_.remove_prefix(1);
    return letter;
  }
  std::optional<double> number() {
    skip();
    if (rest_.starts_with('+')) rest_.remove_prefix(1);
    double value = 0;
    const auto read = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (read.ec != std::errc() || !std::isfinite(value)) return std::nullopt;
    rest_.remove_prefix(std::size_t(read.ptr - rest_.data()));
    return value;
  }
  /// A flag of an arc, 0 or 1; no space is needed after it.
  std::optional<double> flag() {
    skip();
    if (rest_.empty() || (rest_.front() != '0' && rest_.front() != '1')) return std::nullopt;
    const double value = rest_.front() - '0';
    rest_.remove_prefix(1);
    return value;
  }
  std::string_view rest() const { return rest_; }

 private:
  void skip() {
    while (!rest_.empty() && (std::isspace((unsigned char)rest_.front()) || rest_.front() == ','))
      rest_.remove_prefix(1);
  }
  std::string text_;
  std::string_view rest_;
};

constexpr int samples_of_a_curve = 64;

/// Reads the lines of a path.
class PathReader {
 public:
  /// Reads the text of a path. Returns the error, or an empty text.
  std::string read(const std::string& text) {
    Words words(text);
    char command = 0;
    while (!words.at_end()) {
      if (const auto next = words.command())
        command = *next;
      else if (command == 0 || command == 'Z' || command == 'z')
        return "got a number, expected a command";
      if (std::string wrong = follow(command, words); !wrong.empty()) return wrong;
      // further pairs of a move are lines
      if (command == 'M') command = 'L';
      if (command == 'm') command = 'l';
    }
    return "";
  }
  std::vector<PlanLine> take() && { return std::move(lines_); }

 private:
  std::string follow(char command, Words& words) {
    static const std::map<char, int> counts{{'m', 2}, {'l', 2}, {'h', 1}, {'v', 1}, {'c', 6},
                                            {'s', 4}, {'q', 4}, {'t', 2}, {'a', 7}, {'z', 0}};
    const char kind = char(std::tolower((unsigned char)command));
    const auto found = counts.find(kind);
    if (found == counts.end()) return fmt::format("a command '{}'", command);
    std::vector<double> n;
    for (int k = 0; k < found->second; ++k) {
      const auto value = kind == 'a' && (k == 3 || k == 4) ? words.flag() : words.number();
      if (!value) return fmt::format("a '{}' with fewer numbers than {}", command, found->second);
      n.push_back(*value);
    }
    const Point from = command == kind ? at_ : Point(0, 0);
    const auto point = [&](std::size_t k) { return Point(from + Point(n[k], n[k + 1])); };
    if (kind == 'm') return at_ = begin_ = point(0), started_ = false, last_ = kind, "";
    if (kind == 'z') {
      if (started_) lines_.back().closed = true;
      return at_ = begin_, started_ = false, last_ = kind, "";
    }
    if (!std::exchange(started_, true)) lines_.push_back({{at_}, false});
    if (kind == 'l') line(point(0));
    if (kind == 'h') line({from.x() + n[0], at_.y()});
    if (kind == 'v') line({at_.x(), from.y() + n[0]});
    if (kind == 'c') cubic(point(0), point(2), point(4));
    if (kind == 's') cubic(mirrored("cs"), point(0), point(2));
    if (kind == 'q') quadratic(point(0), point(2));
    if (kind == 't') quadratic(mirrored("qt"), point(0));
    if (kind == 'a') arc(std::abs(n[0]), std::abs(n[1]), n[2], n[3] != 0, n[4] != 0, point(5));
    last_ = kind;
    return "";
  }
  /// The last control point mirrored at the current point if the last command is one of `curves`,
  /// else the current point.
  Point mirrored(std::string_view curves) const {
    return curves.find(last_) == curves.npos ? at_ : Point(2 * at_ - control_);
  }
  void line(const Point& to) { lines_.back().points.push_back(at_ = to); }
  void cubic(const Point& a, const Point& b, const Point& to) {
    const Point from = at_;
    for (int k = 1; k <= samples_of_a_curve; ++k) {
      const double t = double(k) / samples_of_a_curve, s = 1 - t;
      line(s * s * s * from + 3 * s * s * t * a + 3 * s * t * t * b + t * t * t * to);
    }
    control_ = b;
  }
  void quadratic(const Point& a, const Point& to) {
    cubic(at_ + 2.0 / 3 * (a - at_), to + 2.0 / 3 * (a - to), to);
    control_ = a;
  }
  /// An arc from its end points to centre and angles, by SVG 1.1, appendix F.6.5.
  void arc(double rx, double ry, double turned_deg, bool large, bool sweep, const Point& to) {
    const Point from = at_;
    if (from == to) return;
    if (rx == 0 || ry == 0) return line(to);
    const Eigen::Rotation2Dd turn(turned_deg * M_PI / 180);
    const Point half = turn.inverse() * Point(0.5 * (from - to));
    const double wide = std::pow(half.x() / rx, 2) + std::pow(half.y() / ry, 2);
    if (wide > 1) rx *= std::sqrt(wide), ry *= std::sqrt(wide);
    const double root =
        std::sqrt(std::max(0.0, 1 / wide - 1)) * (wide > 1 ? 0 : 1) * (large == sweep ? -1 : 1);
    const Point middle(root * rx * half.y() / ry, -root * ry * half.x() / rx);
    const auto angle = [&](const Point& p) {
      return std::atan2((p.y() - middle.y()) / ry, (p.x() - middle.x()) / rx);
    };
    const double begin = angle(half);
    double swept = angle(-half) - begin;
    if (sweep && swept < 0) swept += 2 * M_PI;
    if (!sweep && swept > 0) swept -= 2 * M_PI;
    if (!std::isfinite(swept)) return line(to);
    const Point centre = turn * middle + 0.5 * (from + to);
    const int steps = std::max(1, int(std::ceil(std::abs(swept) * 180 / M_PI)));
    for (int k = 1; k < steps; ++k) {
      const double at = begin + swept * k / steps;
      line(centre + turn * Point(rx * std::cos(at), ry * std::sin(at)));
    }
    line(to);
  }

  std::vector<PlanLine> lines_;
  Point at_{0, 0}, begin_{0, 0}, control_{0, 0};
  bool started_ = false;
  char last_ = 0;
};

/// The transform of a text such as "translate(3 4) rotate(30)"; empty: it is not supported.
std::optional<Eigen::Affine2d> transform_of(std::string_view text) {
  Eigen::Affine2d whole = Eigen::Affine2d::Identity();
  while (text.find('(') != text.npos) {
    const auto open = text.find('('), close = text.find(')', open);
    if (close == text.npos) return std::nullopt;
    std::string name(text.substr(0, open));
    std::erase_if(name, [](char c) { return !std::isalpha((unsigned char)c); });
    std::vector<double> n;
    Words words(std::string(text.substr(open + 1, close - open - 1)));
    while (!words.at_end()) {
      const auto value = words.number();
      if (!value) return std::nullopt;
      n.push_back(*value);
    }
    text.remove_prefix(close + 1);
    Eigen::Affine2d one = Eigen::Affine2d::Identity();
    const auto has = [&](const char* known, std::size_t least, std::size_t most) {
      return name == known && n.size() >= least && n.size() <= most;
    };
    if (has("translate", 1, 2)) {
      one.translate(Point(n[0], n.size() > 1 ? n[1] : 0));
    } else if (has("scale", 1, 2)) {
      one.scale(Point(n[0], n.back()));
    } else if (has("rotate", 1, 3)) {
      const Point about = n.size() == 3 ? Point(n[1], n[2]) : Point(0, 0);
      one.translate(about).rotate(n[0] * M_PI / 180).translate(-about);
    } else if (has("matrix", 6, 6)) {
      one.matrix().topRows<2>() << n[0], n[2], n[4], n[1], n[3], n[5];
    } else if (has("skewX", 1, 1)) {
      one.matrix()(0, 1) = std::tan(n[0] * M_PI / 180);
    } else if (has("skewY", 1, 1)) {
      one.matrix()(1, 0) = std::tan(n[0] * M_PI / 180);
    } else {
      return std::nullopt;
    }
    whole = whole * one;
  }
  return whole;
}

struct Tag {
  std::string name;
  std::map<std::string, std::string> attributes;
  bool ends = false, alone = false;  ///< an end tag </g>; an empty element <path/>

  std::string get(const std::string& key) const {
    const auto found = attributes.find(key);
    return found == attributes.end() ? "" : found->second;
  }
  double number(const std::string& key) const { return Words(get(key)).number().value_or(0); }
};

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
    tag.attributes[key] = std::string(open + 1, close);
    at = close + 1;
  }
  return tag;
}

/// Size of a unit in mm; 0: it is no unit of length.
double unit_of(std::string_view unit) {
  if (unit == "pt") return 25.4 / 72;
  if (unit == "pc") return 25.4 / 6;
  if (unit == "px" || unit.empty()) return 25.4 / 96;
  return millimetres_of(unit);
}

void take_unit(const Tag& svg, PlanDrawing& drawing) {
  drawing.unit_mm = unit_of("px");
  drawing.unit = "in pixels of 1/96 inch, as it names no unit";
  Words width(svg.get("width")), box(svg.get("viewBox"));
  const auto wide = width.number();
  std::vector<double> sides;
  while (const auto value = box.number()) sides.push_back(*value);
  const double unit = unit_of(width.rest());
  if (!wide || *wide <= 0 || unit <= 0 || width.rest().empty()) return;
  const double over = sides.size() == 4 && sides[2] > 0 ? sides[2] : *wide;
  drawing.unit_mm = *wide * unit / over;
  drawing.unit = fmt::format("{} wide as it says", svg.get("width"));
}

/// The lines of a shape; empty if the tag is no shape. `wrong` receives the error of an invalid
/// shape.
std::optional<std::vector<PlanLine>> lines_of(const Tag& tag, std::string& wrong) {
  if (tag.name == "path") {
    PathReader path;
    wrong = path.read(tag.get("d"));
    return std::move(path).take();
  }
  PlanLine line{{}, tag.name != "polyline" && tag.name != "line"};
  if (tag.name == "polygon" || tag.name == "polyline") {
    Words words(tag.get("points"));
    while (!words.at_end()) {
      const auto x = words.number(), y = words.number();
      if (!x || !y) return wrong = "a point of fewer than two numbers", std::nullopt;
      line.points.emplace_back(*x, *y);
    }
  } else if (tag.name == "line") {
    line.points = {{tag.number("x1"), tag.number("y1")}, {tag.number("x2"), tag.number("y2")}};
  } else if (tag.name == "rect") {
    const Point low(tag.number("x"), tag.number("y"));
    const double w = tag.number("width"), h = tag.number("height");
    line.points = {low, low + Point(w, 0), low + Point(w, h), low + Point(0, h)};
  } else if (tag.name == "circle" || tag.name == "ellipse") {
    const double rx = tag.number(tag.name == "circle" ? "r" : "rx"),
                 ry = tag.number(tag.name == "circle" ? "r" : "ry");
    for (int k = 0; k < 360; ++k)
      line.points.emplace_back(tag.number("cx") + rx * std::cos(k * M_PI / 180),
                               tag.number("cy") + ry * std::sin(k * M_PI / 180));
  } else {
    return std::nullopt;
  }
  return std::vector<PlanLine>{std::move(line)};
}

/// The transform of an open element, and whether its contents are drawn.
struct Level {
  Eigen::Affine2d transform = Eigen::Affine2d::Identity();
  bool drawn = true;
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

}  // namespace

Result<PlanDrawing> read_svg(std::string_view bytes, const std::string& name) {
  static const std::set<std::string> hidden{"defs",   "symbol",  "clipPath", "mask",
                                            "marker", "pattern", "metadata"};
  static const std::set<std::string> reported{"text", "image", "use"};
  std::string storage;
  const std::string_view text = plain_text(bytes, storage);
  PlanDrawing drawing;
  std::map<std::string, int> others;
  std::vector<Level> levels{{}};
  bool is_svg = false;
  std::size_t counted = 0;  // the lines of the text before this position were counted
  long number = 1;
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    number += std::ranges::count(text.substr(counted, at - counted), '\n');
    counted = at;
    const auto where = [&] { return fmt::format("{}:{}", name, number); };
    if (const auto next = skipped(text, at)) {
      at = *next;
      continue;
    }
    const auto end = text.find('>', at);
    if (end == text.npos) return invalid("{}: a tag does not end", where());
    const Tag tag = tag_of(text.substr(at + 1, end - at - 1));
    at = end + 1;
    if (tag.ends) {
      if (levels.size() > 1) levels.pop_back();
      continue;
    }
    if (tag.name == "svg" && !std::exchange(is_svg, true)) take_unit(tag, drawing);
    const auto transform = transform_of(tag.get("transform"));
    if (!transform)
      return invalid("{}: transform = \"{}\" is not understood", where(), tag.get("transform"));
    std::string style = tag.get("style") + ";display:" + tag.get("display");
    std::erase(style, ' ');
    const Level level{levels.back().transform * *transform,
                      levels.back().drawn && !hidden.contains(tag.name) &&
                          style.find("display:none") == style.npos};
    if (!tag.alone) levels.push_back(level);
    if (!level.drawn) continue;
    std::string wrong;
    const auto lines = lines_of(tag, wrong);
    if (!wrong.empty()) return invalid("{}: <{}> has {}", where(), tag.name, wrong);
    if (reported.contains(tag.name)) ++others[tag.name];
    if (!lines) continue;
    for (PlanLine line : *lines) {
      for (Point& point : line.points) {
        point = level.transform * point;
        point.y() = -point.y();
      }
      drawing.lines.push_back(std::move(line));
    }
  }
  if (!is_svg) return invalid("{}: got no <svg>, expected an SVG", name);
  std::vector<std::string> counts;
  for (const auto& [kind, count] : others) counts.push_back(fmt::format("{} {}", count, kind));
  if (!counts.empty()) drawing.left_out = fmt::format("; not used: {}", fmt::join(counts, ", "));
  return drawing;
}

}  // namespace gridshell::preset
