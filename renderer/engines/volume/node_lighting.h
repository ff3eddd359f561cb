// Lights a regular grid's nodes on OpenGL: for each frame, because lights and eye move.
#pragma once

#include <map>
#include <optional>

#include "common/error.h"
#include "renderer/engines/volume/drawing.h"
#include "renderer/engines/volume/grid_textures.h"

namespace relief::volume {

class NodeLighting {
 public:
  explicit NodeLighting(const Gl& gl) : gl_(gl), nothing_(gl, "no attributes") {}

  /// Whether it does what these settings ask for: lights and no environment, and the extension
  /// GL_ARB_shader_viewport_layer_array.
  [[nodiscard]] bool can_light(const RenderSettings& settings);

  /// What was kept of other nodes goes.
  void reset() { kept_.reset(); }

  /// Lit colours and extinctions (RGBA16F), until the next call. `nodes`: with the kernels' own
  /// colours and with normals, the same ones since the last reset().
  const Texture& light(const VolumeFrame& frame, const RegularGrid& grid, const GridTextures& nodes,
                       PassTimer& timer);

 private:
  struct Kept {
    Texture lit;
    Framebuffer framebuffer;
    Table squares;
    GLsizei count = 0;
  };

  Kept make_kept(const VolumeFrame& frame, const GridTextures& nodes) const;

  const Gl& gl_;
  VertexArray nothing_;
  std::map<Features, std::optional<Program>> programs_;  ///< none: it does not compile
  std::optional<Kept> kept_;
};

}  // namespace relief::volume
