// What clicks and keys do while one measures.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "viewer/measuring/measurement.h"

namespace relief {

/// A point of the surface under the cursor.
struct PickedPoint {
  SurfacePoint point;
  bool is_exact = true;  ///< of a SurfacePicker or TilePicker; else of a depth in single precision,
                         ///< with a normal of 0 and no colour
};

/// The measuring tools: which one is chosen, the points of the measurement that is open, and the
/// list of those that are complete.
class MeasuringTool {
 public:
  /// Chooses a tool. Drops the open measurement.
  void choose(MeasurementKind kind);

  /// Puts the tool away, with the open measurement.
  void put_away();

  /// The chosen tool; none: clicks do not measure.
  [[nodiscard]] std::optional<MeasurementKind> chosen() const { return chosen_; }

  /// Adds a point. A measurement that then has all its points goes to the list; a polyline waits
  /// for finish(). Does nothing without a tool.
  void add(const SurfacePoint& point);

  /// Ends a polyline that has at least two points. Returns whether there was one.
  bool finish();

  /// Drops the open measurement, or without one puts the tool away. Returns whether there was
  /// either.
  bool escape();

  /// Takes the last point of the open measurement back. Returns whether there was one.
  bool remove_last();

  /// The points of the measurement that is open; empty: none is.
  [[nodiscard]] const std::vector<SurfacePoint>& open_points() const { return open_; }

  /// Returns the open measurement as it will be once `next` is added; none if there is no open one,
  /// or if it will still lack a point.
  [[nodiscard]] std::optional<Measurement> preview(const SurfacePoint& next) const;

  [[nodiscard]] const std::vector<Measurement>& list() const { return list_; }
  void rename(std::size_t index, std::string name);
  void remove(std::size_t index);
  void clear() { list_.clear(); }

 private:
  void complete();

  std::optional<MeasurementKind> chosen_;
  std::vector<SurfacePoint> open_;
  std::vector<Measurement> list_;
  std::size_t named_ = 0;  ///< how many have got a name
};

}  // namespace relief
