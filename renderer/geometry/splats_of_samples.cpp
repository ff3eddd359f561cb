#include "renderer/geometry/splats_of_samples.h"

#include <algorithm>
#include <cmath>

#include "common/image/srgb.h"
#include "renderer/geometry/patch_normals.h"
#include "renderer/shading/materials.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Beyond 80 degrees, which no patch that keeps its normal cone reaches, h stays what it is there.
constexpr double kMinTiltCosine = 0.17;

void append_samples(const Patch& patch, std::uint32_t id, bool coloured, SplatCloud& cloud) {
  const AttributeMap<glm::i16vec2> normals = normal_map_of(patch);
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      if (patch.at(i, j) == kHole) continue;
      const glm::vec3 normal = normal_at_node(normals, i, j);
      const double cosine = std::max(double{normal.z}, kMinTiltCosine);
      cloud.positions.push_back(position_of(patch, i, j));
      cloud.normals.emplace_back(patch.axes * glm::dvec3(normal));
      cloud.radii.push_back(patch.spacing / std::sqrt(cosine));
      cloud.uvs.emplace_back(i, j);
      cloud.patches.push_back(id + 1);
      if (!coloured) continue;
      const glm::vec3 colour = patch.colours.empty()
                                   ? glm::vec3(shared::kNeutralGrey)
                                   : linear_from_srgb8(texel_at(patch.colours, i, j));
      cloud.colours.emplace_back(colour, 1.0F);
    }
  }
}

}  // namespace

SplatCloud splats_of_samples(const PatchModel& model) {
  SplatCloud cloud;
  const std::size_t samples = count_samples(model);
  cloud.positions.reserve(samples);
  cloud.normals.reserve(samples);
  cloud.radii.reserve(samples);
  cloud.uvs.reserve(samples);
  cloud.patches.reserve(samples);
  if (model.has_colours) cloud.colours.reserve(samples);
  for (std::size_t p = 0; p < model.patches.size(); ++p)
    append_samples(model.patches[p], static_cast<std::uint32_t>(p), model.has_colours, cloud);
  cloud.materials = materials_of_patches(model, cloud.patches);
  return cloud;
}

}  // namespace relief
