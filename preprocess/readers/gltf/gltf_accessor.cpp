#include "preprocess/readers/gltf/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace relief {
namespace {

/// Returns whether a file's index is valid for one of its lists.
template <class List>
bool is_index(int index, const List& list) {
  return index >= 0 && static_cast<std::size_t>(index) < list.size();
}

template <class Number>
double take(const std::byte* bytes, bool normalised) {
  Number number{};
  std::memcpy(&number, bytes, sizeof(number));
  const auto value = static_cast<double>(number);
  if (!normalised || !std::numeric_limits<Number>::is_integer) return value;
  return std::max(value / static_cast<double>(std::numeric_limits<Number>::max()), -1.0);
}

/// Returns the function that reads a number of an accessor; null for types that glTF does not have.
using Take = double (*)(const std::byte*, bool);
Take take_for(int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return take<std::int8_t>;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return take<std::uint8_t>;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return take<std::int16_t>;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return take<std::uint16_t>;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return take<std::uint32_t>;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return take<float>;
    default:
      return nullptr;
  }
}

}  // namespace

Result<std::span<const std::byte>> view_bytes(const tinygltf::Model& model, int view) {
  if (!is_index(view, model.bufferViews)) return make_error("there is no bufferView {}", view);
  const tinygltf::BufferView& buffer_view = model.bufferViews[static_cast<std::size_t>(view)];
  if (!is_index(buffer_view.buffer, model.buffers))
    return make_error("there is no buffer {}", buffer_view.buffer);
  const auto& data = model.buffers[static_cast<std::size_t>(buffer_view.buffer)].data;
  if (buffer_view.byteOffset > data.size() ||
      buffer_view.byteLength > data.size() - buffer_view.byteOffset)
    return make_error("bufferView {} reaches beyond its buffer of {} bytes", view, data.size());
  return std::as_bytes(std::span(data)).subspan(buffer_view.byteOffset, buffer_view.byteLength);
}

Result<std::vector<double>> read_accessor(const tinygltf::Model& model, int index, int components) {
  if (!is_index(index, model.accessors)) return make_error("there is no accessor {}", index);
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  if (accessor.sparse.isSparse)
    return make_error("accessor {} is sparse, which is not read", index);
  const Take read = take_for(accessor.componentType);
  if (read == nullptr ||
      tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != components)
    return make_error("accessor {} does not have {} numbers an element", index, components);
  RELIEF_TRY_ASSIGN(const auto bytes, view_bytes(model, accessor.bufferView));
  const auto number = static_cast<std::size_t>(
      tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
  const std::size_t element = number * static_cast<std::size_t>(components);
  const std::size_t stated =
      model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
  const std::size_t stride = stated == 0 ? element : stated;
  const std::size_t left = bytes.size() - std::min(accessor.byteOffset, bytes.size());
  if (accessor.count == 0) return std::vector<double>();
  if (left < element || accessor.count - 1 > (left - element) / stride)
    return make_error("accessor {} reaches beyond its bufferView", index);
  std::vector<double> numbers;
  numbers.reserve(accessor.count * static_cast<std::size_t>(components));
  for (std::size_t k = 0; k < accessor.count; ++k) {
    const std::byte* at = bytes.data() + accessor.byteOffset + k * stride;
    for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c)
      numbers.push_back(read(at + c * number, accessor.normalized));
  }
  return numbers;
}

}  // namespace relief
