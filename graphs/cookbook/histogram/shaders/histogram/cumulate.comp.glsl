// The share of pixels below each luminance. With CEILING, no bin may have so many that the display would show more contrast
// there than the scene has: what is above is cut until less than a fortieth is cut in a round.
// read    counts   uint[BINS]
// write   curve    float[BINS + 1], 0 to 1
layout(local_size_x = 1) in;

layout(std430) readonly buffer counts { uint count[]; };
layout(std430) writeonly buffer curve { float share[]; };
layout(std140) uniform Parameters { float stops; float contrast; };

void main() {
  float kept[BINS];
  float all = 0.0;
  for (int i = 0; i < BINS; ++i) all += kept[i] = float(count[i]);
#if CEILING
  const float first = all;
  for (int round = 0; round < 64; ++round) {
    float most = all * (stops / float(BINS)) / log2(contrast), cut = 0.0;
    for (int i = 0; i < BINS; ++i) {
      cut += max(kept[i] - most, 0.0);
      kept[i] = min(kept[i], most);
    }
    all -= cut;
    if (cut < first / 40.0) break;
  }
#endif
  float sum = 0.0;
  for (int i = 0; i < BINS; ++i) {
    share[i] = sum / all;
    sum += kept[i];
  }
  share[BINS] = 1.0;
}
