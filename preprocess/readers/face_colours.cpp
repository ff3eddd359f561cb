#include "preprocess/readers/face_colours.h"

#include <fmt/format.h>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "common/image/srgb.h"

namespace relief {
namespace {

/// Of triangles that no face has given a colour.
constexpr glm::vec3 kNoColour(std::numeric_limits<float>::quiet_NaN());

/// Materials of triangles; empty if there are more than `most`.
struct Palette {
  std::vector<glm::u8vec3> colours;
  std::vector<std::uint32_t> of_triangles;
};

Palette palette_of(const std::vector<glm::u8vec3>& colours, std::size_t most) {
  Palette palette;
  std::map<std::tuple<int, int, int>, std::uint32_t> numbers;
  for (const glm::u8vec3& c : colours) {
    const auto next = static_cast<std::uint32_t>(palette.colours.size());
    const auto [entry, is_new] = numbers.try_emplace({c.r, c.g, c.b}, next);
    if (is_new) palette.colours.push_back(c);
    if (palette.colours.size() > most) return {};
    palette.of_triangles.push_back(entry->second);
  }
  return palette;
}

void give_materials(const Palette& palette, Points& points) {
  for (const glm::u8vec3& colour : palette.colours) {
    MeshMaterial material;
    material.name = fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b);
    material.colour = linear_from_srgb8(colour);
    material.has_texcoords = false;
    material.is_stated = true;
    points.materials.push_back(std::move(material));
  }
  points.triangle_materials = palette.of_triangles;
}

/// Vertices of no face are white.
void give_means(const std::vector<glm::u8vec3>& colours, Points& points) {
  std::vector<glm::vec3> sums(points.size(), glm::vec3(0.0F));
  std::vector<float> counts(points.size(), 0.0F);
  for (std::size_t t = 0; t < points.triangles.size(); ++t) {
    for (const std::uint32_t p : points.triangles[t]) {
      if (p >= points.size()) continue;
      sums[p] += glm::vec3(colours[t]);
      counts[p] += 1.0F;
    }
  }
  for (std::size_t p = 0; p < sums.size(); ++p)
    sums[p] = counts[p] > 0.0F ? sums[p] / counts[p] : glm::vec3(255.0F);
  points.colours = to_colours(sums, 1.0F);
}

}  // namespace

void FaceColours::add(glm::vec3 colour, ColourNumbers numbers, std::size_t before,
                      std::size_t after) {
  assert(before >= of_triangles_.size() && after >= before);
  if (numbers == ColourNumbers::Real) numbers_ = numbers;
  of_triangles_.resize(before, kNoColour);
  of_triangles_.resize(after, colour);
}

void FaceColours::give(Points& points) {
  if (of_triangles_.empty() || !points.colours.empty() || !points.materials.empty()) return;
  of_triangles_.resize(points.triangles.size(), kNoColour);
  std::vector<glm::u8vec3> colours = to_colours(of_triangles_, numbers_);
  for (std::size_t t = 0; t < colours.size(); ++t) {
    if (std::isnan(of_triangles_[t].x)) colours[t] = glm::u8vec3(255);
  }
  if (std::ranges::all_of(colours, [](glm::u8vec3 c) { return c == glm::u8vec3(255); })) return;
  const Palette palette = palette_of(colours, kMostMaterials);
  palette.colours.empty() ? give_means(colours, points) : give_materials(palette, points);
}

}  // namespace relief
