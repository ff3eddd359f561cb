// What draws with engine `onepass`.
#pragma once

#include <cstdint>
#include <optional>

#include "common/error.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/patch_store.h"

namespace relief::onepass {

/// The programs of a shader variant. Those that its features have no need of are not made.
struct Programs {
  Program main;                                         ///< splats or cells
  std::optional<Program> large_sprites = std::nullopt;  ///< with sprites
  std::optional<Program> rims = std::nullopt;           ///< with cells: the splats beside them
  std::optional<Program> borders = std::nullopt;        ///< cells that holes cut
  std::optional<Program> runs = std::nullopt;           ///< cells, where main draws strips of them
  std::optional<Program> edges = std::nullopt;    ///< with cells: those of levels that holes touch
  std::optional<Program> behind = std::nullopt;   ///< of layers: shading all but the first
  std::optional<Program> over = std::nullopt;     ///< of layers: puts them over the image
  std::optional<Program> shading = std::nullopt;  ///< where cells only find what is seen
  std::optional<Program> proxy = std::nullopt;    ///< of models seen from afar
  std::optional<Program> seams = std::nullopt;    ///< with cells: between patches that meet
};

/// Makes them. Fails if OpenGL refuses a shader.
Result<Programs> make_programs(const Gl& gl, const PatchStore& store, Features features);

}  // namespace relief::onepass
