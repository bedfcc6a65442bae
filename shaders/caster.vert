layout(location = 0) in vec3 position;
layout(location = 2) in vec4 colour;
uniform mat4 light_matrix;
uniform float ground_z;
uniform float height_scale;
out float height;
out float cover;

void main() {
  height = clamp((position.z - ground_z) * height_scale, 0.0, 1.0);
  cover = colour.a;
  gl_Position = light_matrix * vec4(position, 1.0);
}
