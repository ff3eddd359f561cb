// Points stored as records of named numbers: PLY vertices, PCD points, text columns.
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

/// The meaning of a number in a record.
enum Role : std::uint8_t { X, Y, Z, Nx, Ny, Nz, Red, Green, Blue, U, V, Other };
inline constexpr std::size_t kRoles = Other + 1;

/// The numbers of one point, by role. Scalars follow the roles.
using PointRecord = std::array<double, kRoles + kMaxScalars>;

/// Returns the role of a name (in lower case) in any of the formats: x y z; nx or normal_x ...;
/// red, r or diffuse_red ...; s t, u v or texture_u texture_v.
[[nodiscard]] Role role_of(std::string_view name);

/// The roles of a record's numbers. If two numbers have one role, the first counts.
class RecordLayout {
 public:
  /// Adds the next number of the record and returns the role under which to store it.
  Role add(Role role);
  /// The same for a number of this name in the file (lower case), which is a scalar if it has no
  /// other role and the source takes it.
  Role add(std::string_view name, const Source& source);

  [[nodiscard]] bool positions() const { return has_[X] && has_[Y] && has_[Z]; }
  [[nodiscard]] bool normals() const { return has_[Nx] && has_[Ny] && has_[Nz]; }
  [[nodiscard]] bool colours() const { return has_[Red] && has_[Green] && has_[Blue]; }
  [[nodiscard]] bool texcoords() const { return has_[U] && has_[V]; }
  /// The names of the scalars; the first is stored behind the last role.
  [[nodiscard]] const std::vector<std::string>& scalars() const { return scalars_; }

 private:
  std::array<bool, kRoles> has_{};
  std::vector<std::string> scalars_;
};

/// Makes points from records.
class PointCollector {
 public:
  /// `count`: number of records, already checked against the size of the file.
  PointCollector(RecordLayout layout, ColourNumbers colour_numbers, std::size_t count);

  void add(const PointRecord& record);
  [[nodiscard]] Points finish();

  /// Returns whether a full block is ready for the source's sink.
  [[nodiscard]] bool is_block(const Source& source) const {
    return source.sink != nullptr && points_.positions.size() >= PointSink::kBlockPoints;
  }
  /// Passes the collected points to the sink. The first block determines the scale of colours;
  /// fails if a later one exceeds it.
  Status give_block(const Source& source);

 private:
  void begin_scalars(std::size_t count);

  RecordLayout layout_;
  ColourNumbers colour_numbers_;
  Points points_;
  std::vector<glm::vec3> colours_;
  std::optional<float> colour_scale_;  ///< set by the first block
};

}  // namespace relief
