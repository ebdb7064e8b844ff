// Each instance on a layer of its own.
#extension GL_ARB_shader_viewport_layer_array : require
flat out float value;

void main() {
  gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0, 0.5, 1.0);
  gl_Layer = gl_InstanceID;
  value = float(gl_InstanceID + 1);
}
