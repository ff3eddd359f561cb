#include "renderer/geometry/meshes/points_of_patches.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "common/disjoint_sets.h"
#include "common/image/srgb.h"
#include "renderer/geometry/meshes/mesh_of_patches.h"

namespace relief {
namespace {

constexpr std::uint32_t kNotMade = std::numeric_limits<std::uint32_t>::max();

Points points_of(TriangleMesh mesh) {
  Points points;
  points.positions = std::move(mesh.positions);
  points.normals = std::move(mesh.normals);
  points.colours.reserve(mesh.colours.size());
  for (const glm::vec4 colour : mesh.colours)
    points.colours.push_back(srgb8_from_linear(glm::vec3(colour)));
  points.triangles = std::move(mesh.triangles);
  return points;
}

/// Keeps the vertices whose new number is not kNotMade; `numbers` ascends over those.
void keep(const std::vector<std::uint32_t>& numbers, TriangleMesh& mesh) {
  std::size_t kept = 0;
  for (std::size_t v = 0; v < numbers.size(); ++v) {
    if (numbers[v] == kNotMade) continue;
    mesh.positions[kept] = mesh.positions[v];
    mesh.normals[kept] = mesh.normals[v];
    if (!mesh.colours.empty()) mesh.colours[kept] = mesh.colours[v];
    ++kept;
  }
  mesh.positions.resize(kept);
  mesh.normals.resize(kept);
  if (!mesh.colours.empty()) mesh.colours.resize(kept);
}

/// Gives the first of several copies the mean of all, and triangles that one.
void weld(std::vector<SeamCopy> copies, TriangleMesh& mesh) {
  std::sort(copies.begin(), copies.end(), [](const SeamCopy& a, const SeamCopy& b) {
    return a.seam != b.seam ? a.seam < b.seam : a.vertex < b.vertex;
  });
  std::vector<std::uint32_t> shared(mesh.positions.size());
  std::iota(shared.begin(), shared.end(), 0U);
  for (std::size_t first = 0; first < copies.size();) {
    const std::uint32_t vertex = copies[first].vertex;
    std::size_t end = first + 1;
    for (; end < copies.size() && copies[end].seam == copies[first].seam; ++end) {
      const std::uint32_t copy = copies[end].vertex;
      shared[copy] = vertex;
      mesh.normals[vertex] += mesh.normals[copy];
      if (!mesh.colours.empty()) mesh.colours[vertex] += mesh.colours[copy];
    }
    // Normals that cancel out: 0, which means the triangle's own.
    const float length = glm::length(mesh.normals[vertex]);
    mesh.normals[vertex] = length > 1e-3F ? mesh.normals[vertex] / length : glm::vec3(0.0F);
    if (!mesh.colours.empty()) mesh.colours[vertex] /= static_cast<float>(end - first);
    first = end;
  }
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& corner : t) corner = shared[corner];
  }
}

/// The vertices that triangles connect.
DisjointSets find_parts(const TriangleMesh& mesh) {
  DisjointSets parts(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    parts.join(t[0], t[1]);
    parts.join(t[0], t[2]);
  }
  return parts;
}

/// The edges of one triangle.
std::vector<std::uint64_t> border_of(const TriangleMesh& mesh) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(t[c], t[(c + 1) % 3]);
      edges.push_back((std::uint64_t{low} << 32U) | high);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::uint64_t> border;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const bool again =
        (e > 0 && edges[e - 1] == edges[e]) || (e + 1 < edges.size() && edges[e + 1] == edges[e]);
    if (!again) border.push_back(edges[e]);
  }
  return border;
}

/// Leaves out the triangles of parts with a border, but for the largest part. In a surface
/// without a border they are pieces of patches that lie over others.
void drop_islands(TriangleMesh& mesh) {
  DisjointSets parts = find_parts(mesh);
  std::vector<std::uint32_t> sizes(mesh.positions.size(), 0);
  for (const Triangle& t : mesh.triangles) ++sizes[parts.find(t[0])];
  const auto largest =
      static_cast<std::uint32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  std::vector<std::uint8_t> is_island(mesh.positions.size(), 0);
  for (const std::uint64_t edge : border_of(mesh)) {
    const std::uint32_t part = parts.find(static_cast<std::uint32_t>(edge >> 32U));
    if (part != largest) is_island[part] = 1;
  }
  std::erase_if(mesh.triangles,
                [&](const Triangle& t) { return is_island[parts.find(t[0])] != 0; });
}

/// Leaves out the vertices without a triangle.
void drop_unused(TriangleMesh& mesh) {
  std::vector<std::uint32_t> numbers(mesh.positions.size(), kNotMade);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t corner : t) numbers[corner] = 0;
  }
  std::uint32_t next = 0;
  for (std::uint32_t& number : numbers) {
    if (number != kNotMade) number = next++;
  }
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& corner : t) corner = numbers[corner];
  }
  keep(numbers, mesh);
}

/// The values of all samples, in their order; NaN where there is none.
std::vector<double> sample_values(const PatchModel& model, std::size_t scalar) {
  std::vector<double> values;
  for (const Patch& patch : model.patches) {
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) == kHole) continue;
        const std::uint16_t code =
            patch.scalars.empty() ? kNoScalar : texel_at(patch.scalars[scalar], i, j);
        values.push_back(code == kNoScalar ? std::numeric_limits<double>::quiet_NaN()
                                           : model.scalars[scalar].value_of(code));
      }
    }
  }
  return values;
}

}  // namespace

Result<Points> sample_points(const PatchModel& model) {
  std::vector<SeamCopy> copies;
  RELIEF_TRY_ASSIGN(auto mesh, mesh_of_patches(model, MeshBorder::Samples, &copies));
  if (!copies.empty()) {
    std::vector<std::uint32_t> numbers(mesh.positions.size(), 0);
    for (const SeamCopy& copy : copies) numbers[copy.vertex] = kNotMade;
    keep(numbers, mesh);
  }
  mesh.triangles = {};
  Points points = points_of(std::move(mesh));
  for (std::size_t k = 0; k < model.scalars.size(); ++k) {
    const ScalarInfo& scalar = model.scalars[k];
    points.scalars.push_back({scalar.name, scalar.is_label, sample_values(model, k)});
  }
  return points;
}

Result<Points> surface_mesh(const PatchModel& model) {
  std::vector<SeamCopy> copies;
  RELIEF_TRY_ASSIGN(auto mesh, mesh_of_patches(model, MeshBorder::Samples, &copies));
  if (!model.joined.empty()) {
    weld(std::move(copies), mesh);
    const bool has_border = std::any_of(model.joined.begin(), model.joined.end(),
                                        [](const PatchRun& run) { return !run.is_closed; });
    if (!has_border) drop_islands(mesh);
    drop_unused(mesh);
  }
  return points_of(std::move(mesh));
}

}  // namespace relief
