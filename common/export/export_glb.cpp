#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/bounds.h"
#include "common/export/export.h"
#include "common/export/export_file.h"
#include "common/image/srgb.h"
#include "common/version.h"

namespace relief {
namespace {

using nlohmann::ordered_json;

// glTF 2.0, sections 3.6 (types), 3.7 (modes, attributes) and 4.4 (chunks).
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr std::uint32_t kMagic = 0x46546C67;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

/// Returns the nearest float. Not by a cast: GCC 12.2 at -O2 takes two casts to float and back
/// beside each other for nothing to do.
double rounded_to_float(double value) {
  constexpr int bits = 24;
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(fraction, bits)), exponent - bits);
}

glm::dvec3 rounded_to_floats(glm::dvec3 v) {
  return {rounded_to_float(v.x), rounded_to_float(v.y), rounded_to_float(v.z)};
}

/// The world position of the mesh's origin, as floats, because many programs read no more.
glm::dvec3 origin_of(const ExportRequest& request) {
  if (!needs_doubles(request.points, request.tolerance)) return glm::dvec3(0.0);
  const Bounds box = bounds_of(request.points.positions);
  return rounded_to_floats((box.min + box.max) / 2.0);
}

/// Buffer views and accessors, one of each for every array, in the order of the buffer.
class Layout {
 public:
  /// Adds an array and returns its accessor's index.
  ordered_json add(std::size_t count, std::size_t element, int component, std::string_view type,
                   int target) {
    views_.push_back({{"buffer", 0},
                      {"byteOffset", bytes_},
                      {"byteLength", count * element},
                      {"target", target}});
    bytes_ += count * element;
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", component},
                          {"count", count},
                          {"type", type}});
    return accessors_.size() - 1;
  }
  ordered_json& last_accessor() { return accessors_.back(); }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  [[nodiscard]] const ordered_json& views() const { return views_; }
  [[nodiscard]] const ordered_json& accessors() const { return accessors_; }

 private:
  ordered_json views_ = ordered_json::array();
  ordered_json accessors_ = ordered_json::array();
  std::uint64_t bytes_ = 0;
};

ordered_json numbers_of(glm::dvec3 v) {
  return {v.x, v.y, v.z};
}

/// Returns the JSON of the file; sets `buffer_bytes` to the size of its buffer.
std::string document_of(const ExportRequest& request, glm::dvec3 origin,
                        std::uint64_t& buffer_bytes) {
  const Points& points = request.points;
  const Bounds box = bounds_of(points.positions);
  Layout layout;
  ordered_json attributes;
  attributes["POSITION"] = layout.add(points.size(), 12, kFloat, "VEC3", kArrayBuffer);
  // The bounds have to be those of the floats.
  layout.last_accessor()["min"] = numbers_of(rounded_to_floats(box.min - origin));
  layout.last_accessor()["max"] = numbers_of(rounded_to_floats(box.max - origin));
  if (!points.normals.empty())
    attributes["NORMAL"] = layout.add(points.size(), 12, kFloat, "VEC3", kArrayBuffer);
  if (!points.colours.empty()) {
    attributes["COLOR_0"] = layout.add(points.size(), 8, kUnsignedShort, "VEC4", kArrayBuffer);
    layout.last_accessor()["normalized"] = true;
  }
  ordered_json primitive = {{"attributes", attributes}, {"material", 0}};
  if (points.triangles.empty()) {
    primitive["mode"] = 0;
  } else {
    primitive["indices"] =
        layout.add(3 * points.triangles.size(), 4, kUnsignedInt, "SCALAR", kElementArrayBuffer);
  }
  ordered_json node = {{"mesh", 0}};
  if (origin != glm::dvec3(0.0)) node["translation"] = numbers_of(origin);
  buffer_bytes = layout.bytes();
  // A material makes the surface non-metallic; glTF's default is metal.
  const ordered_json document = {
      {"asset", {{"version", "2.0"}, {"generator", fmt::format("relief {}", kVersion)}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {node}},
      {"meshes", {{{"primitives", {primitive}}}}},
      {"materials",
       {{{"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}},
         {"doubleSided", !request.is_closed}}}},
      {"accessors", layout.accessors()},
      {"bufferViews", layout.views()},
      {"buffers", {{{"byteLength", buffer_bytes}}}}};
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return text;
}

std::uint16_t linear16(std::uint8_t srgb) {
  return static_cast<std::uint16_t>(std::lround(linear_from_srgb8(srgb) * 65535.0F));
}

void write_buffer(const Points& points, glm::dvec3 origin, ExportFile& file) {
  for (const glm::dvec3 position : points.positions) {
    const glm::vec3 p(position - origin);
    file.numbers(p.x, p.y, p.z);
    if (!file.end_record()) return;
  }
  for (const glm::vec3 n : points.normals) {
    file.numbers(n.x, n.y, n.z);
    if (!file.end_record()) return;
  }
  for (const glm::u8vec3 c : points.colours) {
    file.numbers(linear16(c.r), linear16(c.g), linear16(c.b), std::uint16_t{65535});
    if (!file.end_record()) return;
  }
  for (const Triangle& t : points.triangles) {
    file.numbers(t[0], t[1], t[2]);
    if (!file.end_record()) return;
  }
}

}  // namespace

Status export_glb(const std::filesystem::path& path, const ExportRequest& request,
                  Progress& progress) {
  const Points& points = request.points;
  const glm::dvec3 origin = origin_of(request);
  std::uint64_t buffer_bytes = 0;
  const std::string document = document_of(request, origin, buffer_bytes);
  const std::uint64_t bytes = 12 + 8 + document.size() + 8 + buffer_bytes;
  if (bytes > UINT32_MAX) {
    return make_error("{}: would have {} bytes, but glTF allows 4 GiB; export a .ply instead",
                      path.string(), bytes);
  }
  RELIEF_TRY_ASSIGN(
      auto file, ExportFile::create(path,
                                    points.size() + points.normals.size() + points.colours.size() +
                                        points.triangles.size(),
                                    progress));
  const auto u32 = [](std::uint64_t value) { return static_cast<std::uint32_t>(value); };
  file.numbers(kMagic, std::uint32_t{2}, u32(bytes), u32(document.size()), kJsonChunk);
  file.text(document);
  file.numbers(u32(buffer_bytes), kBinaryChunk);
  write_buffer(points, origin, file);
  return file.finish();
}

}  // namespace relief
