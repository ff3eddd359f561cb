#include "preprocess/resample/attributes/attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <optional>

#include "common/image/srgb.h"
#include "common/octahedral.h"
#include "preprocess/resample/attributes/colour_interpolation.h"

namespace relief {
namespace {

// Sets every unknown texel to the mean of its known neighbours, ring by ring outward.
template <class Value>
void continue_outward(std::vector<Value>& values, std::vector<std::uint8_t>& known,
                      std::uint32_t width, std::uint32_t height) {
  if (width == 0 || height == 0) return;
  const auto for_neighbours = [&](std::size_t m, auto&& fn) {
    const auto i = static_cast<std::uint32_t>(m % width);
    const auto j = static_cast<std::uint32_t>(m / width);
    for (std::uint32_t b = j > 0 ? j - 1 : 0; b <= std::min(j + 1, height - 1); ++b) {
      for (std::uint32_t a = i > 0 ? i - 1 : 0; a <= std::min(i + 1, width - 1); ++a) {
        fn(std::size_t{b} * width + a);
      }
    }
  };
  constexpr std::uint8_t kQueued = 2;
  std::vector<std::size_t> front;
  const auto enqueue_around = [&](std::size_t m, std::vector<std::size_t>& queue) {
    for_neighbours(m, [&](std::size_t o) {
      if (known[o] != 0) return;
      known[o] = kQueued;
      queue.push_back(o);
    });
  };
  for (std::size_t m = 0; m < values.size(); ++m) {
    if (known[m] == 1) enqueue_around(m, front);
  }
  while (!front.empty()) {
    for (const std::size_t m : front) {
      Value sum(0.0F);
      float count = 0.0F;
      for_neighbours(m, [&](std::size_t o) {
        if (known[o] != 1) return;
        sum += values[o];
        count += 1.0F;
      });
      values[m] = sum / count;
    }
    for (const std::size_t m : front) known[m] = 1;
    std::vector<std::size_t> next;
    for (const std::size_t m : front) enqueue_around(m, next);
    front = std::move(next);
  }
}

// Normals of the fit and of the points that are as near to each other are of a smooth surface,
// whose fit is the better one: 0.1 to 0.4 dB on four models with noise. From twice as far on they
// are beside a crease, as on fandisk, where the fit alone loses 0.2 to 0.4 dB. 15 degrees instead:
// 0.09 dB worse to 0.16 better.
constexpr float kAgreeingDegrees = 8.0F;

glm::vec3 normal_of(const MlsPoint& surface, NormalSource source) {
  if (source == NormalSource::Fits) return surface.fitted_normal;
  if (source == NormalSource::Points) return surface.given_normal;
  const float cosine = glm::dot(surface.fitted_normal, surface.given_normal);
  const float turn = glm::degrees(std::acos(std::clamp(cosine, -1.0F, 1.0F)));
  const float share = glm::smoothstep(kAgreeingDegrees, 2.0F * kAgreeingDegrees, turn);
  return glm::normalize(glm::mix(surface.fitted_normal, surface.given_normal, share));
}

}  // namespace

bool beside_sample(const std::vector<NodeState>& states, const PatchGrid& grid, std::uint32_t a,
                   std::uint32_t b, std::uint32_t scale) {
  const std::uint32_t i0 = a / scale;
  const std::uint32_t j0 = b / scale;
  for (std::uint32_t j = j0; j <= std::min(j0 + 1, grid.height - 1); ++j) {
    for (std::uint32_t i = i0; i <= std::min(i0 + 1, grid.width - 1); ++i) {
      if (states[std::size_t{j} * grid.width + i] != NodeState::Hole) return true;
    }
  }
  return false;
}

AttributeMap<glm::i16vec2> sample_normals(const std::vector<MlsPoint>& surface,
                                          const std::vector<NodeState>& states,
                                          const PatchGrid& grid, NormalSource source) {
  std::vector<glm::vec3> normals(surface.size(), glm::vec3(0.0F));
  std::vector<std::uint8_t> known(surface.size(), 0);
  for (std::size_t m = 0; m < surface.size(); ++m) {
    if (states[m] == NodeState::Hole) continue;
    known[m] = 1;
    normals[m] = normal_of(surface[m], source);
  }
  continue_outward(normals, known, grid.width, grid.height);
  AttributeMap<glm::i16vec2> map{grid.width, grid.height, 1, {}};
  map.texels.reserve(normals.size());
  for (const glm::vec3& n : normals) map.texels.push_back(snorm16_from_unit(n));
  return map;
}

AttributeMap<glm::u8vec3> sample_colours(const PatchPoints& points, const PointGrid& lookup,
                                         const std::vector<NodeState>& states,
                                         const PatchGrid& grid,
                                         const std::vector<glm::u8vec3>& colours,
                                         std::uint32_t scale) {
  AttributeMap<glm::u8vec3> map{
      (grid.width - 1) * scale + 1, (grid.height - 1) * scale + 1, scale, {}};
  const std::size_t size = std::size_t{map.width} * map.height;
  std::vector<glm::vec3> values(size, glm::vec3(0.0F));
  std::vector<std::uint8_t> known(size, 0);
  const double step = grid.spacing / scale;
  std::optional<ColourInterpolation>
      between;  // costs a fit for each point: not needed where colours are averaged
  for (std::uint32_t b = 0; b < map.height; ++b) {
    for (std::uint32_t a = 0; a < map.width; ++a) {
      if (!beside_sample(states, grid, a, b, scale)) continue;
      const double x = grid.x0 + a * step;
      const double y = grid.y0 + b * step;
      const std::uint32_t nearest = lookup.nearest(x, y, 4.0 * grid.spacing);
      if (nearest == PointGrid::kNone) continue;
      const std::size_t m = std::size_t{b} * map.width + a;
      known[m] = 1;
      if (points.spacing[nearest] < step) {
        values[m] = mean_around(points, lookup, {x, y}, nearest, step, [&](std::uint32_t p) {
          return linear_from_srgb8(colours[points.ids[p]]);
        });
        continue;
      }
      if (!between) between.emplace(points, lookup, colours);
      values[m] = between->at(x, y, nearest);
    }
  }
  continue_outward(values, known, map.width, map.height);
  map.texels.reserve(size);
  for (const glm::vec3& v : values) {
    map.texels.push_back(srgb8_from_linear(v));
  }
  return map;
}

}  // namespace relief
