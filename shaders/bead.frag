in vec3 surface;
in vec4 shade, half_way;
in vec3 right, up, axis;
in vec2 place;
in vec2 half_axes;
in vec2 shape;
out vec4 fragment;

void main() {
  // distance to the outline in samples: how far it is over how fast it grows
  float f = max(length(place), 1e-4);
  float cover = clamp(0.5 + (1.0 - f) * f / length(place / half_axes), 0.0, 1.0);
  // where the line of sight meets the spheroid, radius 1: a z^2 + 2 b z + c = 0
  vec3 sight = cross(right, up);
  vec2 p = place * min(1.0, 0.999 / f) * vec2(1.0, shape.y);
  float k = shape.x, along = dot(axis, sight), over = dot(axis, up);
  float a = 1.0 + k * along * along, b = k * along * over * p.y;
  float c = dot(p, p) + k * over * over * p.y * p.y - 1.0;
  float z = (-b + sqrt(max(b * b - a * c, 0.0))) / a;
  vec3 q = p.x * right + p.y * up + z * sight;
  vec3 n = normalize(q + k * dot(q, axis) * axis);
  fragment = metal(Metal(vec4(surface, 1.0), shade.w, half_way.w, shade.xyz),
                   dot(n, light_direction), dot(n, half_way.xyz), dot(n, sight), n.z) *
             cover;
}
