// The map from the world to a light's u, v and depth, 0 to 1, as the rows of its matrix: a rotation and a scale.
#ifndef SHADOW_ROWS_GLSL
#define SHADOW_ROWS_GLSL

struct MapRows {
  vec4 u, v, depth;
};

// Into a part of the map: its corner and its size.
MapRows inPart(MapRows rows, vec3 part) {
  return MapRows(rows.u * part.z + vec4(0.0, 0.0, 0.0, part.x), rows.v * part.z + vec4(0.0, 0.0, 0.0, part.y), rows.depth);
}

vec3 onMap(MapRows rows, vec3 at) {
  vec4 point = vec4(at, 1.0);
  return vec3(dot(rows.u, point), dot(rows.v, point), dot(rows.depth, point));
}

#endif
