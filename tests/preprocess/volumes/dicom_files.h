// DICOM files of one slice each, made for the tests: explicit VR, little endian.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/preprocess/readers/pack.h"

namespace relief::test {

struct DicomFile {
  std::string series = "1.2.3";
  int number = 1;
  std::uint16_t columns = 4;
  std::uint16_t rows = 3;
  std::string position = "10\\20\\30";  ///< empty: not stated
  std::string directions = "1\\0\\0\\0\\1\\0";
  std::string spacing = "2\\0.5";  ///< of rows and columns
  std::string slope = "1";
  std::string intercept = "0";
  std::vector<std::int16_t> values;  ///< row by row
};

/// An element whose value is of one of the kinds with short lengths.
inline std::string dicom_element(std::uint16_t group, std::uint16_t element, const char* kind,
                                 std::string value) {
  if (value.size() % 2 != 0) value += std::string(kind) == "UI" ? '\0' : ' ';
  return pack(group, element) + kind + pack(static_cast<std::uint16_t>(value.size())) + value;
}

inline std::string dicom_bytes(const DicomFile& file) {
  const auto whole = [](int value) { return pack(static_cast<std::uint16_t>(value)); };
  const std::string ct = "1.2.840.10008.5.1.4.1.1.2";
  const std::string meta = dicom_element(2, 2, "UI", ct) + dicom_element(2, 3, "UI", "1.2.3.4") +
                           dicom_element(2, 0x10, "UI", "1.2.840.10008.1.2.1");
  std::string set = dicom_element(8, 0x16, "UI", ct) + dicom_element(8, 0x18, "UI", "1.2.3.4") +
                    dicom_element(8, 0x60, "CS", "CT") + dicom_element(0x18, 0x50, "DS", "1.5") +
                    dicom_element(0x20, 0x0e, "UI", file.series) +
                    dicom_element(0x20, 0x13, "IS", std::to_string(file.number));
  if (!file.position.empty()) {
    set += dicom_element(0x20, 0x32, "DS", file.position) +
           dicom_element(0x20, 0x37, "DS", file.directions);
  }
  set += dicom_element(0x28, 2, "US", whole(1)) + dicom_element(0x28, 4, "CS", "MONOCHROME2") +
         dicom_element(0x28, 0x10, "US", whole(file.rows)) +
         dicom_element(0x28, 0x11, "US", whole(file.columns)) +
         dicom_element(0x28, 0x30, "DS", file.spacing) +
         dicom_element(0x28, 0x100, "US", whole(16)) + dicom_element(0x28, 0x101, "US", whole(16)) +
         dicom_element(0x28, 0x102, "US", whole(15)) + dicom_element(0x28, 0x103, "US", whole(1)) +
         dicom_element(0x28, 0x1052, "DS", file.intercept) +
         dicom_element(0x28, 0x1053, "DS", file.slope);
  std::string values;
  for (const std::int16_t value : file.values) values += pack(value);
  set += pack(std::uint16_t{0x7fe0}, std::uint16_t{0x10}) + "OW" +
         pack(std::uint16_t{0}, static_cast<std::uint32_t>(values.size())) + values;
  return std::string(128, '\0') + "DICM" +
         dicom_element(2, 0, "UL", pack(static_cast<std::uint32_t>(meta.size()))) + meta + set;
}

}  // namespace relief::test
