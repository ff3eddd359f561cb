// How a file writes a number.
#pragma once

#include "preprocess/readers/number_type.h"

namespace relief {

struct NumberForm {
  NumberType type = NumberType::Uint8;
  bool is_big_endian = false;

  bool operator==(const NumberForm&) const = default;
};

}  // namespace relief
