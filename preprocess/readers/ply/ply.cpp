#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "preprocess/readers/face_colours.h"
#include "preprocess/readers/ply/ply_header.h"
#include "preprocess/readers/ply/ply_textures.h"
#include "preprocess/readers/ply/ply_values.h"
#include "preprocess/readers/point_record.h"
#include "preprocess/readers/polygons.h"
#include "preprocess/readers/readers.h"

namespace relief {
namespace {

/// A value as an index; invalid ones become kNoPoint.
std::uint32_t to_index(double value) {
  return value >= 0.0 && value < static_cast<double>(kNoPoint) ? static_cast<std::uint32_t>(value)
                                                               : kNoPoint;
}

/// Reads the body, element by element in the header's order.
template <class Values>
class PlyBody {
 public:
  PlyBody(const Source& source, const PlyHeader& header)
      : source_(source), header_(header), meter_(source), values_(source.text, header.body) {}

  Result<Points> read() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      if (has_vertices_ && source_.sink != nullptr) {
        source_.remarks.notes.push_back(
            fmt::format("{}: its {} elements '{}' are not used with --memory", source_.name,
                        element.count, element.name));
        continue;
      }
      RELIEF_TRY(check_count(element));
      RELIEF_TRY(element.name == "vertex" ? read_vertices(element) : read_lists(element));
    }
    points_.stance = stance();
    textures_.give(header_.textures, points_);
    colours_.give(points_);
    return std::move(points_);
  }

 private:
  /// Range scans are grids in the frame of a scanner that stands in front of them.
  [[nodiscard]] std::optional<Stance> stance() const {
    const auto has = [this](std::string_view name) {
      return std::ranges::any_of(header_.elements, [name](const PlyElement& element) {
        return element.name == name && element.count > 0;
      });
    };
    if (has("range_grid")) return Stance{.is_from_sensor = true};
    // A mesh, although --memory leaves its faces out.
    const bool has_faces = has("face") || has("tristrips");
    return has_faces && points_.triangles.empty() ? std::optional(Stance{}) : std::nullopt;
  }

  /// A count that the rest of the file cannot hold is refused before memory is allocated.
  Status check_count(const PlyElement& element) {
    std::uint64_t min_bytes = 0;
    for (const PlyProperty& p : element.properties) {
      min_bytes += Values::min_size(p.count_type.value_or(p.type));
    }
    assert(min_bytes > 0 && "an element has properties, each of a byte or more");
    if (element.count > values_.left() / min_bytes) {
      return make_error(
          "{}: the header states {} elements '{}', but the {} bytes after byte {} cannot hold "
          "them; "
          "the file is truncated or damaged",
          source_.name, element.count, element.name, values_.left(), values_.offset());
    }
    return {};
  }

  Error failure(const PlyElement& element, std::uint64_t index) {
    return make_error("{}: {} ({} {} of {}); the file is truncated or damaged", source_.name,
                      impossible_list_
                          ? values_.where() + ": a list is longer than the file or less than 0"
                          : values_.failure(),
                      element.name, index + 1, element.count);
  }

