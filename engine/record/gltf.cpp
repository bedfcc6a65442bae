#include "engine/core/try.h"
#include "engine/record/shape_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/core/json.h"

namespace gridshell::exports {
namespace {

constexpr std::size_t most_shapes = 60, most_model_bytes = 20'000'000;

// constants of the glTF format
constexpr int type_float = 5126, type_uint = 5125, for_vertices = 34962, for_indices = 34963;

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

/// Builds the binary part of the file, with the views and accessors into it.
class Buffer {
 public:
  Json views = Json::array(), accessors = Json::array();

  /// Adds 3 x n positions or directions with their bounds. Each function returns its accessor.
  int vectors(const Eigen::Matrix3Xd& values, int target = for_vertices) {
    const Eigen::Matrix3Xf single = values.cast<float>();
    const int view = add(single.data(), 4 * std::size_t(single.size()), target);
    Json accessor = accessor_of(view, type_float, single.cols(), "VEC3");
    const Eigen::Vector3f low = single.rowwise().minCoeff(), high = single.rowwise().maxCoeff();
    accessor["min"] = {low.x(), low.y(), low.z()};
    accessor["max"] = {high.x(), high.y(), high.z()};
    return keep(std::move(accessor));
  }
  int colours(const std::vector<std::array<float, 4>>& values) {
    const int view = add(values.data(), 16 * values.size(), for_vertices);
    return keep(accessor_of(view, type_float, Eigen::Index(values.size()), "VEC4"));
  }
  int triangles(const std::vector<std::array<std::uint32_t, 3>>& values) {
    const int view = add(values.data(), 12 * values.size(), for_indices);
    return keep(accessor_of(view, type_uint, 3 * Eigen::Index(values.size()), "SCALAR"));
  }
  int scalars(const std::vector<float>& values) {
    const int view = add(values.data(), 4 * values.size(), 0);
    Json accessor = accessor_of(view, type_float, Eigen::Index(values.size()), "SCALAR");
    const auto [low, high] = std::ranges::minmax(values);
    accessor["min"] = {low};
    accessor["max"] = {high};
    return keep(std::move(accessor));
  }
  const std::string& bytes() const { return bytes_; }

