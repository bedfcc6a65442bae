#include "engine/preset/likely_surface.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

namespace gridshell::preset {

std::vector<std::string> make_likely(SurfaceData& mesh, double spacing_mm, bool unit_known) {
  constexpr double fewest_spacings = 4, more = 1.5;
  std::vector<std::string> notes;
  Eigen::AlignedBox3d box;
  Eigen::Vector3d faced = Eigen::Vector3d::Zero();
  const auto location = [&](int k) {
    return Eigen::Map<Eigen::Vector3d>(mesh.vertices[std::size_t(k)].data());
  };
  for (int k = 0; k < int(mesh.vertices.size()); ++k) box.extend(location(k));
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d p = location(a), q = location(b), r = location(c);
    faced += (q - p).cross(r - p).cwiseAbs();
  }
  const double width = box.sizes().maxCoeff();
  const auto wide = [&](double unit) { return unit * width >= fewest_spacings * spacing_mm; };
  if (!unit_known && !wide(1) && wide(1000)) {
    const double unit = wide(10) ? 10 : 1000;
    for (auto& vertex : mesh.vertices)
      for (double& number : vertex) number *= unit;
    notes.push_back(
        fmt::format("names no unit and would be {:.3g} mm wide, {:.2g} of the rods' spacing: read "
                    "in {}, {:.4g} mm wide{}; file_unit sets another unit",
                    width, width / spacing_mm, unit == 10 ? "cm" : "m", unit * width,
                    unit == 10 ? " (1 : 100 of a file in metres)" : ""));
  }
  if (faced.y() > more * faced.z()) {
    for (auto& vertex : mesh.vertices) {
      std::swap(vertex[1], vertex[2]);
      vertex[1] *= -1;
    }
    notes.emplace_back("the surface faces y, not z: y is taken as up");
  }
  return notes;
}

}  // namespace gridshell::preset
