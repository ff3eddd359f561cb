// What OpenGL allows of a model on the GPU: known to those who prepare one on another thread.
#pragma once

#include <cstddef>

#include "renderer/gl/functions.h"

namespace relief {

struct StoreLimits {
  std::size_t most_cell_texels = 0;    ///< heights and rows of a page of cells
  std::size_t most_records = 0;        ///< of a page of sample records
  std::size_t most_buffer_texels = 0;  ///< that a shader sees of one buffer
};

[[nodiscard]] StoreLimits store_limits(const Gl& gl);

}  // namespace relief
