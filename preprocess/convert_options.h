// Options and report of a conversion.
#pragma once

#include <cstdint>
#include <optional>

#include "common/patch.h"
#include "preprocess/normals/known_sides.h"

namespace relief {

/// Which noise of the points is removed.
enum class NoiseRemoval {
  Default,     ///< of bare points, as measured, and of tiles, which have no faces; of meshes none
  None,        ///< none
  AsMeasured,  ///< as the scan shows it (estimate_noise)
  AsGiven,     ///< of ConvertOptions::noise everywhere
};

/// Steps that heights are rounded to, in a spacing, unless a conversion is asked for others.
inline constexpr double kUsualStepsPerSpacing = 20.0;

struct ConvertOptions {
  double spacing = 0.0;       ///< grid step in world units; 0: about as many samples as points,
                              ///< or up to twice as many where a mesh bends (share_samples)
  std::uint64_t samples = 0;  ///< about how many there shall be; 0: by default. Without `spacing`.
  /// About how many samples for each point, at most kFinestSamplesPerPoint; 0: by default. Without
  /// `spacing` and `samples`; made in one try, so that margins and ragged borders add some.
  double samples_per_point = 0.0;
  double error = 0.0;  ///< rms distance of the points to the patches, world units: as few
                       ///< samples as reach it; 0: by default. Without all of these.
  double cone_degrees =
      0.0;  ///< largest angle between a patch's normal and its points' normals; 0: default
  /// Whether patches meet at seams instead of overlapping. By default they do if the scan has
  /// faces, or as choose_meeting() says of bare points: those may have gaps, which only margins
  /// close.
  std::optional<bool> seams;
  NoiseRemoval noise_removal = NoiseRemoval::Default;
  double noise = 0.0;        ///< standard deviation along the normal, world units, for AsGiven
  SideChoice side;           ///< that normals face; Auto keeps given normals and faces
  int overlap_cells = 1;     ///< width of the overlap margin, in grid cells
  double height_step = 0.0;  ///< world units per height index; 0: by steps_per_spacing
  double steps_per_spacing = kUsualStepsPerSpacing;  ///< height indices in a patch's spacing
  /// Whether each patch's spacing follows the density of its points; `spacing` is then that at the
  /// median density. If not, patches have one spacing. By default it does if the scan has no faces,
  /// its density varies (is_uneven), and no spacing is given; patches of faces follow their shape.
  std::optional<bool> adaptive_spacing;
  int colour_scale = 2;    ///< texels per grid cell along each side, of the colours and scalars of
                           ///< points
  bool distances = false;  ///< add the scalar `distance` (add_distances). The points' own scalars
                           ///< are always kept.
  int texels_per_cell =
      0;  ///< colour texels per grid cell of meshes with textures or materials, and normal texels
          ///< of meshes with normal maps, 1 to 64; 0: as many as keep their detail (map_textures)
  std::optional<glm::dvec3> up;  ///< how the model stands: any length but 0; none: as the scan says
  int threads = 0;               ///< 0: all cores. The result does not depend on it.
};

/// The noise to remove, world units; nothing if it is measured.
[[nodiscard]] inline std::optional<double> given_noise(const ConvertOptions& options) {
  if (options.noise_removal != NoiseRemoval::AsGiven) return std::nullopt;
  return options.noise;
}

/// Statistics of a conversion.
struct ConvertReport {
  std::uint64_t points = 0;            ///< converted points
  std::uint64_t points_added = 0;      ///< on triangles larger than the spacing; not in `points`
  std::uint64_t points_merged = 0;     ///< into others on the same line (even_out)
  std::uint64_t stray_points = 0;      ///< left out; not in `points`
  double noise = 0.0;                  ///< standard deviation, median, world units; 0: none found
  std::uint64_t points_moved = 0;      ///< points that noise was removed from
  std::uint64_t normals_repaired = 0;  ///< given normals that were zero, NaN or inconsistent
  bool normals_estimated = false;      ///< the scan had no normals
  std::uint64_t fits = 0;              ///< of moving least squares; none for meshes (0158)
  std::uint64_t fits_replaced = 0;     ///< by tangent planes, where points do not bear a fit
  double fit_condition = 1.0;          ///< the largest of a fit's equations
  double error_rms = 0.0;  ///< distance of the points as scanned, noise included, to the patches'
                           ///< bilinear surface, world units
  double error_max = 0.0;
  double finest_spacing = 0.0;  ///< of all patches, world units
  double coarsest_spacing = 0.0;
  double psnr_db = 0.0;                ///< 20 log10(bounding-box diagonal / error_rms)
  std::uint64_t uncovered_points = 0;  ///< points farther than two spacings from every patch
  std::uint64_t colour_texels = 0;     ///< of the colour maps, holes included
  std::uint32_t texels_per_cell =
      0;  ///< of the finest colour map, along a side of a cell; 0: no colours
  std::uint64_t normal_texels = 0;           ///< of the normal maps, holes included
  std::uint32_t normal_texels_per_cell = 0;  ///< of the finest normal map, along a side of a cell
};

struct ConvertResult {
  PatchModel model;
  ConvertReport report;
};

}  // namespace relief
