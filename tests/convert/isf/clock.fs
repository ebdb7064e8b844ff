/*{
  "DESCRIPTION": "What changes from frame to frame",
  "ISFVSN": "2.0",
  "INPUTS": []
}*/

void main() {
  float ring = length(gl_FragCoord.xy - 0.5 * RENDERSIZE) / RENDERSIZE.y;
  float beat = 0.5 + 0.5 * sin(TIME * 20.0 - ring * 12.0);
  float count = mod(float(FRAMEINDEX), 8.0) / 8.0;
  gl_FragColor = vec4(beat, count, TIMEDELTA * 30.0, 1.0);
}
