// The header of .spz files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "common/error.h"
#include "common/io/bytes.h"
#include "preprocess/gaussians/axis_signs.h"

namespace relief {

/// "NGSP": the first bytes, after decompression up to version 3.
inline constexpr std::string_view kSpzMagic = "NGSP";
/// The first version whose streams are compressed one by one.
inline constexpr std::uint32_t kSpzStreamsVersion = 4;

struct SpzHeader {
  /// The bytes of versions 1 to 3. Later ones go on, see spz.cpp.
  static constexpr std::size_t kBytes = 16;

  std::uint32_t version = 0;
  std::uint32_t count = 0;  ///< Gaussians
  int degree = 0;           ///< of harmonics
  int fractional_bits = 0;  ///< of positions, from version 2 on
  bool is_antialiased = false;
  bool has_extensions = false;
  std::uint8_t streams = 0;  ///< version 4
};

/// Reads the first kBytes bytes. Fails if they are no header of a version 1 to 4, and if what it
/// states is not read. Errors begin with `name`.
Result<SpzHeader> read_spz_header(const std::string& name, std::span<const std::byte> bytes);

/// The bytes of a Gaussian in each stream, in the order of the file.
struct SpzSizes {
  std::size_t centres = 9;
  std::size_t opacities = 1;
  std::size_t colours = 3;
  std::size_t scales = 3;
  std::size_t rotations = 4;
  std::size_t harmonics = 0;

  [[nodiscard]] std::size_t sum() const {
    return centres + opacities + colours + scales + rotations + harmonics;
  }
};

[[nodiscard]] SpzSizes spz_sizes(const SpzHeader& header);

/// Returns the axes that a file's extensions state: those of GaussianCloud if they state none.
/// Fails on damaged records, and on axes that are a quarter turn from ours.
Result<AxisSigns> read_spz_axes(const std::string& name, std::span<const std::byte> extensions);

}  // namespace relief
