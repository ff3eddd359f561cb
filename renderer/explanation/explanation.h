// What an image took on OpenGL: nothing that its scene does not use should be in it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/explanation/feature_cost.h"

namespace relief {

/// Recorded while the image was made and drawn (renderer/gl/recorder.h); names are the labels
/// that the objects have in a debugger.
struct Explanation {
  /// A program, compiled with the code of its features alone.
  struct Variant {
    std::string name;
    std::string vertex;  ///< file, relative to shaders/
    std::string fragment;
    std::vector<std::string> features;  ///< of shaders/include/shared.h, in lower case
    /// Of both stages' texts, what the preprocessor leaves
    /// (renderer/gl/shader/preprocess_shader.h).
    std::uint64_t lines = 0;
    bool drawn = false;  ///< in the frame
  };
  /// A buffer or a texture.
  struct Memory {
    std::string name;
    std::uint64_t bytes = 0;  ///< as OpenGL was asked for them; all levels and layers
    bool target = false;      ///< a framebuffer draws into it
    bool bound = false;       ///< to a draw call of the frame
  };
  struct Draw {
    std::string pass;
    std::string program;
    std::string primitive;       ///< "points", "triangles", "triangle strip"
    std::uint64_t commands = 0;  ///< of a multi-draw; 1 of a single draw
    bool front_alone = false;    ///< OpenGL leaves out triangles that face away
  };

  std::vector<std::string> features;  ///< of all variants that the frame drew with
  std::vector<Variant> variants;      ///< all that were compiled
  std::vector<Memory> buffers;        ///< those that exist after the frame or were bound in it
  std::vector<Memory> textures;       ///< the same; without those that show a buffer
  std::vector<std::string> passes;    ///< of one frame, in their order
  std::vector<Draw> draws;            ///< the same
  /// What each feature of the image costs, if RenderSettings::cost_turns asked for it.
  std::optional<FeatureCosts> costs;
};

/// Bytes of the buffers and textures that the frame's draw calls had bound.
struct BoundBytes {
  std::uint64_t all = 0;
  std::uint64_t model = 0;  ///< without what the frame draws into
};

[[nodiscard]] BoundBytes bound_bytes(const Explanation& explanation);

/// Adds what a further part of the same frame took.
void append(Explanation& all, const Explanation& more);

}  // namespace relief
