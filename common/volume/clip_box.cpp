#include "common/volume/clip_box.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace relief {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::optional<ClipSide> parse_side(std::string_view text) {
  ClipSide side;
  side.is_percent = text.ends_with('%');
  if (side.is_percent) text.remove_suffix(1);
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side.number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(side.number))
    return std::nullopt;
  if (side.is_percent && !(side.number >= 0.0 && side.number <= 100.0)) return std::nullopt;
  return side;
}

std::string text_of(ClipSide side) {
  return fmt::format("{}{}", side.number, side.is_percent ? "%" : "");
}

double place(ClipSide side, double low, double high) {
  return side.is_percent ? low + 0.01 * side.number * (high - low) : side.number;
}

}  // namespace

std::optional<ClipBox> parse_clip_box(std::string_view text) {
  ClipBox box;
  for (std::size_t s = 0; s < 6; ++s) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (s == 5)) return std::nullopt;
    const auto side = parse_side(text.substr(0, comma));
    if (!side) return std::nullopt;
    (s < 3 ? box.low : box.high)[s % 3] = *side;
    if (s < 5) text.remove_prefix(comma + 1);
  }
  for (std::size_t a = 0; a < 3; ++a) {
    if (box.low[a].is_percent == box.high[a].is_percent && box.low[a].number > box.high[a].number)
      return std::nullopt;
  }
  return box;
}

std::string text_of(const ClipBox& box) {
  return fmt::format("{},{},{},{},{},{}", text_of(box.low[0]), text_of(box.low[1]),
                     text_of(box.low[2]), text_of(box.high[0]), text_of(box.high[1]),
                     text_of(box.high[2]));
}

Result<Bounds> place_clip_box(const ClipBox& box, const Bounds& extent) {
  Bounds placed;
  bool is_empty = false;
  for (std::size_t side = 0; side < 3; ++side) {
    const auto a = static_cast<glm::length_t>(side);
    const ClipSide& low = box.low[side];
    const ClipSide& high = box.high[side];
    placed.min[a] =
        low.is_percent && low.number == 0.0 ? -kInfinite : place(low, extent.min[a], extent.max[a]);
    placed.max[a] = high.is_percent && high.number == 100.0
                        ? kInfinite
                        : place(high, extent.min[a], extent.max[a]);
    is_empty |= placed.min[a] > placed.max[a] || placed.min[a] > extent.max[a] ||
                placed.max[a] < extent.min[a];
  }
  if (!is_empty) return placed;
  return make_error(
      "the clip box {} holds nothing of the model, which reaches from {},{},{} to {},{},{}",
      text_of(box), extent.min.x, extent.min.y, extent.min.z, extent.max.x, extent.max.y,
      extent.max.z);
}

}  // namespace relief
