// Where engines on OpenGL sum up splats, and the framebuffers of their three passes.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>

#include "common/error.h"
#include "renderer/frame/targets/targets.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief {

/// How exactly splats are summed up. Half floats do for samples of patches, of which few overlap in
/// a pixel: floats changed no PSNR in its second digit. They stop growing at 2048 times what is
/// added, which points that are seen from afar reach.
enum class SumPrecision : bool { Half, Full };

/// One for each image, of its size. A sum that no feature asks for does not exist.
struct SplatSums {
  std::optional<Texture> normals;    ///< RGBA: weighted normal, weights
  std::optional<Texture> colours;    ///< RGBA: weighted linear colour, weights
  std::optional<Texture> depths;     ///< RG32F: weighted depth, weights
  std::optional<Texture> materials;  ///< R8UI: of the splat in front, if pass 1 writes it
  std::optional<Texture> sides;      ///< R8UI: of the splat in front, where both sides are drawn
  Framebuffer visibility;    ///< pass 1: the image's depth buffer, UV, patch id, material, side
  Framebuffer accumulation;  ///< pass 2: the sums, tested against that depth
  Framebuffer shading;       ///< pass 3: the image's colour, normal and depth
};

/// Makes them; `targets` must outlive them. `keeps_materials`: pass 1 writes what material splats
/// have, where there are several. Fails if OpenGL lacks memory.
Result<SplatSums> make_sums(const Gl& gl, const Targets& targets, Features features,
                            SumPrecision precision = SumPrecision::Half,
                            bool keeps_materials = false);

/// Whether there is anything to sum up.
[[nodiscard]] inline bool has_any(const SplatSums& sums) {
  return sums.normals || sums.colours || sums.depths;
}

/// Adds up what a pass over splats draws, or lays it over what is there, without writing depth.
enum class SumBlend : bool { Add, Over };

/// Clears the sums for a frame. While it lives, `sums.accumulation` is bound, blended into, and
/// tested against the depth that it does not write.
class SummingUp {
 public:
  SummingUp(const Gl& gl, const SplatSums& sums, SumBlend blend);
  ~SummingUp();
  SummingUp(const SummingUp&) = delete;
  SummingUp& operator=(const SummingUp&) = delete;

 private:
  const Gl& gl_;
};

/// A texture for a shader; null: none.
struct BoundTexture {
  GLuint unit;
  const Texture* texture;
};

/// Pass 3: shades once each pixel that pass 1 covers, with a program of include/shade_sums.glsl.
/// `environment` may be null; `beside`: what else the program reads. `nothing`: a vertex array
/// without attributes. Leaves nothing bound but the framebuffer.
void draw_shading_pass(const Gl& gl, const SplatSums& sums, const Program& program,
                       const VertexArray& nothing, const Texture* environment,
                       std::initializer_list<BoundTexture> beside);

}  // namespace relief
