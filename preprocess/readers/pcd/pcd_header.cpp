#include "preprocess/readers/pcd/pcd_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "preprocess/readers/text_cursor.h"

namespace relief {
namespace {

/// Collects the header's lines, which have any order that ends with DATA.
class PcdHeaderReader {
 public:
  explicit PcdHeaderReader(const Source& source)
      : source_(source), line_(source.text, TextCursor::kBlanks, '#') {}

  Result<PcdHeader> read() {
    for (bool data = false; !data;) {
      if (!line_.next_line()) {
        return make_error("{}: line {}: the header ends without a DATA line; the file is truncated",
                          source_.name, line_.line_number());
      }
      data = line_.peek() == "DATA";
      RELIEF_TRY(read_line());
    }
    RELIEF_TRY(lay_out());
    RELIEF_TRY(count_points());
    if (!is_default_ || height_.value_or(1) > 1) header_.viewpoint = viewpoint_;
    line_.skip_line();
    // A binary body may begin with a byte that looks like a line end: skip one.
    const std::size_t end = source_.text.find('\n', line_.offset());
    header_.body = std::min(end, source_.text.size() - 1) + 1;
    return std::move(header_);
  }

 private:
  Error wrong(std::string_view what) {
    return make_error("{}: {}; the header is damaged", source_.name, line_.expected(what));
  }

  Status read_line() {
    const std::string_view keyword = line_.word();
    if (keyword == "FIELDS" || keyword == "COLUMNS") {
      while (!line_.at_line_end()) header_.fields.push_back({lower_case(line_.word())});
    } else if (keyword == "SIZE") {
      return read_numbers(sizes_);
    } else if (keyword == "COUNT") {
      return read_numbers(counts_);
    } else if (keyword == "TYPE") {
      while (!line_.at_line_end()) types_.push_back(line_.word().front());
    } else if (keyword == "WIDTH") {
      return read_number(width_);
    } else if (keyword == "HEIGHT") {
      return read_number(height_);
    } else if (keyword == "POINTS") {
      return read_number(points_);
    } else if (keyword == "VIEWPOINT") {
      return read_viewpoint();
    } else if (keyword == "DATA") {
      return read_encoding();
    } else if (keyword != "VERSION") {
      return make_error("{}: line {}: {} is not a PCD header line; the header is damaged",
                        source_.name, line_.line_number(), relief::quoted(keyword));
    }
    return {};
  }

  Status read_number(std::optional<std::uint64_t>& number) {
    std::int64_t value = 0;
    if (!line_.integer(value, 0)) return wrong("a number of points");
    number = static_cast<std::uint64_t>(value);
    return {};
  }

  Status read_numbers(std::vector<std::uint64_t>& numbers) {
    while (!line_.at_line_end()) {
      std::int64_t value = 0;
      if (!line_.integer(value, 1)) return wrong("a positive number");
      numbers.push_back(static_cast<std::uint64_t>(value));
    }
    return {};
  }

  Status read_viewpoint() {
    std::array<double, 7> v{};
    for (double& number : v) {
      if (!line_.number(number)) return wrong("seven numbers (position and quaternion)");
    }
    const bool finite = std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
    if (finite) viewpoint_ = glm::dvec3(v[0], v[1], v[2]);
    is_default_ = v == std::array<double, 7>{0, 0, 0, 1, 0, 0, 0};
    if (finite && !is_default_) header_.pose.position = *viewpoint_;
    const glm::dquat turn(v[3], v[4], v[5], v[6]);
    const double length = glm::length(turn);
    // Anything but a rotation is as good as the default.
    if (std::abs(length - 1.0) < 0.01) header_.pose.turn = turn / length;
    return {};
  }

  Status read_encoding() {
    const std::string_view word = line_.peek();
    if (word == "ascii") {
      header_.encoding = PcdEncoding::Ascii;
    } else if (word == "binary") {
      header_.encoding = PcdEncoding::Binary;
    } else if (word == "binary_compressed") {
      header_.encoding = PcdEncoding::Compressed;
    } else {
      return wrong("ascii, binary or binary_compressed");
    }
    return {};
  }

  static std::optional<NumberType> type_of(char type, std::uint64_t size) {
    if (type == 'F' && size == 4) return NumberType::Float32;
    if (type == 'F' && size == 8) return NumberType::Float64;
    if (type != 'I' && type != 'U') return std::nullopt;
    const bool is_signed = type == 'I';
    switch (size) {
      case 1:
        return is_signed ? NumberType::Int8 : NumberType::Uint8;
      case 2:
        return is_signed ? NumberType::Int16 : NumberType::Uint16;
      case 4:
        return is_signed ? NumberType::Int32 : NumberType::Uint32;
      case 8:
        return is_signed ? NumberType::Int64 : NumberType::Uint64;
      default:
        return std::nullopt;
    }
  }

  Status lay_out() {
    auto& fields = header_.fields;
    // Files before version 0.6 have neither TYPE nor COUNT.
    if (types_.empty()) types_.assign(fields.size(), 'F');
    if (counts_.empty()) counts_.assign(fields.size(), 1);
    if (fields.empty() || sizes_.size() != fields.size() || types_.size() != fields.size() ||
        counts_.size() != fields.size()) {
      return make_error(
          "{}: FIELDS, SIZE, TYPE and COUNT have {}, {}, {} and {} entries, but they must "
          "have equally many; the header is damaged",
          source_.name, fields.size(), sizes_.size(), types_.size(), counts_.size());
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto type = type_of(types_[i], sizes_[i]);
      if (!type || counts_[i] > source_.text.size()) {
        return make_error(
            "{}: field {} has type '{}', size {} and count {}, which no PCD file can have; "
            "the header is damaged",
            source_.name, relief::quoted(fields[i].name), types_[i], sizes_[i], counts_[i]);
      }
      fields[i].type = *type;
      fields[i].count = counts_[i];
      fields[i].offset = header_.stride;
      header_.stride += sizes_[i] * counts_[i];
    }
    return {};
  }

  Status count_points() {
    const std::uint64_t width = width_.value_or(points_.value_or(0));
    const std::uint64_t height = height_.value_or(1);
    const bool fits = height == 0 || width <= kNoPoint / height;
    header_.points = points_.value_or(fits ? width * height : kNoPoint);
    if (header_.points >= kNoPoint) return too_many_points(source_, header_.points);
    if (!fits || header_.points != width * height) {
      return make_error(
          "{}: the header states {} points, but a width of {} and a height of {}; it is "
          "damaged",
          source_.name, header_.points, width, height);
    }
    return {};
  }

  const Source& source_;
  TextCursor line_;
  PcdHeader header_;
  std::vector<std::uint64_t> sizes_;
  std::vector<std::uint64_t> counts_;
  std::vector<char> types_;
  std::optional<std::uint64_t> width_;
  std::optional<std::uint64_t> height_;
  std::optional<std::uint64_t> points_;
  std::optional<glm::dvec3> viewpoint_;
  bool is_default_ = true;  ///< the viewpoint
};

}  // namespace

Result<PcdHeader> read_pcd_header(const Source& source) {
  return PcdHeaderReader(source).read();
}

}  // namespace relief
