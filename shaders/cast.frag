// The ground with the shell's soft shadow.
in vec2 at;
in vec2 point;
uniform sampler2D lit;  // light on the ground over that in the open

void main() { show(point, open * texture(lit, at).r); }
