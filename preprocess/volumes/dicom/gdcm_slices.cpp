// GDCM trusts its files, so it runs in a child process (confined_child.h). A source of its own, for
// its headers.
#include "preprocess/volumes/dicom/gdcm_slices.h"

#ifdef RELIEF_GDCM
#include <gdcmAttribute.h>
#include <gdcmImage.h>
#include <gdcmImageHelper.h>
#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>

#include "common/io/confined_child.h"
#include "preprocess/volumes/number_form.h"
#endif

namespace relief {

#ifdef RELIEF_GDCM
namespace {

using std::filesystem::path;

/// Memory that GDCM may take: an image, as it is packed and unpacked.
constexpr std::uint64_t kMostMemory = std::uint64_t{4} << 30U;

template <std::uint16_t kGroup, std::uint16_t kElement>
std::int64_t number_of(const gdcm::DataSet& set, std::int64_t otherwise) {
  gdcm::Attribute<kGroup, kElement> attribute;
  const gdcm::Tag tag = attribute.GetTag();
  if (!set.FindDataElement(tag) || set.GetDataElement(tag).IsEmpty()) return otherwise;
  attribute.SetFromDataSet(set);
  return attribute.GetValue();
}

bool has(const gdcm::DataSet& set, const gdcm::Tag& tag) {
  return set.FindDataElement(tag);
}

std::string text_of(const gdcm::DataSet& set, const gdcm::Tag& tag) {
  if (!has(set, tag)) return {};
  const gdcm::ByteValue* const bytes = set.GetDataElement(tag).GetByteValue();
  if (bytes == nullptr) return {};
  std::string text(bytes->GetPointer(), bytes->GetLength());
  while (!text.empty() && (text.back() == ' ' || text.back() == '\0')) text.pop_back();
  return text;
}

template <std::size_t kCount, class Values>
void take(const Values& from, std::size_t first, std::array<double, kCount>& to) {
  for (std::size_t i = 0; i < kCount && first + i < from.size(); ++i) to[i] = from[first + i];
}

/// Whether bytes of unpacked pixels are missing, which GDCM takes for zeros. `at`: where the pixels
/// begin.
bool is_truncated(const gdcm::File& file, const DicomSlice& slice, std::uintmax_t at,
                  std::uintmax_t bytes) {
  const gdcm::TransferSyntax& syntax = file.GetHeader().GetDataSetTransferSyntax();
  if (syntax.IsEncapsulated() || syntax == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian)
    return false;
  const auto each = gdcm::ImageHelper::GetPixelFormatValue(file).GetPixelSize();
  const double needed = static_cast<double>(slice.size[0]) * static_cast<double>(slice.size[1]) *
                        static_cast<double>(slice.size[2]) * each;
  return at > bytes || static_cast<double>(bytes - at) < needed;
}

DicomSlice slice_of(const path& file) {
  DicomSlice slice;
  std::ifstream stream(file, std::ios::binary);
  gdcm::Reader reader;
  reader.SetStream(stream);
  const gdcm::Tag pixels(0x7fe0, 0x0010);
  if (!reader.ReadUpToTag(pixels, {pixels})) return slice;  // not the pixels themselves
  const auto at = static_cast<std::uintmax_t>(std::max<std::streamoff>(stream.tellg(), 0));
  const gdcm::File& all = reader.GetFile();
  const gdcm::DataSet& set = all.GetDataSet();
  const std::vector<unsigned int> size = gdcm::ImageHelper::GetDimensionsValue(all);
  if (size.size() < 2 || size[0] == 0 || size[1] == 0) return slice;
  if (number_of<0x0028, 0x0002>(set, 1) != 1) return slice;  // colours
  slice.has_image = true;
  slice.size = {size[0], size[1], size.size() > 2 ? std::max(size[2], 1U) : 1U};
  std::error_code ignored;
  slice.is_truncated = is_truncated(all, slice, at, std::filesystem::file_size(file, ignored));
  const std::string series = text_of(set, {0x0020, 0x000e});
  std::memcpy(slice.series.data(), series.data(), std::min(series.size(), slice.series.size() - 1));
  slice.number = number_of<0x0020, 0x0013>(set, 0);
  take(gdcm::ImageHelper::GetSpacingValue(all), 0, slice.spacing);
  // Of frames that state a place of their own, GDCM returns the first's.
  slice.has_position =
      has(set, {0x0020, 0x0032}) || has(set, {0x5200, 0x9229}) || has(set, {0x5200, 0x9230});
  if (!slice.has_position) return slice;
  const std::vector<double> directions = gdcm::ImageHelper::GetDirectionCosinesValue(all);
  take(gdcm::ImageHelper::GetOriginValue(all), 0, slice.position);
  take(directions, 0, slice.along_row);
  take(directions, 3, slice.along_column);
  return slice;
}

/// None of what packs several numbers into a byte.
std::optional<NumberType> type_of(const gdcm::PixelFormat& format) {
  switch (format.GetScalarType()) {
    case gdcm::PixelFormat::UINT8:
      return NumberType::Uint8;
    case gdcm::PixelFormat::INT8:
      return NumberType::Int8;
    case gdcm::PixelFormat::UINT16:
      return NumberType::Uint16;
    case gdcm::PixelFormat::INT16:
      return NumberType::Int16;
    case gdcm::PixelFormat::UINT32:
      return NumberType::Uint32;
    case gdcm::PixelFormat::INT32:
      return NumberType::Int32;
    case gdcm::PixelFormat::FLOAT32:
      return NumberType::Float32;
    case gdcm::PixelFormat::FLOAT64:
      return NumberType::Float64;
    default:
      return std::nullopt;
  }
}

/// The values of an image; of another number than `count` if it cannot be read.
std::vector<float> values_of(const path& file, std::size_t count) {
  std::vector<float> values;
  gdcm::ImageReader reader;
  reader.SetFileName(file.c_str());
  if (!reader.Read()) return values;
  const gdcm::Image& image = reader.GetImage();
  const gdcm::PixelFormat& format = image.GetPixelFormat();
  const std::size_t length = image.GetBufferLength();
  const auto type = type_of(format);
  if (!type || format.GetSamplesPerPixel() != 1 || length != count * size_of(*type)) return values;
  std::vector<char> bytes(length);
  if (!image.GetBuffer(bytes.data())) return values;
  values.reserve(count);
  for (std::size_t at = 0; at < length; at += size_of(*type)) {
    // GDCM has turned them into this machine's byte order.
    const double number =
        load_number<std::endian::native == std::endian::big>(*type, bytes.data() + at);
    values.push_back(value_or_nan(image.GetSlope() * number + image.GetIntercept()));
  }
  return values;
}

/// Calls `read` for each file with a child that has begun there: one that ends at a file is
/// replaced for the next.
template <class Write, class Read>
Status for_each_in_child(std::span<const path> files, const Write& write, const Read& read) {
  for (std::size_t begun = 0; begun < files.size();) {
    ConfinedChild child;
    const Status started = child.start(kMostMemory, [&](const ChildOutput& output) {
      gdcm::Trace::WarningOff();
      for (const path& file : files.subspan(begun)) {
        if (!write(file, output)) return;
      }
    });
    if (!started)
      return make_error("{}: no process can be started to read it: {}", files[begun].string(),
                        started.error().message);
    for (bool has_ended = false; begun < files.size() && !has_ended; ++begun) {
      RELIEF_TRY_ASSIGN(has_ended, read(begun, child));
    }
  }
  return {};
}

}  // namespace

Result<std::vector<DicomSlice>> read_dicom_slices(std::span<const path> files, Progress& progress) {
  std::vector<DicomSlice> slices(files.size());
  const auto write = [](const path& file, const ChildOutput& output) {
    const DicomSlice slice = slice_of(file);
    return output.write(&slice, sizeof slice);
  };
  const auto read = [&](std::size_t i, const ConfinedChild& child) -> Result<bool> {
    DicomSlice slice;
    const auto got = child.read(&slice, sizeof slice, progress);
    if (got == ConfinedChild::Got::Interrupted) return interrupted_error();
    slice.series.back() = '\0';
    if (got == ConfinedChild::Got::All) slices[i] = slice;
    progress.advance(1);
    return got == ConfinedChild::Got::Ended;
  };
  RELIEF_TRY(for_each_in_child(files, write, read));
  return slices;
}

Status read_dicom_values(std::span<const path> files, std::size_t count, std::vector<float>& values,
                         Progress& progress) {
  const auto write = [count](const path& file, const ChildOutput& output) {
    const std::vector<float> own = values_of(file, count);
    const std::uint64_t found = own.size();
    return output.write(&found, sizeof found) &&
           output.write(own.data(), own.size() * sizeof(float));
  };
  const auto read = [&](std::size_t i, const ConfinedChild& child) -> Result<bool> {
    std::uint64_t found = 0;
    auto got = child.read(&found, sizeof found, progress);
    if (got == ConfinedChild::Got::All && found == count) {
      values.resize(values.size() + count);
      got = child.read(values.data() + values.size() - count, count * sizeof(float), progress);
    } else if (got == ConfinedChild::Got::All) {
      got = ConfinedChild::Got::Ended;
    }
    if (got == ConfinedChild::Got::Interrupted) return interrupted_error();
    if (got == ConfinedChild::Got::Ended) {
      return make_error(
          "{}: GDCM cannot read its {} pixels; it is truncated, damaged or packed in a way that "
          "GDCM does not know",
          files[i].string(), count);
    }
    progress.advance(1);
    return false;
  };
  return for_each_in_child(files, write, read);
}

bool can_read_dicom() {
  return true;
}
#else
Result<std::vector<DicomSlice>> read_dicom_slices(std::span<const std::filesystem::path> files,
                                                  Progress& /*progress*/) {
  return make_error(
      "{}: is DICOM, which this build cannot read: it was built without GDCM (libgdcm-dev); "
      "convert the series to NIfTI first, with `dcm2niix FOLDER`",
      files.front().string());
}

Status read_dicom_values(std::span<const std::filesystem::path> /*files*/, std::size_t /*count*/,
                         std::vector<float>& /*values*/, Progress& /*progress*/) {
  return make_error("this build has no GDCM");
}

bool can_read_dicom() {
  return false;
}
#endif

}  // namespace relief
