#include "renderer/clip/sample_discs.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "renderer/geometry/samples/samples.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// A signed byte of a record's word.
float signed_byte(std::uint32_t word, unsigned shift) {
  return static_cast<float>(static_cast<std::int8_t>((word >> shift) & 0xFFU));
}

glm::vec2 slope_of(const SampleRecord& record, float slope_step) {
  return slope_step * glm::vec2(signed_byte(record.shape, 16), signed_byte(record.shape, 24));
}

/// The largest radius of a splat, in cells.
double disc_radius(const SampleRecord& record, glm::vec2 slope, double radius_factor) {
  const double cosine = 1.0 / std::sqrt(1.0 + double{glm::dot(slope, slope)});
  const double of_paper = std::sqrt(0.5) / (0.1 + 0.9 * cosine);
  return std::max(radius_factor * of_paper,
                  shared::kCoveringSlack * covering_radius(record, slope));
}

void add_samples(const Patch& patch, const PatchSamples& samples, double radius_factor,
                 std::size_t at, SampleDiscs& out) {
  for (const SampleRecord& record : samples.records) {
    const glm::vec2 slope = slope_of(record, samples.slope_step);
    const std::uint32_t column = record.node & shared::kNodeMask;
    const std::uint32_t row = (record.node >> shared::kRowShift) & shared::kNodeMask;
    out.discs.centres[at] = position_of(patch, column, row);
    out.discs.normals[at] =
        patch.axes * glm::normalize(glm::dvec3(-double{slope.x}, -double{slope.y}, 1.0));
    out.discs.radii[at] = patch.spacing * disc_radius(record, slope, radius_factor);
    out.slopes[at] = slope;
    ++at;
  }
}

}  // namespace

Result<SampleDiscs> make_sample_discs(const PatchModel& model, std::size_t first_patch,
                                      std::size_t patches, double radius_factor,
                                      const Progress& progress) {
  SampleDiscs out;
  out.first.push_back(0);
  for (std::size_t p = first_patch; p < first_patch + patches; ++p)
    out.first.push_back(out.first.back() + count_samples(model.patches[p]));
  out.discs.centres.resize(out.first.back());
  out.discs.normals.resize(out.first.back());
  out.discs.radii.resize(out.first.back());
  out.slopes.resize(out.first.back());
  tbb::parallel_for(std::size_t{0}, patches, [&](std::size_t k) {
    if (progress.cancelled()) return;
    const Patch& patch = model.patches[first_patch + k];
    const bool meets = run_of(model, first_patch + k) != nullptr;
    add_samples(patch, make_samples(patch, meets ? kReachToSeam : kReachToHole), radius_factor,
                out.first[k], out);
  });
  if (progress.cancelled()) return interrupted_error();
  return out;
}

}  // namespace relief
