// The shell as the light sees it: the fraction of light that is blocked, and this times the height
// above the ground.
in float height;
in float cover;
uniform float density;  // fraction of the light that an opaque colour blocks
out vec4 fragment;

void main() {
  float held = density * cover;
  fragment = vec4(held, held * height, 0.0, held);
}
