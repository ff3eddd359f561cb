// Numbers of a scan as codes of 16 bits.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/scalar.h"

namespace relief {

/// Returns the quantiles of the numbers that are finite; nothing if none is.
[[nodiscard]] std::optional<Quantiles> find_quantiles(std::span<const double> values);

/// Returns the value below which `percent` % of the values lie, 0 to 100.
[[nodiscard]] double at_percent(const Quantiles& quantiles, double percent);

/// Chooses offset and step for a scalar. Whole numbers of a range up to 65534 keep their values.
/// Others are rounded to 65534 steps over their range, which ends 16 times the distance of the 2nd
/// to the 98th percentile beyond these: a single wrong number must not take all steps from the
/// others. `values`: finite or NaN. Nothing if none is finite.
[[nodiscard]] std::optional<ScalarInfo> describe_scalar(const PointScalar& scalar);

/// The same for a scalar of these quantiles, of which the first and last are its extreme numbers.
/// `are_whole`: all of its numbers.
[[nodiscard]] ScalarInfo describe_scalar(const std::string& name, bool is_label, bool are_whole,
                                         const Quantiles& quantiles);

/// Returns the code of a value, clamped to the range; kNoScalar for NaN.
[[nodiscard]] std::uint16_t code_of(const ScalarInfo& scalar, double value);

}  // namespace relief
