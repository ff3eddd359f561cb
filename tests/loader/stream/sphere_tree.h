// A small file with tiles.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "common/patch_file/patch_tree.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/renderer/scenes.h"

namespace relief::test {

inline TreePart write_part(const std::filesystem::path& path, const PatchModel& model,
                           std::size_t first, std::size_t count) {
  PatchModel part = without_patches(model);
  part.scalars = model.scalars;
  const auto begin = model.patches.begin() + static_cast<std::ptrdiff_t>(first);
  part.patches.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
  EXPECT_TRUE(write_patch_file(path, part));
  return {path};
}

/// Gives the patches of a sphere of radius 1 a label, 2 below the origin and 6 above it.
inline void add_label(PatchModel& sphere) {
  sphere.scalars = {{"classification", true, 2.0, 1.0, {}}};
  for (Patch& patch : sphere.patches) {
    AttributeMap<std::uint16_t> map{patch.width, patch.height, 1, {}};
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        const bool is_hole = patch.at(i, j) == kHole;
        map.texels.push_back(is_hole ? kNoScalar : position_of(patch, i, j).z < 0.0 ? 0 : 4);
      }
    }
    patch.scalars = {std::move(map)};
  }
}

/// Writes a bumpy sphere of radius 1 in four tiles, over which is one of four times their spacing,
/// which is 0.02, with or without add_label(). The parts stay in the folder of `file`.
inline void write_sphere_tree(const std::filesystem::path& file, bool has_label = false) {
  SphereShape shape;
  shape.bumps = 0.05;
  shape.coloured = true;
  shape.spacing = 0.08;
  shape.patches_per_side = 2;
  const std::filesystem::path folder = file.parent_path();
  PatchModel coarse = sphere_model(shape);
  if (has_label) add_label(coarse);
  std::vector<TreePart> parts{write_part(folder / "coarse", coarse, 0, 24)};
  parts.front().level = 1;
  shape.spacing = 0.02;
  shape.patches_per_side = 4;
  PatchModel fine = sphere_model(shape);
  if (has_label) add_label(fine);
  const std::vector<const char*> names{"a", "b", "c", "d"};
  for (std::size_t t = 0; t < 4; ++t) {
    parts.push_back(write_part(folder / names[t], fine, 24 * t, 24));
    parts.back().parent = 0;
  }
  ASSERT_TRUE(write_patch_tree(file, parts, fine));
}

}  // namespace relief::test
