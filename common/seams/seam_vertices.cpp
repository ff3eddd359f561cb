#include "common/seams/seam_vertices.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "common/seams/flat_map.h"

namespace relief {
namespace {

// A seam vertex moves to a crease by this many spacings at most. Planes through few samples may
// meet anywhere.
constexpr double kCreaseReach = 0.7;

// A crease turns the normal by this many times as much as the surface bends beside it.
constexpr double kCreaseContrast = 3.0;

/// Whether the surface has a crease between two samples: a turn that is not that of a round
/// feature.
bool is_crease(const BorderVertex& a, const BorderVertex& b) {
  if (glm::dot(a.plane_normal, b.plane_normal) > kCreaseCosine) return false;
  const double spacings = glm::distance(a.position, b.position) / std::min(a.spacing, b.spacing);
  const double beside = std::max(a.bend, b.bend) * std::max(spacings, 1.0);
  return glm::distance(a.plane_normal, b.plane_normal) > kCreaseContrast * beside;
}

class Sharing {
 public:
  Sharing(const BorderMesh& mesh, Seams& seams) : vertices_(mesh.vertices), seams_(seams) {}

  void add(const Triangle& t) {
    const std::uint32_t a = patch(t[0]);
    const std::uint32_t b = patch(t[1]);
    const std::uint32_t c = patch(t[2]);
    if (a == b && b == c) {
      put(a, node(t[0]), node(t[1]), node(t[2]));
    } else if (b == c) {
      add_between(t[0], t[1], t[2]);
    } else if (c == a) {
      add_between(t[1], t[2], t[0]);
    } else if (a == b) {
      add_between(t[2], t[0], t[1]);
    } else {
      add_junction(t);
    }
  }

 private:
  [[nodiscard]] std::uint32_t patch(std::uint32_t v) const { return vertices_[v].patch; }
  [[nodiscard]] std::uint32_t node(std::uint32_t v) const { return vertices_[v].node; }
  void put(std::uint32_t patch, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    seams_.triangles[patch].push_back({a, b, c});
  }

  /// The corner at the seam vertex between two border vertices.
  std::uint32_t seam(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto next = static_cast<std::uint32_t>(seams_.vertices.size());
    const std::uint32_t number = seams_of_edges_.insert((std::uint64_t{a} << 32U) | b, next);
    if (number == next)
      seams_.vertices.push_back({seam_position(vertices_[a], vertices_[b]), patch(a)});
    return number | kSeamVertexBit;
  }

  /// One corner of a patch, two of another.
  void add_between(std::uint32_t single, std::uint32_t next, std::uint32_t last) {
    const std::uint32_t to_next = seam(single, next);
    const std::uint32_t to_last = seam(single, last);
    put(patch(single), node(single), to_next, to_last);
    const auto at = [&](std::uint32_t corner) {
      return seams_.vertices[corner & ~kSeamVertexBit].position;
    };
    // The quadrangle to_next, next, last, to_last along its shorter diagonal.
    if (glm::distance(at(to_next), vertices_[last].position) <
        glm::distance(at(to_last), vertices_[next].position)) {
      put(patch(next), to_next, node(next), node(last));
      put(patch(next), to_next, node(last), to_last);
    } else {
      put(patch(next), to_next, node(next), to_last);
      put(patch(next), node(next), node(last), to_last);
    }
  }

  /// Three patches meet at a vertex within the triangle.
  void add_junction(const Triangle& t) {
    std::array<std::uint32_t, 3> seams{};
    glm::dvec3 middle(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      seams[k] = seam(t[k], t[(k + 1) % 3]);
      middle += seams_.vertices[seams[k] & ~kSeamVertexBit].position / 3.0;
    }
    const auto junction = static_cast<std::uint32_t>(seams_.vertices.size()) | kSeamVertexBit;
    seams_.vertices.push_back({middle, patch(t[0])});
    for (std::size_t k = 0; k < 3; ++k) {
      put(patch(t[k]), node(t[k]), seams[k], junction);
      put(patch(t[k]), node(t[k]), junction, seams[(k + 2) % 3]);
    }
  }

  const std::vector<BorderVertex>& vertices_;
  Seams& seams_;
  FlatMap seams_of_edges_;
};

}  // namespace

glm::dvec3 seam_position(const BorderVertex& a, const BorderVertex& b) {
  const glm::dvec3 d = b.position - a.position;
  const glm::dvec3 middle = 0.5 * (a.position + b.position);
  const double cosine = glm::dot(a.plane_normal, b.plane_normal);
  if (is_crease(a, b) && cosine > -kCreaseCosine) {
    // middle + s a.plane_normal + t b.plane_normal on both planes: the nearest such point.
    const double rise_a = glm::dot(d, a.plane_normal);
    const double rise_b = glm::dot(d, b.plane_normal);
    const double s = (-0.5 * rise_a - 0.5 * cosine * rise_b) / (1.0 - cosine * cosine);
    const double t = (0.5 * rise_b + 0.5 * cosine * rise_a) / (1.0 - cosine * cosine);
    const glm::dvec3 offset = s * a.plane_normal + t * b.plane_normal;
    const double most = kCreaseReach * std::min(std::min(a.spacing, b.spacing), glm::length(d));
    return middle + offset * std::min(1.0, most / std::max(glm::length(offset), 1e-300));
  }
  return middle + 0.125 * (glm::dot(d, b.normal) * b.normal - glm::dot(d, a.normal) * a.normal);
}

void share_out(std::span<const Triangle> triangles, const BorderMesh& mesh, Seams& seams) {
  Sharing sharing(mesh, seams);
  for (const Triangle& t : triangles) sharing.add(t);
}

}  // namespace relief