 private:
  int add(const void* data, std::size_t size, int target) {
    Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
    if (target != 0) view["target"] = target;
    bytes_.append(static_cast<const char*>(data), size);
    views.push_back(std::move(view));
    return int(views.size()) - 1;
  }
  static Json accessor_of(int view, int component, Eigen::Index count, const char* type) {
    return {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}};
  }
  int keep(Json accessor) {
    accessors.push_back(std::move(accessor));
    return int(accessors.size()) - 1;
  }
  std::string bytes_;
};

/// A surface of triangles: all rods, all cells, or a joint.
struct Surface {
  Eigen::Matrix3Xd vertices, normals;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// All rods as tubes with `sides` sides.
Surface tubes(const record::Layout& layout, const record::Frame& frame, int sides) {
  Surface all;
  Eigen::Index size = 0;
  for (const auto& rod : layout.rods) size += Eigen::Index(rod.size()) * sides + 2;
  all.vertices.resize(3, size);
  all.normals.resize(3, size);
  Eigen::Index first = 0;
  for (std::size_t rod = 0; rod < layout.rods.size(); ++rod) {
    const Tube tube =
        tube_around(rod_points(layout, frame, rod), record::diameter_of(layout, rod) / 2, sides);
    all.vertices.middleCols(first, tube.vertices.cols()) = tube.vertices;
    all.normals.middleCols(first, tube.vertices.cols()) = tube.normals;
    for (const auto& [a, b, c] : tube.triangles)
      all.triangles.push_back(
          {std::uint32_t(first + a), std::uint32_t(first + b), std::uint32_t(first + c)});
    first += tube.vertices.cols();
  }
  return all;
}

/// All cells, each with vertices of its own.
Surface cells(const record::Layout& layout, const record::Frame& frame) {
  Surface all;
  all.vertices.resize(3, 4 * Eigen::Index(layout.cells.size()));
  all.normals.resize(3, all.vertices.cols());
  for (std::size_t cell = 0; cell < layout.cells.size(); ++cell) {
    const auto corners = cell_corners(layout, frame, cell);
    const Eigen::Vector3d a = corners.col(2) - corners.col(0), b = corners.col(3) - corners.col(1);
    const Eigen::Index first = 4 * Eigen::Index(cell);
    all.vertices.middleCols<4>(first) = corners;
    all.normals.middleCols<4>(first).colwise() = a.cross(b).normalized();
    const auto at = std::uint32_t(first);
    all.triangles.push_back({at, at + 1, at + 2});
    all.triangles.push_back({at, at + 2, at + 3});
  }
  return all;
}

/// A small ball about the origin.
Surface ball(double radius_mm) {
  constexpr int around = 10, up = 6;
  Surface all;
  all.normals.resize(3, (up + 1) * around);
  for (int row = 0; row <= up; ++row)
    for (int k = 0; k < around; ++k) {
      const double latitude = M_PI * (double(row) / up - 0.5), longitude = 2 * M_PI * k / around;
      all.normals.col(row * around + k) << std::cos(latitude) * std::cos(longitude),
          std::cos(latitude) * std::sin(longitude), std::sin(latitude);
    }
  all.vertices = radius_mm * all.normals;
  for (int row = 0; row < up; ++row)
    for (int k = 0; k < around; ++k) {
      const auto a = std::uint32_t(row * around + k),
                 b = std::uint32_t(row * around + (k + 1) % around);
      all.triangles.push_back({a, b, b + around});
      all.triangles.push_back({a, b + around, a + around});
    }
  return all;
}

/// Number of sides of the tubes and of key shapes.
struct ModelDetail {
  int sides = 0;
  std::size_t shapes = 0;
};

/// An upper bound of the size of the file, bytes.
std::size_t size_bound(const record::Layout& layout, const ModelDetail& detail) {
  // of an array of data in the text: its accessor with the bounds, and its view
  constexpr std::size_t accessor = 400, vector = 12, triangle = 12, colour = 16;
  constexpr std::size_t fixed = 20'000;  // a ball, materials and titles
  const std::size_t joints = layout.joints.size(), cells = layout.cells.size(),
                    tube = std::size_t(points_of_rods(layout) * detail.sides),
                    vertices = tube + 2 * layout.rods.size() + 4 * cells;
  const std::size_t once =
      fixed + triangle * (2 * tube + 2 * cells) + colour * 4 * cells + joints * (accessor + 300);
  const std::size_t a_shape = 2 * vector * vertices + 4 * (accessor + 50) + vector * joints +
                              4 * (1 + detail.shapes);  // time and weights
  return once + detail.shapes * a_shape;
}

/// The finest detail with which the file is smaller than most_model_bytes: fewer sides are tried
/// before fewer shapes.
Result<ModelDetail> model_detail(const record::Trajectory& run) {
  const auto fits = [&](const ModelDetail& detail) {
    return size_bound(run.layout, detail) <= most_model_bytes;
  };
  ModelDetail detail{8, std::min(most_shapes, run.frames.size())};
  while (detail.sides > 4 && !fits(detail)) detail.sides -= 2;
  while (detail.shapes > 0 && !fits(detail)) --detail.shapes;
  if (detail.shapes > 0) return detail;
  return invalid("one shape of {} points takes more than {} MB as .glb", points_of_rods(run.layout),
                 most_model_bytes / 1'000'000);
}

Json material(const char* name, std::array<double, 4> colour, bool two_sided) {
  return {{"name", name},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", colour}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.6}}},
          {"doubleSided", two_sided}};
}

/// A mesh with morph targets: its first shape, and the differences of the other shapes from it.
class MorphingMesh {
 public:
  MorphingMesh(const char* name, const Surface& first, int material, Buffer& buffer)
      : name_(name), first_(first), material_(material), buffer_(buffer) {}

