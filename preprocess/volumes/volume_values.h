// Reads a volume's values from the part of a file that has them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "preprocess/readers/gzip/inflate.h"
#include "preprocess/volumes/number_form.h"

namespace relief {

/// Volumes are seldom packed tighter; memory for more grows with the data.
inline constexpr std::uint64_t kLikelyVolumeRatio = 8;

/// How values lie in the bytes of a file.
struct ValueBlock {
  NumberForm form;
  std::uint64_t count = 0;
  std::optional<DeflateForm> packing = {};     ///< none: not compressed
  std::uint64_t skip = 0;                      ///< bytes before the values, once unpacked
  std::optional<std::uint32_t> checksum = {};  ///< CRC-32 of all unpacked bytes
  /// Bytes that may follow the values: programs pad, and append remarks. More makes the header
  /// wrong, which states too small a size.
  std::uint64_t most_surplus = std::uint64_t{1} << 20U;
};

/// Returns the error of a block of which only `found` bytes of values are there.
[[nodiscard]] Error too_few_values(const std::string& name, const ValueBlock& block,
                                   std::uint64_t found);
/// Returns the error of a block that is followed by more than `most_surplus` bytes.
[[nodiscard]] Error too_many_values(const std::string& name, const ValueBlock& block);

/// Reads the values that begin `bytes`. Fails before it takes memory if `bytes` cannot hold them.
/// As floats, infinities become NaN. Errors begin with `name`.
template <class Real>
Result<std::vector<Real>> read_values(const std::string& name, std::span<const std::byte> bytes,
                                      const ValueBlock& block, Progress& progress);

/// Reads values as text, separated by blanks and line ends.
template <class Real>
Result<std::vector<Real>> read_text_values(const std::string& name, std::string_view text,
                                           std::uint64_t count, const Progress& progress);

extern template Result<std::vector<float>> read_values(const std::string&,
                                                       std::span<const std::byte>,
                                                       const ValueBlock&, Progress&);
extern template Result<std::vector<double>> read_values(const std::string&,
                                                        std::span<const std::byte>,
                                                        const ValueBlock&, Progress&);
extern template Result<std::vector<float>> read_text_values(const std::string&, std::string_view,
                                                            std::uint64_t, const Progress&);
extern template Result<std::vector<double>> read_text_values(const std::string&, std::string_view,
                                                             std::uint64_t, const Progress&);

}  // namespace relief
