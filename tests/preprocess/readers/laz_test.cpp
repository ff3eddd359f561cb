// LAZ, in builds that have LASzip: what is packed comes back as from the plain file.
#include <laszip/laszip_api.h>

#include <sstream>

#include "tests/preprocess/readers/las_files.h"
#include "tests/preprocess/readers/scan_files.h"

namespace relief::test {
namespace {

/// Packs a LAS file, read by LASzip itself.
std::string packed(const std::string& las) {
  std::istringstream in(las);
  std::ostringstream out;
  laszip_POINTER reader = nullptr;
  laszip_POINTER writer = nullptr;
  laszip_BOOL is_packed = 0;
  EXPECT_EQ(laszip_create(&reader), 0);
  EXPECT_EQ(laszip_create(&writer), 0);
  EXPECT_EQ(laszip_open_reader_stream(reader, in, &is_packed), 0);
  laszip_header_struct* header = nullptr;
  laszip_point_struct* point = nullptr;
  laszip_get_header_pointer(reader, &header);
  laszip_get_point_pointer(reader, &point);
  EXPECT_EQ(laszip_set_header(writer, header), 0);
  laszip_request_native_extension(writer, 1);
  EXPECT_EQ(laszip_open_writer_stream(writer, out, 1, 0), 0);
  laszip_I64 count = 0;
  laszip_get_point_count(reader, &count);
  const auto points = header->number_of_point_records > 0
                          ? std::uint64_t{header->number_of_point_records}
                          : std::uint64_t{header->extended_number_of_point_records};
  for (std::uint64_t i = 0; i < points; ++i) {
    EXPECT_EQ(laszip_read_point(reader), 0);
    EXPECT_EQ(laszip_set_point(writer, point), 0);
    EXPECT_EQ(laszip_write_point(writer), 0);
  }
  EXPECT_EQ(laszip_close_writer(writer), 0);
  laszip_close_reader(reader);
  laszip_destroy(writer);
  laszip_destroy(reader);
  return out.str();
}

LasFile scan_of(std::uint8_t format) {
  LasFile file{.minor = static_cast<std::uint8_t>(format < 6 ? 2 : 4), .format = format};
  for (std::int32_t i = 0; i < 1000; ++i) {
    const auto colour = static_cast<std::uint16_t>(256 * (i % 200));
    file.points.push_back({{i * 7 % 1000, i * i % 977, i},
                           static_cast<std::uint8_t>(i % 9),
                           i % 50 == 0,
                           {colour, 0x8000, 0x1200},
                           static_cast<unsigned>(1 + i % 3),
                           3U});
  }
  return file;
}

TEST(LazTest, PointsAreThoseOfThePlainFile) {
  for (const std::uint8_t format : {0, 1, 2, 3, 6, 7}) {
    const std::string plain = las_file(scan_of(format));
    const std::string small = packed(plain);
    ASSERT_LT(small.size(), plain.size()) << int{format};
    const Points expected = read("a.las", plain);
    const Points found = read("a.laz", small);
    EXPECT_EQ(found.positions, expected.positions) << int{format};
    EXPECT_EQ(found.colours, expected.colours) << int{format};
    ReadOptions last;
    last.selection.returns = ReturnChoice::Last;
    last.selection.classes.set(2);
    Progress progress;
    const auto* const p = reinterpret_cast<const std::byte*>(plain.data());
    const auto* const s = reinterpret_cast<const std::byte*>(small.data());
    const auto some = read_bytes("a.las", {p, p + plain.size()}, progress, last);
    const auto same = read_bytes("a.laz", {s, s + small.size()}, progress, last);
    ASSERT_TRUE(some && same);
    EXPECT_GT(some->points.size(), 0U);
    EXPECT_EQ(same->points.positions, some->points.positions) << int{format};
  }
}

Result<ReadResult> read_with_scalars(const std::string& name, const std::string& bytes) {
  Progress progress;
  const auto* const begin = reinterpret_cast<const std::byte*>(bytes.data());
  return read_bytes(name, {begin, begin + bytes.size()}, progress, {.scalars = {true, {}}});
}

/// With 6 extra bytes a point, three numbers of 16 bits.
std::string with_extra_bytes(LasFile file) {
  file.extra_bytes = 6;
  return las_file_with_record(
      std::move(file), described("first", 3) + described("second", 3) + described("third", 3));
}

TEST(LazTest, ScalarsAreThoseOfThePlainFile) {
  for (const std::uint8_t format : {0, 1, 2, 3, 6, 7}) {
    // Formats from 6 on state where their points end, which a longer record would move.
    const std::string plain =
        format < 6 ? with_extra_bytes(scan_of(format)) : las_file(scan_of(format));
    const auto expected = read_with_scalars("a.las", plain);
    const auto found = read_with_scalars("a.laz", packed(plain));
    ASSERT_TRUE(expected && found) << int{format};
    ASSERT_GE(expected->points.scalars.size(), 7U);
    ASSERT_EQ(found->points.scalars.size(), expected->points.scalars.size()) << int{format};
    for (std::size_t s = 0; s < expected->points.scalars.size(); ++s) {
      const PointScalar& scalar = expected->points.scalars[s];
      EXPECT_EQ(found->points.scalars[s].name, scalar.name);
      EXPECT_EQ(found->points.scalars[s].values, scalar.values) << scalar.name << int{format};
    }
  }
}

TEST(LazTest, ADamagedFileGivesAnAnswer) {
  const std::string whole = packed(las_file(scan_of(7)));
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 50) {
    const auto cut = try_read("a.laz", whole.substr(0, size));
    EXPECT_FALSE(cut) << size;
  }
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 100) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    (void)try_read("a.laz", damaged);  // any answer, but no crash
  }
}

TEST(LazTest, AHugeCountIsNotBelieved) {
  std::string file = packed(las_file(scan_of(0)));
  file.replace(107, 4, pack(std::uint32_t{4'000'000'000U}));
  const std::string message = error("a.laz", file);
  EXPECT_NE(message.find("of 4000000000 cannot be unpacked"), std::string::npos) << message;
}

}  // namespace
}  // namespace relief::test
