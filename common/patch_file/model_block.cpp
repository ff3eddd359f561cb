#include "common/patch_file/model_block.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/extremes.h"
#include "common/io/crc32.h"
#include "common/io/vector_bytes.h"
#include "common/patch_file/scalar_table.h"

namespace relief {
namespace {

constexpr std::array<char, 4> kExtremesEntry{'E', 'X', 'T', 'R'};
constexpr std::array<char, 4> kStanceEntry{'S', 'T', 'N', 'D'};
constexpr std::array<char, 4> kScalarsEntry{'S', 'C', 'L', 'S'};

constexpr std::size_t kEntryHeader = 8;
constexpr std::size_t kExtremeBytes = 6;
constexpr std::size_t kStanceBytes = 49;
constexpr std::size_t kChecksumBytes = 4;

constexpr std::uint8_t kFromSensorFlag = 1;

/// Directions of a stance are unit vectors at right angles up to this, as the axes of patches are.
constexpr double kUnitTolerance = 1e-6;

void append_entry(std::vector<std::byte>& out, const std::array<char, 4>& type,
                  const std::vector<std::byte>& content) {
  for (const char c : type) append_number(out, static_cast<std::uint8_t>(c));
  append_number(out, static_cast<std::uint32_t>(content.size()));
  out.insert(out.end(), content.begin(), content.end());
}

std::vector<std::byte> extremes_content(const std::vector<glm::dvec3>& extremes,
                                        const Bounds& bounds) {
  std::vector<std::byte> out;
  for (const glm::dvec3& point : extremes) {
    const glm::u16vec3 steps = extreme_steps(point, bounds);
    for (glm::length_t c = 0; c < 3; ++c) append_number(out, steps[c]);
  }
  return out;
}

std::vector<std::byte> stance_content(const Stance& stance) {
  std::vector<std::byte> out;
  append_vector(out, stance.up);
  append_vector(out, stance.front);
  append_number(out, stance.is_from_sensor ? kFromSensorFlag : std::uint8_t{0});
  return out;
}

/// Returns what is wrong with an entry, as a clause; empty if nothing is.
std::string take_extremes(ByteReader in, const Bounds& bounds, ModelBlock& block) {
  if (in.left() % kExtremeBytes != 0 || bounds.empty()) return "its extreme points are cut off";
  while (in.left() > 0) {
    glm::u16vec3 steps;
    for (glm::length_t c = 0; c < 3; ++c) steps[c] = in.take<std::uint16_t>();
    block.extremes.push_back(extreme_at(steps, bounds));
  }
  return {};
}

std::string take_stance(ByteReader in, ModelBlock& block) {
  if (in.left() != kStanceBytes) return "its stance has the wrong size";
  Stance& stance = block.stance;
  stance.up = take_vector(in);
  stance.front = take_vector(in);
  stance.is_from_sensor = (in.take<std::uint8_t>() & kFromSensorFlag) != 0;
  const auto is_one = [](double value) { return std::abs(value - 1.0) <= kUnitTolerance; };
  if (is_one(glm::length(stance.up)) && is_one(glm::length(stance.front)) &&
      std::abs(glm::dot(stance.up, stance.front)) <= kUnitTolerance)
    return {};
  return "its stance is not of unit vectors at right angles";
}

std::string take_scalars(std::span<const std::byte> bytes, ModelBlock& block) {
  auto scalars = parse_scalar_table(bytes);
  if (!scalars) return scalars.error().message;
  block.scalars = *std::move(scalars);
  return {};
}

}  // namespace

std::vector<std::byte> write_model_block(const ModelBlock& block, const Bounds& bounds) {
  std::vector<std::byte> out;
  if (!block.extremes.empty() && !bounds.empty())
    append_entry(out, kExtremesEntry, extremes_content(block.extremes, bounds));
  if (block.stance != Stance{}) append_entry(out, kStanceEntry, stance_content(block.stance));
  if (!block.scalars.empty()) append_entry(out, kScalarsEntry, write_scalar_table(block.scalars));
  if (!out.empty()) append_number(out, crc32(out));
  return out;
}

Result<ModelBlock> parse_model_block(std::span<const std::byte> bytes, const Bounds& bounds,
                                     const std::string& name) {
  const auto damaged = [&name](const std::string& what) {
    return make_error("{}: the model block is wrong: {}; the file is damaged", name, what);
  };
  ModelBlock block;
  if (bytes.empty()) return block;
  if (bytes.size() < kChecksumBytes) return damaged("it has no checksum");
  const std::size_t size = bytes.size() - kChecksumBytes;
  ByteReader checksum(bytes.subspan(size));
  if (!has_checksum(bytes.first(size), checksum.take<std::uint32_t>()))
    return damaged("its checksum differs");
  ByteReader in(bytes.first(size));
  while (in.left() > 0) {
    if (in.left() < kEntryHeader) return damaged("an entry is cut off");
    std::array<char, 4> type{};
    for (char& c : type) c = static_cast<char>(in.take<std::uint8_t>());
    const auto length = in.take<std::uint32_t>();
    if (length > in.left()) return damaged("an entry is cut off");
    const std::span<const std::byte> bytes_of_entry = in.take_bytes(length);
    const ByteReader content(bytes_of_entry);
    std::string fault;
    if (type == kExtremesEntry) fault = take_extremes(content, bounds, block);
    if (type == kStanceEntry) fault = take_stance(content, block);
    if (type == kScalarsEntry) fault = take_scalars(bytes_of_entry, block);
    if (!fault.empty()) return damaged(fault);
  }
  return block;
}

}  // namespace relief
