// What a conversion in tiles keeps on disk from step to step, so that a later run can go on from
// there. Of this machine and this version alone; a checksum tells damage.
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

/// Collects numbers and lists of them, then writes them at once.
class StateWriter {
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

  /// Writes beside and renames: `path` is whole or not there.
  Status save(const std::filesystem::path& path) const;

 private:
  void append(std::span<const std::byte> bytes) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + bytes.size());
    if (!bytes.empty()) std::memcpy(bytes_.data() + at, bytes.data(), bytes.size());
  }

  std::vector<std::byte> bytes_;
};

/// Reads what StateWriter wrote, in the same order.
class StateReader {
 public:
  /// Fails with one sentence if the file is missing or damaged.
  static Result<StateReader> open(const std::filesystem::path& path);

  /// False if the file has no such value: it is of another version.
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
      // Each item has its own count.
      if (!take(count) || count > left() / sizeof(std::uint64_t)) return false;
      list.resize(count);
      return std::all_of(list.begin(), list.end(), [this](T& item) { return take(item); });
    }
  }

 private:
  explicit StateReader(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

  std::vector<std::byte> bytes_;
  std::size_t at_ = 0;
};

/// For a state file that is whole but not what this program writes.
[[nodiscard]] Error wrong_state(const std::filesystem::path& path);

/// Writes a file of these values (std::tie), whole or not at all.
template <class... Values>
Status save_state(const std::filesystem::path& path, const std::tuple<Values&...>& values) {
  StateWriter state;
  std::apply([&](const auto&... value) { (state.put(value), ...); }, values);
  return state.save(path);
}

/// Reads what save_state wrote of the same values.
template <class... Values>
Status load_state(const std::filesystem::path& path, const std::tuple<Values&...>& values) {
  auto state = StateReader::open(path);
  if (!state) return state.error();
  const bool whole =
      std::apply([&](auto&... value) { return (state->take(value) && ...); }, values);
  return whole ? Status{} : wrong_state(path);
}

}  // namespace relief
