#include "preprocess/tiles/coarse_points.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "common/image/srgb.h"
#include "common/octahedral.h"

namespace relief {
namespace {

/// Sums of a block of samples, patch frame.
struct BlockSums {
  glm::dvec3 position{0.0};  // nodes, nodes, height steps
  int samples = 0;
  glm::vec3 normal{0.0F};
  glm::vec3 light{0.0F};
  int texels = 0;
};

/// The colours of the cell around a node.
void add_texels(const AttributeMap<glm::u8vec3>& map, std::uint32_t i, std::uint32_t j,
                BlockSums& sums) {
  const std::uint32_t half = map.scale / 2;
  const auto first = [&](std::uint32_t node) { return std::max(node * map.scale, half) - half; };
  const auto last = [&](std::uint32_t node, std::uint32_t size) {
    return std::min(node * map.scale + half, size - 1);
  };
  for (std::uint32_t b = first(j); b <= last(j, map.height); ++b) {
    for (std::uint32_t a = first(i); a <= last(i, map.width); ++a) {
      sums.light += linear_from_srgb8(map.texels[std::size_t{b} * map.width + a]);
      ++sums.texels;
    }
  }
}

void add_node(const Patch& patch, std::uint32_t i, std::uint32_t j, BlockSums& sums) {
  const std::int32_t height = patch.at(i, j);
  if (height == kHole) return;
  sums.position += glm::dvec3(i, j, height);
  ++sums.samples;
  const auto& normals = patch.normals;
  const std::size_t at = (std::size_t{j} * normals.width + std::size_t{i}) * normals.scale;
  sums.normal += unit_from_snorm16(normals.texels[at]);
  if (!patch.colours.empty()) add_texels(patch.colours, i, j, sums);
}

void append(const Patch& patch, const BlockSums& sums, Points& points) {
  const glm::dvec3 mean = sums.position / static_cast<double>(sums.samples);
  points.positions.push_back(
      patch.origin +
      patch.axes * (mean * glm::dvec3(patch.spacing, patch.spacing, patch.height_step)));
  // A patch's normals lie in the half space about its own: they do not cancel each other.
  points.normals.push_back(glm::normalize(glm::mat3(patch.axes) * sums.normal));
  if (!patch.colours.empty())
    points.colours.push_back(srgb8_from_linear(sums.light / static_cast<float>(sums.texels)));
}

}  // namespace

Points coarse_points(const Patch& patch) {
  assert(!patch.normals.empty() && "a converter's patches have normals");
  Points points;
  for (std::uint32_t j = 0; j < patch.height; j += 2) {
    for (std::uint32_t i = 0; i < patch.width; i += 2) {
      BlockSums sums;
      for (const std::uint32_t dj : {0U, 1U}) {
        for (const std::uint32_t di : {0U, 1U}) {
          if (i + di < patch.width && j + dj < patch.height) add_node(patch, i + di, j + dj, sums);
        }
      }
      if (sums.samples > 0) append(patch, sums, points);
    }
  }
  return points;
}

}  // namespace relief
