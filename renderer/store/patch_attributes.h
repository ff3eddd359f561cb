// Vertex arrays of draws whose instances are patches.
#pragma once

#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief {

/// Makes a vertex array without vertex data: per instance the patch, the first 32 bits of each
/// `stride` bytes of `patches`; indices from `elements`.
[[nodiscard]] VertexArray make_patch_attributes(const Gl& gl, const char* label,
                                                const Buffer& patches, GLsizei stride,
                                                const Buffer& elements);

/// Adds another 32 bits of each instance's, `offset` bytes from the first.
void add_instance_attribute(const Gl& gl, const VertexArray& attributes, GLuint location,
                            GLuint offset);

}  // namespace relief
