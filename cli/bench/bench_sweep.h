// `relief bench --sweep`: one quantity with several values.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/progress.h"
#include "common/scene/choices.h"

namespace relief::cli {

/// What can be swept. Spacing and height step are those of the conversion, world units.
enum class Swept : std::uint8_t { Spacing, HeightStep, RadiusFactor, PixelsPerSample };
inline constexpr std::array<Named<Swept>, 4> kSwept{
    {{"spacing", Swept::Spacing},
     {"height-step", Swept::HeightStep},
     {"radius-factor", Swept::RadiusFactor},
     {"pixels-per-sample", Swept::PixelsPerSample}}};

struct Sweep {
  Swept what = Swept::Spacing;
  std::vector<double> values;  ///< above 0; of pixels a sample also 0, the finest levels
};

/// "KEY=V,V,...", 1 to 16 values. Throws CLI::ValidationError.
[[nodiscard]] Sweep parse_sweep(const std::string& text);

/// Whether the scan is converted anew for each value.
[[nodiscard]] constexpr bool converts(const Sweep& sweep) {
  return sweep.what == Swept::Spacing || sweep.what == Swept::HeightStep;
}

/// Converts a scan once for each value; all other options are the defaults.
Result<std::vector<PatchModel>> convert_sweep(const std::filesystem::path& scan, const Sweep& sweep,
                                              Progress& progress);

}  // namespace relief::cli
