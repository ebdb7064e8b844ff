/*{
  "DESCRIPTION": "A transition from one picture to another, from below",
  "ISFVSN": "2.0",
  "CATEGORIES": ["Wipe"],
  "INPUTS": [
    { "NAME": "startImage", "TYPE": "image" },
    { "NAME": "endImage", "TYPE": "image" },
    { "NAME": "progress", "TYPE": "float", "DEFAULT": 0.4, "MIN": 0.0, "MAX": 1.0 }
  ]
}*/

vec4 before(vec2 place) {
  return IMG_NORM_PIXEL(startImage, place);
}

vec4 after(vec2 place) {
  return IMG_NORM_PIXEL(endImage, place);
}

void main() {
  vec2 place = isf_FragNormCoord;
  gl_FragColor = mix(after(place), before(place), smoothstep(progress - 0.1, progress + 0.1, place.y));
}
