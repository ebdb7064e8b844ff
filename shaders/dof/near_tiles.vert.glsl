// The tiles that the near field reaches, for far_hidden, near_bokeh, fill and near_field.
// params  see parameters.glsl
// defines FULL_SIZE   default 0; 1: the target is the full picture, not of the size of the fields
#include "parameters.glsl"
#include "coc.glsl"
#include "idle.glsl"
#include "work.glsl"

#ifndef FULL_SIZE
#define FULL_SIZE 0
#endif

void main() {
  gl_Position = workCorner(tile, FULL_SIZE == 1 ? SCALE : 1, false);
  gl_Position.z = kHidden;
}
