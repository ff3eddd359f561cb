#include <charconv>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "common/mesh/sharp_mesh.h"
#include "preprocess/readers/colours.h"
#include "preprocess/readers/polygons.h"
#include "preprocess/readers/readers.h"
#include "preprocess/readers/text_cursor.h"

namespace relief {
namespace {

/// The corner of a face: indices from 0; kNoPoint for missing ones.
struct Corner {
  std::uint32_t position = kNoPoint;
  std::uint32_t texcoord = kNoPoint;
  std::uint32_t normal = kNoPoint;
};

/// OBJ counts from 1, or backwards from the last one so far: -1.
std::uint32_t resolve(std::int64_t index, std::size_t so_far) {
  if (index < 0) index += static_cast<std::int64_t>(so_far) + 1;
  return index >= 1 && index < std::int64_t{kNoPoint} ? static_cast<std::uint32_t>(index - 1)
                                                      : kNoPoint;
}

class ObjReader {
 public:
  explicit ObjReader(const Source& source)
      : source_(source), line_(source.text, " \t\f\v\\", '#') {}

  Result<Points> read() {
    ReadMeter meter(source_);
    while (line_.next_line()) {
      if (!meter.advance_to(line_.offset())) return interrupted_error();
      RELIEF_TRY(read_line());
    }
    if (points_.size() >= kNoPoint) return too_many_points(source_, points_.size());
    give_normals();
    give_texcoords();
    give_materials();
    // Colours of only some vertices are ignored.
    if (colours_.size() == points_.size()) {
      points_.colours = to_colours(colours_, ColourNumbers::Real);
    }
    keep_normals();
    return std::move(points_);
  }

 private:
  Error wrong(std::string_view what) {
    return make_error("{}: {}; the file is truncated or damaged", source_.name,
                      line_.expected(what));
  }

  /// Other statements (groups, curves) are skipped.
  Status read_line() {
    const std::string_view keyword = line_.word();
    if (keyword == "v") return read_vertex();
    if (keyword == "vn") {
      if (!read_numbers(3)) return wrong("three numbers of a normal");
      normals_.emplace_back(numbers_[0], numbers_[1], numbers_[2]);
    } else if (keyword == "vt") {
      // One number is legal: v is then 0.
      if (!read_numbers(1)) return wrong("a texture coordinate");
      texcoords_.emplace_back(numbers_[0], numbers_[1]);
    } else if (keyword == "f" || keyword == "fo") {
      return read_face();
    } else if (keyword == "usemtl") {
      material_ = trimmed(line_.rest_of_line());
    } else if (keyword == "mtllib") {
      points_.material_files.emplace_back(trimmed(line_.rest_of_line()));
    }
    return {};
  }

  /// Materials are known by name until their files are read. A name stands for two materials if
  /// only some of its faces have texture coordinates.
  std::uint32_t material_of_face(bool has_texcoords) {
    if (material_.empty()) return kNoMaterial;
    const auto [found, is_new] = materials_.try_emplace(
        std::pair(material_, has_texcoords), static_cast<std::uint32_t>(points_.materials.size()));
    if (is_new) {
      MeshMaterial material;
      material.name = material_;
      material.has_texcoords = has_texcoords;
      points_.materials.push_back(std::move(material));
    }
    return found->second;
  }

  /// Reads up to eight numbers, at least `least`, to the line's end; missing ones are 0.
  bool read_numbers(std::size_t min_count) {
    std::fill(std::begin(numbers_), std::end(numbers_), 0.0);
    for (count_ = 0; count_ < std::size(numbers_) && !line_.at_line_end(); ++count_) {
      if (!line_.number(numbers_[count_])) return false;
    }
    return count_ >= min_count && line_.at_line_end();
  }

  /// v x y z [w] [r g b]
  Status read_vertex() {
    if (!read_numbers(3)) return wrong("three coordinates, and a colour at most");
    points_.positions.emplace_back(numbers_[0], numbers_[1], numbers_[2]);
    if (count_ >= 6) {
      const std::size_t red = count_ == 6 ? 3 : 4;
      colours_.emplace_back(numbers_[red], numbers_[red + 1], numbers_[red + 2]);
    }
    return {};
  }

  Status read_face() {
    polygon_.clear();
    polygon_texcoords_.clear();
    polygon_normals_.clear();
    bool has_texcoords = true;
    while (!line_.at_line_end()) {
      Corner corner;
      if (!parse_corner(line_.peek(), corner))
        return wrong("a corner such as 1, 1/2, 1//3 or 1/2/3");
      (void)line_.word();
      polygon_.push_back(corner.position);
      polygon_texcoords_.push_back(corner.texcoord);
      polygon_normals_.push_back(corner.normal);
      corners_.push_back(corner);
      has_texcoords = has_texcoords && corner.texcoord != kNoPoint;
    }
    append_polygon(polygon_, points_.triangles);
    append_polygon(polygon_texcoords_, triangle_texcoords_);
    append_polygon(polygon_normals_, triangle_normals_);
    points_.triangle_materials.resize(points_.triangles.size(), material_of_face(has_texcoords));
    return {};
  }

