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

/// The instances in view that it draws from afar, nearest first.
[[nodiscard]] std::vector<std::uint32_t> find_proxies(const PatchStore& store, const View& view);

/// Commands that draw these instances, each at the level that the view chooses.
[[nodiscard]] std::vector<ElementsCommand> proxy_commands(
    const PatchStore& store, const View& view, const std::vector<std::uint32_t>& instances);

/// Runs the program over them. The model must be bound (BoundModel).
void draw_proxy_meshes(const Gl& gl, const Program& program, const ProxyStore& store,
                       const std::vector<ElementsCommand>& commands);

}  // namespace relief::onepass
