// The shell as the light sees it: the fraction of light that is blocked, and this times the height
// above the ground.
in float height;
in float cover;
uniform float density;  // fraction of the light that an opaque colour blocks
out vec4 fragment;

void main() {
  float blocked = density * cover;
  fragment = vec4(blocked, blocked * height, 0.0, blocked);
}
