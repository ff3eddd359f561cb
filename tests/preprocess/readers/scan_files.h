// Scans in each format, made for the tests.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/readers/readers.h"
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

/// LZF of literals only: legal, and readable by every LZF decoder.
inline std::string lzf_literals(std::string_view bytes) {
  std::string out;
  for (; !bytes.empty(); bytes.remove_prefix(std::min<std::size_t>(32, bytes.size()))) {
    const std::string_view run = bytes.substr(0, 32);
    out += static_cast<char>(run.size() - 1);
    out += run;
  }
  return out;
}

}  // namespace relief::test
