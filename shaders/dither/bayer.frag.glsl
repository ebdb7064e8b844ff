// One bit per pixel, or per channel: ordered dither by the 4 x 4 matrix of Bayer ("An optimum method for two-level rendition of
// continuous-tone pictures", IEEE ICC 1973). Linear values are compared, so that a gray and its pattern are equally bright.
// read    source   the encoded picture, nearest
// write   result   0 or 1
// params  pixel    side of a dot, pixels of the picture
// defines COLOR    1: each channel by itself, eight colors; 0: luminance, black and white
#ifndef COLOR
#define COLOR 0
#endif

uniform sampler2D source;
layout(std140) uniform Parameters { int pixel; };
out vec4 result;

const int kMatrix[16] = int[16](0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5);

void main() {
  ivec2 dot_at = ivec2(gl_FragCoord.xy) / pixel;
  vec3 encoded = texelFetch(source, min(dot_at * pixel + pixel / 2, textureSize(source, 0) - 1), 0).rgb;
  vec3 light = mix(encoded / 12.92, pow((encoded + 0.055) / 1.055, vec3(2.4)), greaterThan(encoded, vec3(0.04045)));
#if !COLOR
  light = vec3(dot(light, vec3(0.2126, 0.7152, 0.0722)));
#endif
  float threshold = (float(kMatrix[(dot_at.y & 3) * 4 + (dot_at.x & 3)]) + 0.5) / 16.0;
  result = vec4(mix(vec3(0.0), vec3(1.0), greaterThan(light, vec3(threshold))), 1.0);
}
