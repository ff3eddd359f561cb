#include <utility>

#include "preprocess/readers/number_type.h"
#include "preprocess/readers/polygons.h"
#include "preprocess/readers/readers.h"
#include "preprocess/readers/text_cursor.h"

namespace relief {
namespace {

constexpr std::size_t kHeader = 80;
constexpr std::size_t kFacet = 50;  // normal, three corners, two bytes of attributes

std::uint64_t stated_facets(std::string_view text) {
  return load_whole<std::uint32_t>(text.data() + kHeader);
}

Result<Points> read_binary(const Source& source) {
  const std::size_t first = kHeader + 4;
  if (source.text.size() < first) {
    return make_error(
        "{}: has {} bytes, fewer than the header of a binary STL file; it is truncated "
        "or not an STL file",
        source.name, source.text.size());
  }
  const std::uint64_t facets = stated_facets(source.text);
  if (facets > (source.text.size() - first) / kFacet) {
    return make_error(
        "{}: states {} facets, but the {} bytes after byte {} cannot hold them; the file "
        "is truncated or not an STL file",
        source.name, facets, source.text.size() - first, first);
  }
  if (3 * facets >= kNoPoint) return too_many_points(source, 3 * facets);
  Points points;
  points.positions.reserve(3 * facets);
  points.triangles.reserve(facets);
  ReadMeter meter(source);
  for (std::uint64_t i = 0; i < facets; ++i) {
    const std::size_t offset = first + i * kFacet;
    if (!meter.advance_to(offset)) return interrupted_error();
    const auto coordinate = [&](std::size_t n) {
      return load_number<false>(NumberType::Float32, source.text.data() + offset + 4 * n);
    };
    const auto corner = static_cast<std::uint32_t>(3 * i);
    for (std::size_t n = 3; n < 12; n += 3) {
      points.positions.emplace_back(coordinate(n), coordinate(n + 1), coordinate(n + 2));
    }
    points.triangles.push_back({corner, corner + 1, corner + 2});
  }
  return points;
}

/// Walks over `facet normal ... outer loop, vertex x y z (three times or more), endloop, endfacet`
/// between `solid` and `endsolid`; a file may have several solids.
Result<Points> read_ascii(const Source& source) {
  Points points;
  ReadMeter meter(source);
  TextCursor line(source.text);
  bool in_solid = false;
  std::vector<std::uint32_t> corners;
  const auto wrong = [&](std::string_view what) {
    return make_error("{}: {}; the file is truncated or damaged", source.name, line.expected(what));
  };
  while (line.next_line()) {
    if (!meter.advance_to(line.offset())) return interrupted_error();
    const std::string keyword = lower_case(line.peek().substr(0, 16));
    if (keyword == "vertex") {
      (void)line.word();
      glm::dvec3 p{};
      for (int i = 0; i < 3; ++i) {
        if (!line.number(p[i])) return wrong("a coordinate");
      }
      if (points.size() + 1 >= kNoPoint) return too_many_points(source, points.size() + 1);
      corners.push_back(static_cast<std::uint32_t>(points.size()));
      points.positions.push_back(p);
    } else if (keyword == "endfacet") {
      if (corners.size() < 3) return wrong("a third vertex before");
      append_polygon(corners, points.triangles);
      corners.clear();
    } else if (keyword == "solid") {
      in_solid = true;
    } else if (keyword == "endsolid") {
      if (!corners.empty()) return wrong("endfacet");
      in_solid = false;
    } else if (keyword != "facet" && keyword != "outer" && keyword != "endloop") {
      return wrong("an STL statement");
    }
  }
  if (in_solid) return wrong("endsolid");
  return points;
}

bool is_binary_stl(std::string_view text) {
  return text.size() >= kHeader + 4 && text.size() - kHeader - 4 == stated_facets(text) * kFacet;
}

bool is_ascii_stl(std::string_view text) {
  const std::string start = lower_case(text.substr(0, 1024));
  return start.starts_with("solid") &&
         (start.find("facet") != start.npos || start.find("endsolid") != start.npos);
}

}  // namespace

bool is_stl(std::string_view text) {
  return is_binary_stl(text) || is_ascii_stl(text);
}

Result<Points> read_stl(const Source& source) {
  // Binary files whose header begins with "solid" exist; their length gives them away.
  if (!is_binary_stl(source.text) && is_ascii_stl(source.text)) return read_ascii(source);
  return read_binary(source);
}

}  // namespace relief
