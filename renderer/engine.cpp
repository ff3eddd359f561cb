#include "renderer/engine.h"

#include <limits>

namespace relief {

Image nothing_seen() {
  Image pixel{1, 1, {}};
  for (const char* const name : {"R", "G", "B", "A"})
    pixel.channels.push_back({name, ChannelType::Half, {0.0F}});
  pixel.channels.push_back({"Z", ChannelType::Float, {std::numeric_limits<float>::infinity()}});
  pixel.channels.push_back({"patch", ChannelType::Uint, {0.0F}});
  return pixel;
}

Result<Image> PreparedModel::probe(const RenderSettings& /*settings*/, std::uint32_t /*x*/,
                                   std::uint32_t /*y*/) {
  return nothing_seen();
}

}  // namespace relief
