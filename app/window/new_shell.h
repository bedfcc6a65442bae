// The values of the form for a new shell, and the preset that they are.
#pragma once

#include <cstddef>
#include <string>

#include "engine/gridshell.h"

namespace gridshell::window {

/// The values of the form.
struct NewShell {
  std::size_t boundary = 0;  ///< circle, ellipse, superellipse, file
  int rods = 12;
  double radius_mm = 126, half_mm[2] = {160, 110}, spacing_mm = 20, ratio = 0.8,
         diameter_mm = 0.254;
  std::string file;
  preset::Material material = preset::Material::none;

  /// The text of a preset with these values.
  std::string preset() const;
};

}  // namespace gridshell::window
