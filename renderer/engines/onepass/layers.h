// Where semi-transparent surfaces are found and summed up, one behind the other.
#pragma once

#include <array>
#include <cstdint>

#include "common/error.h"
#include "renderer/engines/onepass/visibility.h"
#include "renderer/frame/targets/targets.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief::onepass {

/// Surfaces that a pixel shows at most, front to back; what is behind them is left out. At opacity
/// 0.5 less than 1e-9 of its light would come through.
inline constexpr int kMaxSurfaces = 32;

/// A layer: what is found of it, and where it is shaded.
struct Layer {
  Texture z_buffer;
  Visibility visibility;
  Framebuffer shading;  ///< Layers::colour, tested against the layer's depth
};

/// One for each image with a semi-transparent material, of its size.
struct Layers {
  Texture colour;             ///< RGBA16F: the layers so far, premultiplied
  std::array<Layer, 2> pair;  ///< the one before and the one at work, in turns
  Framebuffer front;          ///< of the first: with the image's outputs beside its colour
  Framebuffer over;           ///< the image's colour alone
};

/// Makes them; `targets` must outlive them. Fails if OpenGL lacks memory.
Result<Layers> make_layers(const Gl& gl, const Targets& targets, Features features);

}  // namespace relief::onepass
