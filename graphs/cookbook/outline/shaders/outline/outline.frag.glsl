// The outline over the picture, its rim one pixel soft. Blended by alpha.
// read    nearest   pixel, or -1
// modify  result    encoded picture
uniform sampler2D nearest;
layout(std140) uniform Parameters { float width; vec3 color; };
out vec4 result;

void main() {
  vec2 known = texelFetch(nearest, ivec2(gl_FragCoord.xy), 0).rg;
  float way = known.x < 0.0 ? 1e30 : distance(known, floor(gl_FragCoord.xy));
  result = vec4(color, way == 0.0 ? 0.0 : clamp(width + 0.5 - way, 0.0, 1.0));
}
