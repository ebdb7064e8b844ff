/*{
  "DESCRIPTION": "Two passes of half the width, then the picture",
  "ISFVSN": "2.0",
  "INPUTS": [
    { "NAME": "inputImage", "TYPE": "image" },
    { "NAME": "spread", "TYPE": "float", "DEFAULT": 1.5, "MIN": 0.0, "MAX": 4.0 }
  ],
  "PASSES": [
    { "TARGET": "across", "WIDTH": "$WIDTH/2.0", "HEIGHT": "$HEIGHT" },
    { "TARGET": "down", "WIDTH": "floor($WIDTH / 2)", "HEIGHT": "$HEIGHT / 2.0" },
    { }
  ]
}*/

void main() {
  vec4 sum = vec4(0.0);
  for (int i = -2; i <= 2; ++i) {
    float at = float(i) * spread;
    if (PASSINDEX == 0) {
      vec2 place = isf_FragNormCoord + vec2(at, 0.0) / RENDERSIZE;
      sum += IMG_NORM_PIXEL(inputImage, place);
    } else if (PASSINDEX == 1) {
      vec2 place = isf_FragNormCoord + vec2(0.0, at) / RENDERSIZE;
      sum += IMG_NORM_PIXEL(across, place);
    }
  }
  if (PASSINDEX < 2)
    gl_FragColor = sum / 5.0;
  else
    gl_FragColor = mix(IMG_THIS_PIXEL(inputImage), IMG_THIS_NORM_PIXEL(down), step(0.5, isf_FragNormCoord.x));
}
