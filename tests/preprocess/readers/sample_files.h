// A small file of each format, made for the tests.
#pragma once

#include <string>
#include <vector>

#include "tests/preprocess/readers/drc_files.h"
#include "tests/preprocess/readers/gltf_files.h"
#include "tests/preprocess/readers/las_files.h"
#include "tests/preprocess/readers/scan_files.h"

namespace relief::test {

/// A small file of one format, whole, with four points and two triangles where the format has them.
/// glTF and Draco files have a triangle.
struct SampleFile {
  std::string name;
  std::string bytes;
  bool states_counts;  ///< a file cut short anywhere but in its last number is damaged
};

/// At least one for each format; the tests of damaged files and the seeds of fuzzing come from
/// here.
inline std::vector<SampleFile> sample_files() {
  const std::string points = "0 0 0\n1 0 0\n0 1.5 0\n0 0 2\n";
  const std::string faces = "3 0 1 2\n3 0 2 3\n";
  const auto ply_header = [](std::string_view format) {
    return fmt::format(
        "ply\nformat {} 1.0\ncomment made here\nelement vertex 4\nproperty float x\n"
        "property float y\nproperty float z\nelement face 2\n"
        "property list uchar int vertex_indices\nend_header\n",
        format);
  };
  const auto ply_body = [](ByteOrder order) {
    return pack(order, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.5F, 0.F, 0.F, 0.F, 2.F) +
           pack(order, std::uint8_t{3}, 0, 1, 2, std::uint8_t{3}, 0, 2, 3);
  };
  const std::string xyz = pack(0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.5F, 0.F, 0.F, 0.F, 2.F);
  const std::string xxyyzz = pack(0.F, 1.F, 0.F, 0.F, 0.F, 0.F, 1.5F, 0.F, 0.F, 0.F, 0.F, 2.F);
  const std::string packed = lzf_literals(xxyyzz);
  std::string stl(80, ' ');
  stl += pack(std::uint32_t{2});
  for (const float z : {0.F, 2.F}) {
    stl += pack(0.F, 0.F, 1.F, 0.F, 0.F, z, 1.F, 0.F, z, 0.F, 1.5F, z, std::uint16_t{0});
  }
  const std::vector<LasPoint> las_points = {
      {{0, 0, 0}}, {{100, 0, 0}}, {{0, 150, 0}}, {{0, 0, 200}}};
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1.5 "
      "0\nendloop\nendfacet\n";
  return {
      {"ascii.ply", ply_header("ascii") + points + faces, true},
      {"little.ply", ply_header("binary_little_endian") + ply_body(ByteOrder::Little), true},
      {"big.ply", ply_header("binary_big_endian") + ply_body(ByteOrder::Big), true},
      {"ascii.pcd", pcd_header(4, "ascii") + points, true},
      {"binary.pcd", pcd_header(4, "binary") + xyz, true},
      {"packed.pcd",
       pcd_header(4, "binary_compressed") +
           pack(static_cast<std::uint32_t>(packed.size()), std::uint32_t{48}) + packed,
       true},
      {"points.las", las_file({.format = 2, .points = las_points}), true},
      {"points14.las",
       las_file({.minor = 4,
                 .format = 7,
                 .extra_bytes = 3,
                 .records = 2,
                 .extended_records = 1,
                 .points = las_points}),
       true},
      {"scan.ptx",
       "2\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n5 6 7 1\n"
       "0 0 1 0.5\n1 0 0 0.5\n0 1.5 0 0.5\n0 0 2 0.5\n",
       true},
      {"mesh.off", "OFF # made here\n4 2 0\n" + points + faces, true},
      {"ascii.stl", "solid made here\n" + facet + facet + "endsolid\n", false},
      {"binary.stl", stl, true},
      {"mesh.obj",
       "v 0 0 0\nv 1 0 0\nv 0 1.5 0\nv 0 0 2\nvn 0 0 1\nvt 0 1\nf 1/1/1 2//1 \\\n3\nf -4 -2 -1\n",
       false},
      {"mesh.gltf", embedded(), true},
      {"mesh.glb", binary_gltf(), true},
      {"cloud.drc", drc_cloud(draco::POINT_CLOUD_SEQUENTIAL_ENCODING), true},
      {"mesh.drc", drc_mesh(draco::MESH_EDGEBREAKER_ENCODING), true},
      {"points.xyz", points, false},
      {"table.csv", "x,y,z,r,g,b\n0,0,0,1,2,3\n1,0,0,4,5,6\n0,1.5,0,7,8,9\n0,0,2,10,11,255\n",
       false},
      {"gzipped.ply.gz", gzip(ply_header("ascii") + points + faces), true},
  };
}

}  // namespace relief::test
