// Fuzzes one reader of points: RELIEF_READER, as readers.h has it.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "preprocess/readers/readers.h"
#include "tests/fuzz/memory_file.h"

namespace relief::fuzz {
namespace {

template <class Values>
bool fits(const Values& values, std::size_t count) {
  return values.empty() || values.size() == count;
}

/// What points.h and read_points.h promise of what was read.
void check(const Points& points) {
  const std::size_t count = points.size();
  const std::size_t triangles = points.triangles.size();
  require(fits(points.normals, count) && fits(points.colours, count) &&
          fits(points.texcoords, count));
  require(fits(points.corner_texcoords, triangles) && fits(points.corner_tangents, triangles) &&
          fits(points.triangle_materials, triangles));
  for (const glm::dvec3& p : points.positions) {
    require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  }
  for (const Triangle& t : points.triangles) require(std::max({t[0], t[1], t[2]}) < count);
  for (const std::uint32_t material : points.triangle_materials) {
    require(material == kNoMaterial || material < points.materials.size());
  }
}

}  // namespace
}  // namespace relief::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  relief::Progress progress;
  relief::ReadRemarks remarks;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  // read_bytes asks the readers nothing about an empty file.
  if (text.empty()) return 0;
  auto points = relief::RELIEF_READER({"fuzzed", text, progress, remarks});
  if (points) {
    relief::fuzz::check(relief::clean_points(*std::move(points)).points);
  } else {
    relief::fuzz::require(points.error().message.starts_with("fuzzed: "));
  }
  return 0;
}
