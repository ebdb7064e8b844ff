/*{
  "DESCRIPTION": "A filter with switches",
  "ISFVSN": "2.0",
  "INPUTS": [
    { "NAME": "inputImage", "TYPE": "image" },
    { "NAME": "invert", "TYPE": "bool", "DEFAULT": true, "LABEL": "Invert" },
    { "NAME": "flash", "TYPE": "event" },
    { "NAME": "gain", "TYPE": "float", "DEFAULT": 0.8, "MIN": 0, "MAX": 2 }
  ]
}*/

void main() {
  vec4 color = IMG_THIS_PIXEL(inputImage);
  if (invert) color.rgb = 1.0 - color.rgb;
  if (flash) color.rgb += 0.5;
  gl_FragColor = vec4(color.rgb * gain, color.a);
}
