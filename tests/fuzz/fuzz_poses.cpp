// Fuzzes the reader of poses of range scans.
#include <algorithm>
#include <string_view>

#include "preprocess/readers/scan_poses.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto poses = relief::read_scan_poses("fuzzed", text);
  if (!poses) {
    relief::fuzz::require(poses.error().message.starts_with("fuzzed: "));
    return 0;
  }
  for (const relief::ScanPose& pose : *poses) {
    const auto scan = relief::find_scan("nowhere/fuzzed.conf", pose);
    if (scan) {
      relief::fuzz::require(*scan->begin() == "nowhere" && std::ranges::count(*scan, "..") == 0);
    }
    relief::Points point;
    point.positions.emplace_back(1.0);
    relief::place_scan(pose, point);
  }
  return 0;
}
