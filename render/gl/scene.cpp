#include "render/gl/scene.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "render/gl/image.h"
#include "render/gl/laths.h"

namespace gridshell::render {
namespace {

// errors in pixels by which pieces may be longer than the edges of a mesh: of rods, where they
// show, and of cells, whose sides are hidden by rods
struct Tolerance {
  double rod_pixels, cell_pixels;
};
constexpr Tolerance fine{0.02, 0.25}, coarse{0.5, 1};

using Points = std::vector<Eigen::Vector3f>;
using Colours = std::vector<Eigen::Vector4f>;

/// Rods, rings and joints are never translucent.
Eigen::Vector4f opaque(const Colour& c) { return to_linear({c.r, c.g, c.b, 1}); }

/// A radius as drawn: no thinner than a sample.
float radius_of(double diameter_mm, double mm_per_sample) {
  return float(0.5 * std::max(diameter_mm, 1.1 * mm_per_sample));
}

Points points_of(const Eigen::Matrix3Xd& nodes, const std::vector<int>& rod) {
  Points points;
  for (int node : rod) points.push_back(nodes.col(node).cast<float>());
  return points;
}

/// Which nodes are joints, and the cells on either side of a rod's segment between two joints.
class Neighbours {
 public:
  Neighbours(const record::Layout& layout, Eigen::Index nodes) : joint_(std::size_t(nodes)) {
    for (const record::Joint& joint : layout.joints) joint_[std::size_t(joint.node)] = 1;
    for (int c = 0; c < int(layout.cells.size()); ++c)
      for (int k = 0; k < 4; ++k) {
        const auto& corners = layout.cells[c].joints;
        const int a = layout.joints[corners[k]].node, b = layout.joints[corners[(k + 1) % 4]].node;
        sides_.push_back({std::min(a, b), std::max(a, b), c});
      }
    std::ranges::sort(sides_);
  }
  bool joint(int node) const { return joint_[std::size_t(node)] != 0; }
  /// Sides of cells between the nodes a and b of two joints: {node, node, cell}.
  std::span<const std::array<int, 3>> cells(int a, int b) const {
    const auto found =
        std::ranges::equal_range(sides_, std::pair(std::min(a, b), std::max(a, b)), {},
                                 [](const auto& side) { return std::pair(side[0], side[1]); });
    return {found.begin(), found.end()};
  }

 private:
  std::vector<char> joint_;
  std::vector<std::array<int, 3>> sides_;
};

/// Collects the pieces of a scene, each with its depth along the view, and orders them.
class Weaver {
 public:
  Weaver(Scene& scene, const Drawing& drawing, const Camera& camera, double mm_per_sample,
         const DrawQuality& quality)
      : scene_(scene),
        drawing_(drawing),
        camera_(camera),
        forward_(camera_axes(camera).forward),
        mm_per_sample_(mm_per_sample),
        quality_(quality),
        tolerance_(quality.coarse ? coarse : fine) {}

  void add_cell_patches() {
    cell_depth_.assign(drawing_.layout->cells.size(), INFINITY);
    if (drawing_.cell_colours.empty()) return;
    Colours colours(drawing_.cell_colours.size());
    std::transform(drawing_.cell_colours.begin(), drawing_.cell_colours.end(), colours.begin(),
                   [](const Colour& c) { return to_linear(c); });
    auto patches =
        render::add_cell_patches(scene_.sheets, *drawing_.layout, drawing_.nodes, colours,
                                 float(tolerance_.cell_pixels * mm_per_pixel()));
    for (CellPatch& patch : patches) {
      double depth = 0;
      for (int joint : drawing_.layout->cells[patch.cell].joints)
        depth += 0.25 * forward_.dot(drawing_.nodes.col(drawing_.layout->joints[joint].node));
      cell_depth_[patch.cell] = depth;
      sheets_.push_back({depth, std::move(patch.indices)});
    }
  }

