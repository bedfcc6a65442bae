// Rods as strips that face the eye or the light.
uniform float widest;  // radius (mm) of a vertex whose fourth component is 1

// Half the width (mm) of the ribbon that a vertex belongs to.
float radius_of(float side) { return widest * side * side; }

// The unit vector across the ribbon, at right angles to its axis and to the line of sight.
vec3 across_of(vec3 tangent, vec3 sight) {
  vec3 across = cross(tangent, sight);
  float size = length(across);
  return size > 1e-5 ? across / size : vec3(0.0);
}
