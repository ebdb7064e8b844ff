/*{
  "ISFVSN": "2.0",
  "inputs": [ { "NAME": "gain", "TYPE": "float" } ]
}*/

void main() { gl_FragColor = vec4(gain); }
