#include "preprocess/partition/spacing_range.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstddef>

namespace relief {
namespace {

constexpr double kShare = 0.1;

}  // namespace

SpacingRange spacing_range(std::vector<float> spacings) {
  if (spacings.empty()) return {};
  tbb::parallel_sort(spacings);
  double area = 0.0;
  for (const float s : spacings) area += double{s} * s;
  double sparser = 0.0;
  auto sparse = spacings.end() - 1;
  while (sparse != spacings.begin()) {
    sparser += double{*sparse} * *sparse;
    if (sparser > kShare * area) break;
    --sparse;
  }
  return {spacings[static_cast<std::size_t>(kShare * static_cast<double>(spacings.size()))],
          *sparse};
}

std::vector<float> values_of(const std::vector<float>& values, const Region& region) {
  std::vector<float> own;
  own.reserve(region.points.size());
  for (const std::uint32_t i : region.points) own.push_back(values[i]);
  return own;
}

float median_of(const std::vector<float>& values, const Region& region) {
  std::vector<float> own = values_of(values, region);
  const auto middle = own.begin() + static_cast<std::ptrdiff_t>((own.size() - 1) / 2);
  std::nth_element(own.begin(), middle, own.end());
  return *middle;
}

}  // namespace relief
