// Nets on triangle meshes.

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "engine/core/try.h"
#include "engine/footprint/domains.h"
#include "engine/geometry/mesh_repair.h"
#include "engine/scene/mesh_net.h"
#include "engine/scene/surface_pose.h"

namespace gridshell {
namespace {

constexpr double degree = std::numbers::pi / 180;

std::vector<std::string> lines_text(const TriangleMesh& mesh) {
  std::vector<std::string> texts;
  for (const auto& [kind, name] :
       {std::pair(LineKind::hole, "hole"), {LineKind::crease, "crease"}}) {
    const auto count = std::ranges::count(mesh.lines(), kind, &MeshLine::kind);
    if (count > 0) texts.push_back(fmt::format("{} {}{}", count, name, count > 1 ? "s" : ""));
  }
  return texts;
}

/// The mesh of a file, repaired if it is no sheet with a rim. `done`: the repairs.
Result<TriangleMesh> sheet_of(const preset::SurfaceData& file, std::vector<std::string>& done) {
  const Eigen::Matrix3Xd vertices = preset::matrix_of<3>(file.vertices);
  auto made = TriangleMesh::make(vertices, file.triangles);
  if (made && std::ranges::count(made->lines(), LineKind::rim, &MeshLine::kind) > 0) return made;
  MendedMesh mesh = mended(vertices, file.triangles);
  done = std::move(mesh.done);
  return TriangleMesh::make(mesh.vertices, std::move(mesh.triangles));
}

Result<NetStart> given_start(const preset::Net& requested, const ShapedSurface& shape,
                             const Surface::Function& outside, double allowed_mm) {
  TRY(pose, given_pose(requested, shape, outside, allowed_mm));
  NetStart start;
  start.pose = std::move(*pose);
  const Eigen::Vector3d& up = start.pose.up;
  const Eigen::Vector3d x = (Eigen::Vector3d::UnitX() - up.x() * up).normalized();
  start.axis_deg =
      std::atan2(up.cross(x).dot(start.pose.along_u), x.dot(start.pose.along_u)) / degree;
  return start;
}

}  // namespace

Result<NetDesign> mesh_design(const preset::Net& requested, double spacing_mm) {
  constexpr double apex_off = 0.01;  // largest distance of the apex, over the spacing
  const auto about_file = [](const Error& error) {
    return Error{error.fault, "[net] file: " + error.message};
  };
  auto report = std::make_shared<MeshNetReport>();
  auto made = sheet_of(requested.file, report->mended).map_error(about_file);
  if (!made) return tl::unexpected(made.error());
  const auto mesh = std::make_shared<const TriangleMesh>(std::move(*made));
  auto fitted = MeshSurface::fit(*mesh, spacing_mm, requested.fit_mm).map_error(about_file);
  if (!fitted) return tl::unexpected(fitted.error());
  const auto smooth = std::make_shared<const MeshSurface>(std::move(*fitted));
  const ShapedSurface shape{
      Surface([smooth](const Eigen::Vector3d& p) { return smooth->at(p); }, spacing_mm),
      [mesh](double x, double y) { return highest_at(*mesh, x, y); }};
  const auto lines = std::make_shared<const Barriers>(*mesh);
  TRY(outside, outside_of(requested));
  const double least_angle = requested.least_angle_deg * degree;
  if (requested.apex != preset::NetApex::given) {
    TRY(starts, best_starts(shape.surface, *mesh, *lines, *outside, least_angle, spacing_mm,
                            requested.apex == preset::NetApex::best_angle));
    report->start = starts->front();
    if (starts->size() > 1) report->second = starts->back();
  } else {
    TRY(start, given_start(requested, shape, *outside,
                           std::max(apex_off * spacing_mm, 2 * smooth->largest_distance())));
    report->start = std::move(*start);
  }
  const NetPose& pose = report->start.pose;
  const double chord = net_chord(*mesh, spacing_mm);
  TRY(net_made, MarchedNet::make(shape.surface, pose, lines, least_angle, chord,
                                 chords_across(*mesh, chord)));
  const auto net = std::make_shared<const MarchedNet>(std::move(*net_made));
  report->fit_mm = smooth->largest_distance();
  report->fit_at = smooth->farthest_vertex();
  report->start.least_angle_deg = net->least_angle() / degree;
  report->left_out = left_out_of(net->grid(), *lines, area_samples(*mesh, chord));
  report->start.reached = 1;
  for (const AreaSample& one : report->left_out) report->start.reached -= one.area;
  report->lines = lines_text(*mesh);
  for (const MeshLine& line : mesh->lines())
    report->drawn.push_back({line.kind, mesh->vertices()(Eigen::all, line.vertices)});
  NetDesign design;
  design.domain = reached_part(net);
  design.net = net;
  TRY_DO(lay_flat(requested, pose, design));
  design.report = std::move(report);
  return design;
}

}  // namespace gridshell
