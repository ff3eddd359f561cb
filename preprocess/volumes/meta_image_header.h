// The header of MetaImage files.
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

/// What the header of a scalar volume states.
struct MetaImageHeader {
  std::array<std::int64_t, 3> size{0, 0, 0};
  NumberForm form;
  RegularGrid grid;  ///< left-posterior-superior
  bool is_binary = true;
  bool is_compressed = false;
  std::int64_t header_size = 0;          ///< bytes before the values; -1: they end the file
  std::optional<std::string> data_file;  ///< none: the values follow the header (LOCAL)
  std::size_t end = 0;                   ///< where the header ends, bytes
};

/// Parses the header that begins `text`; its last field is ElementDataFile. Fails on images that
/// are not scalar or not of three dimensions. Source: MetaIO's documentation, and ITK for the
/// meaning of TransformMatrix: three numbers for each axis are its direction.
Result<MetaImageHeader> parse_meta_image_header(const std::string& name, std::string_view text);

}  // namespace relief
