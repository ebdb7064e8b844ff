// The buffer of probes as it is. read probes, write copied.
layout(local_size_x = 64) in;
layout(std430) readonly buffer probes { uvec4 from[]; };
layout(std430) writeonly buffer copied { uvec4 to[]; };

void main() {
  uint self = gl_GlobalInvocationID.x;
  if (self < uint(from.length())) to[self] = from[self];
}
