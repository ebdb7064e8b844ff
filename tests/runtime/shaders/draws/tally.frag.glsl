// modify  tally
layout(std430) buffer tally { uint groups, fragments, samples; };

void main() {
  atomicAdd(fragments, 1u);
  atomicMax(samples, uint(bitCount(gl_SampleMaskIn[0])));
}
