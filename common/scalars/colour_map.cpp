#include "common/scalars/colour_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relief {
namespace {

using ColourTable = std::array<std::uint32_t, 256>;
#include "common/scalars/colour_map_tables.inc"

// Colours of labels and classes are those of ColorBrewer (Paired, Dark2, Greens, Greys, Purples):
// "This product includes color specifications and designs developed by Cynthia Brewer
// (http://colorbrewer.org/)." Copyright (c) 2002 Cynthia Brewer, Mark Harrower, and The
// Pennsylvania State University. Apache-2.0.
// The dark ones of Paired first, then its light ones, then Dark2.
constexpr std::array<std::uint32_t, 20> kLabels{0x1F78B4, 0xFF7F00, 0x33A02C, 0xE31A1C, 0x6A3D9A,
                                                0xB15928, 0xA6CEE3, 0xFDBF6F, 0xB2DF8A, 0xFB9A99,
                                                0xCAB2D6, 0xFFFF99, 0x1B9E77, 0xD95F02, 0x7570B3,
                                                0xE7298A, 0x66A61E, 0xE6AB02, 0xA6761D, 0x666666};
constexpr std::array<std::uint32_t, 23> kLasClasses{
    0x969696,  // never classified
    0xBDBDBD,  // unclassified
    0xB15928,  // ground
    0xC7E9C0,  // low vegetation
    0x74C476,  // medium vegetation
    0x238B45,  // high vegetation
    0xE31A1C,  // building
    0xFFFF99,  // low noise
    0xE6AB02,  // model key point
    0x1F78B4,  // water
    0xCAB2D6,  // rail
    0x737373,  // road surface
    0xA6CEE3,  // overlap
    0xFDBF6F,  // wire, guard
    0xFF7F00,  // wire, conductor
    0xD95F02,  // transmission tower
    0xE7298A,  // wire connector
    0x6A3D9A,  // bridge deck
    0xFFFF99,  // high noise
    0x9E9AC8,  // overhead structure
    0xA6761D,  // ignored ground
    0xF0F0F0,  // snow
    0x525252,  // temporal exclusion
};

glm::u8vec3 unpacked(std::uint32_t rgb) {
  return {static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U),
          static_cast<std::uint8_t>(rgb)};
}

const ColourTable* table_of(ColourMap map) {
  switch (map) {
    case ColourMap::Viridis:
      return &kViridis;
    case ColourMap::Cividis:
      return &kCividis;
    case ColourMap::Inferno:
      return &kInferno;
    case ColourMap::Magma:
      return &kMagma;
    case ColourMap::Plasma:
      return &kPlasma;
    case ColourMap::Turbo:
      return &kTurbo;
    case ColourMap::Batlow:
      return &kBatlow;
    case ColourMap::Grey:
      break;
  }
  return nullptr;
}

}  // namespace

glm::u8vec3 colour_at(ColourMap map, double fraction) {
  // In this form NaN becomes 0.
  const double within = fraction > 0.0 ? std::min(fraction, 1.0) : 0.0;
  const auto entry = static_cast<std::size_t>(std::lround(255.0 * within));
  const ColourTable* const table = table_of(map);
  if (table == nullptr) return glm::u8vec3(static_cast<std::uint8_t>(entry));
  return unpacked((*table)[entry]);
}

glm::u8vec3 label_colour(std::uint32_t label) {
  return unpacked(kLabels[label % kLabels.size()]);
}

glm::u8vec3 las_class_colour(std::uint32_t value) {
  return value < kLasClasses.size() ? unpacked(kLasClasses[value]) : label_colour(value);
}

}  // namespace relief
