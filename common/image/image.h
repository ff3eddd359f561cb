// Pictures in memory: any number of named float channels.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace relief {

/// How a channel is kept in an EXR file. In memory every channel is float; ids up to 2^24 are
/// exact.
enum class ChannelType : std::uint8_t { Half, Float, Uint };

/// What a reader does to the numbers of formats that hold sRGB (PNG and JPEG): turn them into
/// light, or leave them as they are stored, from 0 to 1, where they are no colours.
enum class Transfer : std::uint8_t { Srgb, None };

/// One channel, row-major, top row first.
struct Channel {
  std::string name;
  ChannelType type = ChannelType::Float;
  std::vector<float> values;
};

/// A picture. Colour is linear, with Rec. 709 primaries. The names that engines write, as in EXR:
/// R G B A (colour, premultiplied, and coverage), N.X N.Y N.Z (world normal), Z (distance along the
/// view axis, +infinity where nothing is seen), UV.U UV.V (grid coordinates on the patch),
/// patch (patch id + 1, 0 where nothing is seen).
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Channel> channels;

  [[nodiscard]] const Channel* find(std::string_view name) const {
    for (const Channel& channel : channels) {
      if (channel.name == name) return &channel;
    }
    return nullptr;
  }
};

}  // namespace relief
