// Scans in each format, made for the tests.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/readers/readers.h"
#include "tests/preprocess/readers/las_files.h"
#include "tests/preprocess/readers/pack.h"

namespace relief::test {

/// What read_points would make of a file with this name and these bytes; nothing is written.
inline Result<ReadResult> try_read(const std::string& name, std::string_view bytes) {
  Progress progress;
  const auto* const begin = reinterpret_cast<const std::byte*>(bytes.data());
  return read_bytes(name, {begin, begin + bytes.size()}, progress);
}

/// The points of a file that must be readable.
inline Points read(const std::string& name, std::string_view bytes) {
  auto result = try_read(name, bytes);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  return std::move(result->points);
}

/// The error of a file that must not be readable.
inline std::string error(const std::string& name, std::string_view bytes) {
  const auto result = try_read(name, bytes);
  if (result) return "no error";
  EXPECT_TRUE(result.error().message.starts_with(name + ": ")) << result.error().message;
  return result.error().message;
}

/// One gzip member.
inline std::string gzip(std::string_view bytes) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  std::string in(bytes);
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// A PCD header for `points` points x y z of type F and the given size, and further fields.
inline std::string pcd_header(std::size_t points, std::string_view data, int size = 4,
                              const std::array<std::string_view, 4>& more = {}) {
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z{}\nSIZE {} {} {}{}\n"
      "TYPE F F F{}\nCOUNT 1 1 1{}\nWIDTH {}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA "
      "{}\n",
      more[0], size, size, size, more[1], more[2], more[3], points, points, data);
}

/// LZF made of literals alone: legal, and readable by every LZF decoder.
inline std::string lzf_literals(std::string_view bytes) {
  std::string out;
  for (; !bytes.empty(); bytes.remove_prefix(std::min<std::size_t>(32, bytes.size()))) {
    const std::string_view run = bytes.substr(0, 32);
    out += static_cast<char>(run.size() - 1);
    out += run;
  }
  return out;
}

/// A small file of one format, whole, with four points and two triangles where the format has them.
struct SampleFile {
  std::string name;
  std::string bytes;
  bool states_counts;  ///< a file cut short anywhere but in its last number is damaged
};

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
      {"points.xyz", points, false},
      {"table.csv", "x,y,z,r,g,b\n0,0,0,1,2,3\n1,0,0,4,5,6\n0,1.5,0,7,8,9\n0,0,2,10,11,255\n",
       false},
      {"gzipped.ply.gz", gzip(ply_header("ascii") + points + faces), true},
  };
}

}  // namespace relief::test
