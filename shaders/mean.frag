// A share of what was drawn so far.
uniform sampler2D sum;
uniform float share;
uniform vec2 corner;  // of what was drawn, in the target
out vec4 fragment;

void main() { fragment = share * texelFetch(sum, ivec2(gl_FragCoord.xy - corner), 0); }
