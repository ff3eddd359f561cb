#include <string>
#include <utility>

#include "preprocess/readers/colours.h"
#include "preprocess/readers/face_colours.h"
#include "preprocess/readers/polygons.h"
#include "preprocess/readers/readers.h"
#include "preprocess/readers/text_cursor.h"

namespace relief {
namespace {

/// The contents of a vertex line by the keyword: x y z, then nx ny nz, r g b [a], s t.
struct OffKeyword {
  bool normals = false;
  bool colours = false;
  bool texcoords = false;
  bool other_dimension = false;  ///< 4OFF, nOFF
};

/// [ST][C][N][4][n]OFF; false for other words.
bool parse_keyword(std::string_view word, OffKeyword& keyword) {
  const auto skip = [&word](std::string_view prefix) {
    if (!word.starts_with(prefix)) return false;
    word.remove_prefix(prefix.size());
    return true;
  };
  keyword.texcoords = skip("ST");
  keyword.colours = skip("C");
  keyword.normals = skip("N");
  keyword.other_dimension = skip("4") | static_cast<int>(skip("n"));
  return word == "OFF";
}

class OffReader {
 public:
  explicit OffReader(const Source& source)
      : source_(source), meter_(source), line_(source.text, TextCursor::kBlanks, '#') {}

  Result<Points> read() {
    RELIEF_TRY(read_header());
    RELIEF_TRY(read_vertices());
    RELIEF_TRY(read_faces());
    return std::move(points_);
  }

 private:
  Error wrong(std::string_view what) {
    return make_error("{}: {}; the file is truncated or damaged", source_.name,
                      line_.expected(what));
  }

  Status read_header() {
    if (!line_.next_line()) return make_error("{}: holds no points", source_.name);
    if (parse_keyword(line_.peek(), keyword_)) {
      (void)line_.word();
      if (keyword_.other_dimension) {
        return make_error("{}: its points are not three-dimensional, so it cannot be read",
                          source_.name);
      }
      if (line_.peek() == "BINARY") {
        return make_error("{}: is a binary OFF file, which cannot be read; save it as text",
                          source_.name);
      }
      if (line_.at_line_end() && !line_.next_line()) return wrong("the number of vertices");
    } else {
      // The keyword may be left out.
      keyword_ = {};
    }
    for (std::uint64_t* count : {&vertices_, &faces_}) {
      std::int64_t value = 0;
      if (!line_.integer(value, 0)) return wrong("the numbers of vertices and faces");
      *count = static_cast<std::uint64_t>(value);
    }
    // A vertex takes at least "0 0 0" and a line end, a face "0" and a line end.
    if (vertices_ > (line_.left() + 1) / 6 || faces_ > (line_.left() + 1) / 2) {
      return make_error(
          "{}: line {}: states {} vertices and {} faces, but the {} bytes after it cannot "
          "hold them; the file is truncated or damaged",
          source_.name, line_.line_number(), vertices_, faces_, line_.left());
    }
    if (vertices_ >= kNoPoint) return too_many_points(source_, vertices_);
    return {};
  }

  template <class Vector>
  bool read_vector(Vector& v) {
    for (int i = 0; i < Vector::length(); ++i) {
      double value = 0.0;
      if (!line_.number(value)) return false;
      v[i] = static_cast<typename Vector::value_type>(value);
    }
    return true;
  }

  Status read_vertices() {
    std::vector<glm::vec3> colours;
    ColourNumbers colour_numbers = ColourNumbers::Integer;
    points_.positions.reserve(vertices_);
    for (std::uint64_t i = 0; i < vertices_; ++i) {
      if (!line_.next_line()) return wrong("a vertex");
      if (!meter_.advance_to(line_.offset())) return interrupted_error();
      glm::dvec3 position{};
      if (!read_vector(position)) return wrong("a coordinate");
      points_.positions.push_back(position);
      if (keyword_.normals && !read_vector(points_.normals.emplace_back()))
        return wrong("a normal");
      if (keyword_.colours) {
        if (line_.peek().find('.') != std::string_view::npos) colour_numbers = ColourNumbers::Real;
        if (!read_vector(colours.emplace_back())) return wrong("a colour");
      }
      if (keyword_.texcoords && !read_texcoord()) return wrong("texture coordinates");
    }
    points_.colours = to_colours(colours, colour_numbers);
    return {};
  }

  /// The last two numbers of the line: an opacity may precede them.
  bool read_texcoord() {
    double numbers[3] = {};
    std::size_t count = 0;
    while (count < 3 && !line_.at_line_end()) {
      if (!line_.number(numbers[count++])) return false;
    }
    if (count < 2) return false;
    points_.texcoords.emplace_back(static_cast<float>(numbers[count - 2]),
                                   static_cast<float>(numbers[count - 1]));
    return true;
  }

  Status read_faces() {
    std::vector<std::uint32_t> corners;
    for (std::uint64_t i = 0; i < faces_; ++i) {
      if (!line_.next_line()) return wrong("a face");
      if (!meter_.advance_to(line_.offset())) return interrupted_error();
      std::int64_t count = 0;
      if (!line_.integer(count, 0)) return wrong("the number of a face's corners");
      corners.clear();
      for (std::int64_t c = 0; c < count; ++c) {
        std::int64_t index = 0;
        if (!line_.integer(index)) return wrong("the index of a vertex");
        corners.push_back(index >= 0 && index < std::int64_t{kNoPoint}
                              ? static_cast<std::uint32_t>(index)
                              : kNoPoint);
      }
      const std::size_t before = points_.triangles.size();
      append_polygon(corners, points_.triangles);
      read_face_colour(before);
    }
    face_colours_.give(points_);
    return {};
  }

  /// The rest of a face's line, if that is r g b and perhaps an opacity. It may also be nothing, or
  /// an index into a map of colours that no file has.
  void read_face_colour(std::size_t before) {
    glm::vec3 colour{};
    ColourNumbers numbers = ColourNumbers::Integer;
    for (int channel = 0; channel < 3; ++channel) {
      if (line_.peek().find('.') != std::string_view::npos) numbers = ColourNumbers::Real;
      double value = 0.0;
      if (!line_.number(value)) return;
      colour[channel] = static_cast<float>(value);
    }
    face_colours_.add(colour, numbers, before, points_.triangles.size());
  }

  const Source& source_;
  ReadMeter meter_;
  TextCursor line_;
  OffKeyword keyword_;
  std::uint64_t vertices_ = 0;
  std::uint64_t faces_ = 0;
  FaceColours face_colours_;
  Points points_;
};

}  // namespace

bool is_off(std::string_view text) {
  TextCursor line(text.substr(0, 1024), TextCursor::kBlanks, '#');
  OffKeyword keyword;
  return line.next_line() && parse_keyword(line.word(), keyword);
}

Result<Points> read_off(const Source& source) {
  return OffReader(source).read();
}

}  // namespace relief
