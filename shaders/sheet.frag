in vec3 shade;
in vec4 dark;
in vec3 key_part;
out vec4 fragment;

void main() { fragment = dark + vec4(key_part * lit(shade), 0.0); }
