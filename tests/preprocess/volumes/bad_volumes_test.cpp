// Volume files that are wrong, each with its sentence, and damaged ones: an answer for each, never
// a crash, a hang or a heap of memory.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/preprocess/volumes/volume_files.h"

namespace relief::test {
namespace {

/// `text` with its only `from` replaced.
std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(BadVolumesTest, NrrdSaysWhatIsWrong) {
  const std::string values = sample_bytes<std::int16_t>();
  const std::string good = nrrd_header("short", "raw") + "\n" + values;
  const auto error = [&](std::string_view from, std::string_view to) {
    return volume_error("a.nrrd", replaced(good, from, to));
  };
  EXPECT_EQ(error("NRRD", "nrrd"), "does not begin with NRRD, as NRRD files do");
  EXPECT_EQ(error("dimension: 3", "dimension: 4"),
            "line 4: has '4' dimensions, but a scalar volume has 3; extract one volume from it");
  EXPECT_EQ(error("kinds: domain domain domain", "kinds: RGB-color domain domain"),
            "line 8: an axis is of the kind 'rgb-color', but only scalar volumes can be read "
            "(domain or space); extract one component");
  EXPECT_EQ(error("type: short", "type: block"),
            "line 3: expected a type of numbers (uchar, short, ushort, int, uint, float, double, "
            "...), found 'block'");
  EXPECT_EQ(error("encoding: raw", "encoding: bzip2"),
            "line 9: the encoding 'bzip2' cannot be read, only raw, gzip and ascii; save it with "
            "one of them");
  EXPECT_EQ(error("endian: little\n", ""), "its NRRD header has no field 'endian'; add it");
  EXPECT_EQ(error("endian: little", "endian: middle"),
            "line 12: expected little or big, found 'middle'");
  EXPECT_EQ(error("sizes: 2 3 4", "sizes: 2 3"),
            "line 6: expected three sizes above 0, found '2 3'");
  EXPECT_EQ(error("sizes: 2 3 4", "sizes: 2 0 4"),
            "line 6: expected three sizes above 0, found '2 0 4'");
  EXPECT_EQ(error("sizes: 2 3 4", "sizes: 2147483647 2147483647 2147483647"),
            "states a size of 2147483647 x 2147483647 x 2147483647, which would take more "
            "than half of this machine's memory; crop or downsample it");
  EXPECT_EQ(error("sizes: 2 3 4", "sizes: 4294967298 3 4"),
            "states a size of 4294967298 x 3 x 4; each must be 1 to 2147483647");
  EXPECT_EQ(error("sizes: 2 3 4", "sizes: 2 3 5"),
            "holds 48 bytes of values, but its header or layout states 30 values of 16 bits; the "
            "file is truncated, or the header's size or type is wrong");
  EXPECT_EQ(error("(2,0,0)", "(0,3,0)"),
            "its steps along the three axes lie in one plane (their matrix is singular); correct "
            "the header's directions");
  EXPECT_EQ(error("(2,0,0)", "(0,0,0)"),
            "its step along axis 1 is (0, 0, 0), which is not a step in space; correct the "
            "header's spacing or directions");
  EXPECT_EQ(error("(2,0,0)", "(nan,0,0)"),
            "its step along axis 1 is (nan, 0, 0), which is not a step in space; correct the "
            "header's spacing or directions");
  EXPECT_EQ(error("(2,0,0)", "none"),
            "line 7: expected three vectors of three numbers, found '(0,-1.5,0) none (0,0,3)'");
  EXPECT_EQ(error("(-10,20,30)", "(-10,inf,30)"),
            "its origin (-10, inf, 30) is not a position; correct the header");
  EXPECT_EQ(error("space: left-posterior-superior", "space: left-posterior-superior-time"),
            "line 5: expected a space of three dimensions (left-posterior-superior, "
            "right-anterior-superior, left-anterior-superior, scanner-xyz, 3D-right-handed or "
            "3D-left-handed), found 'left-posterior-superior-...'");
  EXPECT_EQ(error("remark:=none", "remark"), "line 11: expected 'field: value', found 'remark'");
  EXPECT_EQ(error("remark:=none", "data file: LIST"),
            "line 11: its values are in several files ('LIST'), which cannot be read; save it as "
            "one .nrrd");
  EXPECT_EQ(error("remark:=none", "data file: a%03d.raw 1 9 1"),
            "line 11: its values are in several files ('a%03d.raw 1 9 1'), which cannot be read; "
            "save it as one .nrrd");
  EXPECT_EQ(volume_error("a.nrrd", nrrd_header("short", "raw")),
            "its header does not end with an empty line; the file is truncated, or the header "
            "lacks 'data file'");
  EXPECT_EQ(volume_error("a.nrrd", nrrd_header("float", "ascii", "") + "\n1 2 x"),
            "states 24 values, which its 5 bytes of text cannot hold; the file is truncated or its "
            "header is wrong");
  EXPECT_EQ(
      volume_error("a.nrrd", nrrd_header("float", "ascii", "") + "\n1 2 x" + std::string(60, ' ')),
      "value 3: expected a number, found 'x'");
  EXPECT_EQ(
      volume_error("a.nrrd", nrrd_header("float", "ascii", "") + "\n1 2" + std::string(60, ' ')),
      "states 24 values, but its text ends after 2; the file is truncated or its header is wrong");
}

TEST(BadVolumesTest, NiftiSaysWhatIsWrong) {
  const std::string values = sample_bytes<std::int16_t>();
  const auto error = [&](const NiftiFile& file) {
    return volume_error("a.nii", nifti_file(file, values));
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(volume_error("a.nii", std::string(400, 'a')),
            "does not begin with the number 348, as NIfTI-1 files do");
  EXPECT_EQ(volume_error("a.nii", pack(540) + std::string(536, '\0')),
            "is NIfTI-2, which cannot be read; save it as NIfTI-1");
  EXPECT_EQ(volume_error("a.nii", nifti_file({}, "").substr(0, 300)),
            "holds 300 bytes, but a NIfTI-1 header has 348; the file is truncated");
  EXPECT_EQ(error({.magic = "ni1"}),
            "is the header of a pair of NIfTI files (.hdr and .img), which cannot be read; save "
            "them as one .nii");
  EXPECT_EQ(error({.magic = "abc"}),
            "lacks the letters n+1 at byte 344, so it is Analyze or damaged, not NIfTI-1; save it "
            "as NIfTI-1");
  EXPECT_EQ(error({.datatype = 128}),
            "its values are of NIfTI's type 128, which is not one real number a voxel (as colours "
            "and complex numbers are not); extract one component");
  EXPECT_EQ(error({.dim = {2, 2, 3}}), "has 2 dimensions, but a volume has 3; correct the header");
  EXPECT_EQ(error({.dim = {3, 2, -3, 4}}),
            "states a size of 2 x -3 x 4; each must be 1 to 2147483647");
  EXPECT_EQ(error({.dim = {3, 32767, 32767, 32767}}),
            "states a size of 32767 x 32767 x 32767, which would take more than half of "
            "this machine's memory; crop or downsample it");
  EXPECT_EQ(error({.pixdim = {1.F, 1.F, 0.F, 3.F}, .sform_code = 0}),
            "its spacing (pixdim) is 1 x 0 x 3; each must be above 0");
  EXPECT_EQ(error({.pixdim = {1.F, nan, 1.F, 3.F}, .qform_code = 1, .sform_code = 0}),
            "its spacing (pixdim) is nan x 1 x 3; each must be above 0");
  EXPECT_EQ(error({.qform_code = 1, .sform_code = 0, .quatern = {1.F, 1.F, 0.F}}),
            "its rotation (quatern_b, c, d) is (1, 1, 0), which is longer than 1; correct the "
            "header");
  EXPECT_EQ(error({.srow = {1, 2, 0, 0, 2, 4, 0, 0, 0, 0, 1, 0}}),
            "its steps along the three axes lie in one plane (their matrix is singular); correct "
            "the header's directions");
  EXPECT_EQ(error({.vox_offset = 100.F}),
            "its values begin at byte 100 (vox_offset), which cannot be; correct it");
  EXPECT_EQ(error({.vox_offset = 380.F}),
            "holds 20 bytes of values, but its header or layout states 24 values of 16 bits; the "
            "file is truncated, or the header's size or type is wrong");
}

TEST(BadVolumesTest, MetaImageSaysWhatIsWrong) {
  const std::string good =
      meta_header("MET_SHORT", "ElementDataFile = LOCAL\n") + sample_bytes<std::int16_t>();
  const auto error = [&](std::string_view from, std::string_view to) {
    return volume_error("a.mha", replaced(good, from, to));
  };
  EXPECT_EQ(error("Image", "Tube"), "line 1: expected Image, found 'Tube'");
  EXPECT_EQ(error("NDims = 3", "NDims = 2"),
            "line 2: has '2' dimensions, but a volume has 3; extract one volume from it");
  EXPECT_EQ(error("MET_SHORT", "MET_SHORT_ARRAY"),
            "line 8: expected a type of numbers (MET_UCHAR, MET_SHORT, MET_USHORT, MET_FLOAT, "
            "...), found 'MET_SHORT_ARRAY'");
  EXPECT_EQ(error("BinaryData = True", "BinaryData = Maybe"),
            "line 3: expected True or False, found 'Maybe'");
  EXPECT_EQ(error("Offset = -10 20 30", "Offset = -10 20"),
            "line 5: expected 3 numbers, found '-10 20'");
  EXPECT_EQ(error("Offset = -10 20 30", "ElementNumberOfChannels = 3"),
            "line 5: has '3' numbers a voxel, but only scalar volumes can be read; extract one "
            "component");
  EXPECT_EQ(error("DimSize = 2 3 4", "Comment = x"),
            "its MetaImage header has no field DimSize before ElementDataFile; add it");
  EXPECT_EQ(error("LOCAL", "LIST"),
            "its values are in several files ('LIST'), which cannot be read; save it as one .mha");
  EXPECT_EQ(error("ElementSpacing = 1.5 2 3", "ElementSpacing = 1.5 0 3"),
            "its step along axis 1 is (0, 0, 0), which is not a step in space; correct the "
            "header's spacing or directions");
  EXPECT_EQ(volume_error("a.mha", "NDims = 3\nabc\n"),
            "line 2: expected 'Field = value', found 'abc'");
  EXPECT_EQ(volume_error("a.mha", "NDims = 3\n"),
            "its MetaImage header has no field ElementDataFile; the file is truncated or not "
            "MetaImage");
}

TEST(BadVolumesTest, VtkSaysWhatIsWrong) {
  const std::string good = vti_file({.data = VtkForm::Data::AppendedRaw, .is_packed = true});
  const auto error = [&](std::string_view from, std::string_view to) {
    return volume_error("a.vti", replaced(good, from, to));
  };
  EXPECT_EQ(volume_error("a.vti", "abc"), "line 1: is not XML as VTK writes it (syntax error)");
  EXPECT_EQ(volume_error("a.vti", "<a/>"),
            "holds no VTKFile, but a volume is VTK's ImageData, RectilinearGrid or "
            "StructuredGrid");
  EXPECT_EQ(error("type=\"ImageData\"", "type=\"UnstructuredGrid\""),
            "holds 'UnstructuredGrid', but a volume is VTK's ImageData, RectilinearGrid or "
            "StructuredGrid");
  EXPECT_EQ(error("<VTKFile", "<!DOCTYPE a [<!ENTITY b \"c\">]><VTKFile"),
            "line 2: has a document type, which VTK files do not have; remove it");
  EXPECT_EQ(error("vtkZLib", "vtkLZ4"),
            "is compressed by 'vtkLZ4DataCompressor'; only vtkZLibDataCompressor can be read");
  EXPECT_EQ(error("LittleEndian", "Mixed"),
            "its byte order is 'Mixed'; expected LittleEndian or BigEndian");
  EXPECT_EQ(error("UInt32", "UInt16"), "its header type is 'UInt16'; expected UInt32 or UInt64");
  EXPECT_EQ(error("<Piece Extent=\"4 5 0 2 0 3\">", "<Piece Extent=\"4 5 0 2\">"),
            "its piece has the extent '4 5 0 2'; expected six whole numbers");
  EXPECT_EQ(error("<Piece Extent=\"4 5 0 2 0 3\">", "<Piece Extent=\"4 5 0 2 0 -1\">"),
            "states a size of 2 x 3 x 0; each must be 1 to 2147483647");
  EXPECT_EQ(error("</Piece>", "</Piece><Piece/>"),
            "has 2 pieces, but only files of one can be read; save it as one");
  EXPECT_EQ(error("Spacing=\"1.5 2 3\"", "Spacing=\"1.5 2\""),
            "its spacing is '1.5 2'; expected 3 numbers");
  EXPECT_EQ(error("Direction=\"0 -1 0 1 0 0 0 0 1\"", "Direction=\"0 -1 0 1 0 1 0 0 0\""),
            "its steps along the three axes lie in one plane (their matrix is singular); correct "
            "the header's directions");
  EXPECT_EQ(error("type=\"Int16\"", "type=\"String\""),
            "the array 'density' is of the type 'String'; expected Int8 to UInt64, Float32 or "
            "Float64");
  EXPECT_EQ(error("format=\"appended\"", "format=\"xml\""),
            "the array 'density' has the format 'xml'; expected ascii, binary or appended");
  EXPECT_EQ(error("offset=\"0\"", "offset=\"99999\"").substr(0, 58),
            "the array 'density' begins at byte '99999' of the appended");
  EXPECT_EQ(error("encoding=\"raw\"", "encoding=\"hex\""),
            "its appended data is encoded as 'hex'; expected raw or base64");
  EXPECT_EQ(error("Name=\"density\"", "NumberOfComponents=\"3\""),
            "has no array with one number for each point; extract a component");
  EXPECT_EQ(volume_error("a.vti",
                         replaced(replaced(good, "<PointData Scalars=\"density\">", "<CellData>"),
                                  "</PointData>", "</CellData>")),
            "has values at cells only; convert them to point data (ParaView: Cell Data to Point "
            "Data)");
  EXPECT_EQ(error("type=\"Int16\"", "type=\"Int8\""),
            "holds more than the 24 values of 8 bits that its header or layout states; the "
            "header's size or type is wrong");
  EXPECT_EQ(error("type=\"Int16\"", "type=\"Int32\""),
            "holds 48 bytes of values, but its header or layout states 24 values of 32 bits; the "
            "file is truncated, or the header's size or type is wrong");
  EXPECT_EQ(volume_error("a.vti", good.substr(0, good.find("\n_") + 9)),
            "the array 'density' ends early or is not encoded as the file says; the file is "
            "truncated or damaged");
  EXPECT_EQ(volume_error("a.vtr", replaced(vtr_file({}), "1 2.5", "1 1")),
            "its coordinates along axis 0 neither rise nor fall all the way");
  EXPECT_EQ(volume_error("a.vts", replaced(vts_file({}), "10 -20 30 ", "10 nan 30 ")),
            "point 0 is (10, nan, 30), which is not a position");
}

TEST(BadVolumesTest, FilesWithoutAHeaderMustHaveTheSizeOfTheirLayout) {
  const std::string values = sample_bytes<std::int16_t>();
  EXPECT_EQ(volume_error("a.raw", values, "2x3x4:u8"),
            "holds more than the 24 values of 8 bits that its header or layout states; the "
            "header's size or type is wrong");
  for (const auto& [name, bytes] :
       {std::pair<std::string, std::string>{"a.raw", values}, {"a.zip", zip(values)}}) {
    EXPECT_EQ(volume_error(name, bytes, "2x3x5:i16"),
              "holds 48 bytes of values, but its header or layout states 30 values of 16 bits; "
              "the file is truncated, or the header's size or type is wrong");
  }
}

TEST(BadVolumesTest, ZipSaysWhatIsWrong) {
  const std::string good = zip(sample_bytes<std::int16_t>());
  const auto error = [](const std::string& bytes) {
    return volume_error("a.zip", bytes, "2x3x4:i16");
  };
  EXPECT_EQ(error("abc"),
            "is not a whole zip archive (its end record is missing); unpack it, and name the file "
            "in it");
  std::string damaged = good;
  damaged[damaged.find("PK\x01\x02")] = 'a';
  EXPECT_EQ(error(damaged),
            "is not a whole zip archive (its directory is damaged); unpack it, and name the file "
            "in it");
  std::string encrypted = good;
  encrypted[good.find("PK\x01\x02") + 8] = 1;
  EXPECT_EQ(error(encrypted),
            "its file is encrypted, larger than 4 GB or not packed by DEFLATE; unpack it, and name "
            "the file in it");
  std::string changed = good;
  changed[good.find("PK\x01\x02") + 16] ^= 1;
  EXPECT_EQ(error(changed), "its checksum does not match; the file is damaged");
}

TEST(BadVolumesTest, BombsAreStoppedByTheStatedCount) {
  // 64 MB of zeros in 65 kB; the header states 48 bytes.
  const std::string bomb = gzip(std::string(std::size_t{64} << 20U, '\0'));
  EXPECT_EQ(volume_error("a.nrrd", nrrd_header("short", "gzip") + "\n" + bomb),
            "holds more than the 24 values of 16 bits that its header or layout states; the "
            "header's size or type is wrong");
  // A header of more than DEFLATE can pack into the file is refused before any memory is taken.
  EXPECT_EQ(volume_error("a.nrrd", replaced(nrrd_header("short", "gzip"), "2 3 4", "512 512 512") +
                                       "\n" + gzip("abc")),
            "holds 23 bytes of values, but its header or layout states 134217728 values of 16 "
            "bits; the file is truncated, or the header's size or type is wrong");
}

std::vector<VolumeFile> all_files() {
  std::vector<VolumeFile> files = volume_files();
  for (VolumeFile& file : plain_volume_files()) files.push_back(std::move(file));
  return files;
}

/// What ScalarVolume promises.
void expect_sound(const ScalarVolume& volume) {
  ASSERT_EQ(volume.values.size(), nodes_of(volume));
  for (const float value : volume.values) ASSERT_FALSE(std::isinf(value));
}

TEST(BadVolumesTest, AFileCutAnywhereGivesAnAnswer) {
  for (const VolumeFile& file : all_files()) {
    for (std::size_t length = 0; length < file.bytes.size(); ++length) {
      const auto cut =
          try_volume(file.name, std::string_view(file.bytes).substr(0, length), file.layout);
      // What is left out may be the end of XML, of a zip's remark or of the last number of a text.
      if (cut) expect_sound(*cut);
      EXPECT_TRUE(!cut || length + 400 > file.bytes.size()) << file.name << " cut to " << length;
    }
  }
}

TEST(BadVolumesTest, DamagedBytesGiveAnAnswer) {
  std::mt19937 random(1);  // a fixed seed: each run tries the same files
  std::size_t errors = 0;
  std::size_t tried = 0;
  for (const VolumeFile& file : all_files()) {
    for (int i = 0; i < 1500; ++i) {
      std::string bytes = file.bytes;
      const unsigned changes = 1 + random() % 4;
      for (unsigned c = 0; c < changes; ++c) {
        char& byte = bytes[random() % bytes.size()];
        byte = random() % 2 == 0 ? static_cast<char>(random())
                                 : static_cast<char>(byte ^ (1 << random() % 8));
      }
      const auto volume = try_volume(file.name, bytes, file.layout);
      ++tried;
      errors += volume ? 0 : 1;
      if (volume) expect_sound(*volume);
    }
  }
  // Others hit a value or a remark and harm nothing; if all did, none was tried.
  EXPECT_GT(errors, tried / 5);
}

TEST(BadVolumesTest, NumbersSwappedForHugeOnesGiveAnAnswer) {
  for (const VolumeFile& file : all_files()) {
    const std::string& bytes = file.bytes;
    const auto is_digit = [&](std::size_t i) {
      return i < bytes.size() && bytes[i] >= '0' && bytes[i] <= '9';
    };
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      if (!is_digit(at) || (at > 0 && is_digit(at - 1))) continue;
      std::size_t end = at;
      while (is_digit(end)) ++end;
      for (const char* number : {"4294967295", "2147483647", "-2147483648", "-1",
                                 "18446744073709551615", "9223372036854775807", "1e308"}) {
        (void)try_volume(file.name, bytes.substr(0, at) + number + bytes.substr(end), file.layout);
      }
    }
    for (std::size_t at = 0; at + 4 <= bytes.size(); ++at) {
      for (const std::uint32_t number : {UINT32_MAX, 0x80000000U, 0x7FFFFFFFU, 0x40000000U}) {
        std::string changed = bytes;
        (void)try_volume(file.name, changed.replace(at, 4, pack(number)), file.layout);
      }
    }
  }
}

}  // namespace
}  // namespace relief::test