  void add(const Surface& shape) {
    targets_.push_back({{"POSITION", buffer_.vectors(shape.vertices - first_.vertices)},
                        {"NORMAL", buffer_.vectors(shape.normals - first_.normals)}});
  }
  Json mesh(const std::vector<std::array<float, 4>>& colours) {
    Json primitive = {{"attributes",
                       {{"POSITION", buffer_.vectors(first_.vertices)},
                        {"NORMAL", buffer_.vectors(first_.normals)}}},
                      {"indices", buffer_.triangles(first_.triangles)},
                      {"material", material_}};
    if (!colours.empty()) primitive["attributes"]["COLOR_0"] = buffer_.colours(colours);
    Json mesh = {{"name", name_}};
    if (!targets_.empty()) {
      mesh["weights"] = std::vector<double>(targets_.size(), 0.0);
      primitive["targets"] = std::move(targets_);
    }
    mesh["primitives"] = Json::array({std::move(primitive)});
    return mesh;
  }

 private:
  const char* name_;
  Surface first_;
  int material_;
  Buffer& buffer_;
  Json targets_ = Json::array();
};

std::string chunk(const std::string& content, const char* type, char padding) {
  const std::string padded = content + std::string((4 - content.size() % 4) % 4, padding);
  const auto size = std::uint32_t(padded.size());
  std::string bytes(reinterpret_cast<const char*>(&size), 4);
  return bytes.append(type, 4) + padded;
}

/// Builds the file.
class Gltf {
 public:
  Gltf(const record::Layout& layout, const std::string& title) : layout_(layout) {
    json_ = {{"asset", {{"version", "2.0"}, {"generator", "gridshell"}}}, {"scene", 0}};
    json_["scenes"] = Json::array({{{"name", title}, {"nodes", {0}}}});
    json_["materials"] = {material("rods", {0.02, 0.02, 0.02, 1}, false),
                          material("joints", {0.6, 0.02, 0.02, 1}, false),
                          material("cells", {1, 1, 1, 1}, true)};
    json_["meshes"] = Json::array();
    // millimetres and z up become metres and y up
    const double half = std::sqrt(0.5);
    json_["nodes"] = Json::array(
        {{{"name", title}, {"rotation", {-half, 0, 0, half}}, {"scale", {1e-3, 1e-3, 1e-3}}}});
  }

  Buffer& buffer() { return buffer_; }

  /// Adds a mesh that morphs, and a node that shows it.
  void add_morphing(const char* name, Json mesh) {
    json_["meshes"].push_back(std::move(mesh));
    morphing_.push_back(add_node({{"name", name}, {"mesh", json_["meshes"].size() - 1}}));
  }

  /// Adds one sphere per joint, at its position in the first shape.
  void add_joints(const std::vector<Eigen::Matrix3Xd>& shapes) {
    const double radius_mm = 0.5 * layout_.joint_diameter_mm;
    json_["meshes"].push_back(MorphingMesh("joint", ball(radius_mm), 1, buffer_).mesh({}));
    const std::size_t mesh = json_["meshes"].size() - 1;
    for (std::size_t k = 0; k < layout_.joints.size(); ++k) {
      const Eigen::Vector3d at = shapes.front().col(Eigen::Index(k));
      const record::Joint& joint = layout_.joints[k];
      moving_.push_back(add_node({{"name", fmt::format("joint {} {}", joint.i, joint.j)},
                                  {"mesh", mesh},
                                  {"translation", {at.x(), at.y(), at.z()}}}));
    }
  }

