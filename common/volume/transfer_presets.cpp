// Transfer functions that come with Relief, and one from a volume's histogram.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "common/image/srgb.h"
#include "common/volume/spacing.h"
#include "common/volume/transfer_function.h"

namespace relief {
namespace {

constexpr std::array<std::string_view, 4> kPresets{"ct-bone", "ct-skin", "mr", "none"};

/// Millimetres: what medical files are in.
constexpr double kMillimetre = 1.0;

ColourStop srgb_stop(double value, int r, int g, int b) {
  const auto linear = [](int c) { return linear_from_srgb8(static_cast<std::uint8_t>(c)); };
  return {value, {linear(r), linear(g), linear(b)}};
}

/// Of Hounsfield units: air -1000, fat -100, water 0, muscle 50, bone 300 and more.
TransferFunction ct_bone() {
  return {
      {srgb_stop(150, 190, 120, 90), srgb_stop(400, 240, 225, 195), srgb_stop(1500, 255, 255, 250)},
      {{120, 0.0}, {300, 0.15}, {600, 0.6}, {1500, 0.9}},
      {},
      kMillimetre};
}

TransferFunction ct_skin() {
  return {{srgb_stop(-500, 214, 160, 130), srgb_stop(60, 205, 140, 115),
           srgb_stop(300, 240, 225, 195), srgb_stop(1500, 255, 255, 250)},
          {{-600, 0.0}, {-300, 0.04}, {60, 0.05}, {250, 0.1}, {600, 0.6}, {1500, 0.9}},
          {},
          kMillimetre};
}

constexpr std::size_t kBins = 256;

/// The histogram of the finite values between two of them.
struct Histogram {
  double low = 0.0;
  double high = 0.0;
  std::array<double, kBins> counts{};

  [[nodiscard]] double value_at(double bin) const { return low + (high - low) * bin / kBins; }
};

Histogram histogram_of(const ScalarVolume& volume) {
  Histogram histogram;
  bool is_first = true;
  for (const float value : volume.values) {
    if (!std::isfinite(value)) continue;
    histogram.low = is_first ? value : std::min<double>(histogram.low, value);
    histogram.high = is_first ? value : std::max<double>(histogram.high, value);
    is_first = false;
  }
  if (!(histogram.high > histogram.low)) return histogram;
  const double scale = kBins / (histogram.high - histogram.low);
  for (const float value : volume.values) {
    if (!std::isfinite(value)) continue;
    const double bin = (value - histogram.low) * scale;
    ++histogram.counts[std::min(static_cast<std::size_t>(bin), kBins - 1)];
  }
  return histogram;
}

/// The first bin of the upper class, by Otsu's method: the variance between the classes is largest.
std::size_t otsu_bin(const std::array<double, kBins>& counts) {
  double total = 0.0;
  double sum = 0.0;
  for (std::size_t b = 0; b < kBins; ++b) {
    total += counts[b];
    sum += static_cast<double>(b) * counts[b];
  }
  double below = 0.0;
  double sum_below = 0.0;
  double best = -1.0;
  std::size_t best_bin = 1;
  for (std::size_t b = 0; b + 1 < kBins; ++b) {
    below += counts[b];
    sum_below += static_cast<double>(b) * counts[b];
    if (below == 0.0 || below == total) continue;
    const double apart = sum_below / below - (sum - sum_below) / (total - below);
    const double between = below * (total - below) * apart * apart;
    if (between > best) {
      best = between;
      best_bin = b + 1;
    }
  }
  return best_bin;
}

/// The bin below which a share of what is at or above `first` lies.
std::size_t quantile_bin(const std::array<double, kBins>& counts, std::size_t first, double share) {
  double total = 0.0;
  for (std::size_t b = first; b < kBins; ++b) total += counts[b];
  double passed = 0.0;
  for (std::size_t b = first; b < kBins; ++b) {
    passed += counts[b];
    if (passed >= share * total) return b;
  }
  return kBins - 1;
}

}  // namespace

std::span<const std::string_view> transfer_presets() {
  return kPresets;
}

TransferFunction transfer_from_histogram(const ScalarVolume& volume) {
  const Histogram histogram = histogram_of(volume);
  const std::size_t threshold = otsu_bin(histogram.counts);
  const auto value_of = [&](double share) {
    return histogram.value_at(
        static_cast<double>(quantile_bin(histogram.counts, threshold, share)) + 0.5);
  };
  const double edge = histogram.value_at(static_cast<double>(threshold));
  const double middle = std::max(value_of(0.5), edge + 1e-3 * (histogram.high - edge));
  const double high = std::max(value_of(0.98), middle + 1e-3 * (histogram.high - middle));
  // Toward what is background: the voxels of a surface have part of its value.
  const double low = edge - 0.15 * (edge - histogram.low);
  TransferFunction function;
  function.colours = {srgb_stop(low, 190, 110, 80), srgb_stop(middle, 225, 190, 150),
                      srgb_stop(high, 250, 248, 240)};
  function.opacities = {{low, 0.0}, {middle, 0.08}, {high, 0.5}};
  function.unit_length = mean_spacing(volume);
  return function;
}

Result<TransferFunction> transfer_function_for(std::string_view name, const ScalarVolume& volume) {
  if (name.empty() || name == "auto") return transfer_from_histogram(volume);
  if (name == "ct-bone") return ct_bone();
  if (name == "ct-skin") return ct_skin();
  if (name == "none") return TransferFunction{{{0.0, glm::vec3(1.0F)}}, {{0.0, 0.0}}, {}, 1.0};
  if (name == "mr") {
    // Values of MR images have no unit: the histogram tells them apart, tissue stays translucent.
    TransferFunction function = transfer_from_histogram(volume);
    for (OpacityStop& stop : function.opacities) stop.opacity *= 0.4;
    return function;
  }
  const std::filesystem::path path(name);
  if (path.extension() != ".json") {
    return make_error("there is no transfer function {}; take auto, {}, or a .json file", name,
                      fmt::join(kPresets, ", "));
  }
  return read_transfer_function(path, mean_spacing(volume));
}

}  // namespace relief
