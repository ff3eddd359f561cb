#include "renderer/engines/volume_truth/value_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "renderer/volume/kernels/volume_nodes.h"

namespace relief::volume_truth {
namespace {

constexpr int kCorners = 8;

glm::ivec3 corner_of(int c) {
  return {c & 1, (c >> 1) & 1, c >> 2};
}

void widen_range(ValueRange& range, const ValueRange& by) {
  if (by.is_empty()) return;
  if (range.is_empty()) {
    range = by;
    return;
  }
  range.low = std::min(range.low, by.low);
  range.high = std::max(range.high, by.high);
}

}  // namespace

ValueField::ValueField(const ScalarVolume& volume, const Progress& progress)
    : volume_(&volume), gradients_(nodes_of(volume)) {
  const VolumeNodes nodes(volume);
  tbb::parallel_for(std::uint32_t{0}, volume.size.z, [&](std::uint32_t k) {
    if (progress.cancelled()) return;
    for (std::uint32_t j = 0; j < volume.size.y; ++j) {
      for (std::uint32_t i = 0; i < volume.size.x; ++i)
        gradients_[nodes.index({i, j, k})] = glm::vec3(nodes.gradient({i, j, k}));
    }
  });
  blocks_ = (cells() + kBlock - 1) / kBlock;
  ranges_.resize(static_cast<std::size_t>(blocks_.x) * static_cast<std::size_t>(blocks_.y) *
                 static_cast<std::size_t>(blocks_.z));
  tbb::parallel_for(0, blocks_.z, [&](int block) {
    if (progress.cancelled()) return;
    for (int k = block * kBlock; k < std::min((block + 1) * kBlock, cells().z); ++k) {
      for (int j = 0; j < cells().y; ++j) {
        for (int i = 0; i < cells().x; ++i) {
          const glm::ivec3 in = glm::ivec3(i, j, k) / kBlock;
          widen_range(
              ranges_[static_cast<std::size_t>(in.x) +
                      static_cast<std::size_t>(blocks_.x) *
                          (static_cast<std::size_t>(in.y) +
                           static_cast<std::size_t>(blocks_.y) * static_cast<std::size_t>(in.z))],
              range_of_cell({i, j, k}));
        }
      }
    }
  });
}

std::size_t ValueField::index(glm::ivec3 node) const {
  const glm::uvec3 n(node);
  return n.x + std::size_t{volume_->size.x} * (n.y + std::size_t{volume_->size.y} * n.z);
}

ValueRange ValueField::range_of_cell(glm::ivec3 cell) const {
  ValueRange range;
  for (int c = 0; c < kCorners; ++c) {
    const float value = volume_->values[index(cell + corner_of(c))];
    if (std::isnan(value)) return {};
    widen_range(range, {value, value});
  }
  return range;
}

const ValueRange& ValueField::range_of_block(glm::ivec3 cell) const {
  const glm::ivec3 in = cell / kBlock;
  return ranges_[static_cast<std::size_t>(in.x) +
                 static_cast<std::size_t>(blocks_.x) *
                     (static_cast<std::size_t>(in.y) +
                      static_cast<std::size_t>(blocks_.y) * static_cast<std::size_t>(in.z))];
}

template <class T, class At>
T ValueField::interpolated(glm::ivec3 cell, glm::dvec3 place, const At& at) const {
  const glm::dvec3 share = place - glm::dvec3(cell);
  T sum(0.0);
  for (int c = 0; c < kCorners; ++c) {
    const glm::ivec3 corner = corner_of(c);
    const glm::dvec3 w = glm::mix(1.0 - share, share, glm::dvec3(corner));
    sum += w.x * w.y * w.z * T(at(index(cell + corner)));
  }
  return sum;
}

double ValueField::value_at(glm::ivec3 cell, glm::dvec3 place) const {
  return interpolated<double>(cell, place, [&](std::size_t n) { return volume_->values[n]; });
}

ValueField::Sample ValueField::sample_at(glm::ivec3 cell, glm::dvec3 place) const {
  return {value_at(cell, place),
          interpolated<glm::dvec3>(cell, place, [&](std::size_t n) { return gradients_[n]; })};
}

}  // namespace relief::volume_truth
