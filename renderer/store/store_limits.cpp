#include "renderer/store/store_limits.h"

#include "renderer/store/cell_store.h"
#include "renderer/store/sample_pages.h"

namespace relief {

StoreLimits store_limits(const Gl& gl) {
  return {most_cell_texels(gl), most_sample_records(gl),
          static_cast<std::size_t>(get_limit(gl, GL_MAX_TEXTURE_BUFFER_SIZE))};
}

}  // namespace relief
