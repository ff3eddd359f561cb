#include "renderer/geometry/patch_normals.h"

#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "common/octahedral.h"
#include "common/patch_file/continuation.h"
#include "renderer/geometry/node_texels.h"
#include "renderer/geometry/samples/samples.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// One normal per node, from the slopes of the heights.
AttributeMap<glm::i16vec2> normals_of_heights(const Patch& patch) {
  AttributeMap<glm::i16vec2> map{patch.width, patch.height, 1, {}};
  map.texels.resize(patch.heights.size(), glm::i16vec2(0));
  std::vector<std::uint8_t> kept(patch.heights.size(), 0);
  const PatchSamples samples = make_samples(patch);
  for (const SampleRecord& record : samples.records) {
    const std::uint32_t i = record.node & shared::kNodeMask;
    const std::uint32_t j = (record.node >> shared::kRowShift) & shared::kNodeMask;
    const glm::i8vec2 steps(glm::u8vec2(record.shape >> 16U, record.shape >> 24U));
    const glm::vec2 slope = samples.slope_step * glm::vec2(steps);
    const std::size_t k = std::size_t{j} * patch.width + i;
    map.texels[k] = snorm16_from_unit(glm::normalize(glm::vec3(-slope, 1.0F)));
    kept[k] = 1;
  }
  continue_over_holes(map, kept);
  return map;
}

}  // namespace

AttributeMap<glm::i16vec2> normal_map_of(const Patch& patch) {
  return patch.normals.empty() ? normals_of_heights(patch) : patch.normals;
}

glm::vec3 normal_at_node(const AttributeMap<glm::i16vec2>& map, std::uint32_t i, std::uint32_t j) {
  const glm::vec3 middle = unit_from_snorm16(texel_at(map, i, j));
  if (map.scale == 1) return middle;
  const glm::vec3 sum = sum_about_node(map, i, j, unit_from_snorm16).sum;
  const float length = glm::length(sum);
  return length > 1e-3F ? sum / length : middle;
}

}  // namespace relief
