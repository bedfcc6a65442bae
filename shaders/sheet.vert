// Cells as sheets in a colour of the colour bar. Light, shadow or haze would change it to the
// colour of another value.
layout(location = 0) in vec3 position;
layout(location = 2) in vec4 colour;
uniform mat4 view_projection;
out vec4 tint;  // premultiplied

void main() {
  tint = vec4(colour.rgb * colour.a, colour.a);
  gl_Position = view_projection * vec4(position, 1.0);
}
