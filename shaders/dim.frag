// The (negative) change of the light on the ground by the shadow of one of many passes.
in vec2 at;
in vec2 point;
uniform sampler2D lit;  // light on the ground over that in the open
uniform float part;     // light of this pass in the open over the number of passes
out vec4 fragment;

void main() { fragment = vec4(part * (texture(lit, at).r - 1.0)); }
