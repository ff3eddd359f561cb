#include "renderer/geometry/cells/cell_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/vector_int2_sized.hpp>
#include <glm/ext/vector_uint2_sized.hpp>
#include <glm/geometric.hpp>

#include "renderer/geometry/samples/splat_reach.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

std::uint32_t byte_of(std::uint32_t packed, std::uint32_t side) {
  return (packed >> (8 * side)) & 0xFFU;
}

}  // namespace

CellNodes::CellNodes(const Patch& patch, const PatchSamples& samples)
    : heights_(patch), samples_(samples), records_(heights_.size(), nullptr) {
  for (const SampleRecord& record : samples.records) records_[index(node_of(record))] = &record;
}

glm::uvec2 CellNodes::node_of(const SampleRecord& record) {
  return {record.node & shared::kNodeMask, (record.node >> shared::kRowShift) & shared::kNodeMask};
}

bool CellNodes::has_four(glm::uvec2 node) const {
  const std::size_t k = index(node);
  const std::size_t above = k + heights_.stride();
  return heights_.valid(k) && heights_.valid(k + 1) && heights_.valid(above) &&
         heights_.valid(above + 1);
}

bool CellNodes::is_cell(glm::uvec2 node) const {
  const std::size_t k = index(node);
  const std::size_t above = k + heights_.stride();
  return has_four(node) && on_one_sheet(k, k + 1) && on_one_sheet(above, above + 1) &&
         on_one_sheet(k, above) && on_one_sheet(k + 1, above + 1);
}

bool CellNodes::is_border(std::size_t k) const {
  return (records_[k]->node & shared::kBorderBit) != 0;
}

float CellNodes::steepness(std::size_t k) const {
  const glm::vec2 slope = slope_of(*records_[k]);
  return std::sqrt(1.0F + glm::dot(slope, slope));
}

std::uint32_t CellNodes::closed_reach(const SampleRecord& record, bool toward_holes) const {
  const std::size_t k = index(node_of(record));
  const std::array<std::size_t, 4> beside{k - 1, k + 1, k - heights_.stride(),
                                          k + heights_.stride()};
  const float cosine = 1.0F / steepness(k);
  std::uint32_t packed = 0;
  for (std::uint32_t side = 0; side < 4; ++side) {
    if (!toward_holes && !heights_.valid(beside[side])) continue;
    const float gap = shared::kGapStep * static_cast<float>(byte_of(record.gap, side));
    const auto margin =
        static_cast<std::uint32_t>(std::ceil(fixed_margin(gap, cosine) / shared::kReachStep));
    packed |= std::min(byte_of(record.reach, side) + margin, 255U) << (8 * side);
  }
  return packed;
}

float CellNodes::off_edges(const SampleRecord& record) const {
  const std::size_t k = index(node_of(record));
  const glm::vec2 slope = slope_of(record);
  float most = 0.0F;
  for (std::uint32_t side = 0; side < 4; ++side) {
    const std::size_t step = side < 2 ? 1 : heights_.stride();
    const bool forward = side % 2 == 1;
    const std::size_t next = forward ? k + step : k - step;
    if (!heights_.valid(next)) continue;
    const float rise = samples_.height_step * static_cast<float>(heights_[next] - heights_[k]);
    const float reach = shared::kReachStep * static_cast<float>(byte_of(record.reach, side));
    const float along = side < 2 ? slope.x : slope.y;
    most = std::max(most, reach * std::abs((forward ? along : -along) - rise));
  }
  return most / steepness(k);
}

bool CellNodes::on_one_sheet(std::size_t k, std::size_t beside) const {
  const auto rise = static_cast<float>(heights_[beside] - heights_[k]);
  return samples_.height_step * std::abs(rise) <= shared::kSteepest;
}

glm::vec2 CellNodes::slope_of(const SampleRecord& record) const {
  const glm::i8vec2 steps(glm::u8vec2(record.shape >> 16U, record.shape >> 24U));
  return samples_.slope_step * glm::vec2(steps);
}

}  // namespace relief
