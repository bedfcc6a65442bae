#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "engine/core/json.h"
#include "engine/record/frame_values.h"
#include "engine/record/shape_export.h"

namespace gridshell::exports {

std::array<double, 3> ColourRange::colour(double K) const {
  if (!std::isfinite(K)) return unknown;
  const double fraction = std::min(std::abs(K) / end, 1.0);
  const Colour& full = K < 0 ? below : above;
  Colour mixed{};
  for (std::size_t k = 0; k < 3; ++k) mixed[k] = zero[k] + fraction * (full[k] - zero[k]);
  return mixed;
}

ColourRange range_of(const Eigen::VectorXd& K) {
  std::vector<double> sizes;
  for (const double value : K)
    if (std::isfinite(value)) sizes.push_back(std::abs(value));
  if (sizes.empty()) return {};
  std::ranges::sort(sizes);
  const double end = sizes[std::size_t(0.98 * double(sizes.size() - 1))];
  return {end > 0 ? end : 1};
}

std::vector<std::size_t> even_frames(std::size_t frames, std::size_t shown) {
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < shown; ++k)
    chosen.push_back(shown == 1 ? frames - 1 : k * (frames - 1) / (shown - 1));
  return chosen;
}

std::array<double, 3> linear(const std::array<double, 3>& srgb) {
  std::array<double, 3> light{};
  for (std::size_t k = 0; k < 3; ++k)
    light[k] = srgb[k] <= 0.04045 ? srgb[k] / 12.92 : std::pow((srgb[k] + 0.055) / 1.055, 2.4);
  return light;
}

namespace {

constexpr std::size_t most_page_bytes = 9'000'000;  // of the frames, in base64 and JSON

std::string base64(const std::vector<std::uint16_t>& numbers) {
  static constexpr char letters[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes, text;
  for (const std::uint16_t number : numbers) {
    bytes += char(number & 255);
    bytes += char(number >> 8);
  }
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t three = 0;
    for (std::size_t b = 0; b < 3; ++b)
      three = three << 8 | (k + b < bytes.size() ? std::uint8_t(bytes[k + b]) : 0);
    for (std::size_t b = 0; b < 4; ++b)
      text += k + b < bytes.size() + 1 ? letters[three >> (18 - 6 * b) & 63] : '=';
  }
  return text;
}

/// The box around all frames; step_of() is the step to which positions are rounded, mm.
using Extent = Eigen::AlignedBox3d;
double step_of(const Extent& extent) { return std::max(extent.sizes().maxCoeff() / 65535, 1e-12); }

std::string positions(const record::Frame& frame, const Extent& extent) {
  std::vector<std::uint16_t> rounded;
  for (Eigen::Index k = 0; k < frame.nodes.cols(); ++k)
    for (int c = 0; c < 3; ++c)
      rounded.push_back(
          std::uint16_t(std::lround((frame.nodes(c, k) - extent.min()[c]) / step_of(extent))));
  return base64(rounded);
}

double rounded(double value, int digits) {
  return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

Json figures(const record::Frame& frame) {
  Json json = Json::object();
  const auto put = [&](const char* name, double value) {
    if (std::isfinite(value)) json[name] = rounded(value, 5);
  };
  put("progress", frame.progress);
  put("R\u2090 (mm)", frame.boundary_radius_mm);
  put("depth (mm)", frame.depth_mm);
  put("force (N)", frame.force_N);
  put("height (mm)", frame.height_mm);
  put("bend energy (mJ)", frame.energies[Term::bend]);
  put("total K (rad)", frame.total_K);
  if (frame.axial_force_N.size() > 0) {
    put("largest tension (N)", std::max(0.0, frame.axial_force_N.maxCoeff()));
    put("largest compression (N)", std::max(0.0, -frame.axial_force_N.minCoeff()));
  }
  if (frame.reactions_N.cols() > 0)
    put("largest reaction (N)", frame.reactions_N.colwise().norm().maxCoeff());
  put("residual (N)", frame.residual_N);
  put("error estimate (mm)", frame.error_estimate_mm);
  if (frame.negative_pivots >= 0) json["negative pivots"] = frame.negative_pivots;
  if (!frame.event.empty()) json["event"] = frame.event;
  return json;
}

/// At most 128 points of a boundary, evenly chosen, to a tenth of a micrometre.
Json boundary_json(const Eigen::Matrix3Xd& polyline) {
  constexpr Eigen::Index most = 128;
  const Eigen::Index each = (polyline.cols() + most - 1) / most;
  Json points = Json::array();
  for (Eigen::Index k = 0; k < polyline.cols(); k += each) {
    Json point = Json::array();
    for (int c = 0; c < 3; ++c) point.push_back(std::round(1e4 * polyline(c, k)) / 1e4);
    points.push_back(std::move(point));
  }
  return points;
}

/// [node, F_x, F_y, F_z] of every support on which a force acts, N.
Json forces_json(const record::Layout& layout, const Eigen::Matrix3Xd& forces_N) {
  Json forces = Json::array();
  const auto count = std::min(forces_N.cols(), Eigen::Index(layout.supports.size()));
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Vector3d force = forces_N.col(k);
    if (!(force.norm() > 0)) continue;
    forces.push_back({layout.supports[std::size_t(k)], rounded(force.x(), 4), rounded(force.y(), 4),
                      rounded(force.z(), 4)});
  }
  return forces;
}

/// Nodes on which a reaction acts, which the page marks as supports.
Json supports_json(const record::Layout& layout, const record::Frame& frame) {
  Json supports = Json::array();
  for (const Json& one : forces_json(layout, frame.reactions_N)) supports.push_back(one[0]);
  return supports;
}

Json layout_json(const record::Layout& layout) {
  Json json = Json::object();
  json["rods"] = layout.rods;
  json["boundary"] = {boundary_json(layout.original_boundary),
                      boundary_json(layout.actuated_boundary)};
  const std::vector<int> joints = nodes_of_joints(layout);
  json["joints"] = joints;
  json["cells"] = Json::array();
  for (const record::Cell& cell : layout.cells) {
    Json corners = Json::array();
    for (const int joint : cell.joints) corners.push_back(joints[std::size_t(joint)]);
    json["cells"].push_back(std::move(corners));
  }
  return json;
}

}  // namespace

