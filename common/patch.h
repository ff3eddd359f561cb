// The patch model, which preprocessing makes, the patch file stores and the renderer draws.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "common/bounds.h"
#include "common/instance.h"
#include "common/scalar.h"
#include "common/stance.h"

namespace relief {

/// The height value of a grid node without a sample (a hole).
inline constexpr std::int32_t kHole = std::numeric_limits<std::int32_t>::min();

/// The largest number of nodes along one side of a patch; limits what a hostile file can request.
inline constexpr std::uint32_t kMaxPatchSide = 16384;

/// Largest difference of heights within a patch, in height steps: 16 bits hold it, with one value
/// left for holes.
inline constexpr std::int32_t kMaxHeightRange = 65534;

/// A rectangular attribute map of one patch: `scale` texels per grid cell along each side, texel
/// (i, j) at grid coordinates (i / scale, j / scale). Thus its size is scale * (nodes - 1) + 1.
/// Every texel has a value: those over holes continue their surroundings, so that a bilinear lookup
/// near a hole reads no unrelated value.
template <class Texel>
struct AttributeMap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t scale = 1;
  std::vector<Texel> texels;  ///< row-major, texels[j * width + i]

  [[nodiscard]] bool empty() const { return texels.empty(); }
};

/// Returns the texel of a map at a node.
template <class Texel>
[[nodiscard]] const Texel& texel_at(const AttributeMap<Texel>& map, std::uint32_t i,
                                    std::uint32_t j) {
  return map.texels[std::size_t{j} * map.scale * map.width + std::size_t{i} * map.scale];
}

/// A patch: a regular grid of heights over its base plane, with holes, and attribute maps.
///
/// Frame: node (i, j) with height index h lies in the world at
///   origin + axes * (i * spacing, j * spacing, h * height_step), where the columns of `axes` are
/// the plane's two directions and its normal (right-handed, orthonormal). All other members are
/// relative to that frame, so that single precision suffices at any world position ([Ochotta 2008],
/// section 3: plane parameters and a height array).
struct Patch {
  glm::dvec3 origin{0.0};
  glm::dmat3 axes{1.0};
  double spacing = 1.0;               ///< grid step, world units (the papers' mu)
  double height_step = 1.0;           ///< world units per height index
  std::uint32_t width = 0;            ///< nodes along axes[0]
  std::uint32_t height = 0;           ///< nodes along axes[1]
  std::vector<std::int32_t> heights;  ///< row-major height indices, 0..kMaxHeightRange, or kHole

  AttributeMap<glm::i16vec2>
      normals;  ///< octahedral unit normals in the patch frame, see common/octahedral.h
  AttributeMap<glm::u8vec3> colours;  ///< 8-bit sRGB; empty if the scan has no colour
  /// Codes of PatchModel::scalars, in their order; empty, or one map for each. Texels over holes
  /// are kNoScalar, as are those without a value.
  std::vector<AttributeMap<std::uint16_t>> scalars;

  std::uint8_t material = 0;  ///< index into a scene's materials; not in patch files

  [[nodiscard]] std::int32_t at(std::uint32_t i, std::uint32_t j) const {
    return heights[std::size_t{j} * width + i];
  }
};

/// Some of a model's patches, one after another.
struct PatchRun {
  std::uint32_t first = 0;  ///< in PatchModel::patches
  std::uint32_t count = 0;
  bool is_closed = false;  ///< their surface has no border: what is open in it is a gap
};

/// All patches of a model, with what a viewer needs before it reads the first patch.
struct PatchModel {
  std::vector<Patch> patches;
  /// Runs of patches that end where others of the run begin: make_seams() closes the surface
  /// between them. All other patches overlap. In ascending order.
  std::vector<PatchRun> joined;
  /// Instances of runs of patches, in the order of their patch ids. Empty: each patch is drawn
  /// once, untransformed. Bounds and spacing include the instances. Not in patch files.
  std::vector<Instance> instances;
  double spacing = 0.0;  ///< the requested or chosen spacing; each patch has its own
  Bounds bounds;         ///< of the scan's points
  double bounding_radius =
      0.0;  ///< of the sphere about the centre of `bounds` that holds all points
  /// The points of the scan that lie farthest out (common/extremes.h), for cameras. Empty: nothing
  /// but the bounds is known.
  std::vector<glm::dvec3> extremes;
  Stance stance;
  bool has_colours = false;
  bool has_label_colours = false;  ///< the colours stand for labels: none lies between two of them
  std::vector<ScalarInfo> scalars;
  /// The surface encloses a body, normals outward, so that its back is invisible from outside.
  bool is_closed = false;
  bool is_of_points = false;  ///< patches meet, though the scan has no faces
};

/// Sets bounds, bounding sphere and extreme points to those of a scan's positions (world frame).
void set_extent(PatchModel& model, const std::vector<glm::dvec3>& positions);

/// Returns whether all patches of a model meet at seams.
[[nodiscard]] inline bool is_joined(const PatchModel& model) {
  return model.joined.size() == 1 && model.joined.front().count == model.patches.size();
}

/// Returns the run of patches that meet which a patch belongs to; null if it overlaps others.
[[nodiscard]] const PatchRun* run_of(const PatchModel& model, std::size_t patch);

/// Returns the world position of a sample.
[[nodiscard]] inline glm::dvec3 position_of(const Patch& patch, std::uint32_t i, std::uint32_t j) {
  return patch.origin + patch.axes * glm::dvec3(i * patch.spacing, j * patch.spacing,
                                                patch.at(i, j) * patch.height_step);
}

/// Calls `visit` with the world position of every sample of the patches.
template <class Visit>
void for_each_position(std::span<const Patch> patches, const Visit& visit) {
  for (const Patch& patch : patches) {
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) != kHole) visit(position_of(patch, i, j));
      }
    }
  }
}

/// Returns the number of samples (valid grid nodes) of a patch.
[[nodiscard]] std::size_t count_samples(const Patch& patch);

/// Returns the number of samples of a model.
[[nodiscard]] std::size_t count_samples(const PatchModel& model);

}  // namespace relief
