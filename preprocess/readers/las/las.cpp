#include <algorithm>
#include <cstdint>
#include <utility>

#include "preprocess/readers/las/las_header.h"
#include "preprocess/readers/las/las_scalars.h"
#include "preprocess/readers/number_type.h"
#include "preprocess/readers/readers.h"

namespace relief {
namespace {

glm::u16vec3 colour_of(const char* record, std::size_t at) {
  return {load_whole<std::uint16_t>(record + at), load_whole<std::uint16_t>(record + at + 2),
          load_whole<std::uint16_t>(record + at + 4)};
}

/// The contents of a file's 16-bit colour fields. Files do not state it; it follows from the
/// largest value.
enum class Colours {
  None,   ///< the format has none, or all are 0, so unset
  Bytes,  ///< at most 255
  Words   ///< 16 bits
};

Colours find_colours(const Source& source, const LasHeader& header) {
  if (header.colour_at() == 0) return Colours::None;
  Colours found = Colours::None;
  const char* record = source.text.data() + header.body;
  for (std::uint64_t i = 0; i < header.points; ++i, record += header.stride) {
    if (source.sink != nullptr && i % PointSink::kBlockPoints == 0)
      source.sink->pass(header.body + i * header.stride);
    const glm::u16vec3 c = colour_of(record, header.colour_at());
    const auto largest = std::max({c.x, c.y, c.z});
    if (largest > 255) return Colours::Words;
    if (largest > 0) found = Colours::Bytes;
  }
  return found;
}

/// Points that the file marks as not to be used.
struct LeftOut {
  std::uint64_t withheld = 0;
  std::uint64_t noise = 0;

  /// Returns whether this point is one, and counts it.
  bool takes(const char* record, bool is_wide) {
    const auto flags = load_whole<std::uint8_t>(record + 15);
    if ((flags & (is_wide ? 0x04U : 0x80U)) != 0) {
      ++withheld;
      return true;
    }
    // Class 18, high noise, is only defined in formats with a separate byte for classes.
    const auto point_class = is_wide ? load_whole<std::uint8_t>(record + 16) : flags & 0x1FU;
    const bool is_noise = point_class == 7 || (is_wide && point_class == 18);
    noise += is_noise ? 1U : 0U;
    return is_noise;
  }
};

void add_remarks(const Source& source, Colours colours, const LeftOut& left_out) {
  if (colours == Colours::Bytes) {
    source.remarks.notes.push_back(fmt::format(
        "{}: its colours are at most 255 and taken as 8-bit, though their fields have 16 bits",
        source.name));
  } else if (colours == Colours::Words) {
    source.remarks.notes.push_back(
        fmt::format("{}: its colours have 16 bits, of which the upper 8 are taken", source.name));
  }
  source.remarks.left_out = left_out.withheld + left_out.noise;
  if (source.remarks.left_out == 0) return;
  source.remarks.notes.push_back(
      fmt::format("{}: {} withheld points and {} of noise (class 7 or 18) are left out",
                  source.name, left_out.withheld, left_out.noise));
}

}  // namespace

Result<Points> read_las(const Source& source) {
  RELIEF_TRY_ASSIGN(const auto header, read_las_header(source));
  const Colours colours = find_colours(source, header);
  Points points;
  std::uint64_t given = 0;  // to the sink
  const std::uint64_t capacity =
      source.sink != nullptr ? std::min<std::uint64_t>(header.points, PointSink::kBlockPoints)
                             : header.points;
  points.positions.reserve(capacity);
  if (colours != Colours::None) points.colours.reserve(capacity);
  const std::vector<LasScalar> scalars = find_las_scalars(source, header);
  for (const LasScalar& scalar : scalars) points.scalars.push_back({scalar.name, false, {}});
  // The upper byte is right for both scalings of a byte to 16 bits, by 256 and by 257.
  const unsigned shift = colours == Colours::Words ? 8 : 0;
  LeftOut left_out;
  ReadMeter meter(source);
  for (std::uint64_t i = 0; i < header.points; ++i) {
    const std::size_t at = header.body + i * header.stride;
    if (!meter.advance_to(at)) return interrupted_error();
    const char* const record = source.text.data() + at;
    if (left_out.takes(record, header.is_wide())) continue;
    const glm::dvec3 steps(load_whole<std::int32_t>(record), load_whole<std::int32_t>(record + 4),
                           load_whole<std::int32_t>(record + 8));
    points.positions.push_back(header.offset + header.scale * steps);
    if (colours != Colours::None) {
      const glm::u16vec3 c = colour_of(record, header.colour_at());
      points.colours.emplace_back(c.x >> shift, c.y >> shift, c.z >> shift);
    }
    for (std::size_t k = 0; k < scalars.size(); ++k)
      points.scalars[k].values.push_back(scalars[k].of(record));
    if (source.sink != nullptr && points.size() == PointSink::kBlockPoints) {
      given += points.size();
      if (Status taken = source.sink->take(std::exchange(points, {})); !taken) return taken.error();
    }
  }
  add_remarks(source, colours, left_out);
  if (points.size() + given == 0 && source.remarks.left_out > 0) {
    return make_error("{}: holds no points to use: all {} are marked as withheld or noise",
                      source.name, header.points);
  }
  return points;
}

}  // namespace relief
