// A texture times a factor: a mean from a sum.
uniform sampler2D sum;
uniform float share;
uniform vec2 corner;  // pixel of the target at which the texture begins
out vec4 fragment;

void main() { fragment = share * texelFetch(sum, ivec2(gl_FragCoord.xy - corner), 0); }
