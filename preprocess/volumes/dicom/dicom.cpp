#include "preprocess/volumes/dicom/dicom.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "preprocess/volumes/dicom/dicom_stack.h"
#include "preprocess/volumes/dicom/gdcm_slices.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// More files are a mistake, such as a folder of a whole archive.
constexpr std::size_t kMostFiles = 65536;
/// Files of a folder that are looked into until one is DICOM.
constexpr std::size_t kLooks = 64;

/// Whether a file has DICOM's mark.
bool has_mark(const fs::path& file) {
  constexpr std::streamoff kMarkAt = 128;
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 4> mark{};
  return stream.seekg(kMarkAt) && stream.read(mark.data(), mark.size()) &&
         std::string_view(mark.data(), mark.size()) == "DICM";
}

/// The files of a folder, sorted by their names, until `enough` of them.
std::vector<fs::path> files_in(const fs::path& folder, std::size_t enough) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end && files.size() < enough;
       at.increment(error)) {
    std::error_code ignored;
    if (at->is_regular_file(ignored)) files.push_back(at->path());
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

bool is_dicom(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return has_mark(path);
  const std::vector<fs::path> files = files_in(path, kLooks);
  return std::ranges::any_of(files, has_mark);
}

Result<ScalarVolume> read_dicom(const fs::path& path, Progress& progress) {
  std::error_code ignored;
  const bool is_folder = fs::is_directory(path, ignored);
  const fs::path folder = is_folder ? path : fs::absolute(path).parent_path();
  const fs::path named = is_folder ? path : folder / path.filename();
  std::vector<fs::path> files = files_in(folder, kMostFiles + 1);
  if (files.size() > kMostFiles) {
    return make_error("{}: holds more than {} files; put the series into a folder of its own",
                      folder.string(), kMostFiles);
  }
  std::erase_if(files, [](const fs::path& file) { return !has_mark(file); });
  progress.begin_stage("read headers", files.size());
  RELIEF_TRY_ASSIGN(const auto slices, read_dicom_slices(files, progress));
  RELIEF_TRY_ASSIGN(DicomStack stack, stack_slices(files, slices, named));
  std::vector<fs::path> stacked;
  for (const std::size_t i : stack.files) stacked.push_back(files[i]);
  progress.begin_stage("read", stacked.size());
  RELIEF_TRY(read_dicom_values(stacked, nodes_of(stack.volume) / stacked.size(),
                               stack.volume.values, progress));
  return std::move(stack.volume);
}

}  // namespace relief
