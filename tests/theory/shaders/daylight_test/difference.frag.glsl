// read   sky, rest   maps of one size
//        sun         where the sun is, and its light
// write  result      what is in `sky` alone, where the sun is up
uniform sampler2D sky, rest;
layout(std140) uniform sun { vec4 at, light; };
out vec4 result;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  result = (texelFetch(sky, texel, 0) - texelFetch(rest, texel, 0)) * step(0.0, at.y + light.r);
}