  /// Adds the rods in segments between joints. A segment has the depth of the nearer of the cells
  /// next to it, so that these do not cover half of it, and a joint that of its nearest segment.
  void add_rods() {
    const Neighbours neighbours(*drawing_.layout, drawing_.nodes.cols());
    Points normals;
    node_depth_.assign(std::size_t(drawing_.nodes.cols()), INFINITY);
    Colours of_node(drawing_.node_colours.size());
    std::ranges::transform(drawing_.node_colours, of_node.begin(), opaque);
    const Eigen::Vector4f plain = opaque(drawing_.rod_colour);
    for (std::size_t r = 0; r < drawing_.layout->rods.size(); ++r) {
      const auto& rod = drawing_.layout->rods[r];
      if (rod.size() < 2) continue;
      const float radius = radius_of(
          record::thickness_of(*drawing_.layout, r) * drawing_.rod_diameter_mm, mm_per_sample_);
      Colours colours;
      for (int node : rod) colours.push_back(of_node.empty() ? plain : of_node[node]);
      const Points points = points_of(drawing_.nodes, rod);
      const Ribbon ribbon{points, colours, {&radius, 1}};
      const Eigen::Vector2f size = lath_size(drawing_, r);
      const bool lath = size.minCoeff() > 0;
      const std::uint32_t first = lath ? 0 : add_ribbon(scene_.ribbons, ribbon);
      if (lath && normals.empty()) normals = shell_normals(drawing_);
      const Points of_lath = lath ? lath_normals(drawing_, r, normals) : Points();
      for (std::size_t begin = 0; begin + 1 < rod.size();) {
        std::size_t end = begin + 1;
        while (end + 1 < rod.size() && !neighbours.joint(rod[end])) ++end;
        double depth =
            0.5 * forward_.dot(drawing_.nodes.col(rod[begin]) + drawing_.nodes.col(rod[end]));
        for (const auto& side : neighbours.cells(rod[begin], rod[end]))
          depth = std::min(depth, cell_depth_[side[2]]);
        for (int node : {rod[begin], rod[end]})
          node_depth_[node] = std::min(node_depth_[node], depth);
        if (lath)
          add_box({{&points[begin], end - begin + 1},
                   {&of_lath[begin], end - begin + 1},
                   {&colours[begin], end - begin + 1},
                   size.cwiseMax(float(1.1 * mm_per_sample_))},
                  depth);
        else
          add_stretch(ribbon, first, int(begin), int(end), depth, true);
        begin = end;
      }
    }
  }

  /// Adds a lath's piece to the sheets, so that it casts a shadow and its cells do not cover it.
  void add_box(const LathPiece& piece, double depth) {
    const Lighting light = lighting_passes(camera_, 1).front();
    LathView view;
    view.orthographic = camera_.field_of_view_deg <= 0;
    view.eye = (view.orthographic ? Eigen::Vector3d(-forward_)
                                  : camera_.target - camera_distance(camera_) * forward_)
                   .cast<float>();
    view.light = drawing_.node_colours.empty() ? &light : nullptr;
    sheets_.push_back({depth - 1e-6, add_lath(scene_.sheets, piece, view)});
  }

  void add_joints() {
    const double least_mm = quality_.coarse ? 2 * mm_per_sample_ : 0;  // smaller ones are left out
    if (drawing_.joint_diameter_mm <= least_mm) return;
    const auto normals = shell_normals(drawing_);
    const float radius = radius_of(drawing_.joint_diameter_mm, mm_per_sample_);
    const Eigen::Vector4f colour = opaque(drawing_.joint_colour);
    const auto& [joints, above] = std::tie(drawing_.layout->joints, drawing_.layout->above);
    // a joint with a single rod, as networks have, is not drawn
    std::vector<int> rods_at(above.empty() ? std::size_t(drawing_.nodes.cols()) : 0),
        last_rod(rods_at.size(), -1);
    if (above.empty())
      for (int r = 0; r < int(drawing_.layout->rods.size()); ++r)
        for (const int node : drawing_.layout->rods[std::size_t(r)])
          if (std::exchange(last_rod[std::size_t(node)], r) != r) ++rods_at[std::size_t(node)];
    for (std::size_t k = 0; k < joints.size(); ++k) {
      const int joint = joints[k].node;
      if (above.empty() && rods_at[std::size_t(joint)] < 2) continue;
      const float length = normals[joint].norm();
      const Eigen::Vector3f axis =
          length > 1e-6f ? Eigen::Vector3f(normals[joint] / length) : Eigen::Vector3f::UnitZ();
      // if rods are above one another, a joint has two nodes, the ends of its bolt
      for (const int node : std::set{joint, above.empty() ? joint : above[k]}) {
        const Eigen::Vector3f at = drawing_.nodes.col(node).cast<float>();
        const double depth = std::min(node_depth_[node], forward_.dot(drawing_.nodes.col(node)));
        beads_.push_back(
            {depth, add_bead(scene_.beads, at, axis, radius, BeadShape::cylinder, colour)});
        if (quality_.shadow) add_bead_shadow(at, axis, radius);
      }
    }
  }

