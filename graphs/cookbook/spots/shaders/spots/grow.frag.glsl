// A step of Gray and Scott: one substance is fed, the other lives on it and dies; both spread. The tile repeats.
// read    before       r: the first, g: the second
// write   substances   the same, a step later
uniform sampler2D before;
layout(std140) uniform Parameters { float feed; float kill; };
out vec2 substances;

vec2 at(ivec2 p) {
  ivec2 size = textureSize(before, 0);
  return texelFetch(before, (p + size) % size, 0).rg;
}

void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  vec2 here = at(p);
  vec2 beside = at(p + ivec2(1, 0)) + at(p - ivec2(1, 0)) + at(p + ivec2(0, 1)) + at(p - ivec2(0, 1));
  vec2 diagonal = at(p + ivec2(1, 1)) + at(p - ivec2(1, 1)) + at(p + ivec2(1, -1)) + at(p - ivec2(1, -1));
  vec2 spread = vec2(1.0, 0.5) * (0.2 * beside + 0.05 * diagonal - here);
  float eaten = here.r * here.g * here.g;
  substances = here + spread + vec2(feed * (1.0 - here.r) - eaten, eaten - (feed + kill) * here.g);
}
