#include "renderer/engines/onepass/visibility.h"

#include <optional>
#include <utility>

#include "renderer/frame/targets/attachments.h"
#include "shaders/include/shared.h"

namespace relief::onepass {

Result<Visibility> make_visibility(const Gl& gl, glm::uvec2 size, const Texture& z_buffer,
                                   Features features, const VisibilityLabels& labels) {
  const auto make = [&](const char* label, GLenum format) {
    return make_attachment(gl, label, format, size.x, size.y);
  };
  Texture coordinates = make(labels.coordinates, GL_RG32UI);
  std::optional<Texture> depths;
  if (features.has(RELIEF_FEATURE_OUT_DEPTH | RELIEF_FEATURE_POINT_LIGHTS |
                   RELIEF_FEATURE_TWO_INTERFACES))
    depths = make(labels.depths, GL_R32F);
  Framebuffer framebuffer = make_framebuffer(
      gl, labels.framebuffer, &z_buffer,
      {{RELIEF_OUT_VISIBILITY, &coordinates}, {RELIEF_OUT_VISIBILITY_DEPTH, address(depths)}});
  RELIEF_TRY(check_errors(gl, "the visibility buffer"));
  return Visibility{std::move(coordinates), std::move(depths), std::move(framebuffer)};
}

bool can_be_found(const PatchStore& store) {
  return store.patches.size() <= std::size_t{1} << (2 * shared::kVisibilityPatchBits - 1);
}

float position_steps(std::uint32_t side) {
  const float cells = static_cast<float>(side) + 2.0F * shared::kVisibilityBegin;
  float steps = 1.0F;
  while (2.0F * steps * cells <= static_cast<float>(shared::kVisibilityMask)) steps *= 2.0F;
  return steps;
}

}  // namespace relief::onepass
