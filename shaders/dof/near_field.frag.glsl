// The blurred near field over the rest. Scene-referred.
// read    blurred  from fill, `as linear`: premultiplied
// modify  result   radiance, with "blend": "premultiplied"
uniform sampler2D blurred;
out vec4 result;

void main() { result = textureLod(blurred, gl_FragCoord.xy * 0.5 / vec2(textureSize(blurred, 0)), 0.0); }
