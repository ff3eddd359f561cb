#include "common/patch_file/compact/residual_classes.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <vector>

namespace relief {
namespace {

// Residuals r are Laplacian: for |r| of 1 on, each is less probable than the one before by the
// factor q * q / 2^32. The q of the classes up to an expected magnitude of 8: from
// s = 1 / (2 asinh(1 / 2E)), which gives rounded Laplacian numbers of scale s the magnitude E, in
// the geometric middle of each class: q = 2^16 exp(-1 / 2s).
constexpr std::array<std::uint32_t, 32> kHalfSteps{
    2287,  2799,  3310,  3818,  4557,  5568,  6570,  7561,  8987,  10907, 12769,
    14568, 17074, 20285, 23214, 25874, 29309, 33291, 36564, 39280, 42483, 45838,
    48361, 50321, 52500, 54654, 56199, 57361, 58617, 59826, 60675, 61303};
constexpr std::uint64_t kOne = 1U << 16U;

/// From this class on, those of one octave are those of the octave before with one more bit of
/// shift.
constexpr unsigned kFirstShifted = 28;

/// A class's probabilities of its symbols but the escape, in 1/2^32, as long as they are half a
/// grain wide.
std::vector<std::uint64_t> probabilities(unsigned number) {
  std::vector<std::uint64_t> list;
  const bool shifted = number >= kFirstShifted;
  const std::uint64_t half = kHalfSteps[shifted ? kFirstShifted + number % 4 : number];
  const std::uint64_t step = half * half / kOne;
  // Two residuals for each magnitude, except 0; shifted symbols are one-sided.
  if (!shifted) list.push_back((kOne - half) * kOne);
  std::uint64_t p = shifted ? (kOne - step) * kOne : half * (kOne - step) / 2;
  constexpr std::uint64_t kMin = (kOne * kOne / ResidualClasses::kGrains) / 2;
  while (p >= kMin && list.size() + (shifted ? 1 : 2) < ResidualClasses::kMaxSymbols) {
    list.push_back(p);
    if (!shifted) list.push_back(p);
    p = p * step / kOne;
  }
  return list;
}

void make_class(unsigned number, ResidualClasses& classes) {
  if (number >= kFirstShifted) {
    classes.shift[number] = static_cast<std::uint8_t>(1 + (number - kFirstShifted) / 4);
  }
  const std::vector<std::uint64_t> list = probabilities(number);
  // Outliers are more frequent than in a Laplacian: the escape gets one unit more.
  constexpr std::uint32_t kMinEscape = 1;
  std::array<std::uint32_t, ResidualClasses::kMaxSymbols> widths{};
  std::uint32_t sum = 0;
  std::uint64_t left = kOne * kOne;
  for (std::size_t s = 0; s < list.size(); ++s) {
    widths[s] = std::max<std::uint32_t>(
        1, static_cast<std::uint32_t>(list[s] * ResidualClasses::kGrains >> 32U));
    sum += widths[s];
    left -= list[s];
  }
  widths[list.size()] =
      kMinEscape + static_cast<std::uint32_t>(left * ResidualClasses::kGrains >> 32U);
  sum += widths[list.size()];
  // The remainder of rounding goes to the most probable symbol.
  widths[0] += ResidualClasses::kGrains - sum;
  classes.escape[number] = static_cast<std::uint8_t>(list.size());
  classes.plain[number] = classes.shift[number] == 0 ? classes.escape[number] : 0;
  std::uint32_t start = 0;
  for (std::size_t s = 0; s <= list.size(); ++s) {
    assert(widths[s] > 0 && widths[s] < ResidualClasses::kGrains && "every symbol has an interval");
    classes.intervals[number][s] = {
        static_cast<std::uint16_t>(start << ResidualClasses::kGrainBits),
        static_cast<std::uint16_t>(widths[s] << ResidualClasses::kGrainBits)};
    std::fill_n(classes.symbol_at[number].begin() + start, widths[s], static_cast<std::uint8_t>(s));
    start += widths[s];
  }
}

}  // namespace

const ResidualClasses& residual_classes() {
  static const ResidualClasses classes = [] {
    ResidualClasses made;
    for (unsigned n = 0; n < kResidualClasses; ++n) make_class(n, made);
    for (std::uint32_t e = 0; e < kQuickExpectations; ++e) {
      made.quick[e] = static_cast<std::uint8_t>(class_of(e));
    }
    return made;
  }();
  return classes;
}

void put_residual(RansEncoder& out, unsigned residual_class, std::uint16_t residual) {
  const ResidualClasses& classes = residual_classes();
  const unsigned shift = classes.shift[residual_class];
  const std::uint32_t value = std::uint32_t{residual} >> shift;
  const std::uint32_t escape = classes.escape[residual_class];
  out.put(classes.intervals[residual_class][std::min(value, escape)]);
  if (value >= escape) {
    // The number of bits of the remainder plus one, then these bits without the leading one.
    const std::uint32_t rest = value - escape + 1;
    const auto bits = static_cast<unsigned>(std::bit_width(rest)) - 1U;
    out.put_bits(bits, 4);
    out.put_bits(rest - (1U << bits), bits);
  }
  if (shift > 0) out.put_bits(residual & ((1U << shift) - 1U), shift);
}

}  // namespace relief