  bool parse_corner(std::string_view word, Corner& corner) const {
    std::uint32_t* const fields[] = {&corner.position, &corner.texcoord, &corner.normal};
    const std::size_t so_far[] = {points_.size(), texcoords_.size(), normals_.size()};
    const char* p = word.data();
    const char* const end = p + word.size();
    for (std::size_t i = 0; i < 3; ++i) {
      std::int64_t index = 0;
      const auto [stop, code] = std::from_chars(p, end, index);
      if (code == std::errc{}) *fields[i] = resolve(index, so_far[i]);
      // Only the position is a must: 1//3, 1/2/ and 1/ are met.
      if (code != std::errc{} && (i == 0 || stop != p)) return false;
      if (stop == end) return true;
      if (*stop != '/') return false;
      p = stop + 1;
    }
    return false;
  }

  /// A vertex gets the mean direction of its corners' normals; without faces, the normals are the
  /// vertices', one by one, if there are as many.
  void give_normals() {
    if (corners_.empty() && normals_.size() == points_.size())
      points_.normals = std::move(normals_);
    for (const Corner& corner : corners_) {
      if (corner.normal >= normals_.size() || corner.position >= points_.size()) continue;
      if (points_.normals.empty()) points_.normals.assign(points_.size(), glm::vec3(0.0F));
      points_.normals[corner.position] += normals_[corner.normal];
    }
  }

  /// Triangles of a design show whether the edge between them is sharp: a vertex of such a mesh is
  /// repeated for each of its normals.
  void keep_normals() {
    if (points_.normals.empty() || !is_designed_mesh(points_)) return;
    if (points_.size() + 3 * points_.triangles.size() >= kNoPoint) return;
    std::unordered_map<std::uint64_t, std::uint32_t> point_of;
    std::vector<bool> is_taken(points_.size(), false);
    for (std::size_t t = 0; t < points_.triangles.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint32_t& corner = points_.triangles[t][c];
        const std::uint32_t normal = triangle_normals_[t][c];
        if (corner >= is_taken.size() || normal >= normals_.size()) continue;
        const auto [found, is_new] =
            point_of.try_emplace(std::uint64_t{corner} << 32U | normal, corner);
        if (is_new) {
          if (is_taken[corner]) {
            found->second = static_cast<std::uint32_t>(points_.size());
            repeat_point(points_, corner);
          } else {
            is_taken[corner] = true;
          }
          points_.normals[found->second] = normals_[normal];
        }
        corner = found->second;
      }
    }
  }

  /// A vertex gets the texture coordinates of its first corner that has some; where another corner
  /// has others (a seam), the triangles keep their own.
  void give_texcoords() {
    if (corners_.empty() && texcoords_.size() == points_.size()) {
      points_.texcoords = std::move(texcoords_);
    }
    std::vector<bool> given;
    for (const Corner& corner : corners_) {
      if (corner.texcoord >= texcoords_.size() || corner.position >= points_.size()) continue;
      if (given.empty()) {
        points_.texcoords.assign(points_.size(), glm::vec2(0.0F));
        given.assign(points_.size(), false);
      }
      if (!given[corner.position]) points_.texcoords[corner.position] = texcoords_[corner.texcoord];
      given[corner.position] = true;
    }
    keep_seams();
  }

  void keep_seams() {
    if (points_.texcoords.empty() || triangle_texcoords_.empty()) return;
    std::vector<CornerTexcoords> of_corners(points_.triangles.size(), CornerTexcoords{});
    bool seam = false;
    for (std::size_t t = 0; t < of_corners.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t position = points_.triangles[t][c];
        const std::uint32_t texcoord = triangle_texcoords_[t][c];
        if (position >= points_.size()) continue;
        const bool has_own = texcoord < texcoords_.size();
        of_corners[t][c] = has_own ? texcoords_[texcoord] : points_.texcoords[position];
        seam = seam || of_corners[t][c] != points_.texcoords[position];
      }
    }
    if (seam) points_.corner_texcoords = std::move(of_corners);
  }

  void give_materials() {
    if (points_.materials.empty()) points_.triangle_materials.clear();
  }

  const Source& source_;
  TextCursor line_;
  Points points_;
  std::map<std::pair<std::string, bool>, std::uint32_t> materials_;  ///< by material_of_face
  std::string material_;  ///< of the faces to come; empty: none
  std::vector<glm::vec3> normals_;
  std::vector<glm::vec2> texcoords_;
  std::vector<glm::vec3> colours_;
  std::vector<Corner> corners_;
  std::vector<std::uint32_t> polygon_;
  std::vector<std::uint32_t> polygon_texcoords_;
  std::vector<std::uint32_t> polygon_normals_;
  std::vector<Triangle> triangle_texcoords_;  ///< indices into texcoords_, beside the triangles
  std::vector<Triangle> triangle_normals_;    ///< indices into normals_, beside the triangles
  double numbers_[8] = {};
  std::size_t count_ = 0;
};

}  // namespace

Result<Points> read_obj(const Source& source) {
  return ObjReader(source).read();
}

}  // namespace relief
