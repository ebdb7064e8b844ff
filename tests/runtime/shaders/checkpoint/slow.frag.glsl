// write   result   beat, and the place
// params  beat     a number
layout(std140) uniform Parameters { float beat; };
out vec4 result;

void main() { result = vec4(beat, gl_FragCoord.xy, 1.0); }
