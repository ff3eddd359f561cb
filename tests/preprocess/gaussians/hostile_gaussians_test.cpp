// Readers of Gaussians on damaged files: an answer for each, never a crash or a heap of memory.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/preprocess/gaussians/gaussian_files.h"

namespace relief::test {
namespace {

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(std::min(at, text.size()), from.size(), to);
}

/// `bytes` with others from an offset on.
std::string patched(std::string bytes, std::size_t at, std::string_view with) {
  return bytes.replace(at, with.size(), with);
}

TEST(HostileGaussiansTest, WrongPly) {
  const std::string plain = plain_ply(sample_scene(1), "binary_little_endian");
  const std::string text = plain_ply(sample_scene(0), "ascii");
  const std::string many = replaced(plain, "vertex 3", "vertex 4000000000");
  EXPECT_EQ(gaussians_error("a.ply", many),
            fmt::format("the header states 4000000000 elements 'vertex', but the 312 bytes after "
                        "byte {} cannot hold them; the file is truncated or damaged",
                        many.size() - 312));
  EXPECT_EQ(gaussians_error("a.ply", replaced(plain, "f_rest_8", "f_extra")),
            "has 8 properties f_rest_0, f_rest_1 and so on, which is no degree of harmonics: "
            "expected 0, 9, 24, 45 or 72");
  EXPECT_EQ(gaussians_error("a.ply", replaced(plain, "f_rest_8", "f_rest_9")),
            "its elements 'vertex' have no property f_rest_8; write the scene again");
  EXPECT_EQ(gaussians_error("a.ply", replaced(plain, "scale_2", "scale_3")),
            "its elements 'vertex' have no property scale_2; write the scene again");
  EXPECT_EQ(gaussians_error("a.ply", replaced(plain, "scale_0", "scale_3")),
            "its vertices have no properties f_dc_0, opacity, scale_0 and rot_0, so it is not a "
            "scene of Gaussians");
  EXPECT_EQ(
      gaussians_error("a.ply", replaced(text, "element vertex",
                                        "element face 1\nproperty list uchar int vertex_index\n"
                                        "element vertex")),
      "its elements 'face' have lists before the Gaussians, which is not read; write it again "
      "without them");
  EXPECT_EQ(gaussians_error("a.ply", replaced(text, "1.25 ", "none ")),
            "line 23: expected a number, found 'none' (vertex 1 of 3); the file is truncated or "
            "damaged");
}

TEST(HostileGaussiansTest, WrongCompressedPly) {
  const std::string file = compressed_ply(sample_scene(1), true);
  EXPECT_EQ(gaussians_error("a.ply", replaced(file, "element sh 3", "element sh 2")),
            "has harmonics of 2 Gaussians, but there are 3; the header is damaged");
  EXPECT_EQ(gaussians_error("a.ply", replaced(file, "chunk 1", "chunk 0")),
            "has 0 chunks for 3 Gaussians, but a chunk is for 256 of them; the header is damaged");
  EXPECT_EQ(gaussians_error("a.ply", replaced(file, "max_b", "max_a")),
            "its elements 'chunk' have no property max_b; write the scene again");
  EXPECT_EQ(gaussians_error("a.ply", replaced(file, "f_rest_8", "f_extra")),
            "has 8 properties f_rest_0, f_rest_1 and so on, which is no degree of harmonics: "
            "expected 0, 9, 24, 45 or 72");
}

TEST(HostileGaussiansTest, WrongSpz) {
  const std::string file = packed_spz(sample_scene(1));
  const std::string plain = plain_spz(sample_scene(1), 3);
  EXPECT_EQ(gaussians_error("a.spz", "NGSQ"),
            "does not begin with NGSP, so it is not an .spz file");
  EXPECT_EQ(gaussians_error("a.spz", gzip("NGSP")),
            "ends within its header; the file is truncated");
  EXPECT_EQ(gaussians_error("a.spz", patched(file, 4, pack(5))),
            "is of version 5 of .spz, but versions 1 to 4 are read");
  EXPECT_EQ(gaussians_error("a.spz", gzip(patched(plain, 4, pack(4)))),
            "is of version 4 of .spz, but packed with gzip as those up to 3");
  EXPECT_EQ(gaussians_error("a.spz", patched(plain, 12, "\x05")),
            "has harmonics of degree 5, but at most 4 is read");
  EXPECT_EQ(gaussians_error("a.spz", patched(plain, 13, "\x19")),
            "positions have 25 fractional bits of 24; the header is damaged");
  EXPECT_EQ(gaussians_error("a.spz", patched(plain, 14, "\x80")),
            "holds a tree of levels of detail (Spark), which is not read; export the scene without "
            "levels");
  EXPECT_EQ(gaussians_error("a.spz", gzip(patched(plain, 8, pack(4)))),
            "its 4 Gaussians need 116 bytes, but there are 87; the file is truncated");
  EXPECT_EQ(gaussians_error("a.spz", patched(file, 15, "\x05")),
            "has 5 streams, but its Gaussians need 6; the header is damaged");
  EXPECT_EQ(
      gaussians_error("a.spz", patched(file, 16, pack(8))),
      fmt::format("its table of contents is at byte 8 of {}; the file is truncated or damaged",
                  file.size()));
  EXPECT_EQ(gaussians_error("a.spz", file + "a"),
            "the streams are followed by 1 bytes; the file is damaged");
}

TEST(HostileGaussiansTest, SpzStreamsHoldWhatTheCountNeeds) {
  const SampleScene scene = sample_scene(0);
  const std::string file = packed_spz(scene);
  // Many more Gaussians than the file can hold: refused before memory is taken.
  for (const std::string& many : {patched(file, 8, pack(4'000'000'000U)),
                                  gzip(patched(plain_spz(scene, 2), 8, pack(4'000'000'000U)))}) {
    EXPECT_NE(gaussians_error("a.spz", many).find("states 4000000000 Gaussians, which are"),
              std::string::npos);
  }
  EXPECT_EQ(gaussians_error("a.spz", patched(file, 8, pack(4))),
            "a stream is stated to hold 27 bytes, but 4 Gaussians need 36; the file is damaged");
  EXPECT_EQ(
      gaussians_error("a.spz", patched(file, 32, pack(std::uint64_t{1} << 60U))),
      fmt::format("a stream is stated to have 1152921504606846976 bytes, but {} are left; the "
                  "file is truncated or damaged",
                  file.size() - 32 - 80));
  // The first stream decompresses to a megabyte, or to too little.
  for (const std::size_t size : {std::size_t{1} << 20U, std::size_t{26}}) {
    const std::string bomb = zstd_pack(std::string(size, '\0'));
    const std::size_t first = 32 + 80;
    const std::string rest = file.substr(first + static_cast<unsigned char>(file[32]));
    const std::string bytes =
        patched(file.substr(0, first), 32, pack(std::uint64_t{bomb.size()})) + bomb + rest;
    EXPECT_EQ(
        gaussians_error("a.spz", bytes),
        "a compressed stream does not hold the 27 bytes that the table of contents states; the "
        "file is damaged");
  }
  // A gzip file that goes on for a gigabyte is read as far as it is needed.
  std::string endless = gzip(plain_spz(scene, 3) + std::string(std::size_t{1} << 26U, '\0'));
  EXPECT_EQ(gaussians_of("a.spz", endless).size(), 3U);
}

TEST(HostileGaussiansTest, WrongExtensions) {
  const auto with = [](const std::string& extensions) {
    return packed_spz(sample_scene(0), {.flags = 2, .extensions = extensions});
  };
  EXPECT_EQ(gaussians_error("a.spz", with("abc")), "an extension is cut off");
  EXPECT_EQ(gaussians_error("a.spz", with(pack(1, 9) + "abc")),
            "an extension states 9 bytes, but 3 are left; the file is damaged");
  EXPECT_EQ(
      gaussians_error("a.spz", with(pack(0xADBE0003U, 4, 16))),
      "its extension states coordinate system 16, but those of 1 to 8 are read, in which Y is "
      "up or down; export the scene in one of them");
}

TEST(HostileGaussiansTest, AFileCutAnywhereIsRefused) {
  for (const GaussianFile& file : gaussian_files()) {
    ASSERT_TRUE(try_gaussians(file.name, file.bytes)) << file.name;
    // The last number of a text may lose digits.
    const std::size_t complete = file.name.starts_with("ascii")
                                     ? file.bytes.find_last_of(' ', file.bytes.size() - 3) + 2
                                     : file.bytes.size();
    for (std::size_t length = 0; length < complete; ++length) {
      EXPECT_FALSE(try_gaussians(file.name, std::string_view(file.bytes).substr(0, length)))
          << file.name << " cut to " << length;
    }
  }
}

TEST(HostileGaussiansTest, DamagedBytesGiveAnAnswer) {
  std::mt19937 random(1);  // a fixed seed: each run tries the same files
  std::size_t errors = 0;
  std::size_t read = 0;
  for (const GaussianFile& file : gaussian_files()) {
    for (int i = 0; i < 300; ++i) {
      std::string bytes = file.bytes;
      const unsigned changes = 1 + random() % 4;
      for (unsigned c = 0; c < changes; ++c)
        bytes[random() % bytes.size()] = static_cast<char>(random());
      const auto cloud = try_gaussians(file.name, bytes);
      if (!cloud) {
        ++errors;
        continue;
      }
      ++read;
      for (std::size_t k = 0; k < cloud->size(); ++k) {
        ASSERT_NEAR(glm::length(cloud->rotations[k]), 1.0F, 1e-5F) << file.name;
        ASSERT_GT(cloud->scales[k].x, 0.0F) << file.name;
        ASSERT_TRUE(std::isfinite(cloud->centres[k].x + cloud->harmonics[k].x)) << file.name;
      }
    }
  }
  // If all changes did harm, or none, the files would not have been tried.
  EXPECT_GT(errors, 100U);
  EXPECT_GT(read, 100U);
}

}  // namespace
}  // namespace relief::test