  Status read_vertices(const PlyElement& element) {
    RecordLayout layout;
    std::vector<Role> roles;  // per property
    ColourNumbers colour_numbers = ColourNumbers::Integer;
    for (const PlyProperty& property : element.properties) {
      const Role role = property.count_type ? Other : layout.add(property.name, source_);
      roles.push_back(role);
      if (role == Red && is_real(property.type)) colour_numbers = ColourNumbers::Real;
    }
    if (!layout.positions()) {
      return make_error("{}: its vertices have no properties x, y and z", source_.name);
    }
    if (element.count >= kNoPoint) return too_many_points(source_, element.count);

    has_vertices_ = true;
    const std::uint64_t capacity =
        source_.sink != nullptr ? PointSink::kBlockPoints : element.count;
    PointCollector points(layout, colour_numbers, std::min(capacity, element.count));
    PointRecord record{};
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!read_vertex(element, roles, record)) return failure(element, i);
      if (!meter_.advance_to(values_.offset())) return interrupted_error();
      points.add(record);
      if (!points.is_block(source_)) continue;
      RELIEF_TRY(points.give_block(source_));
    }
    // Faces may have come before the vertices.
    std::vector<Triangle> triangles = std::move(points_.triangles);
    points_ = points.finish();
    points_.triangles = std::move(triangles);
    return {};
  }

  bool read_vertex(const PlyElement& element, const std::vector<Role>& roles, PointRecord& record) {
    if (!values_.begin_element()) return false;
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (property.count_type ? !skip_list(property)
                              : !values_.value(property.type, record[roles[p]])) {
        return false;
      }
    }
    return values_.end_element();
  }

  /// Any other element: faces and strips are kept, the rest is skipped.
  Status read_lists(const PlyElement& element) {
    const std::vector<Role> roles = colour_roles(element);
    const std::optional<ColourNumbers> colours = numbers_of_colours(element, roles);
    const std::vector<Use> uses = uses_of(element, roles);
    const bool has_strips = element.name == "tristrips";
    const bool has_faces = element.name == "face";
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!values_.begin_element()) return failure(element, i);
      list_.clear();
      textures_.begin_face();
      for (std::size_t p = 0; p < roles.size(); ++p) {
        if (!read_property(element.properties[p], uses[p], roles[p])) return failure(element, i);
      }
      if (source_.sink == nullptr) {
        const std::size_t before = points_.triangles.size();
        if (has_strips) append_strips(list_, points_.triangles);
        if (has_faces) append_polygon(list_, points_.triangles);
        textures_.end_face(list_.size(), before, points_.triangles.size());
        if (colours) colours_.add(colour_, *colours, before, points_.triangles.size());
      }
      if (!values_.end_element()) return failure(element, i);
      if (!meter_.advance_to(values_.offset())) return interrupted_error();
    }
    return {};
  }

  /// What a property of faces or strips is for.
  enum class Use : std::uint8_t { None, Corners, Texcoords, Texture, Colour };

  static std::vector<Use> uses_of(const PlyElement& element, const std::vector<Role>& roles) {
    const bool face = element.name == "face";
    std::vector<Use> uses;
    for (std::size_t p = 0; p < roles.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      const std::string& name = property.name;
      Use use = Use::None;
      if (property.count_type) {
        const bool corners = name == "vertex_indices" || name == "vertex_index";
        if (corners && (face || element.name == "tristrips")) use = Use::Corners;
        if (face && name == "texcoord") use = Use::Texcoords;
      } else if (face && name == "texnumber") {
        use = Use::Texture;
      } else if (is_colour(roles[p])) {
        use = Use::Colour;
      }
      uses.push_back(use);
    }
    return uses;
  }

  bool read_property(const PlyProperty& property, Use use, Role role) {
    double value = 0.0;
    switch (use) {
      case Use::Corners:
        return read_list(property, [this](double index) { list_.push_back(to_index(index)); });
      case Use::Texcoords:
        return read_list(property, [this](double x) { textures_.add_coordinate(x); });
      case Use::Texture:
        if (!values_.value(property.type, value)) return false;
        textures_.set_number(value);
        return true;
      case Use::Colour:
        if (!values_.value(property.type, value)) return false;
        colour_[role - Red] = static_cast<float>(value);
        return true;
      case Use::None:
        break;
    }
    return skip_property(property);
  }

  static bool is_colour(Role role) { return role >= Red && role <= Blue; }

  /// The roles of the properties of an element of faces that are part of a colour; Other for all
  /// other properties.
  static std::vector<Role> colour_roles(const PlyElement& element) {
    std::vector<Role> roles;
    for (const PlyProperty& property : element.properties) {
      const Role role = role_of(property.name);
      const bool is_part = element.name == "face" && !property.count_type && is_colour(role);
      roles.push_back(is_part ? role : Other);
    }
    return roles;
  }

  /// The numbers of the colours of an element of faces; nothing if it has none.
  static std::optional<ColourNumbers> numbers_of_colours(const PlyElement& element,
                                                         const std::vector<Role>& roles) {
    for (const Role channel : {Red, Green, Blue}) {
      if (std::ranges::find(roles, channel) == roles.end()) return {};
    }
    for (std::size_t p = 0; p < roles.size(); ++p) {
      if (is_colour(roles[p]) && is_real(element.properties[p].type)) return ColourNumbers::Real;
    }
    return ColourNumbers::Integer;
  }

  template <class Take>
  bool read_list(const PlyProperty& property, const Take& take) {
    std::uint64_t count = 0;
    if (!list_count(property, count)) return false;
    for (std::uint64_t i = 0; i < count; ++i) {
      double value = 0.0;
      if (!values_.value(property.type, value)) return false;
      take(value);
    }
    return true;
  }

  bool skip_property(const PlyProperty& property) {
    return property.count_type ? skip_list(property) : values_.skip_values(property.type, 1);
  }

  bool skip_list(const PlyProperty& property) {
    std::uint64_t count = 0;
    return list_count(property, count) && values_.skip_values(property.type, count);
  }

  /// Reads a list's length; returns false if it is missing or the rest of the file is shorter.
  bool list_count(const PlyProperty& property, std::uint64_t& count) {
    double value = 0.0;
    if (!values_.value(*property.count_type, value)) return false;
    const std::uint64_t longest = values_.left() / Values::min_size(property.type);
    const auto max_length = static_cast<double>(longest);
    impossible_list_ = !(value >= 0.0 && value <= max_length && value == std::floor(value));
    if (impossible_list_) return false;
    count = static_cast<std::uint64_t>(value);
    return true;
  }

  const Source& source_;
  const PlyHeader& header_;
  ReadMeter meter_;
  Values values_;
  Points points_;
  PlyTextures textures_;
  FaceColours colours_;
  glm::vec3 colour_{0.0F};  ///< of the face
  std::vector<std::uint32_t> list_;
  bool impossible_list_ = false;
  bool has_vertices_ = false;  ///< they were read, or the sink has them
};

}  // namespace

bool is_ply(std::string_view text) {
  return text.starts_with("ply") && text.substr(3, 1).find_first_of("\n\r ") == 0;
}

Result<Points> read_ply(const Source& source) {
  RELIEF_TRY_ASSIGN(const auto header, read_ply_header(source));
  const auto vertices = std::ranges::count(header.elements, "vertex", &PlyElement::name);
  if (vertices != 1) {
    return make_error("{}: the header has {} elements 'vertex', but one is needed", source.name,
                      vertices);
  }
  switch (header.encoding) {
    case PlyEncoding::Ascii:
      return PlyBody<PlyAsciiValues>(source, header).read();
    case PlyEncoding::LittleEndian:
      return PlyBody<PlyBinaryValues<false>>(source, header).read();
    case PlyEncoding::BigEndian:
      return PlyBody<PlyBinaryValues<true>>(source, header).read();
  }
  return make_error("{}: unknown PLY encoding", source.name);
}

}  // namespace relief
