#include "engine/formats/svg_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>

namespace gridshell::preset {

std::optional<char> SvgWords::command() {
  skip();
  if (rest_.empty() || !std::isalpha((unsigned char)rest_.front())) return std::nullopt;
  const char letter = rest_.front();
  rest_.remove_prefix(1);
  return letter;
}

std::optional<double> SvgWords::number() {
  skip();
  if (rest_.starts_with('+')) rest_.remove_prefix(1);
  double value = 0;
  const auto read = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
  if (read.ec != std::errc() || !std::isfinite(value)) return std::nullopt;
  rest_.remove_prefix(std::size_t(read.ptr - rest_.data()));
  return value;
}

std::optional<double> SvgWords::flag() {
  skip();
  if (rest_.empty() || (rest_.front() != '0' && rest_.front() != '1')) return std::nullopt;
  const double value = rest_.front() - '0';
  rest_.remove_prefix(1);
  return value;
}

void SvgWords::skip() {
  while (!rest_.empty() && (std::isspace((unsigned char)rest_.front()) || rest_.front() == ','))
    rest_.remove_prefix(1);
}

namespace {

using Point = Eigen::Vector2d;

constexpr int samples_of_a_curve = 64;

/// Reads the lines of a path.
class PathReader {
 public:
  explicit PathReader(std::vector<PlanLine>& lines) : lines_(lines) {}

  /// Reads the text of a path. Returns the error, or an empty text.
  std::string read(const std::string& text) {
    SvgWords words(text);
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

 private:
  std::string follow(char command, SvgWords& words) {
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

  std::vector<PlanLine>& lines_;
  Point at_{0, 0}, begin_{0, 0}, control_{0, 0};
  bool started_ = false;
  char last_ = 0;
};

}  // namespace

std::string read_path(const std::string& text, std::vector<PlanLine>& lines) {
  return PathReader(lines).read(text);
}

std::optional<Eigen::Affine2d> transform_of(std::string_view text) {
  Eigen::Affine2d whole = Eigen::Affine2d::Identity();
  while (text.find('(') != text.npos) {
    const auto open = text.find('('), close = text.find(')', open);
    if (close == text.npos) return std::nullopt;
    std::string name(text.substr(0, open));
    std::erase_if(name, [](char c) { return !std::isalpha((unsigned char)c); });
    std::vector<double> n;
    SvgWords words(std::string(text.substr(open + 1, close - open - 1)));
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

}  // namespace gridshell::preset