Result<std::string> to_page(const record::Trajectory& run, const std::string& title) {
  if (run.frames.empty()) return invalid("got no frame, expected at least one");
  const record::Frame& end = run.frames.back();
  if (run.frames.fault()) return tl::unexpected(*run.frames.fault());
  const auto nodes = std::size_t(end.nodes.cols());
  // bytes of a node, a K, a brace, a load and a support, and of the figures
  const std::size_t braces = braces_of(run.layout, end).size(),
                    loads = end.loads_N.size() > 0 ? run.layout.supports.size() : 0,
                    a_frame = 8 * nodes + 8 * run.layout.cells.size() + 16 * braces + 48 * loads +
                              8 * run.layout.supports.size() + 400;
  if (a_frame > most_page_bytes)
    return invalid("one frame of {} nodes takes more than {} MB in a page", nodes,
                   most_page_bytes / 1'000'000);
  const auto shown =
      even_frames(run.frames.size(), std::min(run.frames.size(), most_page_bytes / a_frame));
  Extent extent;
  for (const std::size_t k : shown)
    for (const auto& node : run.frames[k].nodes.colwise()) extent.extend(node);

  Json json = layout_json(run.layout);
  json["title"] = title;
  json["low"] = {extent.min().x(), extent.min().y(), extent.min().z()};
  json["step"] = step_of(extent);
  json["K_end"] = rounded(range_of(run.frames.back().cell_K).end, 3);
  json["colours"] = {{"below", ColourRange::below},
                     {"zero", ColourRange::zero},
                     {"above", ColourRange::above},
                     {"unknown", ColourRange::unknown}};
  json["rod_mm"] = run.layout.rod_diameter_mm;
  json["frames"] = Json::array();
  for (const std::size_t k : shown) {
    const record::Frame& frame = run.frames[k];
    Json K = Json::array();
    for (const double value : frame.cell_K) K.push_back(rounded(value, 3));
    json["frames"].push_back({{"index", frame.index},
                              {"actuation", frame.actuation},
                              {"nodes", positions(frame, extent)},
                              {"K", std::move(K)},
                              {"braces", braces_of(run.layout, frame)},
                              {"loads", forces_json(run.layout, frame.loads_N)},
                              {"held", supports_json(run.layout, frame)},
                              {"figures", figures(frame)}});
  }
  if (run.frames.fault()) return tl::unexpected(*run.frames.fault());

  std::string data = line_of(json, true);
  // "</script" ends a script and "<!--<script" changes its end, even within a text
  for (std::size_t at = 0; (at = data.find('<', at)) != data.npos;) data.replace(at, 1, "\\u003c");
  std::string page = page_template;
  const std::string marker = "/*RUN*/";
  page.replace(page.find(marker), marker.size(), data);
  return page;
}

}  // namespace gridshell::exports
