// Where engines on OpenGL sum up splats, and the framebuffers of their three passes.
#pragma once

#include <cstdint>
#include <optional>

#include "common/error.h"
#include "renderer/frame/targets.h"
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
  Framebuffer visibility;            ///< pass 1: the image's depth buffer, UV, patch id, material
  Framebuffer accumulation;          ///< pass 2: the sums, tested against that depth
  Framebuffer shading;               ///< pass 3: the image's colour, normal and depth
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

/// Clears the sums for a frame.
void clear_sums(const Gl& gl, const SplatSums& sums);

}  // namespace relief
