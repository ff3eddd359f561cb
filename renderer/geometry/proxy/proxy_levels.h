// Coarse meshes of patches, for models seen from afar (proxy.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/patch.h"
#include "common/points.h"
#include "common/seams/seams.h"
#include "renderer/geometry/proxy/proxy.h"
#include "renderer/geometry/proxy/proxy_vertex.h"

namespace relief {

/// A model as a mesh whose vertices are about `spacing` apart.
struct ProxyLevel {
  double spacing = 0.0;
  std::vector<ProxyVertex> vertices;
  std::vector<Triangle> triangles;  ///< counter-clockwise seen from the normals' tips
};

/// Patches that meet, and what closes the surface between them.
struct JoinedPatches {
  std::uint32_t first = 0;  ///< in the run that the levels are made of
  const Seams* seams = nullptr;
};

/// Makes the levels (Proxy::spacings) of a run of patches, in its frame, by vertex clustering
/// (Rossignac and Borrel 1993, "Multi-resolution 3D approximations for rendering complex scenes"):
/// samples in one cube of a grid become one vertex, and what is left of the cells' triangles joins
/// these. Samples in a cube whose normals point to different sides stay apart: a thin sheet keeps
/// both of its sides. Neighbouring patches overlap, so that their samples share cubes and their
/// meshes close; those of patches that meet are closed by what is left of their seams.
[[nodiscard]] std::vector<ProxyLevel> make_proxy_levels(std::span<const Patch> patches,
                                                        std::span<const JoinedPatches> joined,
                                                        const Proxy& model);

}  // namespace relief
