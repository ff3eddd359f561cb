// Images in memory: any number of named float channels.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace relief {

/// The type of a channel in an EXR file. In memory every channel is float; ids up to 2^24 are
/// exact.
enum class ChannelType : std::uint8_t { Half, Float, Uint };

/// The treatment of values of sRGB formats (PNG and JPEG): Srgb converts them to linear
/// light; None keeps them as stored, from 0 to 1, for images that hold no colours.
enum class Transfer : std::uint8_t { Srgb, None };

/// One channel, row-major, top row first.
struct Channel {
  std::string name;
  ChannelType type = ChannelType::Float;
  std::vector<float> values;
};

/// An image. Colour is linear, with Rec. 709 primaries. The names that engines write, as in EXR: R
/// G B A (colour, premultiplied, and coverage), N.X N.Y N.Z (world normal), Z (distance along the
/// view axis, +infinity for the background), UV.U UV.V (grid coordinates on the patch), patch
/// (patch id + 1, 0 for the background), clip (how the splat in front is clipped: ClipKind of
/// renderer/clip/).
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
