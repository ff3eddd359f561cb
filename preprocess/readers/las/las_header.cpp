#include "preprocess/readers/las/las_header.h"

#include <cmath>
#include <string_view>

#include "preprocess/readers/number_type.h"
#include "preprocess/readers/readers.h"

namespace relief {
namespace {

/// Bytes of a point and the offsets of its GPS time and colour, by point record format (LAS 1.4
/// R15, tables 7 to 17).
struct RecordShape {
  std::size_t size;
  std::size_t time;
  std::size_t colour;
};
constexpr RecordShape kShapes[] = {{20, 0, 0},   {28, 20, 0},  {26, 0, 20}, {34, 20, 28},
                                   {57, 20, 0},  {63, 20, 28}, {30, 22, 0}, {36, 22, 30},
                                   {38, 22, 30}, {59, 22, 0},  {67, 22, 30}};
constexpr std::uint32_t kFormats = std::size(kShapes);

/// Offsets in the header (LAS 1.4 R15, table 3).
constexpr std::size_t kMajor = 24;
constexpr std::size_t kMinor = 25;
constexpr std::size_t kHeaderSize = 94;
constexpr std::size_t kBody = 96;
constexpr std::size_t kRecords = 100;
constexpr std::size_t kFormat = 104;
constexpr std::size_t kStride = 105;
constexpr std::size_t kLegacyPoints = 107;
constexpr std::size_t kScale = 131;
constexpr std::size_t kOffset = 155;
constexpr std::size_t kHeaderEnd = 227;  ///< of LAS 1.2; LAS 1.3 adds only waveforms
constexpr std::size_t kExtendedRecords = 235;
constexpr std::size_t kExtendedCount = 243;
constexpr std::size_t kPoints = 247;
constexpr std::size_t kHeaderEnd14 = 375;

/// Variable length records: a header with the length of the data at byte 20.
constexpr std::size_t kRecordHeader = 54;
constexpr std::size_t kExtendedRecordHeader = 60;
constexpr std::size_t kRecordLength = 20;

class LasHeaderReader {
 public:
  explicit LasHeaderReader(const Source& source) : source_(source), size_(source.text.size()) {}

  Result<LasHeader> read() {
    for (const auto step : {&LasHeaderReader::read_version, &LasHeaderReader::read_layout,
                            &LasHeaderReader::read_frame, &LasHeaderReader::check_records,
                            &LasHeaderReader::count_points, &LasHeaderReader::check_body,
                            &LasHeaderReader::check_extended_records}) {
      RELIEF_TRY((this->*step)());
    }
    return header_;
  }

 private:
  [[nodiscard]] double number(NumberType type, std::size_t at) const {
    return load_number<false>(type, source_.text.data() + at);
  }
  template <class Number>
  [[nodiscard]] Number whole(std::size_t at) const {
    return load_whole<Number>(source_.text.data() + at);
  }

  Error damaged(std::size_t at, std::string_view what) const {
    return make_error("{}: byte {}: {}; the file is truncated or damaged", source_.name, at, what);
  }

  Status read_version() {
    if (!is_las(source_.text)) {
      return make_error("{}: does not begin with 'LASF', so it is not a LAS file", source_.name);
    }
    if (size_ < kHeaderEnd) {
      return damaged(size_, fmt::format("the file ends within the header of {} bytes", kHeaderEnd));
    }
    const auto major = whole<std::uint8_t>(kMajor);
    const auto minor = whole<std::uint8_t>(kMinor);
    if (major != 1 || minor < 1 || minor > 4) {
      return make_error("{}: byte {}: is LAS {}.{}, but LAS 1.1 to 1.4 can be read; save it as one",
                        source_.name, kMajor, major, minor);
    }
    is_14_ = minor == 4;
    return {};
  }

  Status read_layout() {
    header_size_ = whole<std::uint16_t>(kHeaderSize);
    const std::size_t min_size = is_14_ ? kHeaderEnd14 : kHeaderEnd;
    if (header_size_ < min_size || header_size_ > size_) {
      return damaged(
          kHeaderSize,
          fmt::format("the header gives its own size as {} bytes; it has at least {}, and "
                      "the file {}",
                      header_size_, min_size, size_));
    }
    const std::uint32_t stated = whole<std::uint8_t>(kFormat);
    // LAZ marks packed points by the upper bits.
    header_.is_packed = (stated & 0xC0U) != 0;
    const std::uint32_t format = stated & 0x3FU;
    if (format >= kFormats) {
      return damaged(kFormat, fmt::format("states point record format {}, but there are 0 to {}",
                                          format, kFormats - 1));
    }
    header_.format = format;
    header_.stride = whole<std::uint16_t>(kStride);
    if (header_.stride < kShapes[format].size) {
      return damaged(kStride, fmt::format("states {} bytes per point, but those of point record "
                                          "format {} have at least {}",
                                          header_.stride, format, kShapes[format].size));
    }
    header_.body = whole<std::uint32_t>(kBody);
    if (header_.body < header_size_ || header_.body > size_) {
      return damaged(kBody, fmt::format("the points are said to begin at byte {}, but the header "
                                        "ends at {} and the file at {}",
                                        header_.body, header_size_, size_));
    }
    return {};
  }

