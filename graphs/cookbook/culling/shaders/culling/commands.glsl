// Boxes to draw: what glDrawElementsIndirect takes, and which boxes they are.
layout(std430) buffer commands { uint indices; uint instances; uint first; int base_vertex; uint base_instance; };
layout(std430) writeonly buffer list { uint box[]; };

void add(uint i) { box[atomicAdd(instances, 1u)] = i; }
