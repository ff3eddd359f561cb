// The header of NRRD files.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/error.h"
#include "preprocess/volumes/number_form.h"
#include "preprocess/volumes/volume_grid.h"

namespace relief {

enum class NrrdEncoding : std::uint8_t { Raw, Gzip, Text };

/// What the header of a scalar volume states.
struct NrrdHeader {
  std::array<std::int64_t, 3> size{0, 0, 0};
  NumberForm form;
  NrrdEncoding encoding = NrrdEncoding::Raw;
  RegularGrid grid;
  FileFrame frame;
  std::optional<std::string> data_file;  ///< none: the values follow the header
  std::int64_t line_skip = 0;            ///< lines before the values
  std::int64_t byte_skip = 0;  ///< bytes before the values, once unpacked; -1: they end the file
  std::size_t end = 0;         ///< where the header ends, bytes
};

/// Parses the header that begins `text`. Fails on volumes that are not scalar or not of three
/// dimensions. Source: Teem's definition of the format, https://teem.sourceforge.net/nrrd.
Result<NrrdHeader> parse_nrrd_header(const std::string& name, std::string_view text);

}  // namespace relief