  Status read_frame() {
    for (int i = 0; i < 3; ++i) {
      const std::size_t step = sizeof(double) * static_cast<std::size_t>(i);
      header_.scale[i] = number(NumberType::Float64, kScale + step);
      header_.offset[i] = number(NumberType::Float64, kOffset + step);
      if (!std::isfinite(header_.scale[i]) || header_.scale[i] <= 0.0) {
        return damaged(kScale + step,
                       fmt::format("the scale of {} is {}, but it must be a number above 0",
                                   "xyz"[i], header_.scale[i]));
      }
      if (!std::isfinite(header_.offset[i])) {
        return damaged(kOffset + step,
                       fmt::format("the offset of {} is {}, but it must be a number", "xyz"[i],
                                   header_.offset[i]));
      }
    }
    return {};
  }

  /// Skips `count` records from `at` on; none may reach beyond `end`.
  template <class Length>
  Status walk(std::uint64_t at, std::uint64_t count, std::uint64_t end, std::size_t count_at,
              std::size_t record_header) const {
    // Each record has at least a header, so that a wrong count ends this soon.
    for (std::uint64_t i = 0; i < count; ++i) {
      const bool begins = end - at >= record_header;
      if (!begins || whole<Length>(at + kRecordLength) > end - at - record_header) {
        return damaged(at, fmt::format("variable length record {} of the {} that byte {} states "
                                       "reaches beyond byte {}, where they end",
                                       i + 1, count, count_at, end));
      }
      at += record_header + whole<Length>(at + kRecordLength);
    }
    return {};
  }

  Status check_records() {
    return walk<std::uint16_t>(header_size_, whole<std::uint32_t>(kRecords), header_.body, kRecords,
                               kRecordHeader);
  }

  Status count_points() {
    const auto legacy = whole<std::uint32_t>(kLegacyPoints);
    header_.points = legacy;
    if (is_14_) {
      header_.points = whole<std::uint64_t>(kPoints);
      if (legacy != 0 && legacy != header_.points) {
        return damaged(kPoints, fmt::format("states {} points, but byte {} states {}",
                                            header_.points, kLegacyPoints, legacy));
      }
    }
    return {};
  }

  Status check_body() {
    const std::size_t left = size_ - header_.body;
    if (!header_.is_packed && header_.points > left / header_.stride) {
      return damaged(is_14_ ? kPoints : kLegacyPoints,
                     fmt::format("states {} points of {} bytes, but the {} bytes after byte {} "
                                 "cannot hold them",
                                 header_.points, header_.stride, left, header_.body));
    }
    if (header_.points >= kNoPoint) return too_many_points(source_, header_.points);
    return {};
  }

  Status check_extended_records() {
    const std::uint32_t count = is_14_ ? whole<std::uint32_t>(kExtendedCount) : 0;
    if (count == 0) return {};
    const auto first = whole<std::uint64_t>(kExtendedRecords);
    const std::uint64_t points_end =
        header_.body + (header_.is_packed ? 0 : header_.points * header_.stride);
    if (first < points_end || first > size_) {
      return damaged(kExtendedRecords,
                     fmt::format("extended variable length records are said to begin at byte {}, "
                                 "but the points end at {} and the file at {}",
                                 first, points_end, size_));
    }
    return walk<std::uint64_t>(first, count, size_, kExtendedCount, kExtendedRecordHeader);
  }

  const Source& source_;
  const std::size_t size_;
  bool is_14_ = false;
  std::size_t header_size_ = 0;
  LasHeader header_;
};

}  // namespace

std::size_t LasHeader::standard_bytes() const {
  return kShapes[format].size;
}

std::size_t LasHeader::time_at() const {
  return kShapes[format].time;
}

std::size_t LasHeader::colour_at() const {
  return kShapes[format].colour;
}

bool is_las(std::string_view text) {
  return text.starts_with("LASF");
}

Result<LasHeader> read_las_header(const Source& source) {
  return LasHeaderReader(source).read();
}

}  // namespace relief
