// Fuzzes the readers of Gaussians: both kinds of .ply, and .spz.
#include <cmath>
#include <string_view>

#include "preprocess/gaussians/gaussian_readers.h"
#include "tests/fuzz/memory_file.h"

namespace relief::fuzz {
namespace {

bool is_finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// What gaussian_cloud.h promises.
void check(const GaussianCloud& cloud) {
  const std::size_t count = cloud.size();
  require(count > 0 && cloud.scales.size() == count && cloud.rotations.size() == count &&
          cloud.opacities.size() == count);
  require(cloud.degree >= 0 && cloud.degree <= kMaxHarmonicsDegree &&
          cloud.harmonics.size() == count * harmonics_of(cloud.degree));
  for (std::size_t k = 0; k < count; ++k) {
    const glm::vec3 scales = cloud.scales[k];
    require(is_finite(cloud.centres[k]) && is_finite(scales));
    require(scales.x > 0.0F && scales.y > 0.0F && scales.z > 0.0F);
    require(std::abs(glm::length(cloud.rotations[k]) - 1.0F) < 1e-5F);
    require(cloud.opacities[k] >= 0.0F && cloud.opacities[k] <= 1.0F);
  }
  for (const glm::vec3& coefficient : cloud.harmonics) require(is_finite(coefficient));
}

}  // namespace
}  // namespace relief::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  // An empty file is refused before any reader sees it. What is packed is .spz of versions 1 to 3.
  if (text.empty()) return 0;
  relief::Progress progress;
  const auto cloud =
      relief::read_gaussian_bytes(text.starts_with("\x1f\x8b") ? "fuzzed.spz" : "fuzzed",
                                  std::as_bytes(std::span(text)), progress);
  if (cloud) {
    relief::fuzz::check(*cloud);
  } else {
    relief::fuzz::require(cloud.error().message.starts_with("fuzzed"));
  }
  return 0;
}