  /// Adds the animation from key shape to key shape, at equal intervals of time.
  void animate(const std::vector<Eigen::Matrix3Xd>& shapes, double seconds) {
    const std::size_t keys = shapes.size();
    std::vector<float> times, weights;
    for (std::size_t k = 0; k < keys; ++k) {
      times.push_back(float(seconds * double(k) / double(keys - 1)));
      for (std::size_t shape = 1; shape < keys; ++shape) weights.push_back(k == shape);
    }
    const int input = buffer_.scalars(times), output = buffer_.scalars(weights);
    Json samplers = Json::array(), channels = Json::array();
    const auto add = [&](int node, const char* path, int values) {
      samplers.push_back({{"input", input}, {"output", values}, {"interpolation", "LINEAR"}});
      channels.push_back(
          {{"sampler", samplers.size() - 1}, {"target", {{"node", node}, {"path", path}}}});
    };
    for (const int node : morphing_) add(node, "weights", output);
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      Eigen::Matrix3Xd positions(3, Eigen::Index(keys));
      for (std::size_t key = 0; key < keys; ++key)
        positions.col(Eigen::Index(key)) = shapes[key].col(Eigen::Index(k));
      add(moving_[k], "translation", buffer_.vectors(positions, 0));
    }
    json_["animations"] =
        Json::array({{{"name", "run"}, {"samplers", samplers}, {"channels", channels}}});
  }

  std::string bytes() && {
    json_["accessors"] = std::move(buffer_.accessors);
    json_["bufferViews"] = std::move(buffer_.views);
    json_["buffers"] = Json::array({{{"byteLength", buffer_.bytes().size()}}});
    const std::string body = chunk(line_of(json_), "JSON", ' ') +
                             chunk(buffer_.bytes(), std::string("BIN\0", 4).data(), '\0');
    const std::uint32_t header[] = {0x46546C67, 2, std::uint32_t(12 + body.size())};
    return std::string(reinterpret_cast<const char*>(header), 12) + body;
  }

 private:
  int add_node(Json node) {
    json_["nodes"].push_back(std::move(node));
    json_["nodes"][0]["children"].push_back(json_["nodes"].size() - 1);
    return int(json_["nodes"].size()) - 1;
  }

  const record::Layout& layout_;
  Json json_;
  Buffer buffer_;
  std::vector<int> morphing_, moving_;  ///< nodes of the file with morph targets; of joints
};

/// Colours of the cells by their K, each repeated for its four vertices.
std::vector<std::array<float, 4>> colours_of(const Eigen::VectorXd& K) {
  std::vector<std::array<float, 4>> colours;
  const ColourRange range = range_of(K);
  for (const double value : K) {
    const auto [r, g, b] = linear(range.colour(value));
    colours.insert(colours.end(), 4, {float(r), float(g), float(b), 1});
  }
  return colours;
}

}  // namespace

Result<std::string> to_glb(const record::Trajectory& run, const std::string& title,
                           double seconds) {
  if (run.frames.empty()) return invalid("got no frame, expected at least one");
  TRY(fine, model_detail(run));
  const record::Layout& layout = run.layout;
  Gltf gltf(layout, title);
  std::vector<Eigen::Matrix3Xd> shapes;
  const auto keys = even_frames(run.frames.size(), fine->shapes);
  const std::vector<int> joints = nodes_of_joints(layout);
  const record::Frame& start = run.frames[keys.front()];
  if (run.frames.fault()) return tl::unexpected(*run.frames.fault());
  MorphingMesh rods("rods", tubes(layout, start, fine->sides), 0, gltf.buffer()),
      skin("cells", cells(layout, start), 2, gltf.buffer());
  for (const std::size_t key : keys) {
    const record::Frame& frame = run.frames[key];
    if (run.frames.fault()) return tl::unexpected(*run.frames.fault());
    shapes.push_back(frame.nodes(Eigen::all, joints));
    if (key == keys.front()) continue;
    rods.add(tubes(layout, frame, fine->sides));
    if (!layout.cells.empty()) skin.add(cells(layout, frame));
  }
  gltf.add_morphing("rods", rods.mesh({}));
  if (!layout.cells.empty())
    gltf.add_morphing("cells", skin.mesh(colours_of(run.frames.back().cell_K)));
  gltf.add_joints(shapes);
  if (keys.size() > 1) gltf.animate(shapes, seconds);
  if (run.frames.fault()) return tl::unexpected(*run.frames.fault());
  return std::move(gltf).bytes();
}

}  // namespace gridshell::exports
