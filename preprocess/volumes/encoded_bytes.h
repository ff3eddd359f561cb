// Bytes that are written as they are or as base64.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace relief {

/// Takes bytes from the front of a text. Base64 is decoded when it is taken.
class EncodedBytes {
 public:
  EncodedBytes(std::string_view text, bool is_base64) : text_(text), is_base64_(is_base64) {}

  /// Returns an upper bound of the number of bytes that are left.
  [[nodiscard]] std::uint64_t left() const {
    return is_base64_ ? text_.size() / 4 * 3 : text_.size();
  }
  /// Takes the next `count` bytes into `bytes`, valid until the next call. Base64 is taken by
  /// groups of four letters, blanks between them are skipped, and what the last group has beyond is
  /// lost: encoders end what they write by itself with a padded group. Returns false, before it
  /// takes memory, if fewer are left, and if the text is not base64.
  [[nodiscard]] bool take(std::uint64_t count, std::span<const std::byte>& bytes);

 private:
  [[nodiscard]] bool take_group(std::byte (&group)[3]);

  std::string_view text_;
  bool is_base64_;
  std::vector<std::byte> decoded_;
};

}  // namespace relief
