// Lines over the picture; dashes where something is in front of them.
// read    depth   near / distance along the view axis (reversed-Z)
// modify  result  display-referred
uniform sampler2D depth;

in float along;
flat in vec3 color;

out vec4 result;

void main() {
  if (gl_FragCoord.z < 0.9995 * texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r && fract(16.0 * along) > 0.4) discard;
  result = vec4(color, 1.0);
}
