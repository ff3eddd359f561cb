// Elliptical Gaussian kernels in the world, ready to be splatted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace relief {

/// A symmetric 3 x 3 matrix.
struct Variance {
  double xx = 0.0;
  double xy = 0.0;
  double xz = 0.0;
  double yy = 0.0;
  double yz = 0.0;
  double zz = 0.0;
};

[[nodiscard]] inline glm::dmat3 matrix_of(const Variance& v) {
  return {{v.xx, v.xy, v.xz}, {v.xy, v.yy, v.yz}, {v.xz, v.yz, v.zz}};
}
[[nodiscard]] inline Variance variance_of(const glm::dmat3& m) {
  return {m[0].x, m[1].x, m[2].x, m[1].y, m[2].y, m[2].z};
}

/// What KernelCloud::weights mean.
enum class KernelWeight : std::uint8_t {
  /// The integral of the kernel's extinction over space, world units squared: that of a volume,
  /// whose optical depth is a sum of kernels [Zwicker 2002, Eq. (9)].
  Integral,
  /// The opacity where the kernel's centre is seen: that of 3D Gaussians [Kerbl 2023].
  Peak
};

/// Kernels in an order that is theirs: of a grid's, the grid's. Arrays have one element for each
/// kernel, where nothing else is said.
struct KernelCloud {
  std::vector<glm::dvec3> centres;  ///< world
  std::vector<Variance> variances;  ///< world units squared; one for each kernel, or one for all
  std::vector<float> weights;       ///< above 0; of Peak also 0, which is not drawn
  KernelWeight weight = KernelWeight::Integral;
  std::vector<glm::vec3> colours;  ///< linear, or encoded sRGB if that is what is blended
  std::vector<glm::vec3> normals;  ///< unit, or 0; empty: nothing is shaded
  /// How flat kernels are weighted: 1 where the weight is divided by 1 / |n . d|, the length of a
  /// ray in a layer along the direction d (section 6.4). Empty: nowhere.
  std::vector<std::uint8_t> is_surface;
  /// Of kernels of several things: where those of each begin, the first at 0. Empty: of one.
  std::vector<std::size_t> starts;
  /// Of a grid: each kernel's node (i + size.x * (j + size.y * k)), ascending; else empty.
  std::vector<std::uint32_t> nodes;
  glm::uvec3 size{0};
  /// Of a grid: the direction across the planes of equal i, j and k, unit vectors as columns.
  glm::dmat3 across{1.0};

  [[nodiscard]] std::size_t count() const { return centres.size(); }
  /// Which of `starts` kernel k belongs to.
  [[nodiscard]] std::size_t part_of(std::size_t k) const {
    std::size_t part = 0;
    while (part + 1 < starts.size() && k >= starts[part + 1]) ++part;
    return part;
  }
  /// Of a grid: the indices of kernel k's node.
  [[nodiscard]] glm::uvec3 node(std::size_t k) const {
    return {nodes[k] % size.x, nodes[k] / size.x % size.y, nodes[k] / size.x / size.y};
  }
  [[nodiscard]] const Variance& variance(std::size_t k) const {
    return variances.size() == 1 ? variances.front() : variances[k];
  }
};

/// Several clouds as one, in their order: without a grid, with a variance for each kernel. Normals,
/// colours and `is_surface` that only some have are 0 for the others. Weights are of the kind
/// Integral unless all are of the kind Peak; which rule a kernel follows its part says. The list is
/// not empty; a single cloud stays as it is.
[[nodiscard]] KernelCloud merged(std::vector<KernelCloud> clouds);

}  // namespace relief
