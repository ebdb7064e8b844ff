// write   depth    (x + 1) / 16
void main() { gl_FragDepth = (floor(gl_FragCoord.x) + 1.0) / 16.0; }
