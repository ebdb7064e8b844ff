// The boxes of decals. A picture is projected along the third axis of its box.
layout(std140) uniform Parameters {
  vec4 places[COUNT];  // world; w: half the size
  vec4 axes[COUNT];    // towards where it is projected from; w: turn in degrees
  vec4 colors[COUNT];  // linear; w: which picture
  float opacity;
};

// The axes of a box, unit.
mat3 boxAxes(int i) {
  vec3 z = normalize(axes[i].xyz);
  vec3 x = normalize(cross(abs(z.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, -1.0), z)), y = cross(z, x);
  float turn = radians(axes[i].w);
  return mat3(cos(turn) * x + sin(turn) * y, cos(turn) * y - sin(turn) * x, z);
}
