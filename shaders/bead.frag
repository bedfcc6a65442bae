// Joints and marks; the inputs are described in bead.vert.
in vec3 surface;
in vec4 shade, half_way;
in vec3 right, up, axis;
in vec2 on_card;
in vec3 shape;
out vec4 fragment;

void main() {
  vec3 sight = cross(right, up), n;
  float radius = shape.x, cover;
  if (shape.y < 0.0) {
    cover = clamp(0.5 + radius - length(on_card), 0.0, 1.0);
    vec2 p = on_card / max(radius, length(on_card));
    n = p.x * right + p.y * up + sqrt(max(0.0, 1.0 - dot(p, p))) * sight;
  } else {
    // a cylinder is seen as a box between two ellipses, of which the nearer one is all visible
    float x = clamp(on_card.x, -radius, radius);
    float ellipse = abs(shape.z) * sqrt(radius * radius - x * x);
    cover = clamp(0.5 + radius - abs(on_card.x), 0.0, 1.0) *
            clamp(0.5 + shape.y + ellipse - abs(on_card.y), 0.0, 1.0);
    float before = shape.z < 0.0 ? -1.0 : 1.0;
    vec3 towards = sight - shape.z * axis;
    n = abs(on_card.y - before * shape.y) < ellipse || dot(towards, towards) < 1e-6
            ? before * axis
            : x / radius * right + sqrt(1.0 - x * x / (radius * radius)) * normalize(towards);
  }
  fragment = metal(Metal(vec4(surface, 1.0), shade.w, half_way.w, shade.xyz),
                   dot(n, light_direction), dot(n, half_way.xyz), dot(n, sight), n.z) *
             cover;
}
