// Makes a model of a surface whose regions are known, with as many samples as are asked for.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/neighbours/neighbours.h"
#include "common/points.h"
#include "common/progress.h"
#include "preprocess/convert_options.h"
#include "preprocess/measure/measure.h"
#include "preprocess/mesh_fit/mesh_sides.h"
#include "preprocess/normals/crease_normals.h"
#include "preprocess/resample/resample.h"
#include "preprocess/texture/maps/flat_triangles.h"

namespace relief {

/// What patches are made from, whatever their spacing. All must outlive it.
struct PartitionedScan {
  double unit = 1.0;  ///< what lengths are in, in world units, for messages
  const Points& points;
  const Points& mesh;                ///< that patches are fitted to; `points`, unless it is coarse
  const MeshSides* sides = nullptr;  ///< of a coarse mesh whose patches meet
  const std::vector<glm::dvec3>&
      scanned;               ///< positions that count; those of `points` without noise
  std::size_t measured = 0;  ///< the first of them: others were added to triangles
  const NeighbourGraph& graph;
  SurfaceSamples samples;
  const std::vector<Region>& regions;
  const std::vector<ScalarInfo>& scalars;    ///< of those of `points`
  const CreaseNormals* creases = nullptr;    ///< none: patches overlap
  const ScanBorder* border = nullptr;        ///< if it is known, for patches that overlap
  const TriangleSpheres* spheres = nullptr;  ///< of the mesh; none without triangles
  bool follows_density = false;              ///< each patch's spacing does
  bool textured = false;                     ///< its triangles have materials
  bool is_borderless = false;                ///< the mesh, or the points
  NormalSource normals = NormalSource::Fits;
};

struct MeasuredModel {
  PatchModel model;
  Fidelity fidelity;
  FitSummary fits;
};

/// Resamples every region, fits the patches to the mesh, and measures them against the points.
///
/// `samples`: how many there shall be, about; nothing: by default, or as options.spacing has it.
/// Fails if the grids would be too large, if there is no surface, or if the user interrupts.
Result<MeasuredModel> make_model(const PartitionedScan& scan, const ConvertOptions& options,
                                 std::optional<double> samples, Progress& progress);

}  // namespace relief
