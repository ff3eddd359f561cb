#include "preprocess/volumes/nrrd_header.h"

#include <algorithm>
#include <utility>

#include "preprocess/readers/source.h"
#include "preprocess/readers/text_cursor.h"
#include "preprocess/volumes/header_field.h"
#include "preprocess/volumes/header_lines.h"

namespace relief {
namespace {

/// Longer ones are not headers; the whole of a file without an empty line would be searched.
constexpr std::size_t kLongestHeader = std::size_t{1} << 20U;
constexpr std::string_view kVectorSeparators = " \t(),";

template <class Value>
struct NrrdName {
  std::string_view name;
  Value value;
};

constexpr NrrdName<NumberType> kNrrdTypes[] = {
    {"signed char", NumberType::Int8},
    {"int8", NumberType::Int8},
    {"int8_t", NumberType::Int8},
    {"uchar", NumberType::Uint8},
    {"unsigned char", NumberType::Uint8},
    {"uint8", NumberType::Uint8},
    {"uint8_t", NumberType::Uint8},
    {"short", NumberType::Int16},
    {"short int", NumberType::Int16},
    {"signed short", NumberType::Int16},
    {"signed short int", NumberType::Int16},
    {"int16", NumberType::Int16},
    {"int16_t", NumberType::Int16},
    {"ushort", NumberType::Uint16},
    {"unsigned short", NumberType::Uint16},
    {"unsigned short int", NumberType::Uint16},
    {"uint16", NumberType::Uint16},
    {"uint16_t", NumberType::Uint16},
    {"int", NumberType::Int32},
    {"signed int", NumberType::Int32},
    {"int32", NumberType::Int32},
    {"int32_t", NumberType::Int32},
    {"uint", NumberType::Uint32},
    {"unsigned int", NumberType::Uint32},
    {"uint32", NumberType::Uint32},
    {"uint32_t", NumberType::Uint32},
    {"longlong", NumberType::Int64},
    {"long long", NumberType::Int64},
    {"long long int", NumberType::Int64},
    {"signed long long", NumberType::Int64},
    {"signed long long int", NumberType::Int64},
    {"int64", NumberType::Int64},
    {"int64_t", NumberType::Int64},
    {"ulonglong", NumberType::Uint64},
    {"unsigned long long", NumberType::Uint64},
    {"unsigned long long int", NumberType::Uint64},
    {"uint64", NumberType::Uint64},
    {"uint64_t", NumberType::Uint64},
    {"float", NumberType::Float32},
    {"double", NumberType::Float64},
};

constexpr NrrdName<NrrdEncoding> kNrrdEncodings[] = {
    {"raw", NrrdEncoding::Raw},    {"gzip", NrrdEncoding::Gzip}, {"gz", NrrdEncoding::Gzip},
    {"ascii", NrrdEncoding::Text}, {"text", NrrdEncoding::Text}, {"txt", NrrdEncoding::Text},
};

/// A left-handed frame without anatomy is turned right-handed by its first axis.
constexpr NrrdName<FileFrame> kNrrdSpaces[] = {
    {"right-anterior-superior", kRasFrame},
    {"ras", kRasFrame},
    {"left-anterior-superior", {{-1.0, 1.0, 1.0}, true}},
    {"las", {{-1.0, 1.0, 1.0}, true}},
    {"left-posterior-superior", kLpsFrame},
    {"lps", kLpsFrame},
    {"scanner-xyz", {}},
    {"3d-right-handed", {}},
    {"3d-left-handed", {{-1.0, 1.0, 1.0}, false}},
};

template <class Row, std::size_t Count>
const Row* find_nrrd_name(const Row (&rows)[Count], const std::string& name) {
  const Row* const row = std::ranges::find(rows, name, &Row::name);
  return row == std::end(rows) ? nullptr : row;
}

/// Parses the fields of a header into what they state.
class NrrdFields {
 public:
  explicit NrrdFields(const std::string& name) : name_(name) {}

