// What the light meets first: how much of it is blocked, and that times the height above ground.
in float height;
in float cover;
uniform float density;
out vec4 fragment;

void main() {
  float held = density * cover;
  fragment = vec4(held, held * height, 0.0, held);
}
