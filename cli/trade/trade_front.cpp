#include "cli/trade/trade_front.h"

#include <algorithm>
#include <cmath>

#include "cli/plot/scatter_plot.h"

namespace relief::cli {
namespace {

std::optional<double> if_finite(std::optional<double> value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// Equal images have an infinite PSNR: more than any other, but a plot and a ratio need a number.
/// 8-bit images that differ in one step of one channel in a million pixels have 113 dB.
constexpr double kMostDecibels = 120.0;

std::optional<double> decibels(std::optional<double> value) {
  if (!value) return value;
  return std::min(*value, kMostDecibels);
}

/// What is to be as small as possible, above 0: the quantity itself, or the error that decibels
/// stand for.
std::optional<double> burden_of(const TradeQuantity& quantity, const TradeRow& row) {
  const auto value = quantity.of(row);
  if (!value) return value;
  return quantity.is_in_decibels ? std::pow(10.0, -*value / 20.0) : *value;
}

using Burdens = std::vector<double>;

std::optional<Burdens> burdens_of(const std::vector<const TradeQuantity*>& quantities,
                                  const TradeRow& row) {
  Burdens burdens;
  for (const TradeQuantity* const quantity : quantities) {
    const auto burden = burden_of(*quantity, row);
    if (!burden) return std::nullopt;
    burdens.push_back(*burden);
  }
  return burdens;
}

bool is_no_worse(const Burdens& other, const Burdens& own, std::size_t except) {
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (k != except && other[k] > own[k]) return false;
  }
  return true;
}

}  // namespace

const TradeQuantity& frame_time() {
  static const TradeQuantity quantity{"frame_ms", "ms a frame", false,
                                      [](const TradeRow& row) { return if_finite(row.frame_ms); }};
  return quantity;
}

const TradeQuantity& conversion_time() {
  static const TradeQuantity quantity{
      "convert_seconds", "seconds to convert", false,
      [](const TradeRow& row) { return if_finite(row.file.convert_seconds); }};
  return quantity;
}

const TradeQuantity& file_size() {
  static const TradeQuantity quantity{
      "file_bytes", "bytes on disk", false, [](const TradeRow& row) {
        return std::optional<double>(static_cast<double>(row.file.file_bytes));
      }};
  return quantity;
}

const TradeQuantity& gpu_size() {
  static const TradeQuantity quantity{
      "gpu_bytes", "bytes on the GPU", false, [](const TradeRow& row) {
        return row.gpu_bytes ? std::optional<double>(static_cast<double>(*row.gpu_bytes))
                             : std::nullopt;
      }};
  return quantity;
}

const TradeQuantity& picture_psnr() {
  static const TradeQuantity quantity{
      "psnr_db", "PSNR of the picture, dB", true,
      [](const TradeRow& row) { return decibels(row.accuracy.psnr_db); }};
  return quantity;
}

const TradeQuantity& surface_psnr() {
  static const TradeQuantity quantity{
      "surface_psnr_db", "PSNR of the surface, dB", true,
      [](const TradeRow& row) { return decibels(row.file.surface_psnr_db); }};
  return quantity;
}

const TradeQuantity& normal_error() {
  static const TradeQuantity quantity{
      "normal_rms_deg", "error of normals, degrees rms", false,
      [](const TradeRow& row) { return if_finite(row.accuracy.normal_rms_deg); }};
  return quantity;
}

const std::array<TradePlane, 6>& trade_planes() {
  static const std::array<TradePlane, 6> planes{
      {{"picture_frame", "Picture and frame time", frame_time(), picture_psnr()},
       {"surface_file", "Surface and bytes on disk", file_size(), surface_psnr()},
       {"picture_file", "Picture and bytes on disk", file_size(), picture_psnr()},
       {"normals_file", "Normals and bytes on disk", file_size(), normal_error()},
       {"picture_conversion", "Picture and conversion time", conversion_time(), picture_psnr()},
       {"picture_gpu", "Picture and bytes on the GPU", gpu_size(), picture_psnr()}}};
  return planes;
}

std::vector<std::size_t> front_of(const std::vector<TradeRow>& rows, const TradePlane& plane) {
  std::vector<PlotPoint> points;
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto cost = plane.cost.of(rows[k]);
    const auto quality = plane.quality.of(rows[k]);
    if (!cost || !quality) continue;
    points.push_back({{}, *cost, plane.less_is_better() ? -*quality : *quality});
    places.push_back(k);
  }
  std::vector<std::size_t> front = pareto_front(points);
  for (std::size_t& k : front) k = places[k];
  return front;
}

std::optional<double> distance_to_front(const std::vector<TradeRow>& rows, std::size_t row,
                                        const std::vector<const TradeQuantity*>& quantities) {
  const auto own = burdens_of(quantities, rows[row]);
  if (!own) return std::nullopt;
  std::vector<double> distances(own->size(), 0.0);
  for (const TradeRow& candidate : rows) {
    const auto other = burdens_of(quantities, candidate);
    if (!other) continue;
    for (std::size_t k = 0; k < own->size(); ++k) {
      if ((*other)[k] < (*own)[k] && is_no_worse(*other, *own, k))
        distances[k] = std::max(distances[k], 1.0 - (*other)[k] / (*own)[k]);
    }
  }
  return *std::min_element(distances.begin(), distances.end());
}

std::optional<double> distance_to_front(const std::vector<TradeRow>& rows, std::size_t row,
                                        const TradePlane& plane) {
  return distance_to_front(rows, row, {&plane.cost, &plane.quality});
}

std::vector<const TradeQuantity*> judged_quantities() {
  return {&frame_time(), &file_size(), &picture_psnr()};
}

}  // namespace relief::cli
