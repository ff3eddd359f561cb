// Which points of a file are read.
#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/bounds.h"
#include "common/error.h"
#include "common/points.h"
#include "common/scalars/scalar_names.h"

namespace relief {

/// Which returns of a laser pulse are read.
enum class ReturnChoice : std::uint8_t {
  All,
  First,
  Last,
  Single,   ///< of pulses with one return
  Numbered  ///< those of PointSelection::return_number
};

/// The points to read. Classes and returns are those of LAS and LAZ; the other formats have none.
struct PointSelection {
  std::bitset<256> classes = {};  ///< none: all but noise. Named noise is read.
  ReturnChoice returns = ReturnChoice::All;
  unsigned return_number = 1;  ///< 1 to 15
  /// In the scan's own coordinates, borders included; may be infinite along z.
  std::optional<Bounds> crop = {};

  [[nodiscard]] bool asks_for_classes() const {
    return classes.any() || returns != ReturnChoice::All;
  }
  [[nodiscard]] bool selects() const { return asks_for_classes() || crop.has_value(); }
};

/// How files are read.
struct ReadOptions {
  PointSelection selection = {};
  ScalarChoice scalars = {};  ///< those to keep
  /// One of PointFormat's extensions, which names the format; empty: by content, then extension.
  std::string format = {};
};

/// Returns the classes and returns as options ("--classes 2,6 --returns last"); empty if all.
[[nodiscard]] std::string describe_classes(const PointSelection& selection);

/// Returns a box as the value of --crop, and z only if it is finite.
[[nodiscard]] std::string describe_box(const Bounds& box);

/// Drops the points outside of the box, NaN included, and their triangles. Returns their number.
std::uint64_t crop_points(Points& points, const Bounds& box);

/// Returns the error of a scan of which the crop leaves nothing. `bounds`: of all its points.
[[nodiscard]] Error nothing_in_crop(std::string_view name, const Bounds& crop,
                                    const Bounds& bounds);

}  // namespace relief
