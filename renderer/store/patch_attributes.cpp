#include "renderer/store/patch_attributes.h"

#include "shaders/include/shared.h"

namespace relief {

VertexArray make_patch_attributes(const Gl& gl, const char* label, const Buffer& patches,
                                  GLsizei stride, const Buffer& elements) {
  VertexArray attributes(gl, label);
  const GLuint id = attributes.id();
  gl.VertexArrayBindingDivisor(id, 0, 1);
  add_instance_attribute(gl, attributes, RELIEF_ATTRIBUTE_PATCH, 0);
  gl.VertexArrayVertexBuffer(id, 0, patches.id(), 0, stride);
  gl.VertexArrayElementBuffer(id, elements.id());
  return attributes;
}

void add_instance_attribute(const Gl& gl, const VertexArray& attributes, GLuint location,
                            GLuint offset) {
  const GLuint id = attributes.id();
  gl.EnableVertexArrayAttrib(id, location);
  gl.VertexArrayAttribIFormat(id, location, 1, GL_UNSIGNED_INT, offset);
  gl.VertexArrayAttribBinding(id, location, 0);
}

}  // namespace relief
