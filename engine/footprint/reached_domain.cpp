// The domain of a net that was marched over a surface: the part that its rods reach.

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/footprint/domains.h"

namespace gridshell {
namespace {

class ReachedPart final : public Domain {
 public:
  explicit ReachedPart(std::shared_ptr<const MarchedNet> net) : net_(std::move(net)) {
    net_->grid().each_known([&](int i, int j) {
      reach_ = std::max({reach_, std::abs(i), std::abs(j)});
    });
    trace();
  }

  std::vector<Interval> intervals(Family family, double c) const override {
    const auto on_line = [&](double s) {
      return family == Family::u ? Eigen::Vector2d(s, c) : Eigen::Vector2d(c, s);
    };
    const double step = net_->chord() / 2;
    std::vector<Interval> pieces;
    // consecutive positions along the line that can be on one rod
    std::vector<std::pair<double, Eigen::Vector3d>> run;
    const auto end_run = [&] {
      // near an edge the net may be rough, so that the rod would not be as long as its path
      const auto rough = [&](std::size_t a, std::size_t b) {
        return !net_->joined(run[a].second, run[b].second, step, exact);
      };
      std::size_t first = 0, last = run.empty() ? 0 : run.size() - 1;
      while (first < last && first < most_trimmed && rough(first, first + 1)) ++first;
      for (int k = 0; first < last && k < int(most_trimmed) && rough(last - 1, last); ++k) --last;
      if (first < last)
        pieces.push_back({end_from(on_line, run[first].first, run[first].second, -1),
                          end_from(on_line, run[last].first, run[last].second, 1)});
      run.clear();
    };
    const int last = 2 * (reach_ + 1);
    for (int k = -last; k <= last; ++k) {
      const double s = k * step;
      const auto here = position(on_line(s));
      if (!run.empty() && !(here && net_->joined(run.back().second, *here, step, usual))) end_run();
      if (here) run.emplace_back(s, *here);
    }
    end_run();
    for (Interval& piece : pieces) {
      piece.begin = off_node(piece.begin, 1);
      piece.end = off_node(piece.end, -1);
    }
    std::erase_if(pieces, [&](const Interval& one) {
      return one.end - one.begin < shortest * net_->chord();
    });
    return pieces;
  }

  Eigen::Matrix2Xd boundary(int points) const override {
    // points of the traced ring next to evenly spaced positions along it
    Eigen::Matrix2Xd ring(2, points);
    for (int k = 0; k < points; ++k) {
      const double at = ring_length_.back() * k / points;
      const auto found = std::ranges::lower_bound(ring_length_, at) - ring_length_.begin();
      ring.col(k) = ring_[std::size_t(found) % ring_.size()];
    }
    return ring;
  }

  double reach() const override { return (reach_ + 1) * net_->chord(); }

 private:
  // allowed relative difference between the distance of two points and the length of the rod there
  static constexpr double usual = 0.02, exact = 0.003;
  static constexpr std::size_t most_trimmed = 6;  // half chords that are cut off a rough end
  static constexpr double shortest = 4;           // chords of the shortest rod: half the spacing

  std::optional<Eigen::Vector3d> position(const Eigen::Vector2d& uv) const {
    const auto point = net_->reached(uv.x(), uv.y());
    return point ? std::optional(point->position) : std::nullopt;
  }

  /// Moves the end of a rod inward if it is at a node of the grid. Joints are on nodes, so a leg to
  /// a joint at such an end would have almost no length.
  double off_node(double s, int inward) const {
    constexpr double at_node = 0.02, before = 0.4;
    const double nodes = s / net_->chord();
    return std::abs(nodes - std::round(nodes)) < at_node ? s + inward * before * net_->chord() : s;
  }

  /// Position up to which a line continues from its position s, which is at p in space; `side` is 1
  /// or -1.
  template <class Line>
  double end_from(const Line& on_line, double s, const Eigen::Vector3d& p, int side) const {
    const auto goes_on = [&](double distance) {
      const auto there = position(on_line(s + side * distance));
      return there && net_->joined(p, *there, distance, exact);
    };
    double inside = 0, outside = net_->chord() / 2;
    while (outside - inside > 1e-13 * reach()) {
      const double middle = 0.5 * (inside + outside);
      if (middle <= inside || middle >= outside) break;
      (goes_on(middle) ? inside : outside) = middle;
    }
    return s + side * inside;
  }

  /// Computes the points where the outer edge crosses the lines of the grid (marching squares).
  void trace() {
    const MarchedGrid& grid = net_->grid();
    const double h = net_->chord();
    const auto known = [&](int i, int j) { return grid.known(i, j); };
    // start at the outermost known node in direction +u
    int i = 0;
    while (known(i + 1, 0)) ++i;
    std::array<int, 2> node{i, 0};
    int heading = 0;  // direction to the neighbour that is not known: +u, +v, -u, -v
    constexpr std::array<std::array<int, 2>, 4> headings{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    const auto start = node;
    const int start_heading = heading;
    do {
      const Eigen::Vector2d at = h * Eigen::Vector2d(node[0], node[1]);
      const auto [du, dv] = headings[std::size_t(heading)];
      const auto on_line = [&, du = du, dv = dv](double s) -> Eigen::Vector2d {
        return at + s * Eigen::Vector2d(du, dv);
      };
      double end = 0;
      for (const double from : {0.0, h / 2}) {
        const auto p = position(on_line(from));
        if (!p || (from > 0 && end < 0.999 * from)) break;
        end = end_from(on_line, from, *p, 1);
      }
      ring_.push_back(on_line(end));
      // turn left around this node, continue along the next one, or go around a concave corner
      const auto [lu, lv] = headings[std::size_t((heading + 1) % 4)];
      if (!known(node[0] + lu, node[1] + lv)) {
        heading = (heading + 1) % 4;
      } else if (!known(node[0] + lu + du, node[1] + lv + dv)) {
        node = {node[0] + lu, node[1] + lv};
      } else {
        node = {node[0] + lu + du, node[1] + lv + dv};
        heading = (heading + 3) % 4;
      }
    } while (node != start || heading != start_heading);
    ring_length_.push_back(0);
    for (std::size_t k = 1; k <= ring_.size(); ++k)
      ring_length_.push_back(ring_length_.back() + (ring_[k % ring_.size()] - ring_[k - 1]).norm());
  }

  std::shared_ptr<const MarchedNet> net_;
  int reach_ = 0;  // largest |i| or |j| of a known node
  std::vector<Eigen::Vector2d> ring_;
  std::vector<double> ring_length_;  // length of the ring up to each point, last its total length
};

}  // namespace

std::unique_ptr<Domain> reached_part(std::shared_ptr<const MarchedNet> net) {
  return std::make_unique<ReachedPart>(std::move(net));
}

}  // namespace gridshell
