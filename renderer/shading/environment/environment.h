// The surroundings on the GPU.
#pragma once

#include <cstdint>
#include <vector>

#include "common/error.h"
#include "renderer/gl/drawing/pass.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/shading/environment/cube_map.h"

namespace relief {

/// A cube map with mip levels, half floats. Fails if OpenGL can't hold it.
Result<Texture> upload_environment(const Gl& gl, const CubeMap& cube);

/// Cube maps of one size as the layers of an array, with mip levels, half floats. Fails if OpenGL
/// can't hold them.
Result<Texture> upload_environments(const Gl& gl, const std::vector<CubeMap>& cubes);

/// Draws the environment where the frame has no model (depth 0 in the bound framebuffer). The frame
/// uniforms must be bound.
class Backdrop {
 public:
  /// `features`: RELIEF_FEATURE_ORTHOGRAPHIC or none.
  static Result<Backdrop> create(const Gl& gl, Features features);
  void draw(PassTimer& timer, const Texture& environment) const;

 private:
  Backdrop(const Gl& gl, Program program, VertexArray nothing)
      : gl_(&gl), program_(std::move(program)), nothing_(std::move(nothing)) {}
  const Gl* gl_;
  Program program_;
  VertexArray nothing_;  ///< a vertex array without attributes, which OpenGL wants nevertheless
};

}  // namespace relief
