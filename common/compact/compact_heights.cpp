// Masks and heights in codec 2 of the patch file.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/compact/compact_codec.h"
#include "common/compact/compact_mask.h"
#include "common/compact/height_levels.h"
#include "common/patch_codec.h"
#include "common/residuals.h"

namespace relief {
namespace {

/// Copies a level's heights from the patch, for writing.
void read_level(const Patch& patch, unsigned level, LevelGrid& grid) {
  for (std::uint32_t j = 0; j < grid.height; ++j) {
    for (std::uint32_t i = 0; i < grid.width; ++i) {
      const std::size_t node = grid.node(i, j);
      if (grid.samples[node] != 0) grid.heights[node] = patch.at(i << level, j << level);
    }
  }
}

/// Makes a patch of `level` whose nodes are those of `grid`.
void store_level(const LevelGrid& grid, Patch& patch) {
  patch.width = grid.width;
  patch.height = grid.height;
  patch.heights.resize(std::size_t{grid.width} * grid.height);
  for (std::uint32_t j = 0; j < grid.height; ++j) {
    const std::size_t from = grid.node(0, j);
    std::int32_t* to = &patch.heights[std::size_t{j} * grid.width];
    for (std::uint32_t i = 0; i < grid.width; ++i) {
      to[i] = grid.samples[from + i] != 0 ? grid.heights[from + i] : kHole;
    }
  }
}

/// Runs `visit_coarsest` and then `visit_level` for each finer level down to `finest`; `prepare`
/// sets up the heights of a level before it is visited. Gives the finest one.
template <class Prepare, class Code>
LevelGrid visit_heights(std::span<const std::uint8_t> mask, std::uint32_t width,
                        std::uint32_t height, unsigned finest, const Prepare& prepare,
                        const Code& code) {
  const PredictorTables& tables = predictor_tables();
  unsigned level = std::max(coarsest_level(width, height), finest);
  LevelGrid grid(width, height, level);
  mark_samples(mask, width, level, grid);
  prepare(level, grid);
  visit_coarsest(grid, code);
  while (level > finest) {
    --level;
    LevelGrid finer(width, height, level);
    mark_samples(mask, width, level, finer);
    take_heights(grid, finer);
    prepare(level, finer);
    grid = std::move(finer);
    visit_level(tables, grid, code);
  }
  return grid;
}

}  // namespace

std::vector<std::byte> encode_heights_compact(const Patch& patch) {
  const std::vector<std::uint8_t> mask = sample_mask(patch);
  RansEncoder out;
  put_mask(out, mask, patch.width);
  visit_heights(
      mask, patch.width, patch.height, 0,
      [&](unsigned level, LevelGrid& grid) { read_level(patch, level, grid); },
      [&](std::int32_t height, Expectation e) {
        const std::int32_t r = wrapped(height - e.height);
        put_residual(out, e.residual_class, zigzag(static_cast<std::uint16_t>(r)));
        return r;
      });
  std::vector<std::byte> bytes;
  out.finish(bytes);
  return bytes;
}

Status decode_heights_compact(std::span<const std::byte> bytes, std::uint32_t samples,
                              unsigned level, Patch& patch) {
  // A node of the mask takes log2(4096 / 4095) bits at least: a chunk of fewer bytes is a bomb,
  // which would be seen only behind the whole mask.
  constexpr std::uint64_t kMostNodesPerByte = 32768;
  const std::uint64_t nodes = std::uint64_t{patch.width} * patch.height;
  if (nodes / kMostNodesPerByte > bytes.size()) return make_error("they are too few for the mask");
  RansDecoder in(bytes);
  const std::vector<std::uint8_t> mask = take_mask(in, patch.width, patch.height);
  if (!in.is_sound()) return make_error("they end within the mask");
  const auto marked = static_cast<std::size_t>(std::count(mask.begin(), mask.end(), 1));
  if (marked != samples) {
    return make_error("the mask has {} samples where the index says {}", marked, samples);
  }
  const auto& classes = residual_classes();
  const LevelGrid grid = visit_heights(
      mask, patch.width, patch.height, level, [](unsigned, const LevelGrid&) {},
      [&](std::int32_t& height, Expectation e) {
        const std::uint16_t residual = unzigzag(take_residual(in, classes[e.residual_class]));
        height = static_cast<std::uint16_t>(e.height + residual);
        return wrapped(residual);
      });
  if (!in.is_sound()) return make_error("they end too early");
  if (level == 0 && !in.is_at_end()) return make_error("they do not end where they should");
  store_level(grid, patch);
  patch.spacing = std::ldexp(patch.spacing, static_cast<int>(level));
  return {};
}

}  // namespace relief
