// Readers on damaged files: an answer for each, never a crash, a hang or a heap of memory.
#include <random>

#include <algorithm>
#include "tests/preprocess/readers/sample_files.h"

namespace relief::test {
namespace {

/// The length of a file without what follows the last separator: in a text that ends without a line
/// end, "12" cut to "1" looks like "1".
std::size_t without_last_number(const SampleFile& file) {
  const std::size_t last = file.bytes.find_last_not_of('\n');
  return file.bytes.find_last_of(" \n", last) + 2;
}

TEST(HostileTest, AFileCutAnywhereGivesAnAnswer) {
  for (const SampleFile& file : sample_files()) {
    const auto whole = try_read(file.name, file.bytes);
    ASSERT_TRUE(whole) << file.name;
    const bool binary = file.bytes.find('\0') != std::string::npos;
    const std::size_t complete = binary ? file.bytes.size() : without_last_number(file);
    for (std::size_t length = 0; length < file.bytes.size(); ++length) {
      const auto cut = try_read(file.name, std::string_view(file.bytes).substr(0, length));
      if (!cut) {
        EXPECT_NE(cut.error().message.find(": "), std::string::npos);
      } else {
        EXPECT_LE(cut->points_in_file, whole->points_in_file) << file.name << " cut to " << length;
        EXPECT_TRUE(!file.states_counts || length >= complete) << file.name << " cut to " << length;
      }
    }
  }
}

TEST(HostileTest, DamagedBytesGiveAnAnswer) {
  std::mt19937 random(1);  // a fixed seed: each run tries the same files
  std::size_t errors = 0;
  std::size_t tried = 0;
  for (const SampleFile& file : sample_files()) {
    if (file.name.ends_with(".gz")) continue;
    for (int i = 0; i < 3000; ++i) {
      std::string bytes = file.bytes;
      const unsigned changes = 1 + random() % 4;
      for (unsigned c = 0; c < changes; ++c) {
        char& byte = bytes[random() % bytes.size()];
        byte = random() % 2 == 0 ? static_cast<char>(random())
                                 : static_cast<char>(byte ^ (1 << random() % 8));
      }
      const auto result = try_read(file.name, bytes);
      ++tried;
      errors += result ? 0 : 1;
      if (!result) continue;
      for (const Triangle& t : result->points.triangles) {
        ASSERT_LT(std::max({t[0], t[1], t[2]}), result->points.size()) << file.name;
      }
    }
  }
  // Half of the changes hit a digit of a coordinate and harm nothing; if all did, none was tried.
  EXPECT_GT(errors, tried / 5);
}

TEST(HostileTest, DamagedGzipGivesAnAnswer) {
  const SampleFile file = sample_files().back();
  ASSERT_TRUE(file.name.ends_with(".gz"));
  const Points whole = read(file.name, file.bytes);
  for (std::size_t at = 0; at < file.bytes.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string bytes = file.bytes;
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << bit));
      // Some bits mean nothing, others refer to equal text elsewhere; the checksum decides.
      const auto result = try_read(file.name, bytes);
      if (result) {
        EXPECT_EQ(result->points.positions, whole.positions) << at;
      }
    }
  }
}

TEST(HostileTest, NumbersSwappedForHugeOnesGiveAnAnswer) {
  const char* const huge[] = {"4294967295",          "4294967296", "2147483647",
                              "-2147483648",         "-1",         "18446744073709551615",
                              "9223372036854775807", "1e308",      "99999999999999999999"};
  for (const SampleFile& file : sample_files()) {
    if (file.name.ends_with(".gz")) continue;
    const std::string& bytes = file.bytes;
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      const auto is_digit = [&](std::size_t i) {
        return i < bytes.size() && bytes[i] >= '0' && bytes[i] <= '9';
      };
      if (!is_digit(at) || (at > 0 && is_digit(at - 1))) continue;
      std::size_t end = at;
      while (is_digit(end)) ++end;
      for (const char* number : huge) {
        (void)try_read(file.name, bytes.substr(0, at) + number + bytes.substr(end));
      }
    }
    // Binary counts and indices.
    for (std::size_t at = 0; at + 4 <= bytes.size(); ++at) {
      for (const std::uint32_t number : {UINT32_MAX, 0x80000000U, 0x7FFFFFFFU, 0x40000000U}) {
        std::string changed = bytes;
        changed.replace(at, 4, pack(number));
        (void)try_read(file.name, changed);
      }
    }
  }
}

}  // namespace
}  // namespace relief::test
