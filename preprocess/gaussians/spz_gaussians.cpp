#include "preprocess/gaussians/spz_gaussians.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numbers>
#include <utility>

#include "preprocess/gaussians/gaussian_collector.h"
#include "preprocess/readers/number_type.h"

namespace relief {
namespace {

/// One unit of degree 0 is this much of the range of a byte, so that colours beyond 0 to 1 fit.
constexpr double kColourScale = 0.15;

/// The streams, with the Gaussian's bytes of each.
struct SpzStreams {
  SpzStreams(const SpzSizes& s, std::size_t count, std::span<const std::byte> bytes) : sizes(s) {
    const auto* at = reinterpret_cast<const unsigned char*>(bytes.data());
    centres = at;
    opacities = centres + count * s.centres;
    colours = opacities + count * s.opacities;
    scales = colours + count * s.colours;
    rotations = scales + count * s.scales;
    harmonics = rotations + count * s.rotations;
  }

  SpzSizes sizes;
  const unsigned char* centres;
  const unsigned char* opacities;
  const unsigned char* colours;
  const unsigned char* scales;
  const unsigned char* rotations;
  const unsigned char* harmonics;
};

/// 24 bits with a sign.
std::int32_t fixed24(const unsigned char* bytes) {
  const auto bits = static_cast<std::uint32_t>(bytes[0]) |
                    static_cast<std::uint32_t>(bytes[1]) << 8U |
                    static_cast<std::uint32_t>(bytes[2]) << 16U;
  return static_cast<std::int32_t>(bits << 8U) >> 8;
}

glm::dvec3 centre_of(const unsigned char* bytes, const SpzHeader& header) {
  glm::dvec3 centre;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<glm::length_t>(a);
    if (header.version == 1) {
      const auto half = static_cast<std::uint16_t>(bytes[2 * a] | bytes[2 * a + 1] << 8);
      centre[axis] = static_cast<double>(glm::unpackHalf1x16(half));
    } else {
      centre[axis] = std::ldexp(fixed24(bytes + 3 * a), -header.fractional_bits);
    }
  }
  return centre;
}

/// Versions 1 and 2: x, y and z, with w not below 0.
glm::dquat rotation_of_three(const unsigned char* bytes) {
  const glm::dvec3 xyz = glm::dvec3(bytes[0], bytes[1], bytes[2]) / 127.5 - 1.0;
  return {std::sqrt(std::max(0.0, 1.0 - glm::dot(xyz, xyz))), xyz.x, xyz.y, xyz.z};
}

/// From version 3 on: three of x y z w in this order, each a sign and 9 bits up to sqrt(1/2),
/// without the largest, whose number is in the highest two bits.
glm::dquat rotation_of_smallest(const unsigned char* bytes) {
  const auto packed = load_whole<std::uint32_t>(reinterpret_cast<const char*>(bytes));
  const std::uint32_t largest = packed >> 30U;
  std::array<double, 4> xyzw{};
  double rest = 1.0;
  unsigned begin = 30;
  for (std::size_t k = 0; k < 4; ++k) {
    if (k == largest) continue;
    begin -= 10;
    const double size = static_cast<double>(packed >> begin & 511U) / 511.0 / std::numbers::sqrt2;
    xyzw[k] = (packed >> (begin + 9) & 1U) != 0 ? -size : size;
    rest -= size * size;
  }
  xyzw[largest] = std::sqrt(std::max(0.0, rest));
  return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

void set_gaussian(GaussianCollector& gaussians, std::size_t k, const SpzHeader& header,
                  const SpzStreams& streams) {
  const std::span<glm::vec3> harmonics = gaussians.harmonics(k);
  const unsigned char* const colour = streams.colours + k * streams.sizes.colours;
  harmonics[0] =
      glm::vec3((glm::dvec3(colour[0], colour[1], colour[2]) / 255.0 - 0.5) / kColourScale);
  const unsigned char* rest = streams.harmonics + k * streams.sizes.harmonics;
  for (std::size_t c = 1; c < harmonics.size(); ++c, rest += 3)
    harmonics[c] = (glm::vec3(rest[0], rest[1], rest[2]) - 128.0F) / 128.0F;

  const unsigned char* const scale = streams.scales + k * streams.sizes.scales;
  const unsigned char* const rotation = streams.rotations + k * streams.sizes.rotations;
  gaussians.set(k, {.centre = centre_of(streams.centres + k * streams.sizes.centres, header),
                    .log_scales = glm::dvec3(scale[0], scale[1], scale[2]) / 16.0 - 10.0,
                    .rotation = header.version < 3 ? rotation_of_three(rotation)
                                                   : rotation_of_smallest(rotation),
                    .opacity = streams.opacities[k] / 255.0});
}

}  // namespace

Result<GaussianCloud> decode_spz(const Source& source, const SpzHeader& header, AxisSigns axes,
                                 std::span<const std::byte> bytes) {
  const std::size_t count = header.count;
  const SpzSizes sizes = spz_sizes(header);
  assert(bytes.size() == count * sizes.sum() && "the caller has checked the count");
  const SpzStreams streams(sizes, count, bytes);
  GaussianCollector gaussians(count, header.degree, axes);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
    if (source.progress.cancelled()) return;
    for (std::size_t k = range.begin(); k != range.end(); ++k)
      set_gaussian(gaussians, k, header, streams);
  });
  if (source.progress.cancelled()) return interrupted_error();
  RELIEF_TRY_ASSIGN(GaussianCloud cloud, std::move(gaussians).finish(source));
  cloud.is_antialiased = header.is_antialiased;
  return cloud;
}

}  // namespace relief
