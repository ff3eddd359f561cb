// Conversions in small tiles.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <optional>

#include "preprocess/convert_tiles.h"
#include "preprocess/tiles/spread_points.h"

namespace relief::test {

/// Small tiles, of scans of more than 24,000 points.
inline TileOptions tiles_of(std::uint64_t points) {
  return {memory_for(24000), points, true, 4000};
}

inline Result<std::optional<TiledResult>> try_convert(const std::filesystem::path& scan,
                                                      const std::filesystem::path& output,
                                                      Progress& progress,
                                                      const ConvertOptions& options = {},
                                                      const PatchFileOptions& file = {}) {
  return convert_tiles({scan}, output, options, file, tiles_of(4000), progress);
}

inline TiledResult must_convert(const std::filesystem::path& scan,
                                const std::filesystem::path& output,
                                const ConvertOptions& options = {},
                                const PatchFileOptions& file = {}) {
  Progress progress;
  auto result = try_convert(scan, output, progress, options, file);
  EXPECT_TRUE(result) << result.error().message;
  EXPECT_TRUE(result && *result) << "it was not converted in tiles";
  return result && *result ? **result : TiledResult{};
}

}  // namespace relief::test
