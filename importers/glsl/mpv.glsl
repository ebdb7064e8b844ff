// What mpv gives every pass of @NAME@. The slots are NAME_raw for each texture that a pass binds.
layout(std140) uniform View { uint frame; };
// From 0 to 1, another in each frame; by the frame's number, so that a frame is always the same.
#define random (float((uint(frame) * 747796405u + 2891336453u) >> 8) / 16777216.0)
#define frame int(frame)
@PARAMETERS@
const vec2 tex_offset = vec2(0.0);
@SLOTS@
