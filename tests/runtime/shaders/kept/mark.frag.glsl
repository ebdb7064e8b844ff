// Counts, and has no output: "raster" says the size.
// modify  marks
layout(r32ui) uniform uimage2D marks;

void main() { imageAtomicAdd(marks, ivec2(gl_FragCoord.xy), 1u); }
