// Slices of a compute pass ("slices": n). A dispatch covers some rows of work groups; these functions give the values that
// gl_WorkGroupID and gl_GlobalInvocationID would have if the pass ran whole. gl_NumWorkGroups is that of the slice: use the
// sizes of images or parameters instead.
#ifndef COMMON_SLICE_GLSL
#define COMMON_SLICE_GLSL

layout(std140) uniform Slice {
  uvec3 first_group;
  uvec3 first_invocation;
};

uvec3 sliceGroup() { return gl_WorkGroupID + first_group; }
uvec3 sliceInvocation() { return gl_GlobalInvocationID + first_invocation; }

#endif
