// Fuzzes the readers of volumes. What begins the input chooses the format, as extensions do.
#include <cmath>
#include <string_view>

#include "preprocess/volumes/read_volume.h"
#include "tests/fuzz/memory_file.h"

namespace relief::fuzz {
namespace {

struct NamedFormat {
  std::string_view name;
  VolumeReadOptions options;
};

NamedFormat format_of(std::string_view text) {
  // The seeds' layout.
  const VolumeReadOptions headerless{RawLayout{{2, 3, 4}, {NumberType::Int16, true}}};
  if (text.starts_with("NRRD")) return {"nowhere/fuzzed.nrrd", {}};
  if (text.starts_with('<')) return {"nowhere/fuzzed.vti", {}};
  if (text.starts_with("PK")) return {"nowhere/fuzzed.zip", headerless};
  if (text.starts_with('O') || text.starts_with('N')) return {"nowhere/fuzzed.mha", {}};
  if (text.size() > 300 || text.starts_with("\x1F\x8B")) return {"nowhere/fuzzed.nii", {}};
  return {"nowhere/fuzzed.raw", headerless};
}

bool is_finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void check(const RegularGrid& grid, std::size_t /*nodes*/) {
  require(is_finite(grid.origin) && std::abs(glm::determinant(grid.step)) >= 0.0);
}
void check(const RectilinearGrid& grid, std::size_t nodes) {
  std::size_t product = 1;
  for (const std::vector<double>& coordinates : grid.coordinates) {
    product *= coordinates.size();
    for (std::size_t k = 1; k < coordinates.size(); ++k)
      require(coordinates[k - 1] < coordinates[k]);
  }
  require(product == nodes);
}
void check(const CurvilinearGrid& grid, std::size_t nodes) {
  require(grid.positions.size() == nodes);
  for (const glm::dvec3& p : grid.positions) require(is_finite(p));
}
void check(const ScatteredPoints& /*points*/, std::size_t /*nodes*/) {
  require(false);  // no format has them
}

}  // namespace
}  // namespace relief::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using relief::fuzz::require;
  const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto format = relief::fuzz::format_of(text);
  relief::Progress progress;
  const auto volume = relief::read_volume_bytes(format.name, bytes, format.options, progress);
  if (!volume) {
    require(volume.error().message.starts_with(std::string(format.name) + ": "));
    return 0;
  }
  require(volume->values.size() == relief::nodes_of(*volume));
  for (const float value : volume->values) require(!std::isinf(value));
  std::visit([&](const auto& placement) { relief::fuzz::check(placement, volume->values.size()); },
             volume->placement);
  (void)relief::parse_raw_layout(text.substr(0, 64));
  return 0;
}
