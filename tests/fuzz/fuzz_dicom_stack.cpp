// Fuzzes the stacking of DICOM slices, whatever GDCM has read of hostile files.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "preprocess/volumes/dicom/dicom_stack.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A byte of flags before each slice, as a bool must be 0 or 1.
  constexpr std::size_t kBytes = 1 + sizeof(relief::DicomSlice);
  constexpr std::size_t kMostSlices = 32;
  std::vector<relief::DicomSlice> slices(std::min(size / kBytes, kMostSlices));
  std::vector<std::filesystem::path> files;
  if (slices.empty()) return 0;
  for (relief::DicomSlice& slice : slices) {
    const std::uint8_t flags = *data;
    std::vector<std::uint8_t> bytes(data + 1, data + kBytes);
    std::fill_n(bytes.begin(), offsetof(relief::DicomSlice, series), std::uint8_t{0});
    std::memcpy(&slice, bytes.data(), bytes.size());
    slice.has_image = (flags & 1U) == 0;
    slice.is_truncated = (flags & 2U) != 0;
    slice.has_position = (flags & 4U) == 0;
    slice.series.back() = '\0';
    data += kBytes;
    files.emplace_back("folder/" + std::to_string(files.size()));
  }
  for (const std::filesystem::path& named : {std::filesystem::path("folder"), files.front()}) {
    const auto stack = relief::stack_slices(files, slices, named);
    if (!stack) {
      relief::fuzz::require(stack.error().message.starts_with("folder"));
      continue;
    }
    relief::fuzz::require(!stack->files.empty() && stack->files.size() <= files.size());
    relief::fuzz::require(stack->files.size() == 1 || stack->volume.size.z == stack->files.size());
  }
  return 0;
}
