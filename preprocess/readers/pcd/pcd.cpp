#include <bit>
#include <cmath>
#include <utility>

#include "preprocess/readers/pcd/lzf.h"
#include "preprocess/readers/pcd/pcd_header.h"
#include "preprocess/readers/point_record.h"
#include "preprocess/readers/readers.h"
#include "preprocess/readers/text_cursor.h"

namespace relief {
namespace {

bool is_packed_colour(const PcdField& field) {
  return (field.name == "rgb" || field.name == "rgba") && size_of(field.type) == 4 &&
         field.count == 1;
}

void unpack_colour(std::uint32_t argb, PointRecord& record) {
  record[Red] = (argb >> 16U) & 0xFFU;
  record[Green] = (argb >> 8U) & 0xFFU;
  record[Blue] = argb & 0xFFU;
}

/// A packed colour written as text. Some writers print the integer, some the float with its bits:
/// such floats are below 1e-30 if the alpha byte is 0, negative or beyond 32 bits otherwise.
std::uint32_t packed_colour(double value) {
  constexpr double two_to_32 = 4294967296.0;
  if (std::isnan(value)) return 0;
  if (value >= 1.0 && value < two_to_32) return static_cast<std::uint32_t>(value);
  return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

/// The fields of a point as roles; a packed colour fills three of them.
struct PcdLayout {
  RecordLayout record;
  std::vector<Role> roles;  ///< per field
  std::size_t packed_colour = SIZE_MAX;
  ColourNumbers colour_numbers = ColourNumbers::Integer;

  PcdLayout(const Source& source, const std::vector<PcdField>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      // Padding, packed colours and histograms are no scalars.
      const bool is_number =
          fields[i].name != "_" && fields[i].count == 1 && !is_packed_colour(fields[i]);
      roles.push_back(is_number ? record.add(fields[i].name, source)
                                : record.add(role_of(fields[i].name)));
      if (roles[i] == Red && is_real(fields[i].type)) colour_numbers = ColourNumbers::Real;
      if (is_packed_colour(fields[i])) packed_colour = i;
    }
    if (record.colours()) packed_colour = SIZE_MAX;
    if (packed_colour != SIZE_MAX) {
      for (const Role role : {Red, Green, Blue}) record.add(role);
    }
  }
};

Error too_short(const Source& source, const PcdHeader& header, std::uint64_t left) {
  return make_error(
      "{}: the header states {} points, but the {} bytes after byte {} cannot hold them; "
      "the file is truncated or damaged",
      source.name, header.points, left, header.body);
}

Result<Points> read_ascii(const Source& source, const PcdHeader& header, const PcdLayout& layout) {
  TextCursor line(source.text, TextCursor::kBlanks, '#');
  line.skip_to(header.body);
  // A field takes at least a digit and a separator.
  if (header.points > (line.left() + 1) / (2 * header.fields.size())) {
    return too_short(source, header, line.left());
  }
  ReadMeter meter(source);
  PointCollector points(layout.record, layout.colour_numbers, header.points);
  PointRecord record{};
  for (std::uint64_t i = 0; i < header.points; ++i) {
    bool whole = line.next_line();
    for (std::size_t f = 0; whole && f < header.fields.size(); ++f) {
      double value = 0.0;
      for (std::uint64_t n = 0; whole && n < header.fields[f].count; ++n)
        whole = line.number(value);
      if (f == layout.packed_colour) {
        unpack_colour(packed_colour(value), record);
      } else {
        record[layout.roles[f]] = value;
      }
    }
    if (!whole || !line.at_line_end()) {
      return make_error("{}: {} (point {} of {}); the file is truncated or damaged", source.name,
                        line.expected(whole ? "the line's end" : "a number"), i + 1, header.points);
    }
    if (!meter.advance_to(line.offset())) return interrupted_error();
    points.add(record);
  }
  return points.finish();
}

/// Reads a binary body. `field_start[f]` is the offset of field f of the first point in `body`,
/// `field_step[f]` the distance to that of the next: points follow points, or fields follow fields.
Result<Points> read_records(const Source& source, const PcdHeader& header, const PcdLayout& layout,
                            std::string_view body, const std::vector<std::uint64_t>& field_start,
                            const std::vector<std::uint64_t>& field_step) {
  ReadMeter meter(source);
  PointCollector points(layout.record, layout.colour_numbers, header.points);
  PointRecord record{};
  for (std::uint64_t i = 0; i < header.points; ++i) {
    for (std::size_t f = 0; f < header.fields.size(); ++f) {
      const char* const bytes = body.data() + field_start[f] + i * field_step[f];
      if (f == layout.packed_colour) {
        unpack_colour(load_whole<std::uint32_t>(bytes), record);
      } else if (layout.roles[f] != Other) {
        record[layout.roles[f]] = load_number<false>(header.fields[f].type, bytes);
      }
    }
    points.add(record);
    if (!meter.advance_to(i * header.stride)) return interrupted_error();
  }
  return points.finish();
}

Result<Points> read_binary(const Source& source, const PcdHeader& header, const PcdLayout& layout) {
  const std::string_view body = source.text.substr(header.body);
  if (header.points > body.size() / header.stride) return too_short(source, header, body.size());
  std::vector<std::uint64_t> start;
  for (const PcdField& field : header.fields) start.push_back(field.offset);
  const std::vector<std::uint64_t> step(header.fields.size(), header.stride);
  return read_records(source, header, layout, body, start, step);
}

Result<Points> read_compressed(const Source& source, const PcdHeader& header,
                               const PcdLayout& layout) {
  std::string_view packed = source.text.substr(header.body);
  if (packed.size() < 8) return too_short(source, header, packed.size());
  const auto packed_size = load_whole<std::uint32_t>(packed.data());
  const auto size = load_whole<std::uint32_t>(packed.data() + 4);
  packed.remove_prefix(8);
  if (packed_size > packed.size() || size > kLzfLargestRatio * packed_size ||
      size / header.stride != header.points || size % header.stride != 0) {
    return make_error(
        "{}: byte {}: {} points of {} bytes are said to be packed from {} into {} bytes, of "
        "which {} are there; the file is truncated or damaged",
        source.name, header.body, header.points, header.stride, size, packed_size, packed.size());
  }
  std::vector<char> body(size);
  if (!lzf_decompress(packed.substr(0, packed_size), body)) {
    return make_error("{}: byte {}: the compressed data are damaged", source.name, header.body + 8);
  }
  std::vector<std::uint64_t> start;
  std::vector<std::uint64_t> step;
  for (const PcdField& field : header.fields) {
    start.push_back(field.offset * header.points);
    step.push_back(size_of(field.type) * field.count);
  }
  return read_records(source, header, layout, {body.data(), body.size()}, start, step);
}

Result<Points> read_body(const Source& source, const PcdHeader& header, const PcdLayout& layout) {
  switch (header.encoding) {
    case PcdEncoding::Ascii:
      return read_ascii(source, header, layout);
    case PcdEncoding::Binary:
      return read_binary(source, header, layout);
    case PcdEncoding::Compressed:
      return read_compressed(source, header, layout);
  }
  return make_error("{}: unknown PCD encoding", source.name);
}

}  // namespace

bool is_pcd(std::string_view text) {
  return text.starts_with("# .PCD") || text.starts_with("VERSION ") || text.starts_with("FIELDS ");
}

Result<Points> read_pcd(const Source& source) {
  RELIEF_TRY_ASSIGN(const auto header, read_pcd_header(source));
  const PcdLayout layout(source, header.fields);
  if (!layout.record.positions()) {
    return make_error("{}: its points have no fields x, y and z", source.name);
  }
  auto points = read_body(source, header, layout);
  if (!points) return points;
  points->viewpoint = header.viewpoint;
  points->stance = sensor_stance(points->positions, header.pose);
  return points;
}

}  // namespace relief
