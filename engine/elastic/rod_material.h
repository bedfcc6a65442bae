// Cross-section and material of a rod.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace gridshell {

/// Stiffness of a round, naturally straight rod: EA (N) and EI (N mm^2).
struct RodSection {
  double EA = 0;
  double EI = 0;
};

/// A solid circular section of diameter D (mm) and Young's modulus E (GPa):
/// EA = E pi D^2/4, EI = E pi D^4/64.
inline RodSection circular_section(double diameter_mm, double young_GPa) {
  const double young_MPa = 1e3 * young_GPa;
  const double area = M_PI * diameter_mm * diameter_mm / 4;
  return {young_MPa * area, young_MPa * area * diameter_mm * diameter_mm / 16};
}

// Material and cross-section of a rod of the `twist` model: two principal axes, torsion, and a
// natural shape.

/// Distances of a section's outermost fibres from its axes, mm: curvature strains them most.
struct FibreReach {
  double about_1 = 0, about_2 = 0;  ///< bent about m1 and about m2
  bool round = true;                ///< else a rectangle: at its corner both strains are added
  double area_mm2 = 0;              ///< of the section; 0: that of a solid one with this reach

  /// Largest strain by the curvatures about m1 and m2, 1/mm.
  double strain(const Eigen::Vector2d& curvature) const {
    if (round) return about_1 * std::hypot(curvature[0], curvature[1]);
    return about_1 * std::abs(curvature[0]) + about_2 * std::abs(curvature[1]);
  }
  /// Largest strain of a section whose spin is free, by a curvature about any axis, 1/mm.
  double strain(double curvature) const {
    return curvature * (round ? about_1 : std::hypot(about_1, about_2));
  }
};

/// Stiffness per rod in its material frame (m1, m2, tangent) [Bergou 2008]. Curvatures are those
/// about m1 and m2: the curvature binormal's components per length.
struct RodMaterial {
  double EA = 0;                    ///< N
  double EI1 = 0, EI2 = 0;          ///< bending about m1 and about m2, N mm^2
  double GJ = 0;                    ///< torsion, N mm^2
  Eigen::Vector2d curvature{0, 0};  ///< natural curvature about m1 and m2, 1/mm
  double twist = 0;                 ///< natural twist, rad/mm
  FibreReach fibres = {};
  bool as_drawn = false;  ///< its natural shape is its line in the flat, in addition to `curvature`

  /// It bends equally in every direction and is naturally straight: the spin of its section changes
  /// nothing.
  bool round_and_straight() const {
    return EI1 == EI2 && curvature[0] == 0 && curvature[1] == 0 && !as_drawn;
  }
};

/// A solid round rod that is naturally straight. Its radius r follows from EI/EA = r^2/4.
inline RodMaterial round_material(const RodSection& section, double GJ) {
  const double radius = 2 * std::sqrt(section.EI / section.EA);
  return {section.EA, section.EI, section.EI, GJ, {0, 0}, 0, {radius, radius}};
}

/// A solid circular section of diameter D (mm), Young's modulus E and shear modulus G (GPa):
/// GJ = G pi D^4/32.
inline RodMaterial circular_material(double diameter_mm, double young_GPa, double shear_GPa) {
  const double d2 = diameter_mm * diameter_mm;
  return round_material(circular_section(diameter_mm, young_GPa),
                        1e3 * shear_GPa * M_PI * d2 * d2 / 32);
}

/// A solid rectangular section, `width` along m1 and `height` along m2 (mm), any ratio: EI1 = E w
/// h^3/12, EI2 = E h w^3/12, GJ by Saint-Venant's series [Timoshenko, Goodier 1951, art. 109].
inline RodMaterial rectangular_material(double width, double height, double young_GPa,
                                        double shear_GPa) {
  const double young = 1e3 * young_GPa, a = std::max(width, height), b = std::min(width, height);
  double series = 0;
  for (int n = 1; n < 40; n += 2) series += std::tanh(n * M_PI * a / (2 * b)) / std::pow(n, 5);
  const double J = a * b * b * b * (1.0 / 3 - 64 / std::pow(M_PI, 5) * b / a * series);
  return {young * width * height,
          young * width * height * height * height / 12,
          young * height * width * width * width / 12,
          1e3 * shear_GPa * J,
          {0, 0},
          0,
          {height / 2, width / 2, false}};
}

/// A tube of outer diameter D and wall t, inner diameter D - 2t: GJ = G pi (D^4 - (D - 2t)^4)/32.
inline RodMaterial tube_material(double diameter_mm, double wall_mm, double young_GPa,
                                 double shear_GPa) {
  const auto solid = [&](double diameter) {
    return circular_material(diameter, young_GPa, shear_GPa);
  };
  const double inner = diameter_mm - 2 * wall_mm;
  RodMaterial tube = solid(diameter_mm);
  const RodMaterial hollow = solid(inner);
  tube.EA -= hollow.EA;
  tube.EI1 = tube.EI2 -= hollow.EI1;
  tube.GJ -= hollow.GJ;
  tube.fibres.area_mm2 = M_PI / 4 * (diameter_mm * diameter_mm - inner * inner);
  return tube;
}

/// A rectangular tube with the outer dimensions of rectangular_material(): GJ = 4 G A^2 t/U by
/// Bredt, with the area A in the middle line of the wall and the length U of that line. The error
/// is some percent for walls of up to a tenth of the smaller side.
inline RodMaterial box_material(double width, double height, double wall, double young_GPa,
                                double shear_GPa) {
  const double w = width - 2 * wall, h = height - 2 * wall;
  RodMaterial box = rectangular_material(width, height, young_GPa, shear_GPa);
  const RodMaterial hollow = rectangular_material(w, h, young_GPa, shear_GPa);
  box.EA -= hollow.EA;
  box.EI1 -= hollow.EI1;
  box.EI2 -= hollow.EI2;
  const double middle = (width - wall) * (height - wall);
  box.GJ = 1e3 * shear_GPa * 4 * middle * middle * wall / (2 * (width + height - 2 * wall));
  box.fibres.area_mm2 = width * height - w * h;
  return box;
}

}  // namespace gridshell
