// One small scene of Gaussians in each format, made for the tests.
#pragma once

#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/gaussians/gaussian_readers.h"
#include "tests/preprocess/readers/pack.h"
#include "tests/preprocess/readers/scan_files.h"

namespace relief::test {

/// A Gaussian as the formats have it.
struct SampleGaussian {
  glm::vec3 centre;
  glm::vec3 log_scales;
  glm::quat rotation;
  float opacity;
  std::vector<glm::vec3> harmonics;
};

struct SampleScene {
  int degree = 0;
  std::vector<SampleGaussian> gaussians;
};

/// Gaussians of which no two numbers are the same. Opacities are neither 0 nor 1; scales lie
/// between e^-6 and 1.
inline SampleScene sample_scene(int degree, std::size_t count = 3) {
  SampleScene scene{degree, {}};
  for (std::size_t k = 0; k < count; ++k) {
    const auto f = static_cast<float>(k);
    SampleGaussian g{
        .centre = {1.25F + f, -2.5F + 0.3F * f, 0.75F - 0.9F * f},
        .log_scales = {-1.5F - 0.11F * f, -2.9F + 0.2F * f, -4.3F + 0.07F * f},
        .rotation = glm::normalize(glm::quat(0.8F, 0.3F - 0.2F * f, -0.4F + 0.03F * f, 0.5F)),
        .opacity = 0.2F + 0.6F / (1.0F + f),
        .harmonics = {}};
    for (std::size_t c = 0; c < harmonics_of(degree); ++c) {
      const float phase = static_cast<float>(c) + 0.37F * f;
      g.harmonics.emplace_back(0.9F * std::sin(phase + 1.0F), 0.8F * std::sin(2.3F * phase + 2.0F),
                               0.7F * std::sin(3.1F * phase + 3.0F));
    }
    scene.gaussians.push_back(std::move(g));
  }
  return scene;
}

/// The header of the files that training writes.
inline std::string plain_ply_header(std::string_view format, std::size_t count, int degree) {
  std::string header =
      fmt::format("ply\nformat {} 1.0\ncomment made here\nelement vertex {}\n", format, count);
  const auto add = [&](std::string_view name) {
    header += fmt::format("property float {}\n", name);
  };
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"})
    add(name);
  for (std::size_t k = 0; k < 3 * (harmonics_of(degree) - 1); ++k) add(fmt::format("f_rest_{}", k));
  for (const char* name :
       {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
    add(name);
  return header + "end_header\n";
}

/// The numbers of a row, in the order of plain_ply_header. The quaternion is of length 3.
inline std::vector<float> plain_ply_row(const SampleGaussian& g) {
  const glm::vec3 c = g.centre;
  std::vector<float> row = {c.x, c.y, c.z, 0.0F, 0.0F, 0.0F};
  for (glm::length_t a = 0; a < 3; ++a) row.push_back(g.harmonics[0][a]);
  for (glm::length_t a = 0; a < 3; ++a) {
    for (std::size_t k = 1; k < g.harmonics.size(); ++k) row.push_back(g.harmonics[k][a]);
  }
  row.push_back(std::log(g.opacity / (1.0F - g.opacity)));
  for (glm::length_t a = 0; a < 3; ++a) row.push_back(g.log_scales[a]);
  for (const float q : {g.rotation.w, g.rotation.x, g.rotation.y, g.rotation.z})
    row.push_back(3.0F * q);
  return row;
}

inline std::string plain_ply(const SampleScene& scene, std::string_view format) {
  std::string file = plain_ply_header(format, scene.gaussians.size(), scene.degree);
  for (const SampleGaussian& g : scene.gaussians) {
    for (const float number : plain_ply_row(g)) {
      if (format == "ascii")
        file += fmt::format("{} ", number);
      else
        file += pack(format == "binary_big_endian" ? ByteOrder::Big : ByteOrder::Little, number);
    }
    if (format == "ascii") file += '\n';
  }
  return file;
}

/// A number from 0 to 1 as `bits` bits.
inline std::uint32_t as_bits(float share, unsigned bits) {
  const auto largest = static_cast<float>((1U << bits) - 1U);
  return static_cast<std::uint32_t>(std::clamp(std::round(share * largest), 0.0F, largest));
}

inline std::uint32_t as_11_10_11(glm::vec3 shares) {
  return as_bits(shares.x, 11) << 21U | as_bits(shares.y, 10) << 11U | as_bits(shares.z, 11);
}

inline char as_byte(float number) {
  return static_cast<char>(
      static_cast<unsigned char>(std::clamp(std::round(number), 0.0F, 255.0F)));
}

/// SuperSplat's file. Ranges are wider than the scene: -4 to 5, -8 to 1, and colours -0.5 to 1.5.
inline std::string compressed_ply(const SampleScene& scene, bool has_colour_ranges) {
  const std::size_t count = scene.gaussians.size();
  const std::size_t chunks = (count + 255) / 256;
  std::string file =
      fmt::format("ply\nformat binary_little_endian 1.0\nelement chunk {}\n", chunks);
  for (const char* name :
       {"min_x", "min_y", "min_z", "max_x", "max_y", "max_z", "min_scale_x", "min_scale_y",
        "min_scale_z", "max_scale_x", "max_scale_y", "max_scale_z"})
    file += fmt::format("property float {}\n", name);
  if (has_colour_ranges) {
    for (const char* name : {"min_r", "min_g", "min_b", "max_r", "max_g", "max_b"})
      file += fmt::format("property float {}\n", name);
  }
  file += fmt::format("element vertex {}\n", count);
  for (const char* name : {"packed_position", "packed_rotation", "packed_scale", "packed_color"})
    file += fmt::format("property uint {}\n", name);
  const std::size_t rest = harmonics_of(scene.degree) - 1;
  if (rest > 0) file += fmt::format("element sh {}\n", count);
  for (std::size_t k = 0; k < 3 * rest; ++k) file += fmt::format("property uchar f_rest_{}\n", k);
  file += "end_header\n";
  for (std::size_t k = 0; k < chunks; ++k) {
    file += pack(-4.F, -4.F, -4.F, 5.F, 5.F, 5.F, -8.F, -8.F, -8.F, 1.F, 1.F, 1.F);
    if (has_colour_ranges) file += pack(-0.5F, -0.5F, -0.5F, 1.5F, 1.5F, 1.5F);
  }
  for (const SampleGaussian& g : scene.gaussians) {
    const std::array<float, 4> q = {g.rotation.w, g.rotation.x, g.rotation.y, g.rotation.z};
    const auto largest = static_cast<std::size_t>(
        std::ranges::max_element(q, {}, [](float c) { return std::abs(c); }) - q.begin());
    auto rotation = static_cast<std::uint32_t>(largest);
    for (std::size_t k = 0; k < 4; ++k) {
      const float component = q[largest] < 0.0F ? -q[k] : q[k];
      if (k != largest)
        rotation = rotation << 10U | as_bits(component * std::sqrt(0.5F) + 0.5F, 10);
    }
    glm::vec3 colour = 0.5F + 0.28209479F * g.harmonics[0];
    if (has_colour_ranges) colour = (colour + 0.5F) / 2.0F;
    file += pack(as_11_10_11((g.centre + 4.0F) / 9.0F), rotation,
                 as_11_10_11((g.log_scales + 8.0F) / 9.0F),
                 as_bits(colour.x, 8) << 24U | as_bits(colour.y, 8) << 16U |
                     as_bits(colour.z, 8) << 8U | as_bits(g.opacity, 8));
  }
  for (const SampleGaussian& g : scene.gaussians) {
    for (glm::length_t a = 0; a < 3; ++a) {
      for (std::size_t k = 1; k <= rest; ++k)
        file += as_byte(std::floor((g.harmonics[k][a] / 8.0F + 0.5F) * 256.0F));
    }
  }
  return file;
}

/// Three of x y z w, as of version 3.
inline std::uint32_t smallest_three(glm::quat rotation) {
  const std::array<float, 4> q = {rotation.x, rotation.y, rotation.z, rotation.w};
  const auto largest = static_cast<std::size_t>(
      std::ranges::max_element(q, {}, [](float c) { return std::abs(c); }) - q.begin());
  auto packed = static_cast<std::uint32_t>(largest);
  for (std::size_t k = 0; k < 4; ++k) {
    if (k == largest) continue;
    const std::uint32_t sign = (q[k] < 0.0F) != (q[largest] < 0.0F) ? 1 : 0;
    packed = packed << 10U | sign << 9U | as_bits(std::abs(q[k]) * std::sqrt(2.0F), 9);
  }
  return packed;
}

/// The streams of an .spz file: positions, opacities, colours, scales, rotations, harmonics.
inline std::vector<std::string> spz_streams(const SampleScene& scene, std::uint32_t version) {
  std::vector<std::string> streams(scene.degree > 0 ? 6 : 5);
  for (const SampleGaussian& g : scene.gaussians) {
    for (glm::length_t a = 0; a < 3; ++a) {
      if (version == 1) {
        streams[0] += pack(glm::packHalf1x16(g.centre[a]));
      } else {
        streams[0] +=
            pack(static_cast<std::int32_t>(std::round(g.centre[a] * 4096.0F))).substr(0, 3);
      }
      streams[2] += as_byte((g.harmonics[0][a] * 0.15F + 0.5F) * 255.0F);
      streams[3] += as_byte((g.log_scales[a] + 10.0F) * 16.0F);
    }
    streams[1] += as_byte(g.opacity * 255.0F);
    if (version < 3) {
      for (const float q : {g.rotation.x, g.rotation.y, g.rotation.z})
        streams[4] += as_byte((g.rotation.w < 0.0F ? -q : q) * 127.5F + 127.5F);
    } else {
      streams[4] += pack(smallest_three(g.rotation));
    }
    for (std::size_t c = 1; c < g.harmonics.size(); ++c) {
      for (glm::length_t a = 0; a < 3; ++a)
        streams[5] += as_byte(g.harmonics[c][a] * 128.0F + 128.0F);
    }
  }
  return streams;
}

struct SpzExtras {
  std::uint8_t flags = 0;
  std::string extensions;
};

/// Versions 1 to 3, not yet packed with gzip.
inline std::string plain_spz(const SampleScene& scene, std::uint32_t version,
                             const SpzExtras& extras = {}) {
  std::string file = "NGSP" + pack(version, static_cast<std::uint32_t>(scene.gaussians.size()),
                                   static_cast<std::uint8_t>(scene.degree), std::uint8_t{12},
                                   extras.flags, std::uint8_t{0});
  for (const std::string& stream : spz_streams(scene, version)) file += stream;
  return file + extras.extensions;
}

inline std::string zstd_pack(std::string_view bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3));
  return packed;
}

/// Version 4.
inline std::string packed_spz(const SampleScene& scene, const SpzExtras& extras = {}) {
  const auto streams = spz_streams(scene, 4);
  std::string file =
      "NGSP" + pack(std::uint32_t{4}, static_cast<std::uint32_t>(scene.gaussians.size()),
                    static_cast<std::uint8_t>(scene.degree), std::uint8_t{12}, extras.flags,
                    static_cast<std::uint8_t>(streams.size()),
                    static_cast<std::uint32_t>(32 + extras.extensions.size()), 0, 0, 0);
  file += extras.extensions;
  std::string packed;
  for (const std::string& stream : streams) {
    const std::string one = zstd_pack(stream);
    file += pack(std::uint64_t{one.size()}, std::uint64_t{stream.size()});
    packed += one;
  }
  return file + packed;
}

inline std::string spz(const SampleScene& scene, std::uint32_t version) {
  return version < 4 ? gzip(plain_spz(scene, version)) : packed_spz(scene);
}

struct GaussianFile {
  std::string name;
  std::string bytes;
};

/// Every format and version, of every degree that it has.
inline std::vector<GaussianFile> gaussian_files() {
  std::vector<GaussianFile> files;
  for (int degree = 0; degree <= kMaxHarmonicsDegree; ++degree) {
    const SampleScene scene = sample_scene(degree);
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
      files.push_back({fmt::format("{}{}.ply", format, degree), plain_ply(scene, format)});
    files.push_back({fmt::format("version4_{}.spz", degree), spz(scene, 4)});
    if (degree == 4) break;
    for (const std::uint32_t version : {1U, 2U, 3U})
      files.push_back({fmt::format("version{}_{}.spz", version, degree), spz(scene, version)});
    files.push_back({fmt::format("plain{}.spz", degree), plain_spz(scene, 3)});
    files.push_back({fmt::format("compressed{}.ply", degree), compressed_ply(scene, true)});
  }
  files.push_back({"old.compressed.ply", compressed_ply(sample_scene(0), false)});
  files.push_back({"packed.ply.gz", gzip(plain_ply(sample_scene(1), "binary_little_endian"))});
  return files;
}

/// Keeps notes, and may be cancelled.
class NotedProgress final : public Progress {
 public:
  void note(std::string_view text) override { notes.emplace_back(text); }
  [[nodiscard]] bool cancelled() const override { return is_cancelled; }

  std::vector<std::string> notes;
  bool is_cancelled = false;
};

/// What read_gaussians would make of a file with this name and these bytes; nothing is written.
inline Result<GaussianCloud> try_gaussians(const std::string& name, std::string_view bytes) {
  Progress progress;
  return read_gaussian_bytes(name, std::as_bytes(std::span(bytes)), progress);
}

/// A file that must be readable.
inline GaussianCloud gaussians_of(const std::string& name, std::string_view bytes) {
  auto cloud = try_gaussians(name, bytes);
  if (!cloud) {
    ADD_FAILURE() << cloud.error().message;
    return {};
  }
  return *std::move(cloud);
}

/// The error, without the file's name, of a file that must not be readable.
inline std::string gaussians_error(const std::string& name, std::string_view bytes) {
  const auto cloud = try_gaussians(name, bytes);
  if (cloud) return "no error";
  const std::string& message = cloud.error().message;
  EXPECT_TRUE(message.starts_with(name + ": ")) << message;
  return message.substr(std::min(name.size() + 2, message.size()));
}

}  // namespace relief::test
