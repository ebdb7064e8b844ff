// The tiles that something in the near field reaches, for near_bokeh, fill and near_field.
// params  see parameters.glsl
// defines FULL_SIZE   default 0; 1: the target is the full picture, not the half size
#include "parameters.glsl"
#include "work.glsl"

#ifndef FULL_SIZE
#define FULL_SIZE 0
#endif

void main() { gl_Position = workCorner(tile, FULL_SIZE == 1 ? 2 : 1); }
