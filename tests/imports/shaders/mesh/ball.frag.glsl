// The albedo of the sphere on top.
// modify  seen, depth
flat in vec3 albedo;
out vec4 seen;

void main() { seen = vec4(albedo, 1.0); }
