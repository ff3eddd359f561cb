// What a DICOM file says of the slice, or of the slices, that it holds.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

namespace relief {

/// Patient coordinates: left-posterior-superior, mm. Plain numbers: it comes through a pipe.
struct DicomSlice {
  bool has_image = false;              ///< one grey value a pixel; else nothing here means anything
  bool is_truncated = false;           ///< pixels are missing
  bool has_position = false;           ///< position and directions are the file's
  std::array<char, 80> series{};       ///< SeriesInstanceUID, ended by 0
  std::int64_t number = 0;             ///< InstanceNumber
  std::array<std::int64_t, 3> size{};  ///< columns, rows, frames
  std::array<double, 3> spacing{};     ///< of columns, rows and frames
  std::array<double, 3> position{};    ///< of the first pixel's centre
  std::array<double, 3> along_row{};   ///< direction of rising columns
  std::array<double, 3> along_column{};
};
static_assert(std::is_trivially_copyable_v<DicomSlice>);

}  // namespace relief
