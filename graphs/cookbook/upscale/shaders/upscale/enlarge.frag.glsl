// A larger picture: the twelve texels around, weighted by a kernel that is long along the edge and short across.
// read    small    encoded picture, as linear
// write   result   encoded picture
uniform sampler2D small;
in vec2 uv;
out vec4 result;

float brightness(vec3 c) { return dot(c, vec3(0.299, 0.587, 0.114)); }

void main() {
#if !EDGES
  result = texture(small, uv);
#else
  ivec2 size = textureSize(small, 0);
  vec2 at = uv * vec2(size) - 0.5, base = floor(at), f = at - base;
  vec3 color[16];
  float bright[16];
  for (int i = 0; i < 16; ++i) {
    ivec2 p = clamp(ivec2(base) + ivec2(i & 3, i >> 2) - 1, ivec2(0), size - 1);
    color[i] = texelFetch(small, p, 0).rgb;
    bright[i] = brightness(color[i]);
  }
  // The gradients of the four texels around, by their bilinear weights, as a structure tensor: the edge lies across its long axis.
  vec3 tensor = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    int c = 5 + (i & 1) + 4 * (i >> 1);
    vec2 slope = 0.5 * vec2(bright[c + 1] - bright[c - 1], bright[c + 4] - bright[c - 4]);
    float weight = ((i & 1) == 1 ? f.x : 1.0 - f.x) * ((i >> 1) == 1 ? f.y : 1.0 - f.y);
    tensor += weight * vec3(slope.x * slope.x, slope.y * slope.y, slope.x * slope.y);
  }
  float mean = 0.5 * (tensor.x + tensor.y), spread = length(vec2(0.5 * (tensor.x - tensor.y), tensor.z));
  float angle = 0.5 * atan(2.0 * tensor.z, tensor.x - tensor.y);
  vec2 across = vec2(cos(angle), sin(angle));
  // 0: no one direction, 1: an edge.
  float edge = mean > 1e-5 ? spread / mean * smoothstep(0.0005, 0.01, mean) : 0.0;

  vec4 sum = vec4(0.0);
  vec3 low = min(min(color[5], color[6]), min(color[9], color[10])), high = max(max(color[5], color[6]), max(color[9], color[10]));
  for (int i = 0; i < 16; ++i) {
    vec2 to = vec2(i & 3, i >> 2) - 1.0 - f;
    vec2 way = vec2(dot(to, across), dot(to, vec2(-across.y, across.x))) / vec2(1.0, 1.0 + 0.6 * edge);
    // A window of two texels: that of Lanczos, as a polynomial.
    float d = min(dot(way, way), 4.0);
    float window = 1.0 - 0.25 * d, lobe = 0.4 * d - 1.0;
    sum += window * window * (25.0 / 16.0 * lobe * lobe - 9.0 / 16.0) * vec4(color[i], 1.0);
  }
  result = vec4(clamp(sum.rgb / sum.w, low, high), 1.0);
#endif
}
