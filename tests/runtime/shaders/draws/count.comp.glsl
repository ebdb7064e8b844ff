// One work group each.
// modify  tally
layout(local_size_x = 1) in;
layout(std430) buffer tally { uint groups, fragments, samples; };

void main() { atomicAdd(groups, 1u << (4u * gl_WorkGroupID.y)); }
