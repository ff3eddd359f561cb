// Where `multipass` sums up splats, and the framebuffers of its three passes.
#pragma once

#include <cstdint>
#include <optional>

#include "common/error.h"
#include "renderer/frame/targets.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief::multipass {

/// One for each image, of its size. A sum that no feature asks for does not exist. Half floats
/// for what a colour target keeps as half floats too: floats changed no PSNR in its second digit.
struct Sums {
  std::optional<Texture> normals;  ///< RGBA16F: weighted normal, weights
  std::optional<Texture> colours;  ///< RGBA16F: weighted linear colour, weights
  std::optional<Texture> depths;   ///< RG32F: weighted depth, weights
  Framebuffer visibility;          ///< pass 1: the image's depth buffer, UV and patch id
  Framebuffer accumulation;        ///< pass 2: the sums, tested against that depth
  Framebuffer shading;             ///< pass 3: the image's colour, normal and depth
};

/// Makes them; `targets` must outlive them. Fails if OpenGL lacks memory.
Result<Sums> make_sums(const Gl& gl, const Targets& targets, Features features);

/// Whether there is anything to sum up.
[[nodiscard]] inline bool has_any(const Sums& sums) {
  return sums.normals || sums.colours || sums.depths;
}

/// Clears the sums for a frame.
void clear_sums(const Gl& gl, const Sums& sums);

}  // namespace relief::multipass
