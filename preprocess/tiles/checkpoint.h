// Checkpoints of a conversion in tiles, from which a later run continues. Valid only on this
// machine and for this version; a checksum detects damage.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

#include "common/error.h"

namespace relief {

/// Collects numbers and lists of numbers, then writes them at once.
class CheckpointWriter {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) { append(std::as_bytes(std::span(&value, 1))); }

  template <class T>
  void put(const std::vector<T>& list) {
    put(std::uint64_t{list.size()});
    if constexpr (std::is_trivially_copyable_v<T>) {
      append(std::as_bytes(std::span(list)));
    } else {
      for (const T& item : list) put(item);
    }
  }

  /// Writes `path` atomically.
  Status save(const std::filesystem::path& path) const;

 private:
  void append(std::span<const std::byte> bytes) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + bytes.size());
    if (!bytes.empty()) std::memcpy(bytes_.data() + at, bytes.data(), bytes.size());
  }

  std::vector<std::byte> bytes_;
};

/// Reads the values of a CheckpointWriter, in their order.
class CheckpointReader {
 public:
  /// Fails with one sentence if the file is missing or damaged.
  static Result<CheckpointReader> open(const std::filesystem::path& path);

  /// Returns false if the file lacks this value, because another version wrote it.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  [[nodiscard]] bool take(T& value) {
    if (left() < sizeof(T)) return false;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return true;
  }

  template <class T>
  [[nodiscard]] bool take(std::vector<T>& list) {
    std::uint64_t count = 0;
    if constexpr (std::is_trivially_copyable_v<T>) {
      if (!take(count) || count > left() / sizeof(T)) return false;
      list.resize(count);
      if (count > 0) std::memcpy(list.data(), bytes_.data() + at_, count * sizeof(T));
      at_ += count * sizeof(T);
      return true;
    } else {
      // Each item stores its own count.
      if (!take(count) || count > left() / sizeof(std::uint64_t)) return false;
      list.resize(count);
      return std::all_of(list.begin(), list.end(), [this](T& item) { return take(item); });
    }
  }

 private:
  explicit CheckpointReader(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

  std::vector<std::byte> bytes_;
  std::size_t at_ = 0;
};

/// Returns the error of an undamaged checkpoint that this program did not write.
[[nodiscard]] Error wrong_checkpoint(const std::filesystem::path& path);

/// Writes a file of these values (std::tie), atomically.
template <class... Values>
Status save_checkpoint(const std::filesystem::path& path, const std::tuple<Values&...>& values) {
  CheckpointWriter state;
  std::apply([&](const auto&... value) { (state.put(value), ...); }, values);
  return state.save(path);
}

/// Reads the values that save_checkpoint wrote.
template <class... Values>
Status load_checkpoint(const std::filesystem::path& path, const std::tuple<Values&...>& values) {
  RELIEF_TRY_ASSIGN(auto state, CheckpointReader::open(path));
  const bool whole = std::apply([&](auto&... value) { return (state.take(value) && ...); }, values);
  return whole ? Status{} : wrong_checkpoint(path);
}

}  // namespace relief
