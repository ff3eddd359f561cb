#include "preprocess/readers/format.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "preprocess/readers/readers.h"

namespace relief {
namespace {

/// STL comes after the other recognised formats, because a binary STL file is recognised only by
/// its length.
constexpr PointFormat kPointFormats[] = {
    {"PLY", "ply", is_ply, FileForm::Either, true, read_ply},
    {"PCD", "pcd", is_pcd, FileForm::Either, false, read_pcd},
    {"LAS", "las laz", is_las, FileForm::Binary, true, read_las, true},
    {"PTX", "ptx", nullptr, FileForm::Text, false, read_ptx},
    {"OBJ", "obj", nullptr, FileForm::Text, false, read_obj},
    {"glTF", "gltf glb", is_glb, FileForm::Either, false, read_gltf},
    {"Draco", "drc", is_drc, FileForm::Binary, false, read_drc},
    {"OFF", "off", is_off, FileForm::Text, false, read_off},
    {"STL", "stl", is_stl, FileForm::Either, false, read_stl},
    {"XYZ text", "xyz txt csv asc pts xyzrgb xyzn", nullptr, FileForm::Text, true, read_xyz},
};

/// Returns the extension in lower case without its dot; for packed files the one before ".gz".
std::string extension_of(std::filesystem::path path) {
  if (lower_case(path.extension().string()) == ".gz") path = path.stem();
  const std::string extension = lower_case(path.extension().string());
  return extension.empty() ? extension : extension.substr(1);
}

/// Describes an unsupported file by its first bytes; empty if unknown.
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

/// "A, B and C"
std::string join_names(const std::vector<std::string_view>& names) {
  std::string joined;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k > 0) joined += k + 1 == names.size() ? " and " : ", ";
    joined += names[k];
  }
  return joined;
}

}  // namespace

bool PointFormat::has_extension(std::string_view extension) const {
  for (std::string_view left = extensions; !left.empty();) {
    const std::size_t end = std::min(left.find(' '), left.size());
    if (left.substr(0, end) == extension) return true;
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return false;
}

std::string_view PointFormat::target() const {
  return extensions.substr(0, extensions.find(' '));
}

std::span<const PointFormat> point_formats() {
  return kPointFormats;
}

std::string readable_formats() {
  std::vector<std::string_view> names;
  for (const PointFormat& format : kPointFormats) names.push_back(format.name);
  return join_names(names);
}

std::string streamed_formats() {
  std::vector<std::string_view> names;
  for (const PointFormat& format : kPointFormats) {
    if (format.streams) names.push_back(format.name);
  }
  return join_names(names);
}

const PointFormat* format_named(std::string_view extension) {
  const auto* const format = std::ranges::find_if(
      kPointFormats, [&](const PointFormat& f) { return f.has_extension(extension); });
  return format == std::end(kPointFormats) ? nullptr : format;
}

Result<const PointFormat*> find_format(const std::filesystem::path& path, std::string_view text,
                                       std::string_view stated) {
  if (const PointFormat* const format = format_named(stated); format != nullptr) return format;
  for (const PointFormat& format : kPointFormats) {
    if (format.recognises != nullptr && format.recognises(text)) return &format;
  }
  if (text.starts_with("\x89RLF") || extension_of(path) == "relief") {
    return make_error(
        "{}: is a patch file already; `relief info` prints what it holds, `relief render` draws it",
        path.string());
  }
  if (text.starts_with("ASTM-E57")) {
    return make_error(
        "{}: E57 files cannot be read; convert it first, with `pdal translate IN.e57 OUT.las` or "
        "CloudCompare",
        path.string());
  }
  if (const auto other = other_format(text); !other.empty()) {
    return make_error("{}: is {}, which cannot be read; readable formats are {}, plain or gzipped",
                      path.string(), other, readable_formats());
  }
  const std::string extension = extension_of(path);
  const PointFormat* const format = format_named(extension);
  if (format == nullptr) {
    return make_error(
        "{}: neither its content nor its extension is of a readable format; readable formats are "
        "{}, plain or gzipped; --format names one",
        path.string(), readable_formats());
  }
  if (format->form == FileForm::Text && text.substr(0, 4096).find('\0') != text.npos) {
    return make_error("{}: contains bytes of value 0, so it is not {} as its extension says",
                      path.string(), format->name);
  }
  return format;
}

Status check_classes(const std::string& name, const PointFormat& format,
                     const PointSelection& selection) {
  if (format.has_classes || !selection.asks_for_classes()) return {};
  return make_error("{}: is {}, which has no classes or returns; leave out {}", name, format.name,
                    describe_classes(selection));
}

}  // namespace relief
