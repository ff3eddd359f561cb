#include "preprocess/tiles/coarse_points.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

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
  std::array<glm::uvec2, 4> nodes{};  ///< those of the samples
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
  sums.nodes[static_cast<std::size_t>(sums.samples++)] = {i, j};
  const auto& normals = patch.normals;
  const std::size_t at = (std::size_t{j} * normals.width + std::size_t{i}) * normals.scale;
  sums.normal += unit_from_snorm16(normals.texels[at]);
  if (!patch.colours.empty()) add_texels(patch.colours, i, j, sums);
}

/// The mean of the block's numbers, or the most frequent of its labels; of equally frequent ones
/// the smallest. NaN if none of the samples has a value.
double value_of(const AttributeMap<std::uint16_t>& codes, const ScalarInfo& scalar,
                const BlockSums& sums) {
  std::array<std::uint16_t, 4> known{};
  std::size_t count = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(sums.samples); ++n) {
    const std::uint16_t code = texel_at(codes, sums.nodes[n].x, sums.nodes[n].y);
    if (code != kNoScalar) known[count++] = code;
  }
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  const auto values = std::span(known).first(count);
  if (!scalar.is_label) {
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    return scalar.offset + scalar.step * sum / static_cast<double>(count);
  }
  const auto is_less = [&](std::uint16_t a, std::uint16_t b) {
    const auto of_a = std::ranges::count(values, a);
    const auto of_b = std::ranges::count(values, b);
    return of_a != of_b ? of_a < of_b : a > b;
  };
  return scalar.value_of(*std::ranges::max_element(values, is_less));
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

void append_scalars(const Patch& patch, std::span<const ScalarInfo> scalars, const BlockSums& sums,
                    Points& points) {
  for (std::size_t k = 0; k < scalars.size(); ++k)
    points.scalars[k].values.push_back(value_of(patch.scalars[k], scalars[k], sums));
}

}  // namespace

Points coarse_points(const Patch& patch, std::span<const ScalarInfo> scalars) {
  assert(!patch.normals.empty() && "a converter's patches have normals");
  assert(patch.scalars.size() == scalars.size());
  Points points;
  for (const ScalarInfo& scalar : scalars)
    points.scalars.push_back({scalar.name, scalar.is_label, {}});
  for (std::uint32_t j = 0; j < patch.height; j += 2) {
    for (std::uint32_t i = 0; i < patch.width; i += 2) {
      BlockSums sums;
      for (const std::uint32_t dj : {0U, 1U}) {
        for (const std::uint32_t di : {0U, 1U}) {
          if (i + di < patch.width && j + dj < patch.height) add_node(patch, i + di, j + dj, sums);
        }
      }
      if (sums.samples == 0) continue;
      append(patch, sums, points);
      append_scalars(patch, scalars, sums, points);
    }
  }
  return points;
}

}  // namespace relief
