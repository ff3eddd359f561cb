// Pareto fronts of what `relief bench --trade` measures.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/trade/trade_row.h"

namespace relief::cli {

/// A measured quantity: its JSON key, its name with its unit, and its value if that is known and
/// finite.
struct TradeQuantity {
  const char* key;
  const char* label;
  bool is_in_decibels;  ///< more is better; else less is, and it is above 0
  std::optional<double> (*of)(const TradeRow& row);
};

/// Costs.
[[nodiscard]] const TradeQuantity& frame_time();       ///< ms
[[nodiscard]] const TradeQuantity& conversion_time();  ///< s
[[nodiscard]] const TradeQuantity& file_size();        ///< bytes
[[nodiscard]] const TradeQuantity& gpu_size();         ///< bytes
/// Qualities.
[[nodiscard]] const TradeQuantity& picture_psnr();
[[nodiscard]] const TradeQuantity& surface_psnr();
[[nodiscard]] const TradeQuantity& normal_error();  ///< degrees

/// A cost against a quality.
struct TradePlane {
  const char* key;
  const char* title;
  const TradeQuantity& cost;
  const TradeQuantity& quality;

  /// Whether the quality is an error.
  [[nodiscard]] bool less_is_better() const { return !quality.is_in_decibels; }
};

/// The planes of the report, the most asked for first.
[[nodiscard]] const std::array<TradePlane, 6>& trade_planes();

/// The rows that no other row beats: the indices, by increasing cost. A row beats another if it is
/// no more expensive and no worse, and better in one of the two. Rows without both values are left
/// out.
[[nodiscard]] std::vector<std::size_t> front_of(const std::vector<TradeRow>& rows,
                                                const TradePlane& plane);

/// How far a row is behind the front of some quantities, at least 0: the least share of its value
/// by which one of them would have to be better so that no other row beats it. 0.05 in the plane of
/// bytes and PSNR: with 5 % fewer bytes, or with an error less by 5 %, it would be on the front.
/// Errors are amplitudes: 5 % of them are 0.42 dB. Empty if the row lacks a value.
[[nodiscard]] std::optional<double> distance_to_front(
    const std::vector<TradeRow>& rows, std::size_t row,
    const std::vector<const TradeQuantity*>& quantities);

/// The same in a plane.
[[nodiscard]] std::optional<double> distance_to_front(const std::vector<TradeRow>& rows,
                                                      std::size_t row, const TradePlane& plane);

/// What presets are judged by: frame time, bytes on disk, and the picture.
[[nodiscard]] std::vector<const TradeQuantity*> judged_quantities();

}  // namespace relief::cli
