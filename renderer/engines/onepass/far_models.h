// Models seen from afar, drawn as coarse meshes.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/patch_store.h"
#include "renderer/view/draw_list.h"
#include "renderer/view/view.h"

namespace relief::onepass {

/// The placements in view that it draws from afar, nearest first.
[[nodiscard]] std::vector<std::uint32_t> find_far(const PatchStore& store, const View& view);

/// Commands that draw these placements, each at the level that the view chooses.
[[nodiscard]] std::vector<ElementsCommand> far_commands(
    const PatchStore& store, const View& view, const std::vector<std::uint32_t>& placements);

/// Runs the program over them. The model must be bound (BoundModel).
void draw_far(const Gl& gl, const Program& program, const FarStore& store,
              const std::vector<ElementsCommand>& commands);

}  // namespace relief::onepass
