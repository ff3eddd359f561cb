// Draco, decoded by Google's library, after a check of the stated counts.
#include <draco/compression/decode.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/geometry_metadata.h>
#include <draco/metadata/metadata_decoder.h>

#include <memory>
#include <utility>

#include "common/guard.h"
#include "preprocess/readers/colours.h"
#include "preprocess/readers/number_type.h"
#include "preprocess/readers/readers.h"

namespace relief {
namespace {

/// The header of bitstream 2.2 (Draco 1.2, 2017) and later, after "DRACO".
struct DracoStart {
  std::uint8_t major = 0;
  std::uint8_t minor = 0;
  std::uint8_t type = 0;
  std::uint8_t method = 0;
  std::uint16_t flags = 0;
  std::uint32_t points = 0;
  std::uint32_t faces = 0;
};

constexpr std::string_view kDracoMagic = "DRACO";
constexpr std::uint16_t kHasMetadata = 0x8000;
/// The densest real coding is near a bit a point; the library allocates any stated count.
constexpr std::uint64_t kMaxPointsPerByte = 256;

/// Skips the metadata.
bool skip_metadata(draco::DecoderBuffer& buffer) {
  draco::GeometryMetadata metadata;
  return draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata);
}

/// Reads up to the counts. Returns false if the bytes end or are invalid.
bool read_start(std::string_view text, DracoStart& start) {
  draco::DecoderBuffer buffer;
  buffer.Init(text.data(), text.size());
  buffer.Advance(static_cast<std::int64_t>(kDracoMagic.size()));
  if (!buffer.Decode(&start.major) || !buffer.Decode(&start.minor) || !buffer.Decode(&start.type) ||
      !buffer.Decode(&start.method) || !buffer.Decode(&start.flags)) {
    return false;
  }
  if (start.major != 2 || start.minor < 2) return true;
  buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(start.major, start.minor));
  if ((start.flags & kHasMetadata) != 0 && !skip_metadata(buffer)) return false;
  if (start.type == draco::POINT_CLOUD) return buffer.Decode(&start.points);
  if (start.type != draco::TRIANGULAR_MESH) return false;
  if (start.method == draco::MESH_SEQUENTIAL_ENCODING) {
    return draco::DecodeVarint(&start.faces, &buffer) &&
           draco::DecodeVarint(&start.points, &buffer);
  }
  std::uint8_t traversal = 0;
  return buffer.Decode(&traversal) && draco::DecodeVarint(&start.points, &buffer) &&
         draco::DecodeVarint(&start.faces, &buffer);
}

Status check_start(const Source& source) {
  DracoStart start;
  if (!read_start(source.text, start)) {
    return make_error("{}: its header is cut or damaged", source.name);
  }
  if (start.major != 2 || start.minor < 2) {
    return make_error(
        "{}: has Draco bitstream {}.{}, which cannot be read; encode it again with Draco 1.2 or "
        "later",
        source.name, start.major, start.minor);
  }
  const std::uint64_t limit = source.text.size() * kMaxPointsPerByte;
  if (start.points > limit || start.faces > limit) {
    return make_error("{}: states {} points and {} faces, which cannot be in {} bytes", source.name,
                      start.points, start.faces, source.text.size());
  }
  if (start.points >= kNoPoint) return too_many_points(source, start.points);
  return {};
}

bool is_number(draco::DataType type) {
  return type >= draco::DT_INT8 && type <= draco::DT_FLOAT64;
}

/// The types have Draco's order, but Draco counts from 1.
NumberType number_type(draco::DataType type) {
  return static_cast<NumberType>(type - draco::DT_INT8);
}

/// Values of an attribute, one for each point; empty if it has fewer components, or damaged ones.
/// Draco's own conversion would trust the file's bools and truncate integers.
template <class Vector>
std::vector<Vector> values_of(const draco::PointCloud& cloud, const draco::PointAttribute* from) {
  constexpr auto components = static_cast<std::size_t>(Vector::length());
  std::vector<Vector> values;
  if (from == nullptr || from->num_components() < components || !is_number(from->data_type()))
    return values;
  const NumberType type = number_type(from->data_type());
  const std::size_t size = size_of(type);
  values.reserve(cloud.num_points());
  for (draco::PointIndex i(0); i < cloud.num_points(); ++i) {
    if (!from->is_mapping_identity() && i.value() >= from->indices_map_size()) return {};
    const draco::AttributeValueIndex index = from->mapped_index(i);
    const auto at = static_cast<std::uint64_t>(from->GetBytePos(index));
    if (index.value() >= from->size() || at > from->buffer()->data_size() ||
        from->buffer()->data_size() - at < components * size) {
      return {};
    }
    const auto* const bytes = reinterpret_cast<const char*>(from->buffer()->data() + at);
    Vector& value = values.emplace_back();
    for (std::size_t c = 0; c < components; ++c) {
      value[static_cast<glm::length_t>(c)] =
          static_cast<typename Vector::value_type>(load_number<false>(type, bytes + c * size));
    }
  }
  return values;
}

std::vector<glm::u8vec3> colours_of(const draco::PointCloud& cloud) {
  const auto* const from = cloud.GetNamedAttribute(draco::GeometryAttribute::COLOR);
  if (from == nullptr || !is_number(from->data_type())) return {};
  return to_colours(values_of<glm::vec3>(cloud, from), is_real(number_type(from->data_type()))
                                                           ? ColourNumbers::Real
                                                           : ColourNumbers::Integer);
}

Points points_of(const draco::PointCloud& cloud) {
  using Attribute = draco::GeometryAttribute;
  Points points;
  points.positions = values_of<glm::dvec3>(cloud, cloud.GetNamedAttribute(Attribute::POSITION));
  if (points.positions.empty()) return points;
  points.normals = values_of<glm::vec3>(cloud, cloud.GetNamedAttribute(Attribute::NORMAL));
  points.colours = colours_of(cloud);
  points.texcoords = values_of<glm::vec2>(cloud, cloud.GetNamedAttribute(Attribute::TEX_COORD));
  return points;
}

Result<Points> decode(const Source& source) {
  RELIEF_TRY(check_start(source));
  draco::DecoderBuffer buffer;
  buffer.Init(source.text.data(), source.text.size());
  draco::Decoder decoder;
  // A mesh comes as its base class, a cloud.
  const auto decoded = decoder.DecodePointCloudFromBuffer(&buffer);
  if (!decoded.ok()) {
    return make_error("{}: cannot be decoded ({}); the file is truncated or damaged", source.name,
                      decoded.status().error_msg_string().empty()
                          ? "Draco gives no reason"
                          : decoded.status().error_msg_string());
  }
  const draco::PointCloud& cloud = *decoded.value();
  Points points = points_of(cloud);
  if (points.positions.empty() && cloud.num_points() > 0) {
    return make_error("{}: its points have no positions of three coordinates", source.name);
  }
  if (const auto* const mesh = dynamic_cast<const draco::Mesh*>(&cloud)) {
    points.triangles.reserve(mesh->num_faces());
    for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f) {
      const auto& face = mesh->face(f);
      points.triangles.push_back({face[0].value(), face[1].value(), face[2].value()});
    }
  }
  return points;
}

}  // namespace

bool is_drc(std::string_view text) {
  return text.starts_with(kDracoMagic);
}

Result<Points> read_drc(const Source& source) {
  return guarded({.subject = source.name,
                  .task = "decode it",
                  .library = "Draco",
                  .advice = "the file may be damaged: write it again, or convert it to PLY",
                  .memory_advice = "convert it to PLY, which --memory reads in blocks"},
                 [&] { return decode(source); });
}

}  // namespace relief
