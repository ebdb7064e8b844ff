// Each pixel of the models is its own nearest; the others have none yet.
// read    inside    depth of the models alone; 0: none
// write   nearest   pixel, or -1
uniform sampler2D inside;
out vec2 nearest;

void main() { nearest = texelFetch(inside, ivec2(gl_FragCoord.xy), 0).r > 0.0 ? floor(gl_FragCoord.xy) : vec2(-1.0); }
