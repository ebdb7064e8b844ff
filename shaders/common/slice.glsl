// Where a slice of a compute pass begins ("slices": n). A dispatch covers some rows of work groups; these functions give what
// gl_WorkGroupID and gl_GlobalInvocationID are when the pass runs whole, where they give the same. gl_NumWorkGroups is that
// of the slice: use the sizes of images or parameters instead.
#ifndef COMMON_SLICE_GLSL
#define COMMON_SLICE_GLSL

layout(std140) uniform Slice {
  uvec3 first_group;
  uvec3 first_invocation;
};

uvec3 sliceGroup() { return gl_WorkGroupID + first_group; }
uvec3 sliceInvocation() { return gl_GlobalInvocationID + first_invocation; }

#endif
