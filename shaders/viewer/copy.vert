// One triangle over the whole window, and where each point of it is in the canvas, 0 to 1.
layout(location = 0) out vec2 at;

void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
  at = 0.5 * gl_Position.xy + 0.5;
}
