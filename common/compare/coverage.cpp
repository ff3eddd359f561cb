#include "common/compare/coverage.h"

#include <algorithm>
#include <cmath>

namespace relief {
namespace {

constexpr float kCoveredAlpha = 0.5F;

/// The channel that determines an image's coverage.
struct Sources {
  const Channel* alpha;  ///< null if there is none or it is 1 everywhere: an opaque background
  const Channel* depth;
};

Sources find_sources(const Image& image) {
  const Channel* alpha = image.find("A");
  // Negated so that NaN counts as a transparent background.
  if (alpha != nullptr &&
      std::all_of(alpha->values.begin(), alpha->values.end(), [](float a) { return a >= 1.0F; })) {
    alpha = nullptr;
  }
  return {alpha, image.find("Z")};
}

template <class IsCovered>
std::vector<std::uint8_t> make_mask(const Channel& channel, const IsCovered& is_covered) {
  std::vector<std::uint8_t> mask(channel.values.size());
  std::transform(channel.values.begin(), channel.values.end(), mask.begin(),
                 [&](float v) { return is_covered(v) ? std::uint8_t{1} : std::uint8_t{0}; });
  return mask;
}

/// Returns the mask of one image; empty if no channel determines it.
std::vector<std::uint8_t> find_mask(const Sources& sources, bool depth_first) {
  if (sources.alpha != nullptr && !(depth_first && sources.depth != nullptr)) {
    return make_mask(*sources.alpha, [](float a) { return a >= kCoveredAlpha; });
  }
  if (sources.depth != nullptr) {
    return make_mask(*sources.depth, [](float z) { return std::isfinite(z); });
  }
  return {};
}

/// Returns whether all pixels of the 3x3 block about (x, y) that lie in the image are covered.
bool is_inside(const std::vector<std::uint8_t>& mask, std::uint32_t width, std::uint32_t height,
               std::uint32_t x, std::uint32_t y) {
  for (std::uint32_t v = y > 0 ? y - 1 : 0; v <= std::min(y + 1, height - 1); ++v) {
    for (std::uint32_t u = x > 0 ? x - 1 : 0; u <= std::min(x + 1, width - 1); ++u) {
      if (mask[std::size_t{v} * width + u] == 0) return false;
    }
  }
  return true;
}

}  // namespace

Result<CoverageMasks> find_coverage(const Image& test, const Image& reference) {
  const Sources a = find_sources(test);
  const Sources b = find_sources(reference);
  const bool depth_first =
      a.depth != nullptr && b.depth != nullptr && (a.alpha == nullptr || b.alpha == nullptr);
  CoverageMasks masks;
  masks.test = find_mask(a, depth_first);
  masks.reference = find_mask(b, depth_first);
  if (masks.test.empty() || masks.reference.empty()) {
    return make_error("{} has neither a transparent background nor a channel Z",
                      masks.test.empty() ? "the image under test" : "the reference");
  }
  masks.both.resize(masks.test.size());
  std::transform(masks.test.begin(), masks.test.end(), masks.reference.begin(), masks.both.begin(),
                 [](std::uint8_t t, std::uint8_t r) { return std::min(t, r); });
  return masks;
}

CoverageErrors count_coverage_errors(const CoverageMasks& masks, std::uint32_t width,
                                     std::uint32_t height) {
  CoverageErrors errors;
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::size_t k = std::size_t{y} * width + x;
      const bool in_test = masks.test[k] != 0;
      const bool in_reference = masks.reference[k] != 0;
      if (in_reference) ++errors.covered_reference;
      if (in_reference && in_test) ++errors.covered_both;
      if (in_test && !in_reference) ++errors.border_extra;
      if (in_reference && !in_test) {
        ++(is_inside(masks.reference, width, height, x, y) ? errors.holes : errors.border_missing);
      }
    }
  }
  return errors;
}

}  // namespace relief
