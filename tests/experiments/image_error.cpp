#include "tests/experiments/image_error.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/compare/colour_errors.h"
#include "common/compare/flip.h"
#include "common/progress.h"

namespace relief::experiment {

Result<ImageError> measure_error(const Image& image, const Image& truth, const Mask& mask) {
  auto colour = take_colour(image);
  if (!colour) return colour.error();
  const auto expected = take_colour(truth);
  if (!expected) return expected.error();
  const auto count = std::count_if(mask.begin(), mask.end(), [](auto value) { return value != 0; });
  if (count == 0) return make_error("no pixel is in the mask");
  const double psnr = colour_psnr_db(*colour, *expected, &mask);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (mask[i] == 0) colour->rgb[c][i] = expected->rgb[c][i];
    }
  }
  Progress progress;
  FlipOptions options;
  options.range = FlipRange::Ldr;
  const auto flip = measure_flip(*colour, *expected, options, progress);
  if (!flip) return flip.error();
  double sum = 0.0;
  for (std::size_t i = 0; i < mask.size(); ++i) sum += mask[i] == 0 ? 0.0 : double{flip->map[i]};
  return ImageError{psnr, sum / static_cast<double>(count)};
}

std::string as_cell(const Result<ImageError>& error) {
  if (!error) return "–";
  return fmt::format("{:.1f} / {:.3f}", error->psnr_db, error->flip_mean);
}

}  // namespace relief::experiment
