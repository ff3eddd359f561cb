// Reads and writes OpenEXR images.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfVersion.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>

#include "common/image/image_formats.h"

namespace relief {
namespace {

/// An output stream of OpenEXR in memory.
class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : Imf::OStream("memory") {}

  // NOLINTNEXTLINE: the name and the array are OpenEXR's
  void write(const char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    if (at_ + count > bytes_.size()) bytes_.resize(at_ + count);
    std::memcpy(bytes_.data() + at_, c, count);
    at_ += count;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }

  [[nodiscard]] std::vector<std::byte>& bytes() { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t at_ = 0;
};

/// An input stream of OpenEXR in memory.
class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(std::span<const std::byte> bytes) : Imf::IStream("memory"), bytes_(bytes) {}

  // NOLINTNEXTLINE: the name and the array are OpenEXR's
  bool read(char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    if (n < 0 || at_ > bytes_.size() || count > bytes_.size() - at_) {
      throw std::runtime_error("it ends too early");
    }
    std::memcpy(c, bytes_.data() + at_, count);
    at_ += count;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  std::span<const std::byte> bytes_;
  std::uint64_t at_ = 0;
};

/// A channel in OpenEXR's type.
struct ExrChannel {
  Imf::PixelType type = Imf::FLOAT;
  std::vector<half> halves;
  std::vector<std::uint32_t> uints;
  char* data = nullptr;  ///< the values, one of the above or the image's own
  std::size_t value_bytes = 0;
};

ExrChannel to_exr(const Channel& channel) {
  ExrChannel out;
  switch (channel.type) {
    case ChannelType::Half: {
      // A finite value stays finite: infinity would spoil every filter that touches it.
      static constexpr float kLargest = 65504.0F;
      out.type = Imf::HALF;
      out.halves.resize(channel.values.size());
      std::transform(channel.values.begin(), channel.values.end(), out.halves.begin(), [](float v) {
        return half(std::isfinite(v) ? std::clamp(v, -kLargest, kLargest) : v);
      });
      out.data = reinterpret_cast<char*>(out.halves.data());
      out.value_bytes = sizeof(half);
      break;
    }
    case ChannelType::Uint:
      out.type = Imf::UINT;
      out.uints.resize(channel.values.size());
      std::transform(channel.values.begin(), channel.values.end(), out.uints.begin(), [](float v) {
        // Compared in this order, NaN becomes 0; 2^32 is a float, 2^32 - 1 is not.
        if (!(v > 0.0F)) return std::uint32_t{0};
        if (v >= 4294967296.0F) return std::numeric_limits<std::uint32_t>::max();
        return static_cast<std::uint32_t>(v);
      });
      out.data = reinterpret_cast<char*>(out.uints.data());
      out.value_bytes = sizeof(std::uint32_t);
      break;
    case ChannelType::Float:
      // OpenEXR reads through the pointer only.
      out.data = reinterpret_cast<char*>(const_cast<float*>(channel.values.data()));
      out.value_bytes = sizeof(float);
      break;
  }
  return out;
}

ChannelType from_exr(Imf::PixelType type) {
  if (type == Imf::HALF) return ChannelType::Half;
  return type == Imf::UINT ? ChannelType::Uint : ChannelType::Float;
}

/// Returns the names and types of a file's channels. Fails if a channel does not have one value a
/// pixel.
Result<std::vector<Channel>> list_channels(const Imf::Header& header) {
  std::vector<Channel> channels;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1) {
      return make_error("its channel {} is subsampled; save it as RGB", c.name());
    }
    channels.push_back({c.name(), from_exr(c.channel().type), {}});
  }
  if (channels.empty()) return make_error("it has no channels");
  return channels;
}

