#include "preprocess/readers/gltf/gltf_parse.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "common/guard.h"
#include "common/io/file.h"
#include "preprocess/readers/readers.h"
#include "preprocess/texture/files/load_textures.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// Limits the recursion of tinygltf's parser in nested JSON.
constexpr int kMaxDepth = 64;

bool nests_too_deep(std::string_view json) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t k = 0; k < json.size(); ++k) {
    const char c = json[k];
    if (in_text) {
      if (c == '\\') ++k;
      in_text = c != '"';
    } else if (c == '"') {
      in_text = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxDepth) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

/// Keeps an image's bytes undecoded: common/image/image_io.h decodes used images. Images in buffer
/// views are read later, with their bounds checked.
bool keep_image(tinygltf::Image* image, int /*index*/, std::string* /*error*/,
                std::string* /*warning*/, int /*width*/, int /*height*/, const unsigned char* bytes,
                int count, void* /*user*/) {
  if (image->bufferView < 0 && bytes != nullptr && count > 0)
    image->image.assign(bytes, bytes + count);
  return true;
}

bool file_is_there(const std::string& name, void* user) {
  std::error_code ignored;
  return fs::is_regular_file(resolve_beside(*static_cast<const fs::path*>(user), name), ignored);
}

bool read_beside(std::vector<unsigned char>* out, std::string* error, const std::string& name,
                 void* user) {
  const auto bytes = read_file(resolve_beside(*static_cast<const fs::path*>(user), name));
  if (!bytes) {
    *error += bytes.error().message;
    return false;
  }
  const auto* const begin = reinterpret_cast<const unsigned char*>(bytes->data());
  out->assign(begin, begin + bytes->size());
  return true;
}

bool refuse_to_write(std::string* /*error*/, const std::string& /*name*/,
                     const std::vector<unsigned char>& /*bytes*/, void* /*user*/) {
  return false;
}

/// Lets tinygltf read files beside the glTF file only. All callbacks are set: version 2.9 would
/// otherwise go on with its own, which open any file. Versions from 2.8 on also ask for a file's
/// size, and refuse files of more than 2 GiB by default.
void read_files_beside(auto& loader, fs::path& owner) {
  const auto set_callbacks = [&](auto callbacks) {
    callbacks.FileExists = file_is_there;
    callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
    callbacks.ReadWholeFile = read_beside;
    callbacks.WriteWholeFile = refuse_to_write;
    callbacks.user_data = &owner;
    if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
      callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string* error,
                                        const std::string& name, void* user) {
        std::error_code failed;
        const auto found =
            fs::file_size(resolve_beside(*static_cast<const fs::path*>(user), name), failed);
        if (failed) *error += failed.message();
        *size = failed ? 0 : static_cast<std::size_t>(found);
        return !failed;
      };
    }
    loader.SetFsCallbacks(callbacks);
  };
  set_callbacks(tinygltf::FsCallbacks{});
  if constexpr (requires { loader.SetMaxExternalFileSize(SIZE_MAX); })
    loader.SetMaxExternalFileSize(SIZE_MAX);
}

/// The first line of tinygltf's message.
std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "it is not glTF 2.0" : line;
}

/// The end of the JSON text: in a binary file it is the first chunk, after 20 bytes.
std::size_t json_end(std::string_view text) {
  if (!is_glb(text) || text.size() < 20) return text.size();
  std::uint32_t length = 0;
  std::memcpy(&length, text.data() + 12, 4);
  return std::min<std::size_t>(text.size(), std::size_t{20} + length);
}

}  // namespace

bool is_glb(std::string_view text) {
  return text.starts_with("glTF");
}

Result<tinygltf::Model> parse_gltf(const Source& source) {
  if (nests_too_deep(source.text.substr(0, json_end(source.text))))
    return make_error("{}: its JSON nests deeper than {} levels", source.name, kMaxDepth);
  fs::path path(source.name);
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_image, nullptr);
  read_files_beside(loader, path);
  std::string error;
  std::string warning;
  const auto size = static_cast<unsigned int>(source.text.size());
  if (source.text.size() > UINT32_MAX)
    return make_error("{}: is larger than the 4 GiB that glTF allows", source.name);
  const auto load = [&]() -> Result<tinygltf::Model> {
    tinygltf::Model model;
    const char* const text = source.text.data();
    const bool good =
        is_glb(source.text)
            ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                          reinterpret_cast<const unsigned char*>(text), size)
            : loader.LoadASCIIFromString(&model, &error, &warning, text, size, "");
    if (good) return model;
    return make_error("{}: cannot be read as glTF: {}", source.name, first_line(error));
  };
  // tinygltf 2.8 throws std::out_of_range on a buffer of no bytes.
  return guarded({.subject = source.name,
                  .task = "read it",
                  .library = "tinygltf",
                  .advice = "the file may be damaged: write it again, or convert it to PLY",
                  .memory_advice = "convert it to PLY, which --memory reads in blocks"},
                 load);
}

}  // namespace relief
