// The shell's soft shadow on the ground.
in vec2 at;
in vec2 point;
uniform sampler2D lit;  // light over that in the open

void main() { show(point, open * texture(lit, at).r); }
