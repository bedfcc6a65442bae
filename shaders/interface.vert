// A triangle of the interface; positions are pixels from the top left.
uniform vec2 size;       // of the window, pixels
uniform float upwards;   // 1: the target's first row is the lowest; -1: the highest
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texel;
layout(location = 2) in vec4 tint;
out vec2 at;
out vec4 ink;

void main() {
  at = texel;
  ink = tint;
  vec2 clip = 2.0 * position / size - 1.0;
  gl_Position = vec4(clip.x, -upwards * clip.y, 0.0, 1.0);
}
