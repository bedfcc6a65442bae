// What one of many shadows takes from the light on the ground.
in vec2 at;
in vec2 point;
uniform sampler2D lit;  // light over that in the open
uniform float part;     // of this light in the open, over that of all
out vec4 fragment;

void main() { fragment = vec4(part * (texture(lit, at).r - 1.0)); }
