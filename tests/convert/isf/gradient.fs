/*{
  "DESCRIPTION": "A gradient: shows where the origin is, and floats and colours",
  "CREDIT": "Weft's tests",
  "ISFVSN": "2.0",
  "INPUTS": [
    { "NAME": "level", "TYPE": "float", "LABEL": "Level", "DEFAULT": 0.75, "MIN": 0.0, "MAX": 1.0 },
    { "NAME": "tint", "TYPE": "color", "DEFAULT": [1.0, 0.5, 0.25, 1.0] },
    { "NAME": "bands", "TYPE": "float", "DEFAULT": 5, "MIN": 1, "MAX": 10 }
  ]
}*/

void main() {
  vec2 uv = isf_FragNormCoord;
  float band = floor(uv.x * bands) / bands;
  gl_FragColor = vec4(tint.rgb * vec3(uv.x, uv.y, band) * level, tint.a);
}
