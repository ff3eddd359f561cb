#include "common/compare/compare.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/compare/colour_errors.h"

namespace relief {
namespace {

/// An infinite depth means background; all other values must be finite.
bool is_value(const Channel& channel, float value) {
  return std::isfinite(value) || (channel.name == "Z" && value > 0.0F);
}

std::uint64_t count_non_finite(const Image& image) {
  std::vector<bool> bad(std::size_t{image.width} * image.height);
  for (const Channel& channel : image.channels) {
    for (std::size_t k = 0; k < bad.size(); ++k) {
      if (!is_value(channel, channel.values[k])) bad[k] = true;
    }
  }
  return static_cast<std::uint64_t>(std::count(bad.begin(), bad.end(), true));
}

bool are_identical(const Image& a, const Image& b) {
  return a.channels.size() == b.channels.size() &&
         std::all_of(a.channels.begin(), a.channels.end(), [&](const Channel& channel) {
           const Channel* const other = b.find(channel.name);
           return other != nullptr && std::memcmp(channel.values.data(), other->values.data(),
                                                  channel.values.size() * sizeof(float)) == 0;
         });
}

}  // namespace

Result<Comparison> compare_images(const Image& test, const Image& reference,
                                  const FlipOptions& options, Progress& progress) {
  if (test.width != reference.width || test.height != reference.height) {
    return make_error(
        "the image under test has {}x{} pixels and the reference {}x{}; make both in one size",
        test.width, test.height, reference.width, reference.height);
  }
  const auto colour = take_colour(test);
  if (!colour) return make_error("the image under test {}", colour.error().message);
  const auto reference_colour = take_colour(reference);
  if (!reference_colour) return make_error("the reference {}", reference_colour.error().message);

  RELIEF_TRY_ASSIGN(auto flip, measure_flip(*colour, *reference_colour, options, progress));

  const auto masks = find_coverage(test, reference);
  const auto* const both = masks ? &masks->both : nullptr;
  const auto psnr_covered_db = [&]() -> Result<double> {
    if (!masks) return masks.error();
    if (std::count(both->begin(), both->end(), 1) == 0) {
      return make_error("no pixel is covered in both images");
    }
    return colour_psnr_db(*colour, *reference_colour, both);
  };
  const auto coverage = [&]() -> Result<CoverageErrors> {
    if (!masks) return masks.error();
    return count_coverage_errors(*masks, reference.width, reference.height);
  };
  return Comparison{
      .width = reference.width,
      .height = reference.height,
      .identical = are_identical(test, reference),
      .non_finite = count_non_finite(test),
      .non_finite_reference = count_non_finite(reference),
      .psnr_db = colour_psnr_db(*colour, *reference_colour, nullptr),
      .psnr_covered_db = psnr_covered_db(),
      .flip = std::move(flip),
      .coverage = coverage(),
      .normal = measure_normals(test, reference, both),
      .depth = measure_depth(test, reference, both),
      .psnr_uv_db = measure_uv_psnr_db(test, reference, both),
      .psnr_alpha_db = measure_alpha_psnr_db(test, reference),
  };
}

}  // namespace relief
