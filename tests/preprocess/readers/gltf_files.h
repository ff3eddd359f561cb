// glTF files, made for the tests.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tests/preprocess/readers/pack.h"

namespace relief::test {

inline std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t bits = 0;
    for (std::size_t b = 0; b < 3; ++b)
      bits = bits << 8U | (k + b < bytes.size() ? static_cast<unsigned char>(bytes[k + b]) : 0U);
    for (std::size_t d = 0; d < 4; ++d)
      text += k + d > bytes.size() ? '=' : digits[bits >> (18 - 6 * d) & 63U];
  }
  return text;
}

/// A triangle in the plane z = 0 with texture coordinates and 16-bit indices: 36 + 24 + 6 bytes.
inline std::string triangle_bytes() {
  return pack(0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F) + pack(0.F, 0.F, 1.F, 0.F, 0.F, 1.F) +
         pack(std::uint16_t{0}, std::uint16_t{1}, std::uint16_t{2});
}

/// The rest of the file; `buffer` is its buffer's uri as a member with a comma, or nothing.
inline std::string document(const std::string& buffer, const std::string& nodes) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": )" +
         nodes + R"(, "buffers": [{)" + buffer + R"("byteLength": 66}], "bufferViews": [
    {"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24},
    {"buffer": 0, "byteOffset": 60, "byteLength": 6}], "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
    {"bufferView": 2, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "materials": [{"name": "m", "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 1]}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2,
    "material": 0}]}]})";
}

inline const std::string kNode = R"([{"mesh": 0}])";

inline std::string embedded(const std::string& nodes = kNode) {
  return document(
      R"("uri": "data:application/octet-stream;base64,)" + base64(triangle_bytes()) + "\", ",
      nodes);
}

inline std::string binary_gltf() {
  std::string json = document("", kNode);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string bytes = triangle_bytes() + std::string(2, '\0');
  const auto length = [](const std::string& text) {
    return static_cast<std::uint32_t>(text.size());
  };
  return pack(std::uint32_t{0x46546C67}, std::uint32_t{2}, 28 + length(json) + length(bytes),
              length(json), std::uint32_t{0x4E4F534A}) +
         json + pack(length(bytes), std::uint32_t{0x004E4942}) + bytes;
}

}  // namespace relief::test
