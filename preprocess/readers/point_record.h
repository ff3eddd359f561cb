// Points whose attributes come side by side, each under a name: PLY vertices, PCD points, columns.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "common/points.h"
#include "preprocess/readers/colours.h"
#include "preprocess/readers/source.h"

namespace relief {

/// What a named number means.
enum Role : std::uint8_t { X, Y, Z, Nx, Ny, Nz, Red, Green, Blue, U, V, Other };
inline constexpr std::size_t kRoles = Other + 1;

/// The numbers of one point, by role.
using PointRecord = std::array<double, kRoles>;

/// What a name (in lower case) means in any of the formats: x y z; nx or normal_x ...; red, r or
/// diffuse_red ...; s t, u v or texture_u texture_v.
[[nodiscard]] Role role_of(std::string_view name);

/// Which roles a record fills. Of two numbers with the same role the first counts.
class RecordLayout {
 public:
  /// Adds the next number of the record; gives the role under which it is to be stored.
  Role add(Role role);

  [[nodiscard]] bool positions() const { return has_[X] && has_[Y] && has_[Z]; }
  [[nodiscard]] bool normals() const { return has_[Nx] && has_[Ny] && has_[Nz]; }
  [[nodiscard]] bool colours() const { return has_[Red] && has_[Green] && has_[Blue]; }
  [[nodiscard]] bool texcoords() const { return has_[U] && has_[V]; }

 private:
  std::array<bool, kRoles> has_{};
};

/// Makes points from records.
class PointCollector {
 public:
  /// `count`: records to come, already checked against the size of the file.
  PointCollector(const RecordLayout& layout, ColourNumbers colour_numbers, std::size_t count);

  void add(const PointRecord& record);
  [[nodiscard]] Points finish();

  /// Whether the source's sink, if it has one, shall have what is there.
  [[nodiscard]] bool is_block(const Source& source) const {
    return source.sink != nullptr && points_.positions.size() >= PointSink::kBlockPoints;
  }
  /// Gives the sink what is there. The first block tells the scale of colours; fails if later ones
  /// do not fit into it.
  Status give_block(const Source& source);

 private:
  RecordLayout layout_;
  ColourNumbers colour_numbers_;
  Points points_;
  std::vector<glm::vec3> colours_;
  std::optional<float> colour_scale_;  ///< once a block has told it
};

}  // namespace relief
