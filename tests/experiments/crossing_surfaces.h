// Semi-transparent surfaces that cross ([Zwicker 2001], Figure 7): points for the engine `ewa`, and
// the triangles between them for the ray tracer.
#pragma once

#include "common/points.h"
#include "renderer/geometry/meshes/triangle_mesh.h"
#include "renderer/geometry/splat_cloud.h"

namespace relief::experiment {

/// The vertices of `mesh` are the positions of `cloud`, with the same normals and colours.
struct Surfaces {
  TriangleMesh mesh;
  SplatCloud cloud;
};

/// Two wavy sheets, orange and blue, that cross along a winding line. Waves are high enough to hide
/// one another from the side. side x side points each. World unit: half a sheet's width.
[[nodiscard]] Surfaces crossing_sheets(std::uint32_t side, float opacity);

/// A scan (with faces) and a wavy sheet through its middle, with about the scan's spacing. h of the
/// scan's points as the command `relief render` finds it.
[[nodiscard]] Surfaces scan_through_sheet(const Points& scan, float opacity);

}  // namespace relief::experiment
