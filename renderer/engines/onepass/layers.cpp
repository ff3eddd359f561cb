#include "renderer/engines/onepass/layers.h"

#include <utility>

#include "renderer/frame/targets/attachments.h"
#include "shaders/include/shared.h"

namespace relief::onepass {
namespace {

Result<Layer> make_layer(const Gl& gl, const Targets& targets, const Texture& colour,
                         Features features) {
  Texture z_buffer =
      make_attachment(gl, "layer depth", GL_DEPTH_COMPONENT32F, targets.width, targets.height);
  Result<Visibility> visibility =
      make_visibility(gl, {targets.width, targets.height}, z_buffer, features);
  if (!visibility) return visibility.error();
  Framebuffer shading = make_framebuffer(gl, "layer", &z_buffer, {{RELIEF_OUT_COLOUR, &colour}});
  return Layer{std::move(z_buffer), std::move(*visibility), std::move(shading)};
}

}  // namespace

Result<Layers> make_layers(const Gl& gl, const Targets& targets, Features features) {
  Texture colour = make_attachment(gl, "layers", GL_RGBA16F, targets.width, targets.height);
  RELIEF_TRY_ASSIGN(Layer one, make_layer(gl, targets, colour, features));
  RELIEF_TRY_ASSIGN(Layer other, make_layer(gl, targets, colour, features));
  Framebuffer front = make_framebuffer(gl, "front layer", &one.z_buffer,
                                       {{RELIEF_OUT_COLOUR, &colour},
                                        {RELIEF_OUT_NORMAL, address(targets.normal)},
                                        {RELIEF_OUT_DEPTH, address(targets.depth)},
                                        {RELIEF_OUT_UV, address(targets.uv)},
                                        {RELIEF_OUT_PATCH, address(targets.patch_id)}});
  Framebuffer over = make_framebuffer(gl, "over", nullptr, {{RELIEF_OUT_COLOUR, &targets.colour}});
  RELIEF_TRY(check_errors(gl, "the layers of semi-transparent surfaces"));
  return Layers{
      std::move(colour), {std::move(one), std::move(other)}, std::move(front), std::move(over)};
}

}  // namespace relief::onepass
