#include "preprocess/gaussians/spz_header.h"

namespace relief {
namespace {

constexpr std::uint32_t kLatestVersion = 4;
/// Positions have 24 bits.
constexpr int kMostFractionalBits = 24;

// Flags of the header.
constexpr unsigned kAntialiased = 0x01;
constexpr unsigned kHasExtensions = 0x02;
/// Spark's: coarser Gaussians stand beside those that they replace.
constexpr unsigned kLevelsOfDetail = 0x80;

/// "SPZ_ADOBE_coordinate_system": one number of 4 bytes.
constexpr std::uint32_t kCoordinateSystem = 0xADBE0003U;
/// Its numbers 1 to 8: one less has a bit for each of right, up and front. Up to 16, Y is to the
/// back or the front.
constexpr std::uint32_t kLastUpright = 8;

}  // namespace

Result<SpzHeader> read_spz_header(const std::string& name, std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!text.starts_with(kSpzMagic)) {
    return make_error("{}: does not begin with {}, so it is not an .spz file", name, kSpzMagic);
  }
  if (bytes.size() < SpzHeader::kBytes) {
    return make_error("{}: ends within its header; the file is truncated", name);
  }
  ByteReader reader(bytes.subspan(kSpzMagic.size()));
  SpzHeader header;
  header.version = reader.take<std::uint32_t>();
  header.count = reader.take<std::uint32_t>();
  header.degree = reader.take<std::uint8_t>();
  header.fractional_bits = reader.take<std::uint8_t>();
  const unsigned flags = reader.take<std::uint8_t>();
  header.streams = reader.take<std::uint8_t>();
  header.is_antialiased = (flags & kAntialiased) != 0;
  header.has_extensions = (flags & kHasExtensions) != 0;
  if (header.version < 1 || header.version > kLatestVersion) {
    return make_error("{}: is of version {} of .spz, but versions 1 to {} are read", name,
                      header.version, kLatestVersion);
  }
  if (header.degree > kMaxHarmonicsDegree) {
    return make_error("{}: has harmonics of degree {}, but at most {} is read", name, header.degree,
                      kMaxHarmonicsDegree);
  }
  if (header.fractional_bits > kMostFractionalBits) {
    return make_error("{}: positions have {} fractional bits of {}; the header is damaged", name,
                      header.fractional_bits, kMostFractionalBits);
  }
  if ((flags & kLevelsOfDetail) != 0) {
    return make_error(
        "{}: holds a tree of levels of detail (Spark), which is not read; export the scene without "
        "levels",
        name);
  }
  return header;
}

SpzSizes spz_sizes(const SpzHeader& header) {
  return {.centres = header.version == 1 ? 6U : 9U,
          .rotations = header.version < 3 ? 3U : 4U,
          .harmonics = 3 * (harmonics_of(header.degree) - 1)};
}

Result<AxisSigns> read_spz_axes(const std::string& name, std::span<const std::byte> extensions) {
  AxisSigns axes(1.0F);
  ByteReader reader(extensions);
  while (reader.left() > 0) {
    if (reader.left() < 8) return make_error("{}: an extension is cut off", name);
    const auto type = reader.take<std::uint32_t>();
    const auto size = reader.take<std::uint32_t>();
    if (size > reader.left()) {
      return make_error("{}: an extension states {} bytes, but {} are left; the file is damaged",
                        name, size, reader.left());
    }
    ByteReader payload(reader.take_bytes(size));
    if (type != kCoordinateSystem || size < 4) continue;
    const auto system = payload.take<std::uint32_t>();
    if (system > kLastUpright) {
      return make_error(
          "{}: its extension states coordinate system {}, but those of 1 to {} are read, in which "
          "Y is up or down; export the scene in one of them",
          name, system, kLastUpright);
    }
    if (system == 0) continue;  // not stated
    const std::uint32_t bits = system - 1;
    axes = {(bits & 1U) != 0 ? 1.0F : -1.0F, (bits & 2U) != 0 ? 1.0F : -1.0F,
            (bits & 4U) != 0 ? -1.0F : 1.0F};
  }
  return axes;
}

}  // namespace relief
