/*{
  "DESCRIPTION": "A persistent buffer of floats: a dot that leaves a trail",
  "ISFVSN": "2.0",
  "INPUTS": [ { "NAME": "decay", "TYPE": "float", "DEFAULT": 0.875, "MIN": 0.0, "MAX": 1.0 } ],
  "PASSES": [ { "TARGET": "trail", "PERSISTENT": true, "FLOAT": true } ]
}*/

void main() {
  vec2 centre = RENDERSIZE * vec2(0.15 + 0.04 * float(FRAMEINDEX), 0.3 + 0.02 * float(FRAMEINDEX));
  float dot_ = FRAMEINDEX > 0 ? clamp(6.5 - distance(gl_FragCoord.xy, centre), 0.0, 1.0) : 0.0;
  vec4 old = IMG_THIS_PIXEL(trail);
  gl_FragColor = vec4(max(vec3(dot_, dot_ * 0.5, dot_ * 0.25), old.rgb * decay), 1.0);
}
