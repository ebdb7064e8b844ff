// Each of 64 threads takes a place in the list.
// modify  list, used
layout(local_size_x = 64) in;
layout(std430) buffer list { uint item[]; };
layout(std430) buffer used { uint count; };

void main() { item[atomicAdd(count, 1u)] = 7u; }
