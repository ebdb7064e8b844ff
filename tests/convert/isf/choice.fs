/*{
  "DESCRIPTION": "A long with values and labels, and one without",
  "ISFVSN": "2",
  "INPUTS": [
    { "NAME": "pattern", "TYPE": "long", "VALUES": [0, 5, 9], "LABELS": ["Checks", "Wide stripes", "Dots"], "DEFAULT": 5 },
    { "NAME": "count", "TYPE": "long", "DEFAULT": 6, "MIN": 2, "MAX": 12 }
  ]
}*/

void main() {
  vec2 cell = floor(isf_FragNormCoord * float(count));
  vec2 inside = fract(isf_FragNormCoord * float(count)) - 0.5;
  float on = 0.0;
  if (pattern == 0)
    on = mod(cell.x + cell.y, 2.0);
  else if (pattern == 5)
    on = mod(cell.x, 2.0);
  else if (pattern == 9)
    on = dot(inside, inside) < 0.1 ? 1.0 : 0.0;
  gl_FragColor = vec4(on, 1.0 - on, 0.25, 1.0);
}
