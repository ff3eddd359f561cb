// Whether patches of bare points meet.
#pragma once

#include <memory>
#include <optional>

#include "common/neighbours/neighbours.h"
#include "preprocess/normals/crease_normals.h"
#include "preprocess/partition/partition.h"
#include "preprocess/resample/borders/scan_border.h"

namespace relief {

/// What decides it, kept for what comes after.
struct Meeting {
  std::optional<CreaseNormals> creases;  ///< if they meet
  std::unique_ptr<ScanBorder> border;    ///< if they overlap
  bool is_closed = false;                ///< the scan ends nowhere
};

/// Chooses for points without triangles whether their patches meet at seams or overlap.
///
/// Where patches overlap they reach beyond sharp edges and thin parts, into the air: on shapes with
/// sharp edges this costs 10 to 20 dB, on Lucy 5. Where they meet, the scan's borders end in steps,
/// and gaps stay open. So they meet where the scan is closed, or has more points at creases than at
/// borders (record 0145).
[[nodiscard]] Meeting choose_meeting(const SurfaceSamples& samples, const NeighbourGraph& graph);

}  // namespace relief
