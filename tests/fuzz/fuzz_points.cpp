// Fuzzes one reader of points, named by the target of its row in the table of formats:
//   fuzz_points --format=ply ...
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "preprocess/readers/format.h"
#include "preprocess/readers/read_points.h"
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
  for (const PointScalar& scalar : points.scalars) require(scalar.values.size() == count);
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

/// The format of this run.
const PointFormat* fuzzed_format = nullptr;

const PointFormat* format_of(std::string_view target) {
  for (const PointFormat& format : point_formats()) {
    if (format.target() == target) return &format;
  }
  return nullptr;
}

}  // namespace
}  // namespace relief::fuzz

// libFuzzer passes over options that begin with two dashes.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);  // NOLINT
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view option = "--format=";
  for (int k = 1; k < *argc; ++k) {
    const std::string_view argument = (*argv)[k];
    if (argument.starts_with(option))
      relief::fuzz::fuzzed_format = relief::fuzz::format_of(argument.substr(option.size()));
  }
  if (relief::fuzz::fuzzed_format != nullptr) return 0;
  std::fputs("fuzz_points needs --format=TARGET, of a row in preprocess/readers/format.cpp\n",
             stderr);
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  relief::Progress progress;
  relief::ReadRemarks remarks;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  // read_bytes refuses an empty file before any reader sees it.
  if (text.empty()) return 0;
  const relief::ScalarChoice scalars{true, {}};
  auto points = relief::fuzz::fuzzed_format->read({.name = "fuzzed",
                                                   .text = text,
                                                   .progress = progress,
                                                   .remarks = remarks,
                                                   .scalars = &scalars});
  if (points) {
    relief::fuzz::check(relief::clean_points(*std::move(points)).points);
  } else {
    relief::fuzz::require(points.error().message.starts_with("fuzzed: "));
  }
  return 0;
}
