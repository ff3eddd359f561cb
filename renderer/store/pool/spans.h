// Which places of a buffer are taken.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace relief {

/// Spans of places 0 to size - 1. Each is taken from the first gap that it fits.
class Spans {
 public:
  explicit Spans(std::uint32_t size = 0) { grow(size); }

  /// Returns the first place of a span of `count` places; none if no gap is as large. No places
  /// are at 0.
  [[nodiscard]] std::optional<std::uint32_t> take(std::uint32_t count);

  /// Whether these places are free.
  [[nodiscard]] bool has(std::uint32_t first, std::uint32_t count) const;

  /// Takes these places, which are free; `count` is at least 1.
  void take(std::uint32_t first, std::uint32_t count);

  /// By first place of each gap how many places it has.
  [[nodiscard]] const std::map<std::uint32_t, std::uint32_t>& gaps() const { return gaps_; }

  /// Gives back what take() returned for that count.
  void give(std::uint32_t first, std::uint32_t count);

  /// Adds places at the end. `size` is at least size().
  void grow(std::uint32_t size);

  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] std::uint32_t taken() const { return taken_; }

 private:
  std::map<std::uint32_t, std::uint32_t> gaps_;  ///< by first place: how many; none touch
  std::uint32_t size_ = 0;
  std::uint32_t taken_ = 0;
};

}  // namespace relief
