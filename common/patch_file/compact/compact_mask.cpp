#include "common/patch_file/compact/compact_mask.h"

#include <array>

namespace relief {
namespace {

#include "common/patch_file/compact/compact_mask_chances.inc"

/// Samples of a row and the two rows above it, each with two holes at either end.
class MaskRows {
 public:
  explicit MaskRows(std::size_t width)
      : width_(width), row_(width + 4), above_(row_), second_(row_), contexts_(width) {}

  /// Moves to the next row.
  void go_down() {
    second_.swap(above_);
    above_.swap(row_);
    // Bits 2 to 6 are the row above from east to west, 7 is two rows above; west of the node comes
    // later.
    const std::uint8_t* const above = above_.data();
    const std::uint8_t* const second = second_.data();
    std::uint8_t* __restrict contexts = contexts_.data();
    for (std::size_t i = 0; i < width_; ++i) {
      contexts[i] =
          static_cast<std::uint8_t>(above[i + 4] << 2U | above[i + 3] << 3U | above[i + 2] << 4U |
                                    above[i + 1] << 5U | above[i] << 6U | second[i + 2] << 7U);
    }
  }

  std::uint8_t* row() { return row_.data() + 2; }
  const std::uint8_t* contexts() const { return contexts_.data(); }

 private:
  std::size_t width_;
  std::vector<std::uint8_t> row_;
  std::vector<std::uint8_t> above_;
  std::vector<std::uint8_t> second_;
  std::vector<std::uint8_t> contexts_;
};

/// Calls `code(chance)` for each node in scan order; `chance` of 4096 is that it is a sample, and
/// the return value is whether it is a sample. The context: two nodes to the west, five of the row
/// above and the one above that; outside the grid are holes. `code` is passed and returned by
/// value, so that a decoder's state stays in registers.
template <class Code>
[[nodiscard]] Code visit_mask(std::size_t width, std::size_t height, Code code) {
  MaskRows rows(width);
  for (std::size_t j = 0; j < height; ++j) {
    rows.go_down();
    const std::uint8_t* const contexts = rows.contexts();
    std::uint8_t* const row = rows.row();
    unsigned west = 0;
    for (std::size_t i = 0; i < width; ++i) {
      // Two branches, which processors predict well, because most nodes equal those before them.
      if (code(kSampleChances[contexts[i] | west])) {
        row[i] = 1;
        west = (west << 1U & 2U) | 1U;
      } else {
        row[i] = 0;
        west = west << 1U & 2U;
      }
    }
  }
  return code;
}

Interval interval_of(std::uint16_t chance, bool is_sample) {
  return is_sample ? Interval{0, chance}
                   : Interval{chance, static_cast<std::uint16_t>(kProbabilityOne - chance)};
}

}  // namespace

void put_mask(RansEncoder& out, std::span<const std::uint8_t> mask, std::size_t width) {
  struct Writer {
    RansEncoder* out;
    const std::uint8_t* node;
    bool operator()(std::uint16_t chance) {
      const bool is_sample = *node++ != 0;
      out->put(interval_of(chance, is_sample));
      return is_sample;
    }
  };
  static_cast<void>(visit_mask(width, mask.size() / width, Writer{&out, mask.data()}));
}

std::vector<std::uint8_t> take_mask(RansDecoder& in, std::size_t width, std::size_t height) {
  struct Reader {
    RansDecoder in;
    std::uint8_t* node;
    bool operator()(std::uint16_t chance) {
      const bool is_sample = in.peek() < chance;
      if (is_sample) {
        in.advance({0, chance});
      } else {
        in.advance({chance, static_cast<std::uint16_t>(kProbabilityOne - chance)});
      }
      *node++ = is_sample ? 1 : 0;
      return is_sample;
    }
  };
  std::vector<std::uint8_t> mask(width * height);
  in = visit_mask(width, height, Reader{in, mask.data()}).in;
  return mask;
}

}  // namespace relief
