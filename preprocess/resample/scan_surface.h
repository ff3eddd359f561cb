// What resampling knows of a scan.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/scalar.h"
#include "preprocess/normals/crease_normals.h"
#include "preprocess/partition/partition.h"
#include "preprocess/resample/heights/fit_census.h"

namespace relief {

class ScanBorder;

/// The input of resampling the regions of a scan.
struct ScanSurface {
  const SurfaceSamples& samples;
  const NeighbourGraph& graph;
  const Membership& membership;                   ///< of all points
  const std::vector<glm::u8vec3>& colours;        ///< empty, or one for each point
  const CreaseNormals* creases = nullptr;         ///< of all points, with seams; may be null
  std::span<const PointScalar> scalars = {};      ///< of all points
  std::span<const ScalarInfo> scalar_infos = {};  ///< one for each
  const ScanBorder* border = nullptr;             ///< of all points; null: patches end with support
  bool follows_density = false;                   ///< patches' spacings do (spacing_factors)
  bool is_cut_later = false;                      ///< by cut_to_mesh(): patches may overhang
  bool is_fitted_later = false;                   ///< to triangles, by fit_to_mesh()
  FitCensus* fits = nullptr;                      ///< counts the fits; null: nothing does
};

}  // namespace relief