  /// `field` in lower case.
  Status take(std::string_view field, std::string_view value, std::size_t line) {
    line_ = line;
    if (field == "dimension") return take_dimension(value);
    if (field == "sizes") return take_sizes(value);
    if (field == "type") return take_type(value);
    if (field == "encoding") return take_encoding(value);
    if (field == "endian") return take_endian(value);
    if (field == "space") return take_space(value);
    if (field == "space dimension") return take_space_dimension(value);
    if (field == "space directions") return take_directions(value);
    if (field == "space origin") return take_origin(value);
    if (field == "spacings") return take_spacings(value);
    if (field == "kinds") return take_kinds(value);
    if (field == "data file" || field == "datafile") return take_data_file(value);
    if (field == "line skip" || field == "lineskip") return take_skip(value, 0, header_.line_skip);
    if (field == "byte skip" || field == "byteskip") return take_skip(value, -1, header_.byte_skip);
    return {};
  }

  Result<NrrdHeader> finish(std::size_t end) {
    if (!has_dimension_) return missing("dimension");
    if (!has_sizes_) return missing("sizes");
    if (!has_type_) return missing("type");
    if (!has_encoding_) return missing("encoding");
    const bool has_order =
        header_.encoding == NrrdEncoding::Text || size_of(header_.form.type) == 1 || has_endian_;
    if (!has_order) return missing("endian");
    if (has_spacings_ && !has_directions_)
      header_.grid.step = scaled_axes(glm::dmat3(1.0), spacings_);
    header_.end = end;
    return header_;
  }

 private:
  [[nodiscard]] Error missing(std::string_view field) const {
    return make_error("{}: its NRRD header has no field '{}'; add it", name_, field);
  }
  [[nodiscard]] Error wrong(std::string_view expected, std::string_view found) const {
    return wrong_field({name_, line_}, expected, found);
  }

