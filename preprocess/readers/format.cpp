#include "preprocess/readers/format.h"

#include <algorithm>
#include <string>
#include <utility>

#include "preprocess/readers/readers.h"

namespace relief {
namespace {

/// The ending of the name in lower case, that of the packed file if it ends with ".gz".
std::string ending(std::filesystem::path path) {
  const auto lower = [](const std::filesystem::path& p) {
    return lower_case(p.extension().string());
  };
  if (lower(path) == ".gz") path = path.stem();
  return lower(path);
}

Reader reader_by_content(std::string_view text) {
  if (is_ply(text)) return read_ply;
  if (is_pcd(text)) return read_pcd;
  if (is_las(text)) return read_las;
  if (is_binary_stl(text) || is_ascii_stl(text)) return read_stl;
  if (is_off(text)) return read_off;
  if (is_glb(text)) return read_gltf;
  if (is_drc(text)) return read_drc;
  return nullptr;
}

Reader reader_by_name(std::string_view name) {
  constexpr std::pair<std::string_view, Reader> readers[] = {
      {".ply", read_ply},    {".pcd", read_pcd},  {".obj", read_obj}, {".off", read_off},
      {".gltf", read_gltf},  {".glb", read_gltf}, {".stl", read_stl}, {".xyz", read_xyz},
      {".txt", read_xyz},    {".csv", read_xyz},  {".asc", read_xyz}, {".pts", read_xyz},
      {".xyzrgb", read_xyz}, {".xyzn", read_xyz}, {".las", read_las}, {".laz", read_las},
      {".ptx", read_ptx},    {".drc", read_drc}};
  for (const auto& [ending, reader] : readers) {
    if (ending == name) return reader;
  }
  return nullptr;
}

/// Formats that people may try, by their first bytes; empty if it is none of them.
std::string_view other_format(std::string_view text) {
  constexpr std::pair<std::string_view, std::string_view> others[] = {
      {"PK\x03\x04", "a ZIP archive"},
      {"BZh", "packed with bzip2"},
      {"\xFD"
       "7zXZ",
       "packed with xz"},
      {"\x28\xB5\x2F\xFD", "packed with zstd"},
      {"\x1F\x8B", "packed with gzip twice"}};
  for (const auto& [magic, what] : others) {
    if (text.starts_with(magic)) return what;
  }
  return {};
}

}  // namespace

Result<Reader> find_reader(const std::filesystem::path& path, std::string_view text) {
  constexpr std::string_view readable =
      "PLY, PCD, LAS, PTX, OBJ, glTF, Draco, OFF, STL and XYZ text, plain or gzipped";
  if (const Reader reader = reader_by_content(text)) return reader;
  if (text.starts_with("ASTM-E57")) {
    return make_error(
        "{}: is an E57 file, which cannot be read; convert it first, with `pdal translate IN.e57 "
        "OUT.las` or CloudCompare",
        path.string());
  }
  if (const auto other = other_format(text); !other.empty()) {
    return make_error("{}: is {}, which cannot be read; {} can", path.string(), other, readable);
  }
  const Reader reader = reader_by_name(ending(path));
  if (reader == nullptr) {
    return make_error("{}: neither its first bytes nor its name tell a format that can be read: {}",
                      path.string(), readable);
  }
  const bool is_text =
      reader == read_obj || reader == read_off || reader == read_xyz || reader == read_ptx;
  if (is_text && text.substr(0, 4096).find('\0') != text.npos) {
    return make_error("{}: has bytes of value 0, so it is not the plain text that its name says",
                      path.string());
  }
  return reader;
}

bool reads_in_blocks(Reader reader) {
  return reader == read_ply || reader == read_las || reader == read_xyz;
}

}  // namespace relief
