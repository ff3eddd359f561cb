#include "preprocess/volumes/read_volume.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "common/guard.h"
#include "preprocess/readers/source.h"
#include "preprocess/volumes/dicom/dicom.h"
#include "preprocess/volumes/volume_readers.h"

namespace relief {
namespace {

struct VolumeFormat {
  std::string_view extension;  ///< lower case
  Result<ScalarVolume> (*read)(const VolumeSource&);
};

constexpr VolumeFormat kVolumeFormats[] = {
    {".nrrd", read_nrrd},    {".nhdr", read_nrrd},      {".nii", read_nifti},
    {".nii.gz", read_nifti}, {".mha", read_meta_image}, {".mhd", read_meta_image},
    {".vti", read_vtk_xml},  {".vtr", read_vtk_xml},    {".vts", read_vtk_xml},
};

const VolumeFormat* volume_format(const std::filesystem::path& path) {
  const std::string name = lower_case(path.filename().string());
  const auto* const format = std::ranges::find_if(
      kVolumeFormats, [&](const VolumeFormat& f) { return name.ends_with(f.extension); });
  return format == std::end(kVolumeFormats) ? nullptr : format;
}

Result<ScalarVolume> read_by_format(const VolumeSource& source, const VolumeReadOptions& options) {
  if (options.raw) return read_headerless(source, *options.raw);
  const VolumeFormat* const format = volume_format(source.name);
  if (format != nullptr) return format->read(source);
  return make_error(
      "{}: its extension is not of a volume ({}); a file without a header needs its layout, as in "
      "--raw 256x256x109:u8",
      source.name, volume_extensions());
}

/// What `read` returns, if it has values. Exceptions become errors.
template <class Read>
Result<ScalarVolume> checked_volume(const std::string& name, const Read& read) {
  return guarded({.subject = name,
                  .task = "read it",
                  .advice = "the file may be damaged: write it again",
                  .memory_advice = "crop or downsample the volume"},
                 [&]() -> Result<ScalarVolume> {
                   RELIEF_TRY_ASSIGN(auto volume, read());
                   if (std::ranges::all_of(volume.values, [](float v) { return std::isnan(v); }))
                     return make_error("{}: holds no value that is a finite number", name);
                   return volume;
                 });
}

}  // namespace

bool is_volume(const std::filesystem::path& path, const VolumeReadOptions& options) {
  return options.raw.has_value() || volume_format(path) != nullptr || is_dicom(path);
}

std::string volume_extensions() {
  std::string all;
  for (const VolumeFormat& format : kVolumeFormats) {
    if (!all.empty()) all += &format == std::end(kVolumeFormats) - 1 ? " and " : ", ";
    all += format.extension;
  }
  return all;
}

Result<ScalarVolume> read_volume_bytes(const std::filesystem::path& path,
                                       std::span<const std::byte> bytes,
                                       const VolumeReadOptions& options, Progress& progress) {
  const std::string name = path.string();
  return checked_volume(name, [&] {
    progress.begin_stage("read", bytes.size());
    return read_by_format({name, bytes, progress}, options);
  });
}

Result<ScalarVolume> read_volume(const std::filesystem::path& path,
                                 const VolumeReadOptions& options, Progress& progress) {
  if (!options.raw && volume_format(path) == nullptr && is_dicom(path))
    return checked_volume(path.string(), [&] { return read_dicom(path, progress); });
  RELIEF_TRY_ASSIGN(const auto file, MappedFile::open(path));
  return read_volume_bytes(path, file.bytes(), options, progress);
}

}  // namespace relief
