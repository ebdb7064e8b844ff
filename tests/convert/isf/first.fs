/*{
  "DESCRIPTION": "Version 1: persistent buffers at the top, the old name of the coordinate",
  "INPUTS": [ { "NAME": "inputImage", "TYPE": "image" } ],
  "PERSISTENT_BUFFERS": [ "memory" ],
  "PASSES": [ { "TARGET": "memory" }, { } ]
}*/

void main() {
  if (PASSINDEX == 0) {
    vec4 now = IMG_THIS_PIXEL(inputImage);
    vec4 before = IMG_THIS_PIXEL(memory);
    gl_FragColor = mix(now, before, 0.5);
  } else {
    gl_FragColor = vec4(IMG_THIS_PIXEL(memory).rgb * vv_FragNormCoord.x, 1.0);
  }
}
