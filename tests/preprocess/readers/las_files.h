// LAS files, written for the tests by the tables of LAS 1.4 R15.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tests/preprocess/readers/pack.h"

namespace relief::test {

struct LasPoint {
  std::array<std::int32_t, 3> steps{};
  std::uint8_t point_class = 1;
  bool withheld = false;
  std::array<std::uint16_t, 3> colour{0xFF00, 0x8000, 0};
  unsigned return_number = 1;
  unsigned returns = 1;
};

struct LasFile {
  std::uint8_t minor = 2;
  std::uint8_t format = 0;
  std::uint16_t extra_bytes = 0;
  std::uint32_t records = 0;           ///< variable length records, of 5 bytes each
  std::uint32_t extended_records = 0;  ///< of 7 bytes each, behind the points
  std::array<double, 3> scale{0.01, 0.01, 0.01};
  std::array<double, 3> offset{0, 0, 0};
  std::vector<LasPoint> points{};
};

/// Where the headers of LAS 1.2, 1.3 and 1.4 end.
inline std::uint16_t las_header_size(std::uint8_t minor) {
  return minor == 4 ? 375 : (minor == 3 ? 235 : 227);
}

/// One point record: every field that is not of interest has bytes that would show in its place.
inline std::string las_record(const LasPoint& p, std::uint8_t format, std::uint16_t extra_bytes) {
  std::string out = pack(p.steps[0], p.steps[1], p.steps[2], std::uint16_t{0xABCD});
  const auto flags = static_cast<std::uint8_t>(p.withheld ? (format < 6 ? 0x80 : 0x04) : 0);
  const auto returns =
      static_cast<std::uint8_t>(p.return_number | p.returns << (format < 6 ? 3U : 4U));
  if (format < 6) {
    out += pack(returns, static_cast<std::uint8_t>(p.point_class | flags), std::int8_t{-9},
                std::uint8_t{0xEE}, std::uint16_t{7});
  } else {
    out += pack(returns, flags, p.point_class, std::uint8_t{0xEE}, std::int16_t{-900},
                std::uint16_t{7}, 123456.789);
  }
  const bool time = format == 1 || format == 3 || format == 4 || format == 5;
  if (time) out += pack(123456.789);
  const bool colour =
      format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
  if (colour) out += pack(p.colour[0], p.colour[1], p.colour[2]);
  if (format == 8 || format == 10) out += pack(std::uint16_t{0x7777});  // near infrared
  const bool waveform = format == 4 || format == 5 || format == 9 || format == 10;
  if (waveform) out += std::string(29, '\x5A');
  return out + std::string(extra_bytes, '\x3C');
}

/// A whole file, with bounds that say nothing: readers must not need them.
inline std::string las_file(const LasFile& f) {
  const std::uint16_t header_size = las_header_size(f.minor);
  const auto stride = static_cast<std::uint16_t>(las_record({}, f.format, f.extra_bytes).size());
  const std::uint32_t body = header_size + f.records * 59;
  const auto count = static_cast<std::uint32_t>(f.points.size());
  const std::uint32_t legacy = f.format < 6 ? count : 0;
  std::string out = "LASF" + std::string(20, '\x01');
  out += pack(std::uint8_t{1}, f.minor) + std::string(64, 'x');
  out += pack(std::uint16_t{326}, std::uint16_t{2026}, header_size, body, f.records, f.format,
              stride, legacy, legacy, 0U, 0U, 0U, 0U);
  for (const double s : f.scale) out += pack(s);
  for (const double o : f.offset) out += pack(o);
  for (int i = 0; i < 6; ++i) out += pack(std::numeric_limits<double>::quiet_NaN());
  const std::uint64_t points_end = body + std::uint64_t{stride} * count;
  if (f.minor >= 3) out += pack(std::uint64_t{0});
  if (f.minor >= 4) {
    out += pack(points_end, f.extended_records, std::uint64_t{count}, std::uint64_t{count});
    out += std::string(14 * 8, '\0');
  }
  for (std::uint32_t i = 0; i < f.records; ++i) {
    out += std::string(20, 'r') + pack(std::uint16_t{5}) + std::string(32 + 5, 'r');
  }
  for (const LasPoint& p : f.points) out += las_record(p, f.format, f.extra_bytes);
  for (std::uint32_t i = 0; i < f.extended_records; ++i) {
    out += std::string(20, 'e') + pack(std::uint64_t{7}) + std::string(32 + 7, 'e');
  }
  return out;
}

/// The description of an extra-bytes field (LAS 1.4 R15, table 24).
inline std::string described(const std::string& name, std::uint8_t type, std::uint8_t options = 0,
                             double scale = 0, double offset = 0, std::int64_t no_data = 0) {
  std::string out = pack(std::uint16_t{0}, type, options) + name;
  out.resize(40, '\0');
  out += pack(no_data);
  out.resize(112, '\0');
  out += pack(scale);
  out.resize(136, '\0');
  out += pack(offset);
  out.resize(192, '\0');
  return out;
}

/// A whole file whose only variable length record is an extra-bytes record. Of formats 0 to 5:
/// those from 6 on state where their points end, which this does not move.
inline std::string las_file_with_record(LasFile file, const std::string& record) {
  file.records = 1;
  std::string bytes = las_file(file);
  const std::size_t at = las_header_size(file.minor);
  const std::string vlr = pack(std::uint16_t{0}) + std::string("LASF_Spec\0\0\0\0\0\0\0", 16) +
                          pack(std::uint16_t{4}, static_cast<std::uint16_t>(record.size())) +
                          std::string(32, 'd') + record;
  bytes.replace(at, 59, vlr);
  return bytes.replace(96, 4, pack(static_cast<std::uint32_t>(at + vlr.size())));
}

}  // namespace relief::test