  Status take_dimension(std::string_view value) {
    if (value == "3") {
      has_dimension_ = true;
      return {};
    }
    return make_error(
        "{}: line {}: has {} dimensions, but a scalar volume has 3; extract one volume from it",
        name_, line_, relief::quoted(value));
  }
  Status take_sizes(std::string_view value) {
    RELIEF_TRY(parse_sizes({name_, line_}, value, header_.size));
    has_sizes_ = true;
    return {};
  }
  Status take_type(std::string_view value) {
    const auto* const row = find_nrrd_name(kNrrdTypes, lower_case(value));
    if (row == nullptr) {
      return wrong("a type of numbers (uchar, short, ushort, int, uint, float, double, ...)",
                   value);
    }
    header_.form.type = row->value;
    has_type_ = true;
    return {};
  }
  Status take_encoding(std::string_view value) {
    const auto* const row = find_nrrd_name(kNrrdEncodings, lower_case(value));
    if (row == nullptr) {
      return make_error(
          "{}: line {}: the encoding {} cannot be read, only raw, gzip and ascii; save it with one "
          "of them",
          name_, line_, relief::quoted(value));
    }
    header_.encoding = row->value;
    has_encoding_ = true;
    return {};
  }
  Status take_endian(std::string_view value) {
    const std::string order = lower_case(value);
    if (order != "little" && order != "big") return wrong("little or big", value);
    header_.form.is_big_endian = order == "big";
    has_endian_ = true;
    return {};
  }
  Status take_space(std::string_view value) {
    const auto* const row = find_nrrd_name(kNrrdSpaces, lower_case(value));
    if (row == nullptr) {
      return wrong(
          "a space of three dimensions (left-posterior-superior, right-anterior-superior, "
          "left-anterior-superior, scanner-xyz, 3D-right-handed or 3D-left-handed)",
          value);
    }
    header_.frame = row->value;
    return {};
  }
  Status take_space_dimension(std::string_view value) {
    return value == "3" ? Status() : wrong("a space dimension of 3", value);
  }
  /// Reads three numbers of a vector.
  static bool take_vector3(TextCursor& cursor, glm::dvec3& vector) {
    return cursor.number(vector.x) && cursor.number(vector.y) && cursor.number(vector.z);
  }
  Status take_directions(std::string_view value) {
    TextCursor cursor(value, kVectorSeparators);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      if (!take_vector3(cursor, header_.grid.step[axis]))
        return wrong("three vectors of three numbers", value);
    }
    if (!cursor.at_line_end()) return wrong("three vectors of three numbers", value);
    has_directions_ = true;
    return {};
  }
  Status take_origin(std::string_view value) {
    TextCursor cursor(value, kVectorSeparators);
    if (!take_vector3(cursor, header_.grid.origin) || !cursor.at_line_end())
      return wrong("a vector of three numbers", value);
    return {};
  }
  Status take_spacings(std::string_view value) {
    TextCursor cursor(value);
    if (!take_vector3(cursor, spacings_) || !cursor.at_line_end())
      return wrong("three spacings", value);
    has_spacings_ = true;
    return {};
  }
  Status take_kinds(std::string_view value) {
    TextCursor cursor(value);
    while (!cursor.at_line_end()) {
      const std::string kind = lower_case(cursor.word());
      if (kind == "domain" || kind == "space" || kind == "???" || kind == "none") continue;
      return make_error(
          "{}: line {}: an axis is of the kind {}, but only scalar volumes can be read (domain or "
          "space); extract one component",
          name_, line_, relief::quoted(kind));
    }
    return {};
  }
  Status take_data_file(std::string_view value) {
    if (value.starts_with("LIST") || value.find('%') != value.npos) {
      return make_error(
          "{}: line {}: its values are in several files ({}), which cannot be read; save it as one "
          ".nrrd",
          name_, line_, relief::quoted(value));
    }
    header_.data_file = std::string(value);
    return {};
  }
  Status take_skip(std::string_view value, std::int64_t least, std::int64_t& skip) {
    TextCursor cursor(value);
    if (!cursor.integer(skip, least) || !cursor.at_line_end())
      return wrong("a number to skip", value);
    return {};
  }

  const std::string& name_;
  NrrdHeader header_;
  std::size_t line_ = 0;
  glm::dvec3 spacings_{1.0};
  bool has_dimension_ = false;
  bool has_sizes_ = false;
  bool has_type_ = false;
  bool has_encoding_ = false;
  bool has_endian_ = false;
  bool has_directions_ = false;
  bool has_spacings_ = false;
};

}  // namespace

Result<NrrdHeader> parse_nrrd_header(const std::string& name, std::string_view text) {
  HeaderLines lines(text.substr(0, kLongestHeader));
  std::string_view line;
  if (!lines.next(line) || !line.starts_with("NRRD"))
    return make_error("{}: does not begin with NRRD, as NRRD files do", name);
  NrrdFields fields(name);
  bool has_end = false;
  while (!has_end && lines.next(line)) {
    has_end = line.empty();
    if (has_end || line.starts_with('#')) continue;
    const std::size_t colon = line.find(':');
    if (colon == line.npos || colon + 1 == line.size()) {
      return make_error("{}: line {}: expected 'field: value', found {}", name, lines.number(),
                        relief::quoted(line));
    }
    if (line[colon + 1] == '=') continue;  // a remark of the program that wrote it
    RELIEF_TRY(fields.take(lower_case(trimmed(line.substr(0, colon))),
                           trimmed(line.substr(colon + 1)), lines.number()));
  }
  RELIEF_TRY_ASSIGN(auto header, fields.finish(lines.offset()));
  if (!has_end && !header.data_file) {
    return make_error(
        "{}: its header does not end with an empty line; the file is truncated, or the header "
        "lacks 'data file'",
        name);
  }
  return header;
}

}  // namespace relief
