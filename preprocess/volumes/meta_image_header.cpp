#include "preprocess/volumes/meta_image_header.h"

#include <algorithm>
#include <span>

#include "preprocess/readers/source.h"
#include "preprocess/readers/text_cursor.h"
#include "preprocess/volumes/header_field.h"
#include "preprocess/volumes/header_lines.h"

namespace relief {
namespace {

constexpr std::size_t kLongestMetaHeader = std::size_t{1} << 20U;

struct MetaTypeName {
  std::string_view name;
  NumberType type;
};

/// "long" has the four bytes that MetaIO gives it.
constexpr MetaTypeName kMetaTypes[] = {
    {"MET_CHAR", NumberType::Int8},       {"MET_UCHAR", NumberType::Uint8},
    {"MET_SHORT", NumberType::Int16},     {"MET_USHORT", NumberType::Uint16},
    {"MET_INT", NumberType::Int32},       {"MET_UINT", NumberType::Uint32},
    {"MET_LONG", NumberType::Int32},      {"MET_ULONG", NumberType::Uint32},
    {"MET_LONG_LONG", NumberType::Int64}, {"MET_ULONG_LONG", NumberType::Uint64},
    {"MET_FLOAT", NumberType::Float32},   {"MET_DOUBLE", NumberType::Float64},
};

/// Parses the fields of a header into what they state.
class MetaFields {
 public:
  explicit MetaFields(const std::string& name) : name_(name) {}

  Status take(std::string_view field, std::string_view value, std::size_t line) {
    line_ = line;
    if (field == "ObjectType") return value == "Image" ? Status() : wrong("Image", value);
    if (field == "NDims") return take_dimensions(value);
    if (field == "DimSize") return take_sizes(value);
    if (field == "ElementType") return take_type(value);
    if (field == "ElementNumberOfChannels") return take_channels(value);
    if (field == "ElementSpacing") return take_spacing(value);
    if (field == "ElementSize" && !has_spacing_) return take_numbers(value, 3, &spacing_.x);
    if (field == "TransformMatrix" || field == "Rotation" || field == "Orientation")
      return take_numbers(value, 9, &directions_[0][0]);
    if (field == "Offset" || field == "Position" || field == "Origin")
      return take_numbers(value, 3, &header_.grid.origin.x);
    if (field == "BinaryData") return take_flag(value, header_.is_binary);
    if (field == "BinaryDataByteOrderMSB" || field == "ElementByteOrderMSB")
      return take_flag(value, header_.form.is_big_endian);
    if (field == "CompressedData") return take_flag(value, header_.is_compressed);
    if (field == "HeaderSize") return take_header_size(value);
    return {};
  }

  /// `data_file`: the value of ElementDataFile.
  Result<MetaImageHeader> finish(std::string_view data_file, std::size_t end) {
    if (!has_dimensions_) return missing("NDims");
    if (!has_sizes_) return missing("DimSize");
    if (!has_type_) return missing("ElementType");
    if (data_file.starts_with("LIST") || data_file.find('%') != data_file.npos) {
      return make_error(
          "{}: its values are in several files ({}), which cannot be read; save it as one .mha",
          name_, relief::quoted(data_file));
    }
    if (data_file != "LOCAL" && data_file != "Local" && data_file != "local")
      header_.data_file = std::string(data_file);
    header_.grid.step = scaled_axes(directions_, spacing_);
    header_.end = end;
    return header_;
  }

 private:
  [[nodiscard]] Error missing(std::string_view field) const {
    return make_error("{}: its MetaImage header has no field {} before ElementDataFile; add it",
                      name_, field);
  }
  [[nodiscard]] Error wrong(std::string_view expected, std::string_view found) const {
    return wrong_field({name_, line_}, expected, found);
  }

  Status take_dimensions(std::string_view value) {
    if (value == "3") {
      has_dimensions_ = true;
      return {};
    }
    return make_error(
        "{}: line {}: has {} dimensions, but a volume has 3; extract one volume from it", name_,
        line_, relief::quoted(value));
  }
  Status take_sizes(std::string_view value) {
    RELIEF_TRY(parse_sizes({name_, line_}, value, header_.size));
    has_sizes_ = true;
    return {};
  }
  Status take_type(std::string_view value) {
    const auto* const row = std::ranges::find(kMetaTypes, value, &MetaTypeName::name);
    if (row == std::end(kMetaTypes)) {
      return wrong("a type of numbers (MET_UCHAR, MET_SHORT, MET_USHORT, MET_FLOAT, ...)", value);
    }
    header_.form.type = row->type;
    has_type_ = true;
    return {};
  }
  Status take_channels(std::string_view value) {
    if (value == "1") return {};
    return make_error(
        "{}: line {}: has {} numbers a voxel, but only scalar volumes can be read; extract one "
        "component",
        name_, line_, relief::quoted(value));
  }
  Status take_spacing(std::string_view value) {
    has_spacing_ = true;
    return take_numbers(value, 3, &spacing_.x);
  }
  Status take_numbers(std::string_view value, std::size_t count, double* numbers) const {
    TextCursor cursor(value);
    for (double& number : std::span(numbers, count)) {
      if (!cursor.number(number)) return wrong(fmt::format("{} numbers", count), value);
    }
    if (!cursor.at_line_end()) return wrong(fmt::format("{} numbers", count), value);
    return {};
  }
  Status take_flag(std::string_view value, bool& flag) const {
    const std::string word = lower_case(value);
    if (word != "true" && word != "false" && word != "1" && word != "0")
      return wrong("True or False", value);
    flag = word == "true" || word == "1";
    return {};
  }
  Status take_header_size(std::string_view value) {
    TextCursor cursor(value);
    if (!cursor.integer(header_.header_size, -1) || !cursor.at_line_end())
      return wrong("a number of bytes, or -1", value);
    return {};
  }

  const std::string& name_;
  MetaImageHeader header_;
  glm::dmat3 directions_{1.0};  ///< columns: the directions of the axes, as the file lists them
  glm::dvec3 spacing_{1.0};
  std::size_t line_ = 0;
  bool has_dimensions_ = false;
  bool has_sizes_ = false;
  bool has_type_ = false;
  bool has_spacing_ = false;
};

}  // namespace

Result<MetaImageHeader> parse_meta_image_header(const std::string& name, std::string_view text) {
  HeaderLines lines(text.substr(0, kLongestMetaHeader));
  MetaFields fields(name);
  std::string_view line;
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    const std::size_t equals = line.find('=');
    if (equals == line.npos) {
      return make_error("{}: line {}: expected 'Field = value', found {}", name, lines.number(),
                        relief::quoted(line));
    }
    const std::string_view field = trimmed(line.substr(0, equals));
    const std::string_view value = trimmed(line.substr(equals + 1));
    if (field == "ElementDataFile") return fields.finish(value, lines.offset());
    RELIEF_TRY(fields.take(field, value, lines.number()));
  }
  return make_error(
      "{}: its MetaImage header has no field ElementDataFile; the file is truncated or not "
      "MetaImage",
      name);
}

}  // namespace relief
