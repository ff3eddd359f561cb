// Masks and heights in codec 2 of the patch file.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/patch_file/compact/compact_codec.h"
#include "common/patch_file/compact/compact_mask.h"
#include "common/patch_file/compact/height_levels.h"
#include "common/patch_file/fast/patch_codec.h"
#include "common/patch_file/fast/residuals.h"

namespace relief {
namespace {

/// Copies a level's heights from the patch, for writing.
void read_level(const Patch& patch, unsigned level, LevelGrid& grid) {
  for (std::uint32_t j = 0; j < grid.height; ++j) {
    for (std::uint32_t i = 0; i < grid.width; ++i) {
      const std::size_t node = grid.node(i, j);
      if (grid.samples[node] != 0) {
        grid.heights[node] =
            static_cast<std::int16_t>(patch.at(i << level, j << level) - LevelGrid::kHeightBase);
      }
    }
  }
}

/// Makes a patch of `level` whose nodes are those of `grid`.
void store_level(const LevelGrid& grid, Patch& patch) {
  patch.width = grid.width;
  patch.height = grid.height;
  patch.heights.resize(std::size_t{grid.width} * grid.height);
  for (std::uint32_t j = 0; j < grid.height; ++j) {
    const std::uint8_t* const samples = &grid.samples[grid.node(0, j)];
    const std::int16_t* const heights = &grid.heights[grid.node(0, j)];
    std::int32_t* __restrict to = &patch.heights[std::size_t{j} * grid.width];
    for (std::uint32_t i = 0; i < grid.width; ++i) {
      const std::int32_t height = heights[i] + LevelGrid::kHeightBase;
      to[i] = samples[i] != 0 ? height : kHole;
    }
  }
}

/// Writes the heights that are visited.
struct HeightWriter {
  RansEncoder* out;
  std::uint32_t operator()(std::int16_t height, Expectation e) const {
    const std::uint16_t r = zigzag(static_cast<std::uint16_t>(height - e.height));
    put_residual(*out, e.residual_class, r);
    return std::min(magnitude_of(r), kMaxMagnitude);
  }
};

/// Reads them.
struct HeightReader {
  RansDecoder in;
  const ResidualClasses* classes;
  std::uint32_t operator()(std::int16_t& height, Expectation e) {
    const std::uint32_t symbol = take_symbol(in, *classes, e.residual_class);
    std::uint32_t residual = symbol;
    // The next symbol waits for the magnitude: nearly always it follows in two steps.
    std::uint32_t magnitude = magnitude_of(symbol);
    if (symbol >= classes->plain[e.residual_class]) [[unlikely]] {
      residual = take_rest(in, *classes, e.residual_class, symbol);
      magnitude = std::min(magnitude_of(residual), kMaxMagnitude);
    }
    height = static_cast<std::int16_t>(
        static_cast<std::uint16_t>(e.height + unzigzag(static_cast<std::uint16_t>(residual))));
    return magnitude;
  }
};

/// Runs `visit_coarsest` and then `visit_level` for each finer level down to `finest`; `prepare`
/// sets up the heights of a level before it is visited. Returns the finest one.
template <class Prepare, class Code>
LevelGrid visit_heights(std::span<const std::uint8_t> mask, std::uint32_t width,
                        std::uint32_t height, unsigned finest, const Prepare& prepare, Code& code) {
  const PredictorTables& tables = predictor_tables();
  unsigned level = std::max(coarsest_level(width, height), finest);
  LevelGrid grid(width, height, level);
  mark_samples(mask, width, level, grid);
  prepare(level, grid);
  code = visit_coarsest(grid, code);
  while (level > finest) {
    --level;
    LevelGrid finer(width, height, level);
    mark_samples(mask, width, level, finer);
    take_heights(grid, finer);
    prepare(level, finer);
    grid = std::move(finer);
    code = visit_level(tables, grid, code);
  }
  return grid;
}

}  // namespace

std::vector<std::byte> encode_heights_compact(const Patch& patch) {
  const std::vector<std::uint8_t> mask = sample_mask(patch);
  RansEncoder out;
  put_mask(out, mask, patch.width);
  HeightWriter writer{&out};
  visit_heights(
      mask, patch.width, patch.height, 0,
      [&](unsigned level, LevelGrid& grid) { read_level(patch, level, grid); }, writer);
  std::vector<std::byte> bytes;
  out.finish(bytes);
  return bytes;
}

Status decode_heights_compact(std::span<const std::byte> bytes, std::uint32_t samples,
                              unsigned level, Patch& patch) {
  // A node of the mask takes at least log2(4096 / 4095) bits: a chunk of fewer bytes is a bomb,
  // which decoding would notice only after the whole mask.
  constexpr std::uint64_t kMaxNodesPerByte = 32768;
  const std::uint64_t nodes = std::uint64_t{patch.width} * patch.height;
  if (nodes / kMaxNodesPerByte > bytes.size()) return make_error("they are too few for the mask");
  RansDecoder in(bytes);
  const std::vector<std::uint8_t> mask = take_mask(in, patch.width, patch.height);
  if (!in.is_sound()) return make_error("they end within the mask");
  const std::uint32_t marked = count_marked(mask);
  if (marked != samples) {
    return make_error("the mask has {} samples, but the index states {}", marked, samples);
  }
  HeightReader reader{in, &residual_classes()};
  const LevelGrid grid = visit_heights(
      mask, patch.width, patch.height, level, [](unsigned, const LevelGrid&) {}, reader);
  if (!reader.in.is_sound()) return make_error("they end too early");
  if (level == 0 && !reader.in.is_at_end()) {
    return make_error("they do not end where they should");
  }
  store_level(grid, patch);
  patch.spacing = std::ldexp(patch.spacing, static_cast<int>(level));
  return {};
}

}  // namespace relief