  void add_rings() {
    for (const Ring& ring : drawing_.rings) {
      Points points(ring.points.cols());
      for (int k = 0; k < int(points.size()); ++k) points[k] = ring.points.col(k).cast<float>();
      // a last point that repeats the first would be an edge without length
      while (points.size() > 1 && (points.back() - points.front()).norm() < 1e-6f)
        points.pop_back();
      if (points.size() < 3) continue;
      const Colours colours(points.size(), opaque(ring.colour));
      const float radius = radius_of(ring.diameter_mm, mm_per_sample_);
      const Ribbon ribbon{points, colours, {&radius, 1}, true};
      const std::uint32_t first = add_ribbon(scene_.ribbons, ribbon);
      for (int k = 0, n = int(points.size()), next = 0; k < n; k = next) {
        next = quality_.coarse ? longest_straight_piece(ribbon, k, n, rod_tolerance()) : k + 1;
        Piece piece{forward_.dot(points[k].cast<double>()), {}};
        add_strip_quad(piece.indices, first, k, next % n);
        if (ring.shadow && quality_.shadow) insert(scene_.casters, piece.indices);
        ribbons_.push_back(std::move(piece));
      }
    }
  }

  void add_ghosts() {
    constexpr int edges = 4;
    for (const GhostRods& ghost : drawing_.ghosts) {
      const float radius = radius_of(ghost.diameter_mm, mm_per_sample_);
      for (const auto& rod : ghost.rods) {
        if (rod.size() < 2) continue;
        const Points points = points_of(ghost.nodes, rod);
        const Colours colours(points.size(), to_linear(ghost.colour));
        const Ribbon ribbon{points, colours, {&radius, 1}};
        const std::uint32_t first = add_ribbon(scene_.ribbons, ribbon);
        for (int begin = 0, last = int(rod.size()) - 1; begin < last; begin += edges) {
          const int end = std::min(begin + edges, last);
          add_stretch(
              ribbon, first, begin, end,
              0.5 * forward_.dot((points[begin] + points[end]).cast<double>()) + ghost.behind_mm,
              false);
        }
      }
    }
  }

  void add_arrows() {
    constexpr float head_width = 2.8f, head_length = 9;  // over the shaft's radius
    for (const Arrow& arrow : drawing_.arrows) {
      const Eigen::Vector3f from = arrow.from.cast<float>(), to = arrow.to.cast<float>();
      const float radius = radius_of(arrow.diameter_mm, mm_per_sample_),
                  length = (to - from).norm();
      const Eigen::Vector3f along = (to - from).stableNormalized();
      const Eigen::Vector3f neck = to - std::min(head_length * radius, 0.6f * length) * along;
      // the head is a strip of its own that narrows to its tip
      const Points points{from, neck, neck, to};
      const std::vector<float> radii{radius, radius, head_width * radius, 0.05f * radius};
      const Colours colours(4, opaque(arrow.colour));
      const Ribbon ribbon{points, colours, radii};
      const std::uint32_t first = add_ribbon(scene_.ribbons, ribbon);
      for (const int begin : {0, 2})
        add_stretch(ribbon, first, begin, begin + 1, forward_.dot(arrow.to) - radius, arrow.shadow);
    }
  }

  void add_marks() {
    for (const PointMark& mark : drawing_.marks) {
      const auto radius = float(0.5 * mark.diameter_mm);
      beads_.push_back(
          {forward_.dot(mark.at) - radius - (mark.over ? drawing_.layout->spacing_mm : 0),
           add_bead(scene_.beads, mark.at.cast<float>(), Eigen::Vector3f::UnitZ(), radius,
                    BeadShape::ball, opaque(mark.colour))});
    }
  }