/// Returns whether all attributes of the headers lie within the file: OpenEXR allocates their
/// stated sizes, up to 2 GiB each.
bool attributes_fit(std::span<const std::byte> bytes) {
  const bool has_parts = std::to_integer<unsigned>(bytes[5] & std::byte{0x10}) != 0;
  std::size_t at = 8;
  const auto ends_here = [&] { return at < bytes.size() && bytes[at] == std::byte{0}; };
  const auto skip_text = [&] {
    const auto end =
        std::find(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end(), std::byte{0});
    at = std::min(static_cast<std::size_t>(end - bytes.begin()) + 1, bytes.size());
  };
  do {
    for (; !ends_here();) {
      skip_text();  // its name
      skip_text();  // its type
      std::int32_t size = 0;
      if (bytes.size() - at < sizeof(size)) return false;
      std::memcpy(&size, bytes.data() + at, sizeof(size));
      at += sizeof(size);
      if (size < 0 || bytes.size() - at < static_cast<std::size_t>(size)) return false;
      at += static_cast<std::size_t>(size);
    }
    ++at;
  } while (has_parts && !ends_here());  // the header of a further part
  return true;
}

/// OpenEXR allocates by the header's sizes, so the header is checked first.
std::optional<Error> check_header(std::span<const std::byte> bytes) {
  // A magic number and a version of 4 bytes each come before the header.
  if (bytes.size() < 8) return make_error("it ends too early");
  int version = std::to_integer<int>(bytes[4]);
  if (std::to_integer<unsigned>(bytes[5] & std::byte{0x08}) != 0) {
    return make_error("it holds deep pixels; flatten it first");
  }
  if (!attributes_fit(bytes)) return make_error("its header is longer than the file");
  MemoryInput stream(bytes);
  stream.seekg(8);
  Imf::Header header;
  header.readFrom(stream, version);
  RELIEF_TRY_ASSIGN(const auto channels, list_channels(header));
  const auto& window = header.dataWindow();
  return find_size_fault(std::int64_t{window.max.x} - window.min.x + 1,
                         std::int64_t{window.max.y} - window.min.y + 1, channels.size(),
                         bytes.size());
}

Image read_pixels(std::span<const std::byte> bytes) {
  MemoryInput stream(bytes);
  Imf::InputFile file(stream, 0);
  const auto window = file.header().dataWindow();
  Image image;
  image.width = static_cast<std::uint32_t>(window.max.x - window.min.x + 1);
  image.height = static_cast<std::uint32_t>(window.max.y - window.min.y + 1);
  image.channels = *list_channels(file.header());
  Imf::FrameBuffer frame;
  for (Channel& channel : image.channels) {
    channel.values.resize(std::size_t{image.width} * image.height);
    frame.insert(channel.name, Imf::Slice::Make(Imf::FLOAT, channel.values.data(), window));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace

bool is_exr(std::span<const std::byte> bytes) {
  constexpr std::uint8_t kStart[4] = {0x76, 0x2F, 0x31, 0x01};
  return bytes.size() >= 4 && std::memcmp(bytes.data(), kStart, 4) == 0;
}

Result<std::vector<std::byte>> encode_exr(const Image& image) try {
  assert(image.width > 0 && image.height > 0 && !image.channels.empty() && "an image has pixels");
  Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  std::vector<ExrChannel> channels;
  channels.reserve(image.channels.size());
  for (const Channel& channel : image.channels) {
    assert(channel.values.size() == std::size_t{image.width} * image.height &&
           "a channel has a value for each pixel");
    const ExrChannel& exr = channels.emplace_back(to_exr(channel));
    header.channels().insert(channel.name, Imf::Channel(exr.type));
    frame.insert(channel.name,
                 Imf::Slice(exr.type, exr.data, exr.value_bytes, exr.value_bytes * image.width));
  }
  MemoryOutput stream;
  {
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(frame);
    file.writePixels(static_cast<int>(image.height));
  }
  return std::move(stream.bytes());
} catch (const std::exception& failure) {
  return make_error("OpenEXR failed to encode it ({}); write a PNG instead", failure.what());
}

Result<Image> decode_exr(std::span<const std::byte> bytes) try {
  if (const auto fault = check_header(bytes)) return *fault;
  return read_pixels(bytes);
} catch (const std::bad_alloc&) {
  throw;  // decode_image reports it
} catch (const std::exception& failure) {
  return make_error("it is damaged ({})", failure.what());
}

}  // namespace relief
