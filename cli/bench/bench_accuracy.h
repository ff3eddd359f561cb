// The accuracy of the images of `relief bench`.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/compare/compare.h"
#include "common/error.h"
#include "common/progress.h"
#include "renderer/bench/bench.h"

namespace relief::cli {

/// An image against a ray-traced one; empty where it could not be measured. The PSNR of equal
/// images is infinite.
struct PictureAccuracy {
  std::optional<double> psnr_db;       ///< over all pixels
  std::optional<double> flip_mean;     ///< LDR-FLIP
  std::optional<std::uint64_t> holes;  ///< pixels inside the silhouette that only the truth covers
  std::optional<std::uint64_t> border_missing;  ///< that only the truth covers, at the silhouette
  std::optional<std::uint64_t> border_extra;    ///< that only the row covers: its overhang
  std::optional<double> normal_rms_deg;  ///< over pixels that both cover, if normals are compared
};

/// A row's images: in its material, and as a mirror.
struct RowAccuracy : PictureAccuracy {
  std::optional<double> psnr_covered_db;  ///< over pixels that both cover
  std::optional<double> psnr_mirror_db;   ///< the same as a mirror
  std::optional<double> psnr_mirror_covered_db;
};

[[nodiscard]] PictureAccuracy accuracy_of(const Comparison& comparison);

/// Whether the directions of normals are compared, too.
enum class CompareNormals : bool { No, Yes };

/// What is compared: images in a material, with these outputs, and how many rays a pixel the truth
/// has.
struct Look {
  Material material = Material::Lit;
  Outputs outputs;
  int rays = 1;
};

/// A look whose coverage is found by depth, also where the model fills the image
/// (common/compare/coverage.h).
[[nodiscard]] Look look_in(Material material, CompareNormals normals, int rays);

/// The row's view by the engine `raytrace`, of the mesh or, if that is null, of the row's model.
Result<Image> trace_truth(const BenchMethod& row, const TriangleMesh* mesh, const Look& look,
                          Progress& progress);

/// Draws each row and compares it with the truth. Rows that draw one model share it if they follow
/// each other.
Result<std::vector<Comparison>> compare_rows(const std::vector<BenchMethod>& rows,
                                             const Image& truth, const Look& look,
                                             Progress& progress);

/// Draws each row twice, in its material and as a mirror (of its environment, or the built-in one),
/// and compares with the engine `raytrace`, which follows rays to the mesh or, if that is null, to
/// the first row's patches, which it must have then: one ray a pixel where the image has one sample
/// too, and 16 for a mirror, as one ray reads one point of an environment that all others filter.
/// Rows have no background.
Result<std::vector<RowAccuracy>> measure_accuracy(const std::vector<BenchMethod>& rows,
                                                  const TriangleMesh* mesh, CompareNormals normals,
                                                  Progress& progress);

}  // namespace relief::cli
