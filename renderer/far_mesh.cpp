#include "renderer/far_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <utility>

#include "common/octahedral.h"
#include "common/srgb.h"
#include "renderer/patch_normals.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Vertices are at most this far apart, in pixels, before a finer level is drawn.
constexpr double kFarPixels = 2.0;
/// Where the model has no finer ones, up to this.
constexpr double kMostFarPixels = 4.0;
/// The coarsest level has this many cubes across.
constexpr double kFewestAcross = 3.0;

/// World units a pixel, where the sphere is nearest to the eye; below 0 behind it.
double nearest_pixel(const View& view, const Sphere& model) {
  return pixel_at(view, -(view.rotation * (model.centre - view.eye)).z - model.radius);
}

/// A cube of the grid, and one of the sides that normals point to.
struct Cell {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;
  int side = 0;  ///< 0 to 5: the axis that the normal is nearest to, and its sign

  bool operator==(const Cell&) const = default;
};

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t hash = static_cast<std::uint64_t>(cell.side);
    for (const std::int64_t value : {cell.x, cell.y, cell.z}) {
      hash = (hash ^ static_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 29U;
    }
    return hash;
  }
};

int side_of(glm::vec3 normal) {
  const glm::vec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return 2 * axis + (normal[axis] < 0.0F ? 1 : 0);
}

/// Samples that become one vertex: their sums, and how far from the middle of their cube the one is
/// whose place the vertex has.
struct Cluster {
  FarVertex sum;
  double count = 0.0;
  double away = 0.0;  ///< in cubes
};

/// Collects samples, or the clusters of a finer level, into cubes of a grid.
class Grid {
 public:
  explicit Grid(double spacing) : spacing_(spacing) {}

  /// The number of the cluster that this one goes into.
  std::uint32_t add(const Cluster& finer) {
    const glm::dvec3 place = finer.sum.position / (finer.count * spacing_);
    const glm::dvec3 low = glm::floor(place);
    const Cell cell{static_cast<std::int64_t>(low.x), static_cast<std::int64_t>(low.y),
                    static_cast<std::int64_t>(low.z), side_of(finer.sum.normal)};
    const double away = glm::distance(place, low + 0.5);
    const auto [found, is_new] =
        numbers_.try_emplace(cell, static_cast<std::uint32_t>(clusters_.size()));
    if (is_new) {
      clusters_.push_back(finer);
      clusters_.back().away = away;
      return found->second;
    }
    Cluster& cluster = clusters_[found->second];
    cluster.sum.position += finer.sum.position;
    cluster.sum.normal += finer.sum.normal;
    cluster.sum.colour += finer.sum.colour;
    cluster.count += finer.count;
    if (away < cluster.away) {
      cluster.away = away;
      cluster.sum.patch = finer.sum.patch;
      cluster.sum.place = finer.sum.place;
    }
    return found->second;
  }

  [[nodiscard]] const std::vector<Cluster>& clusters() const { return clusters_; }

 private:
  double spacing_;
  std::unordered_map<Cell, std::uint32_t, CellHash> numbers_;
  std::vector<Cluster> clusters_;
};

/// Notes a triangle unless two of its corners have become one; the least corner comes first.
void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                  std::vector<Triangle>& triangles) {
  if (a == b || b == c || c == a) return;
  if (b < a && b < c) {
    triangles.push_back({b, c, a});
  } else if (c < a && c < b) {
    triangles.push_back({c, a, b});
  } else {
    triangles.push_back({a, b, c});
  }
}

/// Each triangle once.
void keep_unique(std::vector<Triangle>& triangles) {
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
}

/// The mean of the texels that are nearer to a node than to any other.
glm::vec3 colour_at(const Patch& patch, std::uint32_t i, std::uint32_t j) {
  const AttributeMap<glm::u8vec3>& map = patch.colours;
  if (map.empty()) return glm::vec3(shared::kNeutralGrey);
  const std::uint32_t half = map.scale / 2;
  const auto low = [half, &map](std::uint32_t node) {
    return std::max(node * map.scale, half) - half;
  };
  glm::vec3 sum(0.0F);
  float count = 0.0F;
  for (std::uint32_t y = low(j); y <= std::min(j * map.scale + half, map.height - 1); ++y) {
    for (std::uint32_t x = low(i); x <= std::min(i * map.scale + half, map.width - 1); ++x) {
      sum += linear_from_srgb8(map.texels[std::size_t{y} * map.width + x]);
      count += 1.0F;
    }
  }
  return sum / count;
}

