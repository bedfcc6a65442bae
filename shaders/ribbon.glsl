// Rods as strips that face whoever looks at them.
uniform float widest;  // radius that a fourth component of 1 means, mm

// Half the width of the ribbon that a vertex belongs to.
float radius_of(float side) { return widest * abs(side); }

// Across the ribbon, at right angles to its axis and to the line of sight.
vec3 across_of(vec3 tangent, vec3 sight) {
  vec3 across = cross(tangent, sight);
  float size = length(across);
  return size > 1e-5 ? across / size : vec3(0.0);
}
