// Which maps of patch files the views of a plan show.
#pragma once

#include <span>

#include "common/error.h"
#include "common/patch_file/patch_file.h"
#include "loader/scene/scene_plan.h"
#include "renderer/engine_registry.h"

namespace relief {

/// Returns the maps that some view of the plan shows: normals where something is shaded by them or
/// clipped, where they are an output, or where patches meet at seams; colours where they are seen;
/// scalars if they take the place of colours (`by_scalar`). All, where an engine of the plan makes
/// something else of patches, or where a model is no patch file. Opens the files, and reads their
/// indices only. Fails as PatchTree::open() does.
Result<PatchSections> sections_of(const ScenePlan& plan, bool by_scalar,
                                  std::span<const EngineEntry> among = engines());

}  // namespace relief
