/*{
  "IMPORTED": {
    "sky": { "TYPE": "cube", "PATH": ["a.png", "b.png", "c.png", "d.png", "e.png", "f.png"] }
  }
}*/
void main() { gl_FragColor = vec4(1.0); }
