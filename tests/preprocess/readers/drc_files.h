// Draco files, coded by the library for the tests.
#pragma once

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <draco/point_cloud/point_cloud_builder.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>

namespace relief::test {

using Attribute = draco::GeometryAttribute;

/// What the points of both kinds of file are.
inline constexpr std::array<std::array<float, 3>, 4> kDrcPositions{
    {{0, 0, 0}, {1, 0, 0}, {0, 1.5F, 0}, {0, 0, 2}}};
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> kDrcColours{
    {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 255}}};
inline constexpr std::array<std::array<std::uint32_t, 3>, 2> kDrcFaces{{{0, 1, 2}, {0, 2, 3}}};

/// Positions in 14 bits, normals in 10, colours and texture coordinates (a tenth of x and y) as
/// they are.
inline draco::Encoder drc_encoder() {
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(Attribute::POSITION, 14);
  encoder.SetAttributeQuantization(Attribute::NORMAL, 10);
  return encoder;
}

inline std::string drc_bytes(const draco::EncoderBuffer& buffer) {
  return {buffer.data(), buffer.size()};
}

/// A point cloud with colours and normals along +Z.
inline std::string drc_cloud(draco::PointCloudEncodingMethod method) {
  draco::PointCloudBuilder builder;
  builder.Start(4);
  const int positions = builder.AddAttribute(Attribute::POSITION, 3, draco::DT_FLOAT32);
  const int normals = builder.AddAttribute(Attribute::NORMAL, 3, draco::DT_FLOAT32);
  const int colours = builder.AddAttribute(Attribute::COLOR, 3, draco::DT_UINT8);
  constexpr std::array<float, 3> up{0, 0, 1};
  for (std::uint32_t i = 0; i < 4; ++i) {
    builder.SetAttributeValueForPoint(positions, draco::PointIndex(i), kDrcPositions[i].data());
    builder.SetAttributeValueForPoint(normals, draco::PointIndex(i), up.data());
    builder.SetAttributeValueForPoint(colours, draco::PointIndex(i), kDrcColours[i].data());
  }
  const auto cloud = builder.Finalize(false);
  draco::Encoder encoder = drc_encoder();
  encoder.SetEncodingMethod(method);
  draco::EncoderBuffer out;
  return encoder.EncodePointCloudToBuffer(*cloud, &out).ok() ? drc_bytes(out) : std::string();
}

/// The mesh of kDrcFaces with texture coordinates, and what it says about itself.
inline std::string drc_mesh(draco::MeshEncoderMethod method) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(kDrcFaces.size()));
  const int positions = builder.AddAttribute(Attribute::POSITION, 3, draco::DT_FLOAT32);
  const int texcoords = builder.AddAttribute(Attribute::TEX_COORD, 2, draco::DT_FLOAT32);
  for (std::uint32_t f = 0; f < kDrcFaces.size(); ++f) {
    std::array<std::array<float, 2>, 3> uv{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& p = kDrcPositions[kDrcFaces[f][c]];
      uv[c] = {0.1F * p[0], 0.1F * p[1]};
    }
    builder.SetAttributeValuesForFace(
        positions, draco::FaceIndex(f), kDrcPositions[kDrcFaces[f][0]].data(),
        kDrcPositions[kDrcFaces[f][1]].data(), kDrcPositions[kDrcFaces[f][2]].data());
    builder.SetAttributeValuesForFace(texcoords, draco::FaceIndex(f), uv[0].data(), uv[1].data(),
                                      uv[2].data());
  }
  const auto mesh = builder.Finalize();
  auto metadata = std::make_unique<draco::GeometryMetadata>();
  metadata->AddEntryString("author", "made here");
  mesh->AddMetadata(std::move(metadata));
  draco::Encoder encoder = drc_encoder();
  encoder.SetEncodingMethod(method);
  draco::EncoderBuffer out;
  return encoder.EncodeMeshToBuffer(*mesh, &out).ok() ? drc_bytes(out) : std::string();
}

}  // namespace relief::test
