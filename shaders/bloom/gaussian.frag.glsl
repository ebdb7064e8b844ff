// One axis of a separable Gaussian blur. Scene-referred; keeps constant pictures.
// read    source    `as linear`
// write   result    of the same size
// params  sigma     standard deviation in texels
//         axis      [1, 0] or [0, 1]
//
// Pairs of texels are read by one linear lookup between them (Rakos, "Efficient Gaussian blur with linear sampling", 2010).
uniform sampler2D source;
layout(std140) uniform Parameters {
  vec2 axis;
  float sigma;
};
in vec2 uv;
out vec4 result;

float weightAt(float distance) { return exp(-0.5 * distance * distance / (sigma * sigma)); }

void main() {
  vec2 texel = axis / vec2(textureSize(source, 0));
  vec3 sum = textureLod(source, uv, 0.0).rgb;
  float weights = 1.0;
  int last = int(ceil(3.0 * sigma));
  for (int i = 1; i <= last; i += 2) {
    float near = weightAt(float(i)), far = i + 1 <= last ? weightAt(float(i + 1)) : 0.0, both = near + far;
    vec2 offset = (float(i) + far / max(both, 1e-30)) * texel;
    sum += both * (textureLod(source, uv + offset, 0.0).rgb + textureLod(source, uv - offset, 0.0).rgb);
    weights += 2.0 * both;
  }
  result = vec4(sum / weights, 1.0);
}
