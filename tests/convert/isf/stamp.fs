/*{
  "DESCRIPTION": "A picture that comes with the file",
  "ISFVSN": "2.0",
  "INPUTS": [ { "NAME": "scale", "TYPE": "float", "DEFAULT": 2.0, "MIN": 1.0, "MAX": 4.0 } ],
  "IMPORTED": { "stamp": { "PATH": "../pictures/card.png" } }
}*/

void main() {
  vec2 place = isf_FragNormCoord * scale;
  gl_FragColor = place.x < 1.0 && place.y < 1.0 ? IMG_NORM_PIXEL(stamp, place) : vec4(0.1, 0.2, 0.3, 1.0);
}