/// Adds a patch's samples to the grid; of each node the cluster that it is in, or kNoMaterial for a
/// hole.
std::vector<std::uint32_t> add_samples(const Patch& patch, std::uint32_t number, Grid& grid) {
  const AttributeMap<glm::i16vec2> normals = normal_map_of(patch);
  const glm::mat3 axes(patch.axes);
  std::vector<std::uint32_t> clusters(patch.heights.size(), kNoMaterial);
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      if (patch.at(i, j) == kHole) continue;
      const glm::dvec3 offset(i * patch.spacing, j * patch.spacing,
                              patch.at(i, j) * patch.height_step);
      const std::size_t texel =
          std::size_t{j} * normals.scale * normals.width + std::size_t{i} * normals.scale;
      const glm::vec3 normal = axes * unit_from_snorm16(normals.texels[texel]);
      clusters[std::size_t{j} * patch.width + i] =
          grid.add({{patch.origin + patch.axes * offset, normal, colour_at(patch, i, j), number,
                     glm::vec2(i, j)},
                    1.0,
                    0.0});
    }
  }
  return clusters;
}

/// What is left of the triangles of its cells.
void add_cells(const Patch& patch, const std::vector<std::uint32_t>& clusters,
               std::vector<Triangle>& triangles) {
  for (std::uint32_t j = 0; j + 1 < patch.height; ++j) {
    for (std::uint32_t i = 0; i + 1 < patch.width; ++i) {
      const std::size_t node = std::size_t{j} * patch.width + i;
      const std::uint32_t a = clusters[node];
      const std::uint32_t b = clusters[node + 1];
      const std::uint32_t c = clusters[node + patch.width];
      const std::uint32_t d = clusters[node + patch.width + 1];
      if (a == kNoMaterial || b == kNoMaterial || c == kNoMaterial || d == kNoMaterial) continue;
      add_triangle(a, b, d, triangles);
      add_triangle(a, d, c, triangles);
    }
  }
}

FarLevel make_level(double spacing, const Grid& grid, const std::vector<Triangle>& triangles) {
  FarLevel level{spacing, {}, triangles};
  level.vertices.reserve(grid.clusters().size());
  for (const Cluster& cluster : grid.clusters()) {
    FarVertex vertex = cluster.sum;
    vertex.position /= cluster.count;
    vertex.normal /= static_cast<float>(cluster.count);
    vertex.colour /= static_cast<float>(cluster.count);
    level.vertices.push_back(vertex);
  }
  return level;
}

}  // namespace

std::vector<double> far_spacings(const Sphere& model, double spacing) {
  const double diameter = 2.0 * model.radius;
  std::vector<double> spacings;
  for (double s = kFarPixels / kFarDiameter * diameter; s * kFewestAcross < diameter;
       s *= std::sqrt(2.0)) {
    if (s >= 2.0 * spacing) spacings.push_back(s);
  }
  return spacings;
}

bool is_far(const View& view, const Sphere& model, double finest_spacing) {
  const double pixel = nearest_pixel(view, model);
  // Where a pixel has several samples, View::far_diameter counts these.
  const double whole_pixel = pixel * view.far_diameter / kFarDiameter;
  return 2.0 * model.radius < view.far_diameter * pixel &&
         finest_spacing <= kMostFarPixels * whole_pixel;
}

std::size_t choose_far_level(const View& view, const Sphere& model,
                             std::span<const double> spacings) {
  const double pixel = nearest_pixel(view, model);
  std::size_t level = 0;
  while (level + 1 < spacings.size() && spacings[level + 1] <= kFarPixels * pixel) ++level;
  return level;
}

std::vector<FarLevel> make_far_levels(std::span<const Patch> patches,
                                      std::span<const double> spacings) {
  std::vector<FarLevel> levels;
  if (spacings.empty()) return levels;
  Grid grid(spacings.front());
  std::vector<Triangle> triangles;
  for (std::uint32_t p = 0; p < patches.size(); ++p) {
    add_cells(patches[p], add_samples(patches[p], p, grid), triangles);
    keep_unique(triangles);
  }
  levels.push_back(make_level(spacings.front(), grid, triangles));
  for (const double spacing : spacings.subspan(1)) {
    Grid coarser(spacing);
    std::vector<std::uint32_t> numbers;
    numbers.reserve(grid.clusters().size());
    for (const Cluster& cluster : grid.clusters()) numbers.push_back(coarser.add(cluster));
    const std::vector<Triangle> finer = std::exchange(triangles, {});
    for (const Triangle& t : finer)
      add_triangle(numbers[t[0]], numbers[t[1]], numbers[t[2]], triangles);
    keep_unique(triangles);
    grid = std::move(coarser);
    levels.push_back(make_level(spacing, grid, triangles));
  }
  return levels;
}

}  // namespace relief
