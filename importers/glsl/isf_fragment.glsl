// What @NAME@ draws. The lines of @NAME@.fs.glsl are those of the ISF file.
@PLACE@
out vec4 isf_FragColor;
#include "isf.glsl"
#include "@NAME@.fs.glsl"