  /// Orders the pieces from far to near and divides them into layers of equal depth.
  void finish() {
    const int most_layers = quality_.coarse && beads_.empty() ? 8 : 32;
    double near = INFINITY, far = -INFINITY;
    for (auto* pieces : {&sheets_, &ribbons_, &beads_}) {
      std::ranges::stable_sort(*pieces,
                               [](const Piece& a, const Piece& b) { return a.depth > b.depth; });
      if (pieces->empty()) continue;
      far = std::max(far, pieces->front().depth);
      near = std::min(near, pieces->back().depth);
    }
    // ribbons alone are in the right order already
    const int layers = sheets_.empty() && beads_.empty() ? 1 : most_layers;
    std::size_t sheet = 0, ribbon = 0, bead = 0;
    for (int k = 1; k <= layers; ++k) {
      scene_.layers.push_back({scene_.sheets.indices.size(), scene_.ribbons.indices.size(),
                               scene_.beads.indices.size()});
      const double until = k == layers ? -INFINITY : far + (near - far) * k / layers;
      take(sheets_, sheet, until, scene_.sheets.indices);
      take(ribbons_, ribbon, until, scene_.ribbons.indices);
      take(beads_, bead, until, scene_.beads.indices);
    }
    scene_.layers.push_back(
        {scene_.sheets.indices.size(), scene_.ribbons.indices.size(), scene_.beads.indices.size()});
  }

 private:
  struct Piece {
    double depth = 0;
    std::vector<std::uint32_t> indices;
  };
  static void insert(std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>& from) {
    to.insert(to.end(), from.begin(), from.end());
  }
  static void take(const std::vector<Piece>& pieces, std::size_t& next, double until,
                   std::vector<std::uint32_t>& indices) {
    for (; next < pieces.size() && pieces[next].depth >= until; ++next)
      insert(indices, pieces[next].indices);
  }
  double mm_per_pixel() const { return quality_.supersample * mm_per_sample_; }
  float rod_tolerance() const { return float(tolerance_.rod_pixels * mm_per_pixel()); }
  void add_stretch(const Ribbon& ribbon, std::uint32_t first, int begin, int end, double depth,
                   bool casts) {
    Piece piece{depth, {}};
    for (int k = begin, next = begin; k < end; k = next) {
      next = longest_straight_piece(ribbon, k, end, rod_tolerance());
      add_strip_quad(piece.indices, first, k, next);
    }
    // shadows have all edges, since small changes show where a shadow just touches a rod
    for (int k = begin; casts && quality_.shadow && k < end; ++k)
      add_strip_quad(scene_.casters, first, k, k + 1);
    ribbons_.push_back(std::move(piece));
  }
  /// Adds a short strip as wide as a bead, which casts the bead's shadow.
  void add_bead_shadow(const Eigen::Vector3f& at, const Eigen::Vector3f& axis, float radius) {
    const Eigen::Vector3f half = 5.f / 3 * radius * axis;
    const Points points{at - half, at + half};
    const Colours colours(2, {0, 0, 0, 1});
    const std::uint32_t first = add_ribbon(scene_.ribbons, {points, colours, {&radius, 1}});
    add_strip_quad(scene_.casters, first, 0, 1);
  }

  Scene& scene_;
  const Drawing& drawing_;
  const Camera& camera_;
  Eigen::Vector3d forward_;
  double mm_per_sample_;
  const DrawQuality& quality_;
  Tolerance tolerance_;
  std::vector<double> cell_depth_, node_depth_;
  std::vector<Piece> sheets_, ribbons_, beads_;
};

void enclose(Scene& scene) {
  Eigen::AlignedBox3f box;
  float widest = 0;
  for (const Mesh* mesh : {&scene.sheets, &scene.ribbons, &scene.beads})
    for (const Vertex& v : mesh->vertices) {
      box.extend(v.position);
      widest = std::max(widest, radius_mm(v));
    }
  if (box.isEmpty()) box.extend(Eigen::Vector3f::Zero());
  const double room = 1e-3 + double(widest);
  scene.low = box.min().cast<double>() - Eigen::Vector3d::Constant(room);
  scene.high = box.max().cast<double>() + Eigen::Vector3d::Constant(room);
}

}  // namespace

double Scene::radius() const { return 0.5 * (high - low).norm(); }

Result<Scene> make_scene(const Drawing& drawing, const Camera& camera, double mm_per_sample,
                         const DrawQuality& quality) {
  if (const std::string fault = drawing_error(drawing); !fault.empty())
    return invalid("the drawing " + fault);
  Scene scene;
  Weaver weaver(scene, drawing, camera, mm_per_sample, quality);
  weaver.add_cell_patches();
  weaver.add_rods();
  weaver.add_rings();
  weaver.add_joints();
  weaver.add_arrows();
  weaver.add_marks();
  weaver.add_ghosts();
  weaver.finish();
  enclose(scene);
  return scene;
}

}  // namespace gridshell::render
