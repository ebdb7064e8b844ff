// Too few coordinates.
uniform sampler2D source;
out vec4 result;

void main() { result = texture(source, gl_FragCoord.x); }
