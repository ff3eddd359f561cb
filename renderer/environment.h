// The surroundings: a cube map from a picture, or the built-in one.
#pragma once

#include <filesystem>

#include "common/error.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/gl/pass.h"

namespace relief {

/// A cube map with mip levels, linear light, world directions. From an equirectangular picture
/// (+Y up, its middle toward -Z, its right half toward +X), or, if `path` is empty, the built-in
/// sky with a grid. Non-finite values become 0, those above what half floats hold are clamped.
/// Fails if the file can't be read, has no colour, or is wider than OpenGL allows.
Result<Texture> make_environment(const Gl& gl, const std::filesystem::path& path);

/// Draws the environment where the frame has no model (depth 0 in the bound framebuffer). The frame
/// uniforms must be bound.
class Backdrop {
 public:
  static Result<Backdrop> create(const Gl& gl);
  void draw(PassTimer& timer, const Texture& environment) const;

 private:
  Backdrop(const Gl& gl, Program program, VertexArray nothing)
      : gl_(&gl), program_(std::move(program)), nothing_(std::move(nothing)) {}
  const Gl* gl_;
  Program program_;
  VertexArray nothing_;  ///< a vertex array without attributes, which OpenGL wants nevertheless
};

}  // namespace relief
